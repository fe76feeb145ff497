// Kalker's creep coefficients of a contact patch in full adhesion, and its steady rolling, by halves where the strips
// are mirrored.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Core>

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
#include "response.hpp"

namespace rollbem {

/// Kalker's coefficients from the 3 x 3 of a response in units of a (outlines: c), steady or harmonic: entry (i, j)
/// minus the force F_x, F_y, M_z per xi, eta, phi. Throws std::invalid_argument if they are not 3 x 3.
template <class Value, class Scalar>
CreepCoefficients<Value> creep_coefficients(const PatchContact<Scalar>& contact, const Response<Value>& response) {
    const MatrixX<Value>& coefficients = response.coefficients;
    detail::require(coefficients.cols() == 3, "creep_coefficients", "number of creepages", coefficients.cols(), "be 3");
    const Scalar force = contact.a_over_b(), spin = std::sqrt(force);  // a^2/(a b), a/c
    return {force * coefficients(0, 0), force * coefficients(1, 1), force * spin * coefficients(1, 2),
            force * spin * coefficients(2, 1), force * force * coefficients(2, 2)};
}

/// Errors of coefficients that change by less were at most 6 %, those of others up to 1e5 %: a/b = 12 to 1000, nu = 0,
/// 0.28 and 0.5, 8 x 8 to 100 x 8 and 32 x 32 elements.
inline constexpr double largest_mesh_change = 0.07;

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

namespace detail {

/// solve_steady without a look at other meshes.
template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
Response<Scalar> solve_on_mesh(const PatchMesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
    const Elements<Scalar> elements = patch_elements(mesh, scheme);
    const MatrixX<Scalar> inputs = rigid_slip(elements), outputs = force_weights(elements);
    Response<Scalar> response;
    if (mesh.is_mirrored()) {
        response = response_without_parts<Scalar>(3);
        response.unknowns = MatrixX<Scalar>::Zero(2 * mesh.size(), 3);
        const InfluenceRows<Scalar> rows = patch_rows(mesh, strip_rows(mesh.along(), scheme, Quantity::slope), kernel,
                                                      Quantity::slope, computed_strips(mesh));
        for (const auto& half : MirroredHalf<Scalar>::both(mesh.elements_per_strip(), mesh.strip_count())) {
            const Response<Scalar> own =
                solve_steady<Scalar>(half.matrix(rows), half.inputs(inputs), half.outputs(outputs));
            add_part(own, half.first, response);
            half.unfold(own.unknowns, response.unknowns);
        }
    } else {
        response = solve_steady<Scalar>(joined(patch_blocks(mesh, scheme, kernel, Quantity::slope)), inputs, outputs);
    }
    const auto own = response.coefficients.diagonal();
    const bool opposes = own[0] > 0 && own[1] > 0 && own[2] >= 0;  // 0: one element
    if (response.status == Status::ok && !opposes) response.status = Status::assists_creepage;
    return response;
}

/// Long elements let the coupling of both directions go wrong, c33 first, which is then a small difference of large
/// numbers. Proof of dissipation says nothing about its size, other meshes do.
template <class Scalar>
bool is_elongated(const PatchMesh<Scalar>& mesh) {
    return 2 * mesh.half_lengths().maxCoeff() > Scalar(10.001) * (mesh.edges()[mesh.strip_count()] - mesh.edges()[0]);
}

/// A coarse mesh of an ellipse shows by c32, which is not -c23.
template <class Scalar>
MatrixX<Scalar> mirrored_coupling(MatrixX<Scalar> coefficients) {
    coefficients(1, 2) = -std::exchange(coefficients(2, 1), -coefficients(1, 2));
    return coefficients;
}

/// Compares with the coefficients of another mesh those that an ellipse has: c23 and c32 with the larger of both, which
/// tends to 0 with neither.
template <class Scalar>
void compare_meshes(const MatrixX<Scalar>& other, Response<Scalar>& response) {
    const MatrixX<Scalar>& own = response.coefficients;
    const Scalar coupling = (std::max)(std::abs(own(1, 2)), std::abs(own(2, 1)));
    for (const auto& [i, j] : {std::pair{0, 0}, {1, 1}, {1, 2}, {2, 1}, {2, 2}}) {
        Scalar& change = response.error_estimates(i, j);
        change = (std::max)(change, std::abs(other(i, j) - own(i, j)) / (i == j ? std::abs(own(i, i)) : coupling));
        if (!(change <= Scalar(largest_mesh_change))) response.status = Status::not_converged;
    }
}

}  // namespace detail

/// Steady rolling at unit creepages xi, eta and phi a; needs no G. `mesh` must be in units of the contact's a,
/// as patch_mesh makes it. Status::assists_creepage if a force or the moment assists its own creepage.
///
/// A patch more than ten times longer than wide is solved on two cosine meshes more, each half as fine in one
/// direction: error_estimates are by how much each coefficient changes, the larger of both over the coefficient; of an
/// ellipse c23 and c32 at least by |c23 + c32|, which tends to 0. Status::not_converged: one is larger than
/// largest_mesh_change, and that coefficient may be wrong. Throws std::invalid_argument unless the scheme takes
/// differences of u and fits the strips' mesh.
template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
Response<Scalar> solve_steady(const PatchContact<Scalar>& contact, const PatchMesh<Scalar>& mesh, const Scheme& scheme,
                              const Kernel& kernel) {
    Response<Scalar> response = detail::solve_on_mesh(mesh, scheme, kernel);
    const Eigen::Index n = mesh.elements_per_strip(), m = mesh.strip_count();
    if (response.status != Status::ok || !detail::is_elongated(mesh)) return response;
    response.error_estimates = MatrixX<Scalar>::Zero(3, 3);
    if (n == 1 || m == 1) {
        response.status = Status::not_converged;
        response.error_estimates.setOnes();
        return response;
    }
    if (!contact.outline()) detail::compare_meshes<Scalar>(detail::mirrored_coupling(response.coefficients), response);
    for (const auto& [elements, strips] : {std::pair{n, m / 2}, {n / 2, m}}) {
        const PatchMesh<Scalar> coarser = patch_mesh(contact, elements, strips);
        detail::compare_meshes(detail::solve_on_mesh(coarser, scheme, kernel).coefficients, response);
    }
    return response;
}

/// The same for the half-space.
template <class Scalar, RollingScheme<Scalar> Scheme>
Response<Scalar> solve_steady(const PatchContact<Scalar>& contact, const PatchMesh<Scalar>& mesh,
                              const Scheme& scheme) {
    return solve_steady(contact, mesh, scheme, HalfSpace<Scalar>(contact.poisson_ratio()));
}

}  // namespace rollbem
