#include "friction.hpp"

namespace rollbem {

template class detail::ActiveSet<double>;
template class detail::FrictionCore<double>;
template class SteadyFrictionModel<double>;
template class FrictionModel<double>;

}  // namespace rollbem
