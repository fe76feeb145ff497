// Chebyshev states, frequency response, state space and steps in full adhesion, compiled for double. Replaces
// adhesion/frequency.hpp, adhesion/state_space.hpp, adhesion/transient.hpp and spectral/chebyshev.hpp; link
// rollbem::compiled.
#pragma once

#include <complex>

#include <Eigen/LU>

#include "../adhesion/frequency.hpp"
#include "../adhesion/transient.hpp"
#include "../closed_form/plane_lambda.hpp"
#include "../spectral/state_space.hpp"
#include "steady.hpp"

namespace Eigen {

extern template void PartialPivLU<Ref<MatrixXcd>>::compute();

}  // namespace Eigen

namespace rollbem {

extern template ChebyshevSystem<double> rolling_system<AnyKernel<double>>(const Chebyshev&, const AnyKernel<double>&);
extern template ChebyshevSystem<double> rolling_system<PlaneKernel<double>>(const Chebyshev&,
                                                                            const PlaneKernel<double>&);
extern template ChebyshevSystem<double> rolling_system<StripKernel<double>>(const Chebyshev&,
                                                                            const StripKernel<double>&);
extern template decltype(detail::factorise<std::complex<double>, double>)
    detail::factorise<std::complex<double>, double>;
extern template decltype(detail::judge<std::complex<double>, double>) detail::judge<std::complex<double>, double>;
extern template decltype(detail::solve_copied<std::complex<double>, double>)
    detail::solve_copied<std::complex<double>, double>;
extern template decltype(solve_response<double>) solve_response<double>;
extern template double detail::stable_plane_lambda<double>(const char*, double, double);
extern template VectorX<double> detail::steady_tractions<double>(MatrixX<double>, Eigen::Index, Eigen::Index);
extern template void detail::require_convergent<double, ArrayX<double>>(const char*, const VectorX<double>&,
                                                                        const ArrayX<double>&, double);
extern template void detail::require_usable_in_time<double>(const char*, const RollingSystem<double>&,
                                                            const StabilityVerdict&);
extern template class detail::StepMap<1>;
extern template class detail::StepMap<2>;
extern template class AdhesionModel<1>;
extern template class AdhesionModel<2>;

}  // namespace rollbem
