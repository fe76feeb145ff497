#include "friction.hpp"

namespace rollbem {

template class detail::ActiveSet<double>;
template class detail::FrictionCore<double>;
template class SteadyFrictionModel<double>;
template class FrictionModel<double>;
template class detail::CombinedSolver<double>;
template class detail::CombinedCore<double>;
template class SteadyCombinedModel<double>;
template class CombinedFrictionModel<double>;

}  // namespace rollbem
