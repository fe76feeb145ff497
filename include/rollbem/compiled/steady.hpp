// Systems of line contacts and their steady rolling, compiled for double: include this in addition to or in place of
// steady/steady.hpp, assembly/influence.hpp, assembly/rolling_system.hpp and, for steady rolling,
// spectral/chebyshev.hpp, and link rollbem::compiled. Each header in this folder declares the largest templates of the
// headers it names as instantiated in this library, so that no translation unit compiles them again. Library and
// program must be built with the same options that affect the layout of Eigen's objects (-march and the like).
#pragma once

#include "../detail/decl.hpp"

#include <cstddef>

#include <Eigen/LU>

#include "../assembly/rolling_system.hpp"
#include "../detail/gauss_legendre.hpp"
#include "../detail/reciprocal_condition.hpp"
#include "../detail/require.hpp"
#include "../discretisation/any_scheme.hpp"
#include "../elasticity/any_kernel.hpp"
#include "../spectral/chebyshev.hpp"
#include "../steady/steady.hpp"

namespace Eigen {

extern template void PartialPivLU<MatrixXd>::compute();

}  // namespace Eigen

namespace rollbem {

extern template void detail::require<double>(bool, const char*, const char*, double, const char*);
extern template void detail::require<Eigen::Index>(bool, const char*, const char*, Eigen::Index, const char*);
extern template void detail::require<int>(bool, const char*, const char*, int, const char*);
extern template detail::QuadratureRule<double> detail::gauss_legendre<double>(Eigen::Index);
extern template double detail::reciprocal_condition<Eigen::PartialPivLU<Eigen::MatrixXd>>(
    const Eigen::PartialPivLU<Eigen::MatrixXd>&, double);
extern template class Mesh<double>;
extern template Mesh<double> uniform_mesh<double>(Eigen::Index);
extern template Mesh<double> cosine_mesh<double>(Eigen::Index);
extern template Mesh<double> make_mesh<double>(Topology, Eigen::Index, double);
extern template void detail::check_rows<double>(const SchemeRows<double>&, Quantity, Eigen::Index);
extern template SchemeRows<double> rows_about<double>(const Mesh<double>&, double, double);
extern template SchemeRows<double> NodeDifference::rows<double>(Quantity, const Mesh<double>&) const;
extern template SchemeRows<double> AnyScheme::rows<double>(Quantity, const Mesh<double>&) const;
extern template detail::KernelView<double>::KernelView(const AnyKernel<double>&);
extern template detail::KernelView<double>::KernelView(const PlaneKernel<double>&);
extern template detail::KernelView<double>::KernelView(const StripKernel<double>&);
extern template MatrixX<double> detail::influence_matrix<double>(const Mesh<double>&, const SchemeRows<double>&,
                                                                 const detail::KernelView<double>&, Quantity);
extern template VectorX<double> detail::influence_product<double>(const Mesh<double>&, const SchemeRows<double>&,
                                                                  const detail::KernelView<double>&, Quantity,
                                                                  const VectorX<double>&);
extern template void detail::require_finite<MatrixX<double>>(const char*, const char*, const MatrixX<double>&);
extern template void detail::require_square<MatrixX<double>>(const char*, const char*, const MatrixX<double>&,
                                                             std::ptrdiff_t, const char*);
extern template struct Elements<double>;
extern template class RollingSystem<double>;
extern template class ElementSystem<double, 1>;
extern template Elements<double> detail::line_elements<double>(const Mesh<double>&, const detail::BothRows<double>&);
extern template ElementSystem<double> rolling_system<double, AnyScheme, AnyKernel<double>>(const Mesh<double>&,
                                                                                           const AnyScheme&,
                                                                                           const AnyKernel<double>&);
extern template ElementSystem<double> rolling_system<double, Collocation, PlaneKernel<double>>(
    const Mesh<double>&, const Collocation&, const PlaneKernel<double>&);
extern template ElementSystem<double> rolling_system<double, Collocation, StripKernel<double>>(
    const Mesh<double>&, const Collocation&, const StripKernel<double>&);
extern template ElementSystem<double> rolling_system<double, NodeDifference, PlaneKernel<double>>(
    const Mesh<double>&, const NodeDifference&, const PlaneKernel<double>&);
extern template decltype(detail::factorise<double, double>) detail::factorise<double, double>;
extern template decltype(detail::judge<double, double>) detail::judge<double, double>;
extern template decltype(detail::solve_copied<double, double>) detail::solve_copied<double, double>;
extern template decltype(detail::solve_chebyshev_steady<AnyKernel<double>>)
    detail::solve_chebyshev_steady<AnyKernel<double>>;
extern template decltype(detail::solve_chebyshev_steady<PlaneKernel<double>>)
    detail::solve_chebyshev_steady<PlaneKernel<double>>;
extern template decltype(detail::solve_chebyshev_steady<StripKernel<double>>)
    detail::solve_chebyshev_steady<StripKernel<double>>;

}  // namespace rollbem
