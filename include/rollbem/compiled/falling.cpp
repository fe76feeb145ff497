#include "falling.hpp"

namespace rollbem {

template class detail::FallingSet<double>;
template class detail::FallingStages<ExponentialFall<double>, double>;
template class SteadyFallingModel<ExponentialFall<double>, double>;
template class FallingFrictionModel<ExponentialFall<double>, double>;

}  // namespace rollbem
