// Steps in time compiled for double.
#include <rollbem/adhesion/transient.hpp>

namespace rollbem {

template class TransientModel<double>;

}  // namespace rollbem
