// Kalker's creep coefficients of a contact patch in full adhesion, and its steady rolling, solved as two uncoupled
// subsystems where the strips are mirrored.
#pragma once

#include "../detail/decl.hpp"

#include <Eigen/Core>

#include "../adhesion/response.hpp"
#include "../assembly/patch_system.hpp"
#include "../detail/require.hpp"
#include "../discretisation/mesh.hpp"
#include "../discretisation/patch_mesh.hpp"
#include "../elasticity/patch_kernel.hpp"
#include "../scene/creepage.hpp"
#include "../scene/patch_contact.hpp"
#include "../types.hpp"

namespace rollbem {

/// Kalker's coefficients from the 3 x 3 coefficients of a response in units of a (outlines: c), steady or harmonic:
/// entry (i, j) is minus the force F_x, F_y, M_z per xi, eta, phi. Throws std::invalid_argument if they are not 3 x 3.
template <class Value>
CreepCoefficients<Value> creep_coefficients(const PatchContact& contact, const Response<Value>& response);

/// Largest estimate of a coefficient's relative error that confirms it: errors up to 5 % (docs/measured.md).
inline constexpr double largest_error_estimate = 0.045;
/// Whether entry (i, j) of steady coefficients can be used: the status is ok, or it is not_converged and other meshes
/// confirm this entry.
template <class Scalar>
bool is_confirmed(const Response<Scalar>& steady, Eigen::Index i, Eigen::Index j);

/// The forces on body 1 [N] and the moment about the origin [N m] of steady rolling, also of an outline without
/// symmetry. Throws std::invalid_argument if the coefficients are not 3 x 3.
TangentialForce creep_force(const PatchContact& contact, const Response<double>& steady, const Creepage& creepage);

/// Steady rolling at unit creepages xi, eta and phi times the mesh's unit of length, by one mesh alone: the status does
/// not show whether the mesh is fine enough. Needs no G. Status::assists_creepage if a force or the moment assists its
/// own creepage. Throws std::invalid_argument unless the scheme takes differences of u and fits the strips' mesh.
template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
Response<Scalar> solve_steady(const PatchMesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel);

/// Steady rolling of a contact, at unit xi, eta and phi a; `mesh` must be in units of its a, as from patch_mesh.
///
/// Ellipses of a/b <= 10 are trusted on enough elements and strips, at least 8 of each, 12 above a/b = 3.5, dense at
/// the ends, if c23 and -c32 agree. All else is also solved on other meshes, whatever its own:
///
/// - on two or three, of 8, 12 and 16 elements in each strip, from which limits of small elements are extrapolated;
/// - on more than 256 elements of a patch more than twelve times longer than wide, on two meshes half as fine in one
///   direction; by a kernel that takes the coupling of wide strips at their middles, on half as many strips.
///
/// The error_estimates are then relative to the coefficient; for c23 and c32 to the larger of both, for c12, c13, c21
/// and c31 to the mean of theirs on the diagonal. Status::not_converged: an estimate is larger than
/// largest_error_estimate, and this coefficient may be wrong (is_confirmed). Throws std::invalid_argument unless the
/// scheme takes differences of u and fits the strips' mesh.
template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
Response<Scalar> solve_steady(const PatchContact& contact, const PatchMesh<Scalar>& mesh, const Scheme& scheme,
                              const Kernel& kernel);

/// Steady rolling of a contact between half-spaces.
template <class Scalar, RollingScheme<Scalar> Scheme>
Response<Scalar> solve_steady(const PatchContact& contact, const PatchMesh<Scalar>& mesh, const Scheme& scheme) {
    return solve_steady(contact, mesh, scheme, HalfSpace<Scalar>(static_cast<Scalar>(contact.poisson_ratio())));
}

}  // namespace rollbem

#include "impl/creep_coefficients.tpp"

#ifdef ROLLBEM_COMPILED
namespace rollbem {
extern template Response<double> solve_steady<double, NodeDifference, HalfSpace<double>>(const PatchMesh<double>&,
                                                                                         const NodeDifference&,
                                                                                         const HalfSpace<double>&);
extern template Response<double> solve_steady<double, NodeDifference, HalfSpace<double>>(const PatchContact&,
                                                                                         const PatchMesh<double>&,
                                                                                         const NodeDifference&,
                                                                                         const HalfSpace<double>&);
}  // namespace rollbem
#endif
