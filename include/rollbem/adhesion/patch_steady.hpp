// Steady rolling of a contact patch in full adhesion: Kalker's creep coefficients, by halves where the strips are
// mirrored.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <Eigen/Core>

#include "../assembly/patch_system.hpp"
#include "../detail/finite.hpp"
#include "../discretisation/patch_mesh.hpp"
#include "../elasticity/rectangle_kernel.hpp"
#include "../scene/creep_coefficients.hpp"
#include "../scene/force.hpp"
#include "../scene/patch_contact.hpp"
#include "../status.hpp"
#include "../types.hpp"
#include "response.hpp"

namespace rollbem {

/// From the 3 x 3 coefficients of a system in units of a, entry (i, j) minus the force F_x, F_y, M_z per xi, eta, phi.
template <class Value, class Scalar>
CreepCoefficients<Value> creep_coefficients(const PatchContact<Scalar>& contact, const MatrixX<Value>& coefficients) {
    const Scalar force = contact.a_over_b(), spin = std::sqrt(force);  // a^2/(a b), a/c
    return {force * coefficients(0, 0), force * coefficients(1, 1), force * spin * coefficients(1, 2),
            force * spin * coefficients(2, 1), force * force * coefficients(2, 2)};
}

/// Solution for unit creepages: columns xi, eta, phi; lengths in units of a (outlines: c).
template <class Scalar>
struct PatchSteadySolution : CreepCoefficients<Scalar> {
    MatrixX<Scalar> traction_x, traction_y;  ///< N x 3: p_x, p_y over G of each element; phi times a for 1
    MatrixX<Scalar> coefficients;            ///< 3 x 3: -F_x, -F_y over G a^2, -M_z over G a^3
    Scalar residual = 0;                     ///< |G' p - slip| / (|G'| |p| + |slip|) in the maximum norm [-]
    Scalar rcond = 1;                        ///< estimate of 1 / (|G'| |G'^-1|) in the 1-norm [-]
    /// assists_creepage: a force or moment that assists its own creepage
    Status status = Status::ok;
};

/// The forces on body 1 [N] and the moment about the origin [N m] of steady rolling at creepages xi, eta [-] and spin phi
/// [1/m], also of an outline without symmetry.
template <class Scalar>
TangentialForce<Scalar> forces(const PatchContact<Scalar>& contact, const PatchSteadySolution<Scalar>& solution,
                               std::type_identity_t<Scalar> xi, std::type_identity_t<Scalar> eta,
                               std::type_identity_t<Scalar> phi) {
    const Scalar a = contact.half_length(), scale = -contact.shear_modulus() * a * a;
    const MatrixX<Scalar>& c = solution.coefficients;
    const auto force = [&](Eigen::Index i) { return scale * (c(i, 0) * xi + c(i, 1) * eta + c(i, 2) * (phi * a)); };
    return {force(0), force(1), a * force(2)};
}

namespace detail {

template <class Scalar>
void add_part(const Response<Scalar>& part, Eigen::Index first, PatchSteadySolution<Scalar>& solution) {
    const Eigen::Index count = part.coefficients.cols();
    solution.coefficients.block(first, first, count, count) = part.coefficients;
    solution.residual = (std::max)(solution.residual, part.residual);
    solution.rcond = (std::min)(solution.rcond, part.rcond);
    if (solution.status == Status::ok) solution.status = part.status;
}

}  // namespace detail

/// Creep coefficients and tractions for unit creepages; needs no G. `mesh` must be in units of the contact's a,
/// as patch_mesh makes it. Throws std::invalid_argument unless the scheme takes differences of u and fits the strips'
/// mesh.
template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
PatchSteadySolution<Scalar> solve_steady(const PatchContact<Scalar>& contact, const PatchMesh<Scalar>& mesh,
                                         const Scheme& scheme, const Kernel& kernel) {
    const Eigen::Index n = mesh.elements_per_strip(), m = mesh.strip_count(), size = mesh.size();
    const Elements<Scalar> elements = patch_elements(mesh, scheme);
    const MatrixX<Scalar> inputs = rigid_slip(elements), outputs = force_weights(elements);
    PatchSteadySolution<Scalar> solution;
    solution.coefficients = MatrixX<Scalar>::Zero(3, 3);
    solution.traction_x = solution.traction_y = MatrixX<Scalar>::Zero(size, 3);
    if (mesh.is_mirrored()) {
        const detail::InfluenceRows<Scalar> rows = detail::patch_rows(
            mesh, detail::strip_rows(mesh.along(), scheme, Quantity::slope), kernel, Quantity::slope, (m + 1) / 2);
        for (const Scalar sign : {Scalar(1), Scalar(-1)}) {
            const Eigen::Index first = sign > 0 ? 0 : 1, count = sign > 0 ? 1 : 2;
            const Eigen::Index x = sign > 0 ? (m + 1) / 2 : m / 2, y = m - x;
            const Response<Scalar> half = solve_steady_response<Scalar>(detail::half_matrix(rows, n, m, sign),
                                                                        detail::half_columns(inputs, n, m, sign),
                                                                        detail::half_outputs(outputs, n, m, sign));
            detail::add_part(half, first, solution);
            const auto unfold = [&](Eigen::Index from, Eigen::Index strips, Scalar parity, MatrixX<Scalar>& traction) {
                for (Eigen::Index j = 0; j < strips; ++j) {
                    const auto own = half.unknowns.middleRows((from + j) * n, n);
                    traction.block(j * n, first, n, count) = own;
                    if (m - 1 - j != j) traction.block((m - 1 - j) * n, first, n, count) = parity * own;
                }
            };
            unfold(0, x, sign, solution.traction_x);
            unfold(x, y, -sign, solution.traction_y);
        }
    } else {
        const Response<Scalar> whole = solve_steady_response<Scalar>(
            detail::joined(detail::patch_blocks(mesh, scheme, kernel, Quantity::slope)), inputs, outputs);
        detail::add_part(whole, 0, solution);
        solution.traction_x = whole.unknowns.topRows(size);
        solution.traction_y = whole.unknowns.bottomRows(size);
    }
    static_cast<CreepCoefficients<Scalar>&>(solution) = creep_coefficients(contact, solution.coefficients);
    const bool opposes = solution.c11 > 0 && solution.c22 > 0 && solution.c33 >= 0;  // 0: one element
    if (solution.status == Status::ok && !opposes) solution.status = Status::assists_creepage;
    return solution;
}

/// The same for the half-space.
template <class Scalar, RollingScheme<Scalar> Scheme>
PatchSteadySolution<Scalar> solve_steady(const PatchContact<Scalar>& contact, const PatchMesh<Scalar>& mesh,
                                         const Scheme& scheme) {
    return solve_steady(contact, mesh, scheme, HalfSpace<Scalar>(contact.poisson_ratio()));
}

}  // namespace rollbem
