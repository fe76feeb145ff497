#include "transient.hpp"

namespace rollbem {

template class TransientModel<double>;

}  // namespace rollbem
