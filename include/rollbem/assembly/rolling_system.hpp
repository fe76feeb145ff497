// The system of a line: influence matrices G (displacement) and G' (its slope) of Eqs. (12)-(14) for any mesh, scheme
// and kernel, and the coordinates of its elements.
#pragma once

#include "../detail/decl.hpp"

#include <Eigen/Core>

#include "../discretisation/mesh.hpp"
#include "../discretisation/scheme.hpp"
#include "../elasticity/line_kernel.hpp"
#include "../system/rolling_system.hpp"
#include "../types.hpp"
#include "detail/line_rows.hpp"

namespace rollbem {

/// G' of Eq. (12), n x n (n-1 x n-1 for KnotheBoundary), in units of 1/G: G'_lm is the slope du/dx at the point of row
/// l, Eq. (28), or its mean about that point, Eqs. (14) and (29), or between two nodes, under unit traction of element
/// m. A steady problem needs nothing else. Throws std::invalid_argument if the scheme does not fit the mesh.
template <class Scalar, RollingScheme<Scalar> Scheme, LineKernel Kernel>
MatrixX<Scalar> assemble_G_prime(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel);

/// G of Eq. (13), for Galerkin of Eq. (14), with the shape of G', in units of a/G: the displacement u instead of its
/// slope. The kernel's half-width must be finite. Throws std::invalid_argument if the scheme does not fit the mesh or G
/// is not finite.
template <class Scalar, RollingScheme<Scalar> Scheme, LineKernel Kernel>
MatrixX<Scalar> assemble_G(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel);

/// Assembles both matrices. Throws std::invalid_argument if the scheme does not fit the mesh, if G is not finite (an
/// infinite half-width), and for a plane kernel with Lambda <= 0, whose model is unstable in the time domain.
template <class Scalar, RollingScheme<Scalar> Scheme, LineKernel Kernel>
ElementSystem<Scalar> rolling_system(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel);

/// G' alone, which costs less than both, for steady friction; the half-width may be infinite. Throws
/// std::invalid_argument if assemble_G_prime refuses the scheme.
template <class Scalar, RollingScheme<Scalar> Scheme, LineKernel Kernel>
ElementSystem<Scalar> steady_system(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel);

}  // namespace rollbem

#include "impl/rolling_system.tpp"

#ifdef ROLLBEM_COMPILED
namespace rollbem {
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
}  // namespace rollbem
#endif
