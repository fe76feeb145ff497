#include "friction.hpp"

namespace rollbem {

template class detail::ActiveSet<double>;
template class detail::CombinedSolver<double>;
template class detail::FallingSet<detail::ActiveSetSlip<double>>;
template class detail::FallingSet<detail::CombinedSlip<double>>;
template class detail::FrictionCore<ConstantFriction<double>, 1, double>;
template class detail::FrictionCore<ConstantFriction<double>, 2, double>;
template class detail::FrictionCore<ExponentialFall<double>, 1, double>;
template class detail::FrictionCore<ExponentialFall<double>, 2, double>;

}  // namespace rollbem
