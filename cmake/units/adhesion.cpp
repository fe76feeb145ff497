// Full adhesion: frequency response, eigenvalues, state spaces, and steps in time.
#include <rollbem/adhesion/impl/balanced_reduction.ipp>
#include <rollbem/adhesion/impl/frequency.ipp>
#include <rollbem/adhesion/impl/stability.ipp>
#include <rollbem/adhesion/impl/state_space.ipp>
#include <rollbem/adhesion/impl/transient.tpp>
#include <rollbem/closed_form/impl/carter.ipp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/spectral/chebyshev.hpp>

namespace Eigen {
template void PartialPivLU<Ref<MatrixXcd>>::compute();
}  // namespace Eigen

namespace rollbem {
template Chebyshev::System<double> rolling_system<AnyKernel<double>>(const Chebyshev&, const AnyKernel<double>&);
template Chebyshev::System<double> rolling_system<PlaneKernel<double>>(const Chebyshev&, const PlaneKernel<double>&);
template Chebyshev::System<double> rolling_system<StripKernel<double>>(const Chebyshev&, const StripKernel<double>&);
template decltype(detail::factorise<std::complex<double>, double>) detail::factorise<std::complex<double>, double>;
template decltype(detail::judge<std::complex<double>, double>) detail::judge<std::complex<double>, double>;
template decltype(detail::solve_copied<std::complex<double>, double>)
    detail::solve_copied<std::complex<double>, double>;
template Response<std::complex<double>> solve_response<double>(const RollingSystem<double>&, std::complex<double>);
template VectorX<double> detail::steady_tractions<double>(MatrixX<double>, Eigen::Index, Eigen::Index);
template void detail::require_convergent<double, ArrayX<double>>(const char*, const VectorX<double>&,
                                                                 const ArrayX<double>&, double);
template void detail::require_usable_in_time<double>(const char*, const RollingSystem<double>&,
                                                     const StabilityVerdict&);
template class detail::StepMap<1>;
template class detail::StepMap<2>;
template class AdhesionModel<1>;
template class AdhesionModel<2>;
template AdhesionModel<2>::AdhesionModel(const Contact&, const ElementSystem<double, 2>&, const StabilityVerdict&,
                                         Integrator);
template AdhesionModel<2>::AdhesionModel(const PatchContact&, const ElementSystem<double, 2>&, const StabilityVerdict&,
                                         Integrator);
}  // namespace rollbem
