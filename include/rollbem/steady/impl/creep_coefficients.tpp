// Bodies of steady/creep_coefficients.hpp. Internal.
#pragma once

#include "../creep_coefficients.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Core>

#include "../../adhesion/response.hpp"
#include "../../assembly/patch_system.hpp"
#include "../../detail/require.hpp"
#include "../../discretisation/mesh.hpp"
#include "../../discretisation/patch_mesh.hpp"
#include "../../elasticity/patch_kernel.hpp"
#include "../../scene/creepage.hpp"
#include "../../scene/patch_contact.hpp"
#include "../../status.hpp"
#include "../../system/detail/response_parts.hpp"
#include "../../types.hpp"

namespace rollbem {

template <class Value>
CreepCoefficients<Value> creep_coefficients(const PatchContact& contact, const Response<Value>& response) {
    const MatrixX<Value>& coefficients = response.coefficients;
    detail::require(coefficients.cols() == 3, "creep_coefficients", "number of creepages", coefficients.cols(), "be 3");
    using Scalar = typename Response<Value>::Scalar;
    const auto force = static_cast<Scalar>(contact.a_over_b()), spin = std::sqrt(force);  // a^2/(a b), a/c
    return {force * coefficients(0, 0), force * coefficients(1, 1), force * (spin * coefficients(1, 2)),
            force * (spin * coefficients(2, 1)), force * (force * coefficients(2, 2))};  // force^2 may overflow
}

template <class Scalar>
bool is_confirmed(const Response<Scalar>& steady, Eigen::Index i, Eigen::Index j) {
    if (steady.status == Status::ok) return true;
    return steady.status == Status::not_converged && steady.error_estimates(i, j) <= Scalar(largest_error_estimate);
}

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

}  // namespace rollbem

namespace rollbem::detail {

/// Sizes of differences of coefficients, relative to them: c23 and c32 to the larger of both, c12, c13, c21 and c31 to
/// the mean of theirs on the diagonal.
template <class Scalar>
MatrixX<Scalar> relative_sizes(const MatrixX<Scalar>& differences, const MatrixX<Scalar>& coefficients) {
    const VectorX<Scalar> own = coefficients.diagonal().cwiseAbs();
    MatrixX<Scalar> scale = (own * own.transpose()).cwiseSqrt();
    scale(1, 2) = scale(2, 1) = (std::max)(std::abs(coefficients(1, 2)), std::abs(coefficients(2, 1)));
    return differences.cwiseAbs().cwiseQuotient(scale);
}

/// The coefficients of an ellipse with c23 = -c32, as in the limit of small elements.
template <class Scalar>
MatrixX<Scalar> antisymmetric_coupling(MatrixX<Scalar> coefficients) {
    coefficients(1, 2) = (coefficients(1, 2) - coefficients(2, 1)) / 2;
    coefficients(2, 1) = -coefficients(1, 2);
    return coefficients;
}

/// Whether the coefficients of an ellipse can be trusted without other meshes. Long elements and few strips get c33
/// wrong first, a small difference of large numbers there; few strips at the ends get the lengths of strips wrong, by
/// the squares of which forces of wide patches go, times y^2 in c33.
template <class Scalar>
bool is_resolved(const PatchContact& contact, const PatchMesh<Scalar>& mesh) {
    const auto ratio = static_cast<Scalar>(contact.a_over_b());
    if (contact.outline() || ratio > Scalar(10.001)) return false;
    const Scalar enough = ratio > Scalar(3.5) ? 12 : 8, pi = std::numbers::pi_v<Scalar>;
    const ArrayX<Scalar>& along = mesh.along().widths();
    const Scalar end = (std::max)(along[0], along[along.size() - 1]);  // 1 - cos(pi/n) of a cosine mesh
    if (end > Scalar(1.001) * (1 - std::cos(pi / enough)) || Scalar(mesh.strip_count()) < enough) return false;
    const ArrayX<Scalar> y = mesh.middles_y() * ratio;
    const Scalar found = (mesh.widths() * ratio * y.square() * mesh.half_lengths().square()).sum();
    return std::abs(found / Scalar(4.0 / 15) - 1) < Scalar(0.035);
}

/// Relative distances of coefficients from the limits of small elements that meshes of the library's own show, and the
/// doubt about these limits.
template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
MatrixX<Scalar> distances_from_limits(const PatchContact& contact, const Scheme& scheme, const Kernel& kernel,
                                      const MatrixX<Scalar>& own) {
    const PatchContact::Outline* const outline = contact.outline();
    const Scalar order = outline ? Scalar(1.5) : Scalar(2);  // corners leave less than the second
    const auto on = [&](Eigen::Index n) -> MatrixX<Scalar> {
        const Mesh<Scalar> across =
            outline ? mesh_from_edges<Scalar>(outline_strips(*outline, n + n / 2).edges().template cast<Scalar>())
                    : cosine_mesh<Scalar>(n);
        const MatrixX<Scalar> found =
            solve_steady(patch_mesh(contact, cosine_mesh<Scalar>(n), across), scheme, kernel).coefficients;
        return outline ? found : antisymmetric_coupling(found);
    };
    const auto limit = [&](const MatrixX<Scalar>& coarse, const MatrixX<Scalar>& fine, Scalar sizes) {
        return MatrixX<Scalar>(fine + (fine - coarse) / (std::pow(sizes, order) - 1));
    };
    const MatrixX<Scalar> middle = on(12), first = limit(on(8), middle, Scalar(1.5));
    const auto of_first = [&](const MatrixX<Scalar>& from) { return relative_sizes<Scalar>(from - first, first); };
    const MatrixX<Scalar> errors = of_first(own), doubts = of_first(middle);
    // a third mesh decides what is neither certainly right nor far off by two; of outlines it costs most
    constexpr Scalar largest = Scalar(largest_error_estimate);
    const Scalar right = outline ? largest : 2 * largest / 3;
    const bool decided = ((errors + doubts).array() <= right || (errors - doubts).array() > 2 * largest).all();
    if (decided) return errors + doubts;
    const MatrixX<Scalar> last = limit(middle, on(16), Scalar(4) / 3);
    return relative_sizes<Scalar>(own - last, last) + relative_sizes<Scalar>(last - first, last);
}

/// Estimates of the errors of coefficients, relative to them.
template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
MatrixX<Scalar> estimated_errors(const PatchContact& contact, const PatchMesh<Scalar>& mesh, const Scheme& scheme,
                                 const Kernel& kernel, const MatrixX<Scalar>& own) {
    const Eigen::Index n = mesh.elements_per_strip(), m = mesh.strip_count();
    const bool at_middles = has_wide_strips(mesh) && !HasCouplingIntegral<Kernel>;
    const bool is_long = 2 * mesh.half_lengths().maxCoeff() > Scalar(12.001) * mesh.height();
    if (!at_middles && !(is_long && mesh.size() > 256)) {
        if (!is_resolved(contact, mesh)) return distances_from_limits(contact, scheme, kernel, own);
        return relative_sizes<Scalar>(antisymmetric_coupling(own) - own, own);
    }
    MatrixX<Scalar> errors = MatrixX<Scalar>::Zero(3, 3);
    const auto compare = [&](Eigen::Index other_n, Eigen::Index other_m) {
        if (other_n == 0 || other_m == 0) {  // half of one element or strip
            errors.setOnes();
            return;
        }
        const MatrixX<Scalar> other =
            solve_steady(patch_mesh(contact, cosine_mesh<Scalar>(other_n), cosine_mesh<Scalar>(other_m)), scheme,
                         kernel)
                .coefficients;
        errors = errors.cwiseMax(relative_sizes<Scalar>(own - other, own) * Scalar(0.65));
    };
    compare(n, m / 2);
    if (is_long) compare(n / 2, m);
    return errors;
}

}  // namespace rollbem::detail

namespace rollbem {

template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
Response<Scalar> solve_steady(const PatchContact& contact, const PatchMesh<Scalar>& mesh, const Scheme& scheme,
                              const Kernel& kernel) {
    Response<Scalar> response = solve_steady(mesh, scheme, kernel);
    if (response.status != Status::ok) return response;
    MatrixX<Scalar> estimates = detail::estimated_errors(contact, mesh, scheme, kernel, response.coefficients);
    if ((estimates.array() <= Scalar(largest_error_estimate)).all()) {
        if (!detail::is_resolved(contact, mesh)) response.error_estimates = std::move(estimates);
    } else {
        response.status = Status::not_converged;
        response.error_estimates = std::move(estimates);
    }
    return response;
}

inline TangentialForce creep_force(const PatchContact& contact, const Response<double>& steady,
                                   const Creepage& creepage) {
    const double a = contact.half_length(), scale = -contact.shear_modulus() * a * a;
    const MatrixX<double>& c = steady.coefficients;
    detail::require(c.cols() == 3, "creep_force", "number of creepages", c.cols(), "be 3");
    const auto force = [&](Eigen::Index i) {
        return scale * (c(i, 0) * creepage.longitudinal + c(i, 1) * creepage.lateral + c(i, 2) * (creepage.spin * a));
    };
    return {force(0), force(1), a * force(2)};
}

}  // namespace rollbem
