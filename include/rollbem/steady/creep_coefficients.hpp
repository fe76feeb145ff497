// Kalker's creep coefficients of a contact patch in full adhesion, and its steady rolling, solved as two uncoupled
// subsystems where the strips are mirrored.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../adhesion/response.hpp"
#include "../assembly/patch_system.hpp"
#include "../detail/require.hpp"
#include "../discretisation/patch_mesh.hpp"
#include "../elasticity/rectangle_kernel.hpp"
#include "../scene/creep_coefficients.hpp"
#include "../scene/creepage.hpp"
#include "../scene/force.hpp"
#include "../scene/patch_contact.hpp"
#include "../status.hpp"
#include "../types.hpp"

namespace rollbem {

/// Kalker's coefficients from the 3 x 3 coefficients of a response in units of a (outlines: c), steady or harmonic:
/// entry (i, j) is minus the force F_x, F_y, M_z per xi, eta, phi. Throws std::invalid_argument if they are not 3 x 3.
template <class Value, class Scalar>
CreepCoefficients<Value> creep_coefficients(const PatchContact<Scalar>& contact, const Response<Value>& response) {
    const MatrixX<Value>& coefficients = response.coefficients;
    detail::require(coefficients.cols() == 3, "creep_coefficients", "number of creepages", coefficients.cols(), "be 3");
    const Scalar force = contact.a_over_b(), spin = std::sqrt(force);  // a^2/(a b), a/c
    return {force * coefficients(0, 0), force * coefficients(1, 1), force * (spin * coefficients(1, 2)),
            force * (spin * coefficients(2, 1)), force * (force * coefficients(2, 2))};  // force^2 may overflow
}

/// Largest change of a coefficient from one mesh to another that confirms it (errors on both sides: docs/measured.md).
inline constexpr double largest_mesh_change = 0.07;

/// Whether entry (i, j) of steady coefficients can be used: the status is ok, or it is not_converged and other meshes
/// confirm this entry.
template <class Scalar>
bool is_confirmed(const Response<Scalar>& steady, Eigen::Index i, Eigen::Index j) {
    if (steady.status == Status::ok) return true;
    const bool compared = steady.status == Status::not_converged && (i == 0) == (j == 0);
    return compared && steady.error_estimates(i, j) <= Scalar(largest_mesh_change);
}

/// The forces on body 1 [N] and the moment about the origin [N m] of steady rolling, also of an outline without
/// symmetry. Throws std::invalid_argument if the coefficients are not 3 x 3.
template <class Scalar>
TangentialForce<Scalar> creep_force(const PatchContact<Scalar>& contact, const Response<Scalar>& steady,
                                    const Creepage<Scalar>& creepage) {
    const Scalar a = contact.half_length(), scale = -contact.shear_modulus() * a * a;
    const MatrixX<Scalar>& c = steady.coefficients;
    detail::require(c.cols() == 3, "creep_force", "number of creepages", c.cols(), "be 3");
    const auto force = [&](Eigen::Index i) {
        return scale * (c(i, 0) * creepage.longitudinal + c(i, 1) * creepage.lateral + c(i, 2) * (creepage.spin * a));
    };
    return {force(0), force(1), a * force(2)};
}

/// Steady rolling at unit creepages xi, eta and phi times the mesh's unit of length, by one mesh alone: the status does
/// not show whether the mesh is fine enough. Needs no G. Status::assists_creepage if a force or the moment assists its
/// own creepage. Throws std::invalid_argument unless the scheme takes differences of u and fits the strips' mesh.
template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
Response<Scalar> solve_steady(const PatchMesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
    const Elements<Scalar> elements = patch_elements(mesh, scheme);
    const MatrixX<Scalar> inputs = detail::rigid_slip(elements), outputs = detail::force_weights(elements);
    Response<Scalar> response;
    if (mesh.is_mirrored()) {
        response = detail::response_without_parts<Scalar>(3);
        response.unknowns = MatrixX<Scalar>::Zero(2 * mesh.size(), 3);
        const detail::InfluenceRows<Scalar> rows =
            detail::patch_rows(mesh, detail::strip_rows(mesh.along(), scheme, Quantity::slope), kernel, Quantity::slope,
                               detail::has_wide_strips(mesh));
        for (const auto& half : detail::MirroredHalf<Scalar>::both(mesh.elements_per_strip(), mesh.strip_count())) {
            const Response<Scalar> own =
                solve_steady<Scalar>(half.matrix(rows), half.inputs(inputs), half.outputs(outputs));
            detail::add_part(own, half.first, response);
            half.unfold(own.unknowns, response.unknowns);
        }
    } else {
        response = solve_steady<Scalar>(detail::joined(detail::patch_blocks(mesh, scheme, kernel, Quantity::slope)),
                                        inputs, outputs);
    }
    const auto own = response.coefficients.diagonal();
    const bool opposes = own[0] > 0 && own[1] > 0 && own[2] >= 0;  // own[2] is 0 for a single element
    if (response.status == Status::ok && !opposes) response.status = Status::assists_creepage;
    return response;
}

namespace detail {

/// Compares the coefficients that an ellipse has with another mesh's. Differences of c23 and c32 are divided by the
/// larger of both, which does not vanish with one of them.
template <class Scalar>
void compare_meshes(const MatrixX<Scalar>& other, Response<Scalar>& response) {
    const MatrixX<Scalar>& own = response.coefficients;
    const Scalar coupling = (std::max)(std::abs(own(1, 2)), std::abs(own(2, 1)));
    if (response.error_estimates.size() == 0) response.error_estimates = MatrixX<Scalar>::Zero(3, 3);
    for (const auto& [i, j] : {std::pair{0, 0}, {1, 1}, {1, 2}, {2, 1}, {2, 2}}) {
        Scalar& change = response.error_estimates(i, j);
        change = (std::max)(change, std::abs(other(i, j) - own(i, j)) / (i == j ? std::abs(own(i, i)) : coupling));
        if (!(change <= Scalar(largest_mesh_change))) response.status = Status::not_converged;
    }
}

/// The coefficients after exchange of c23 and -c32: their difference reveals a coarse mesh of an ellipse.
template <class Scalar>
MatrixX<Scalar> mirrored_coupling(MatrixX<Scalar> coefficients) {
    coefficients(1, 2) = -std::exchange(coefficients(2, 1), -coefficients(1, 2));
    return coefficients;
}

/// Elements and strips of the meshes with which a patch is compared. The comparison reveals errors of
///
/// - long elements: the coupling of both directions is wrong, first c33, which is then a small difference of large
///   numbers; a proof of dissipation does not bound c33, meshes half as fine do;
/// - corners of an outline;
/// - wide strips whose coupling is taken at their middles;
/// - fewer than eight strips or elements, too few for some coefficient of some patch.
template <class Scalar, RectangleKernel Kernel>
std::vector<std::pair<Eigen::Index, Eigen::Index>> other_meshes(const PatchMesh<Scalar>& mesh, bool ellipse) {
    constexpr Eigen::Index enough = 8, least = 12, most = 16;
    const Eigen::Index n = mesh.elements_per_strip(), m = mesh.strip_count();
    const Scalar width = mesh.height();
    const auto finer = [&](Eigen::Index count) {
        return count < enough ? (std::max)(2 * count, least) : (std::min)(count, most);
    };
    if (2 * mesh.half_lengths().maxCoeff() > Scalar(10.001) * width) {
        if (n < enough) return {{n, m / 2}, {n / 2, m}, {finer(n), m}};
        return {{n, m / 2}, {n / 2, m}};
    }
    if (n < enough || m < enough) return {{finer(n), finer(m)}};
    if (!ellipse || (has_wide_strips(mesh) && !HasCouplingIntegral<Kernel>)) return {{n, m / 2}};
    return {};
}

}  // namespace detail

/// Steady rolling of a contact, at unit xi, eta and phi a; `mesh` must be in units of its a, as from patch_mesh.
///
/// Some patches are also solved on other cosine meshes:
///
/// - patches more than ten times longer than wide, on two meshes half as fine in one direction;
/// - others of fewer than eight strips or elements in each, on one finer mesh;
/// - other outlines, on one mesh with half as many strips.
///
/// The error_estimates are then the changes of the coefficients, the largest over the meshes, relative to the
/// coefficient; for c23 and c32 of an ellipse at least |c23 + c32|, which tends to 0. Status::not_converged: a change
/// is larger than largest_mesh_change, and this coefficient may be wrong (is_confirmed). Throws std::invalid_argument
/// unless the scheme takes differences of u and fits the strips' mesh.
template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
Response<Scalar> solve_steady(const PatchContact<Scalar>& contact, const PatchMesh<Scalar>& mesh, const Scheme& scheme,
                              const Kernel& kernel) {
    Response<Scalar> response = solve_steady(mesh, scheme, kernel);
    const bool ellipse = !contact.outline();
    if (response.status != Status::ok) return response;
    if (ellipse) detail::compare_meshes<Scalar>(detail::mirrored_coupling(response.coefficients), response);
    const auto others = detail::other_meshes<Scalar, Kernel>(mesh, ellipse);
    for (const auto& [n, m] : others) {
        if (n == 0 || m == 0) {  // a mesh with half of one element or strip
            response.status = Status::not_converged;
            response.error_estimates.setOnes(3, 3);
            return response;
        }
        const Response<Scalar> other = solve_steady(patch_mesh(contact, n, m), scheme, kernel);
        detail::compare_meshes(other.coefficients, response);
    }
    if (others.empty() && response.status == Status::ok) response.error_estimates.resize(0, 0);
    return response;
}

/// Steady rolling of a contact between half-spaces.
template <class Scalar, RollingScheme<Scalar> Scheme>
Response<Scalar> solve_steady(const PatchContact<Scalar>& contact, const PatchMesh<Scalar>& mesh,
                              const Scheme& scheme) {
    return solve_steady(contact, mesh, scheme, HalfSpace<Scalar>(contact.poisson_ratio()));
}

}  // namespace rollbem
