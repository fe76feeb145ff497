#include "support/scalars.hpp"

namespace rollbem {

ROLLBEM_LONG_DOUBLE()

}  // namespace rollbem
