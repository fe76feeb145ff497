#include "support/scalars.hpp"

namespace rollbem {

ROLLBEM_SCALARS(, long double)

}  // namespace rollbem
