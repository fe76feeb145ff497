// Friction compiled for double, with a constant coefficient and with one that falls exponentially with slip. Replaces
// friction/friction.hpp; link rollbem::compiled. Other laws are compiled where they are used.
#pragma once

#include "../friction/friction.hpp"
#include "assembly.hpp"

namespace rollbem {

extern template class detail::ActiveSet<double>;
extern template class detail::CombinedSolver<double>;
extern template class detail::FallingSet<detail::ActiveSetSlip<double>>;
extern template class detail::FallingSet<detail::CombinedSlip<double>>;
extern template class detail::FrictionCore<ConstantFriction<double>, 1, double>;
extern template class detail::FrictionCore<ConstantFriction<double>, 2, double>;
extern template class detail::FrictionCore<ExponentialFall<double>, 1, double>;
extern template class detail::FrictionCore<ExponentialFall<double>, 2, double>;
extern template decltype(detail::find_exact_border<double, PlaneKernel<double>>)
    detail::find_exact_border<double, PlaneKernel<double>>;
extern template decltype(detail::find_exact_border<double, StripKernel<double>>)
    detail::find_exact_border<double, StripKernel<double>>;

}  // namespace rollbem
