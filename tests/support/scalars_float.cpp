#include "scalars.hpp"

namespace rollbem {

ROLLBEM_SCALARS(, float)

}  // namespace rollbem
