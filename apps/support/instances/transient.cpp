// Steps in time compiled for double.
#include <rollbem/problem/transient.hpp>

namespace rollbem {

template class TransientModel<double>;

}  // namespace rollbem
