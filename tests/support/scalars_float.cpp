#include "support/scalars.hpp"

namespace rollbem {

ROLLBEM_SCALARS(, float)

}  // namespace rollbem
