// The unit of a mixed pair with the headers alone.
#include "mixed.hpp"

Made make_by_headers() { return {&rollbem::s1002, rollbem::s1002().moved(0.01, 0, 0)}; }
