// Steady rolling of a contact patch in full adhesion: Kalker's creep coefficients, by halves where the strips are
// mirrored.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

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
    /// Of a patch more than ten times longer than wide, otherwise 0: by how much each coefficient changes with half as
    /// many strips or half as many elements in each, the larger of both over the coefficient; of an ellipse c23 and c32
    /// at least by |c23 + c32|, which tends to 0.
    CreepCoefficients<Scalar> mesh_change{};
    /// assists_creepage: a force or moment that assists its own creepage; not_converged: a mesh_change is larger than
    /// largest_mesh_change, and that coefficient may be wrong
    Status status = Status::ok;
};

/// Errors of coefficients that change by less were at most 6 %, those of others up to 1e5 %: a/b = 12 to 1000, nu = 0,
/// 0.28 and 0.5, 8 x 8 to 100 x 8 and 32 x 32 elements.
inline constexpr double largest_mesh_change = 0.07;

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

/// solve_steady without a look at other meshes.
template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
PatchSteadySolution<Scalar> solve_on_mesh(const PatchContact<Scalar>& contact, const PatchMesh<Scalar>& mesh,
                                          const Scheme& scheme, const Kernel& kernel) {
    const Eigen::Index n = mesh.elements_per_strip(), m = mesh.strip_count(), size = mesh.size();
    const Elements<Scalar> elements = patch_elements(mesh, scheme);
    const MatrixX<Scalar> inputs = rigid_slip(elements), outputs = force_weights(elements);
    PatchSteadySolution<Scalar> solution;
    solution.coefficients = MatrixX<Scalar>::Zero(3, 3);
    solution.traction_x = solution.traction_y = MatrixX<Scalar>::Zero(size, 3);
    if (mesh.is_mirrored()) {
        const InfluenceRows<Scalar> rows =
            patch_rows(mesh, strip_rows(mesh.along(), scheme, Quantity::slope), kernel, Quantity::slope, (m + 1) / 2);
        for (const Scalar sign : {Scalar(1), Scalar(-1)}) {
            const Eigen::Index first = sign > 0 ? 0 : 1, count = sign > 0 ? 1 : 2;
            const Eigen::Index x = sign > 0 ? (m + 1) / 2 : m / 2, y = m - x;
            const Response<Scalar> half = solve_steady_response<Scalar>(
                half_matrix(rows, n, m, sign), half_columns(inputs, n, m, sign), half_outputs(outputs, n, m, sign));
            add_part(half, first, solution);
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
        const Response<Scalar> whole =
            solve_steady_response<Scalar>(joined(patch_blocks(mesh, scheme, kernel, Quantity::slope)), inputs, outputs);
        add_part(whole, 0, solution);
        solution.traction_x = whole.unknowns.topRows(size);
        solution.traction_y = whole.unknowns.bottomRows(size);
    }
    static_cast<CreepCoefficients<Scalar>&>(solution) = creep_coefficients(contact, solution.coefficients);
    const bool opposes = solution.c11 > 0 && solution.c22 > 0 && solution.c33 >= 0;  // 0: one element
    if (solution.status == Status::ok && !opposes) solution.status = Status::assists_creepage;
    return solution;
}

/// Long elements let the coupling of both directions go wrong, c33 first, which is then a small difference of large
/// numbers. Proof of dissipation says nothing about its size, other meshes do.
template <class Scalar>
bool is_elongated(const PatchMesh<Scalar>& mesh) {
    return 2 * mesh.half_lengths().maxCoeff() > Scalar(10.001) * (mesh.edges()[mesh.strip_count()] - mesh.edges()[0]);
}

template <class Scalar>
void compare_meshes(const CreepCoefficients<Scalar>& other, PatchSteadySolution<Scalar>& solution) {
    const Scalar coupling = (std::max)(std::abs(solution.c23), std::abs(solution.c32));
    const auto compare = [&](auto coefficient, Scalar scale) {
        Scalar& change = solution.mesh_change.*coefficient;
        change = (std::max)(change, std::abs(other.*coefficient - solution.*coefficient) / scale);
        if (!(change <= Scalar(largest_mesh_change))) solution.status = Status::not_converged;
    };
    using Coefficients = CreepCoefficients<Scalar>;
    compare(&Coefficients::c11, std::abs(solution.c11));
    compare(&Coefficients::c22, std::abs(solution.c22));
    compare(&Coefficients::c23, coupling);
    compare(&Coefficients::c32, coupling);
    compare(&Coefficients::c33, std::abs(solution.c33));
}

/// A coarse mesh of an ellipse shows by c32, which is not -c23.
template <class Scalar>
CreepCoefficients<Scalar> mirrored_coupling(CreepCoefficients<Scalar> coefficients) {
    coefficients.c23 = -std::exchange(coefficients.c32, -coefficients.c23);
    return coefficients;
}

}  // namespace detail

/// Creep coefficients and tractions for unit creepages; needs no G. `mesh` must be in units of the contact's a,
/// as patch_mesh makes it. A patch more than ten times longer than wide is solved on two cosine meshes more, each half
/// as fine in one direction. Throws std::invalid_argument unless the scheme takes differences of u and fits the strips'
/// mesh.
template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
PatchSteadySolution<Scalar> solve_steady(const PatchContact<Scalar>& contact, const PatchMesh<Scalar>& mesh,
                                         const Scheme& scheme, const Kernel& kernel) {
    PatchSteadySolution<Scalar> solution = detail::solve_on_mesh(contact, mesh, scheme, kernel);
    const Eigen::Index n = mesh.elements_per_strip(), m = mesh.strip_count();
    if (solution.status != Status::ok || !detail::is_elongated(mesh)) return solution;
    if (n == 1 || m == 1) {
        solution.status = Status::not_converged;
        solution.mesh_change = {1, 1, 1, 1, 1};
        return solution;
    }
    if (!contact.outline()) detail::compare_meshes(detail::mirrored_coupling<Scalar>(solution), solution);
    for (const auto& [elements, strips] : {std::pair{n, m / 2}, {n / 2, m}}) {
        const PatchMesh<Scalar> coarser = patch_mesh(contact, elements, strips);
        detail::compare_meshes<Scalar>(detail::solve_on_mesh(contact, coarser, scheme, kernel), solution);
    }
    return solution;
}

/// The same for the half-space.
template <class Scalar, RollingScheme<Scalar> Scheme>
PatchSteadySolution<Scalar> solve_steady(const PatchContact<Scalar>& contact, const PatchMesh<Scalar>& mesh,
                                         const Scheme& scheme) {
    return solve_steady(contact, mesh, scheme, HalfSpace<Scalar>(contact.poisson_ratio()));
}

}  // namespace rollbem
