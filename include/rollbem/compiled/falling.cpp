#include "falling.hpp"

namespace rollbem {

template class detail::FallingSet<detail::ActiveSetSlip<double>>;
template class detail::FallingStages<ExponentialFall<double>, detail::ActiveSetSlip<double>>;
template class SteadyFallingModel<ExponentialFall<double>, double>;
template class FallingFrictionModel<ExponentialFall<double>, double>;

}  // namespace rollbem
