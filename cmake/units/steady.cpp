// Templates of lines: meshes, schemes, kernels, systems and steady rolling.
#include <rollbem/accuracy/impl/recommendation.ipp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/closed_form/detail/plane_lambda.hpp>
#include <rollbem/discretisation/impl/mesh.tpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/spectral/chebyshev.hpp>
#include <rollbem/steady/steady.hpp>

namespace Eigen {
template void PartialPivLU<MatrixXd>::compute();
}  // namespace Eigen

namespace rollbem {
template void detail::require<double>(bool, const char*, const char*, double, const char*);
template void detail::require<std::ptrdiff_t>(bool, const char*, const char*, std::ptrdiff_t, const char*);
template void detail::require<int>(bool, const char*, const char*, int, const char*);
template detail::QuadratureRule<double> detail::gauss_legendre<double>(Eigen::Index);
template double detail::reciprocal_condition<Eigen::PartialPivLU<Eigen::MatrixXd>>(
    const Eigen::PartialPivLU<Eigen::MatrixXd>&, double);
template double detail::stable_plane_lambda<double>(const char*, double, double);
template class Mesh<float>;
template Mesh<float> uniform_mesh<float>(Eigen::Index);
template Mesh<float> geometric_mesh<float>(Eigen::Index, float);
template Mesh<float> knothe_mesh<float>(Eigen::Index, float);
template Mesh<float> modified_knothe_mesh<float>(Eigen::Index, float);
template Mesh<float> cosine_mesh<float>(Eigen::Index);
template Mesh<float> make_mesh<float>(Topology, Eigen::Index, double);
template class Mesh<double>;
template Mesh<double> uniform_mesh<double>(Eigen::Index);
template Mesh<double> geometric_mesh<double>(Eigen::Index, double);
template Mesh<double> knothe_mesh<double>(Eigen::Index, double);
template Mesh<double> modified_knothe_mesh<double>(Eigen::Index, double);
template Mesh<double> cosine_mesh<double>(Eigen::Index);
template Mesh<double> make_mesh<double>(Topology, Eigen::Index, double);
template class Mesh<long double>;
template Mesh<long double> uniform_mesh<long double>(Eigen::Index);
template Mesh<long double> geometric_mesh<long double>(Eigen::Index, long double);
template Mesh<long double> knothe_mesh<long double>(Eigen::Index, long double);
template Mesh<long double> modified_knothe_mesh<long double>(Eigen::Index, long double);
template Mesh<long double> cosine_mesh<long double>(Eigen::Index);
template Mesh<long double> make_mesh<long double>(Topology, Eigen::Index, double);
template void detail::check_rows<double>(const SchemeRows<double>&, Quantity, Eigen::Index);
template SchemeRows<double> rows_about<double>(const Mesh<double>&, double, double);
template SchemeRows<double> NodeDifference::rows<double>(Quantity, const Mesh<double>&) const;
template SchemeRows<double> AnyScheme::rows<double>(Quantity, const Mesh<double>&) const;
template detail::KernelView<double>::KernelView(const AnyKernel<double>&);
template detail::KernelView<double>::KernelView(const PlaneKernel<double>&);
template detail::KernelView<double>::KernelView(const StripKernel<double>&);
template MatrixX<double> detail::influence_matrix<double>(const Mesh<double>&, const SchemeRows<double>&,
                                                          const detail::KernelView<double>&, Quantity);
template VectorX<double> detail::influence_product<double>(const Mesh<double>&, const SchemeRows<double>&,
                                                           const detail::KernelView<double>&, Quantity,
                                                           const VectorX<double>&);
template struct Elements<double>;
template class RollingSystem<double>;
template class ElementSystem<double, 1>;
template Elements<double> detail::line_elements<double>(const Mesh<double>&, const detail::BothRows<double>&);
template ElementSystem<double> rolling_system<double, AnyScheme, AnyKernel<double>>(const Mesh<double>&,
                                                                                    const AnyScheme&,
                                                                                    const AnyKernel<double>&);
template ElementSystem<double> rolling_system<double, Collocation, PlaneKernel<double>>(const Mesh<double>&,
                                                                                        const Collocation&,
                                                                                        const PlaneKernel<double>&);
template ElementSystem<double> rolling_system<double, Collocation, StripKernel<double>>(const Mesh<double>&,
                                                                                        const Collocation&,
                                                                                        const StripKernel<double>&);
template ElementSystem<double> rolling_system<double, NodeDifference, PlaneKernel<double>>(const Mesh<double>&,
                                                                                           const NodeDifference&,
                                                                                           const PlaneKernel<double>&);
template decltype(detail::factorise<double, double>) detail::factorise<double, double>;
template decltype(detail::judge<double, double>) detail::judge<double, double>;
template decltype(detail::solve_copied<double, double>) detail::solve_copied<double, double>;
template Response<double> solve_steady<AnyKernel<double>>(const Chebyshev&, const AnyKernel<double>&);
template Response<double> solve_steady<PlaneKernel<double>>(const Chebyshev&, const PlaneKernel<double>&);
template Response<double> solve_steady<StripKernel<double>>(const Chebyshev&, const StripKernel<double>&);
}  // namespace rollbem
