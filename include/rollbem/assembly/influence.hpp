// Influence matrices: G (displacement) and G' (its slope) of Eqs. (12)-(14) for any mesh, scheme and kernel; row =
// equation, column = unknown element, and G' p - (1/V) G dp/dt = xi.
// rolling_system.hpp combines them with the weights that turn tractions into the force.
#pragma once

#include <Eigen/Core>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../discretisation/mesh.hpp"
#include "../discretisation/scheme.hpp"
#include "../elasticity/line_kernel.hpp"
#include "../types.hpp"
#include "detail/influence_rows.hpp"
#include "detail/kernel_view.hpp"

namespace rollbem {

/// G' of Eq. (12), n x n (n-1 x n-1 for KnotheBoundary), in units of 1/G: G'_lm is the slope du/dx at the point of row
/// l, Eq. (28), or its mean about that point, Eqs. (14) and (29), or between two nodes, under unit traction of element
/// m. A steady problem needs nothing else. Throws std::invalid_argument if the scheme does not fit the mesh.
template <class Scalar, RollingScheme<Scalar> Scheme, LineKernel Kernel>
MatrixX<Scalar> assemble_G_prime(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
    return detail::influence_matrix<Scalar>(mesh, scheme_rows(scheme, Quantity::slope, mesh),
                                            detail::KernelView<Scalar>(kernel), Quantity::slope);
}

/// G of Eq. (13), for Galerkin of Eq. (14), with the shape of G', in units of a/G: the displacement u instead of its
/// slope. The kernel's half-width must be finite. Throws std::invalid_argument if the scheme does not fit the mesh or G
/// is not finite.
template <class Scalar, RollingScheme<Scalar> Scheme, LineKernel Kernel>
MatrixX<Scalar> assemble_G(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
    MatrixX<Scalar> G = detail::influence_matrix<Scalar>(mesh, scheme_rows(scheme, Quantity::displacement, mesh),
                                                         detail::KernelView<Scalar>(kernel), Quantity::displacement);
    detail::require(detail::is_finite(G(0, 0)), "assemble_G", "displacement per traction", G(0, 0),
                    "be finite: an infinite aspect is for steady problems only");
    return G;
}

}  // namespace rollbem
