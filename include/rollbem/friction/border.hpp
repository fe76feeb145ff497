// Steady rolling with friction on a mesh that is fitted to the border between slip and stick, and extrapolated.
// For one slip zone at the trailing edge and stick from there to the leading edge, as under Hertz's pressure.
#pragma once

#include "../detail/language.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>
#include <type_traits>
#include <utility>

#include <Eigen/LU>

#include "../detail/finite.hpp"
#include "steady.hpp"

namespace rollbem {

/// A pressure known at every point: the mean p_n [Pa] on each element of any mesh.
template <class Pressure, class Scalar>
concept PressureLaw = requires(const Pressure& pressure, const Mesh<Scalar>& mesh) {
    { pressure(mesh) } -> std::convertible_to<ArrayX<Scalar>>;
};

/// Two cosine meshes that meet at a border: `slip_count` elements behind it, `stick_count` ahead of it, small ones at
/// the border and at both edges. `border_from_trailing` = 1 + x of the border. Throws std::invalid_argument unless both
/// counts are at least 1 and 0 < border_from_trailing < 2.
template <class Scalar>
Mesh<Scalar> border_mesh(Eigen::Index slip_count, Eigen::Index stick_count, Scalar border_from_trailing) {
    detail::require(slip_count >= 1, "border_mesh", "slip_count", slip_count, "be at least 1");
    detail::require(stick_count >= 1, "border_mesh", "stick_count", stick_count, "be at least 1");
    detail::require(detail::is_finite(border_from_trailing) && border_from_trailing > 0 && border_from_trailing < 2,
                    "border_mesh", "border_from_trailing", border_from_trailing, "lie between 0 and 2");
    const Scalar behind = border_from_trailing, ahead = 2 - border_from_trailing;
    const Mesh<Scalar> slip = cosine_mesh<Scalar>(slip_count), stick = cosine_mesh<Scalar>(stick_count);
    typename Mesh<Scalar>::Data data;
    data.widths.resize(slip_count + stick_count);
    data.edges_from_trailing.resize(slip_count + stick_count + 1);
    data.edges_from_leading.resize(slip_count + stick_count + 1);
    data.widths << slip.widths() * (behind / 2), stick.widths() * (ahead / 2);
    data.edges_from_trailing << slip.edges_from_trailing() * (behind / 2),
        behind + stick.edges_from_trailing().tail(stick_count) * (ahead / 2);
    data.edges_from_leading << ahead + slip.edges_from_leading().head(slip_count) * (behind / 2),
        stick.edges_from_leading() * (ahead / 2);
    return Mesh<Scalar>(std::move(data));
}

/// Steady rolling with friction on a fitted mesh.
template <class Scalar>
struct FittedFrictionSolution {
    Mesh<Scalar> mesh;         ///< the finer of both meshes
    VectorX<Scalar> traction;  ///< p on body 1 of its elements [Pa], trailing to leading
    VectorX<Scalar> slip;      ///< s/V of its elements [-]; zero in stick
    bool fitted = false;       ///< whether the picture held; if not, all results are those of the plain solver
    /// x/a at which stick begins [-]; 1 for full sliding; not a number unless fitted.
    Scalar border = std::numeric_limits<Scalar>::quiet_NaN();
    /// F_bar on body 1 [N/m], extrapolated. Not a number, as all that follows, where the creepage is not finite.
    Scalar force_per_width = std::numeric_limits<Scalar>::quiet_NaN();
    /// |F_bar - F_bar of the finer mesh| [N/m]: the order of the error before extrapolation, mostly far more than what
    /// is left. Not a number unless fitted.
    Scalar force_error = std::numeric_limits<Scalar>::quiet_NaN();
    /// d F_bar / d creepage [N/m], extrapolated.
    Scalar tangent_per_width = std::numeric_limits<Scalar>::quiet_NaN();
    /// Work that slip turns into heat per unit width and distance rolled [J/m^2]: -F_bar xi, as in steady rolling the
    /// elastic energy does not change.
    Scalar slip_work_per_width = std::numeric_limits<Scalar>::quiet_NaN();
    /// Largest violation on the finer mesh of |p| <= mu p_n (over the largest mu p_n) and of the slip's direction (over
    /// |xi|): of the order of the discretisation error.
    Scalar complementarity_residual = std::numeric_limits<Scalar>::quiet_NaN();
    int evaluations = 0;  ///< fitted meshes assembled and solved, of either size
    StepStatus status = StepStatus::not_finite;
};

namespace detail {

/// The steady problem as a function of the border, dimensionless, for creepage >= 0: p = -bound up to and with the last
/// element behind the border, where slip just begins, and stick ahead of it. The creepage that belongs to the border is
/// unknown along with the tractions of the stick zone: one linear system.
template <class Scalar, RollingScheme<Scalar> Scheme, LineKernel Kernel, class Bound>
class BorderProblem {
public:
    struct Point {
        Scalar creepage, force, tangent;
    };

    BorderProblem(Eigen::Index n, const Scheme& scheme, const Kernel& kernel, const Bound& bound)
        : n_(n),
          slip_count_(n / 2),
          scheme_(scheme),
          kernel_(kernel),
          bound_of_(bound),
          mesh_(cosine_mesh<Scalar>(n)) {}

    Point evaluate(Scalar border_from_trailing) {
        set_mesh(border_mesh<Scalar>(slip_count_, n_ - slip_count_, border_from_trailing));
        const Eigen::Index free = n_ - slip_count_, last = slip_count_ - 1;
        // unknowns: creepage, then the tractions ahead of the border; equations: the rows from the last slip element on
        MatrixX<Scalar> system(free + 1, free + 1);
        system.col(0).setConstant(-1);
        system.rightCols(free) = G_prime_.bottomRightCorner(free + 1, free);
        const Eigen::PartialPivLU<MatrixX<Scalar>> lu(system);
        const VectorX<Scalar> solution =
            lu.solve(G_prime_.block(last, 0, free + 1, slip_count_) * bound_.head(slip_count_));
        traction_ << -bound_.head(slip_count_), solution.tail(free);
        const Eigen::PartialPivLU<MatrixX<Scalar>> stick(G_prime_.bottomRightCorner(free, free));
        const VectorX<Scalar> change = stick.solve(VectorX<Scalar>::Ones(free));
        return {solution[0], mesh_.widths().matrix().dot(traction_), mesh_.widths().tail(free).matrix().dot(change)};
    }

    void slide() {
        set_mesh(cosine_mesh<Scalar>(n_));
        traction_ = -bound_;
    }

    /// s/V of the present tractions.
    VectorX<Scalar> slip(Scalar creepage) const {
        VectorX<Scalar> slip = VectorX<Scalar>::Constant(n_, creepage) - G_prime_ * traction_;
        return slip;
    }
    Eigen::Index slip_count() const { return slip_count_; }
    const Mesh<Scalar>& mesh() const { return mesh_; }
    const VectorX<Scalar>& traction() const { return traction_; }
    const VectorX<Scalar>& bound() const { return bound_; }

private:
    void set_mesh(Mesh<Scalar> mesh) {
        mesh_ = std::move(mesh);
        bound_ = bound_of_(mesh_);
        G_prime_ = assemble_G_prime(mesh_, scheme_, kernel_);
        traction_.resize(n_);
    }

    Eigen::Index n_, slip_count_;
    const Scheme& scheme_;
    const Kernel& kernel_;
    const Bound& bound_of_;
    Mesh<Scalar> mesh_;
    VectorX<Scalar> bound_, traction_;
    MatrixX<Scalar> G_prime_;
};

template <class Scalar>
struct FittedLevel {
    Scalar border_from_trailing, force, tangent;
    bool found;
};

/// Seeks the border that belongs to a creepage >= 0, starting from `guess` where that lies between 0 and 2. Without
/// creepage there is none.
template <class Scalar, class Problem>
FittedLevel<Scalar> fit_border(Problem& problem, Scalar creepage, Scalar guess, int& evaluations) {
    FittedLevel<Scalar> level{2, 0, 0, creepage > 0};
    ++evaluations;
    problem.slide();
    if (!level.found) return level;
    if (problem.slip(creepage).minCoeff() >= 0) {
        level.force = problem.mesh().widths().matrix().dot(problem.traction());
        return level;
    }
    // The creepage rises with the border, from 0 to that of full sliding: secant steps, bisection where they leave the
    // bracket. What is left is corrected along the tangent, so that the root need not be exact.
    const Scalar smallest = std::sqrt(std::numeric_limits<Scalar>::epsilon()) / 64;
    Scalar low = 0, high = 2, y = guess > 0 && guess < 2 ? guess : Scalar(1);
    Scalar y_before = 0, excess_before = -creepage;
    for (int iteration = 0; iteration < 100; ++iteration) {
        ++evaluations;
        const auto point = problem.evaluate(y);
        const Scalar excess = point.creepage - creepage;
        if (!is_finite(excess)) break;
        const bool narrow = high - low <= smallest * std::min(low, 2 - high);
        if (std::abs(excess) <= 16 * smallest * creepage || narrow) {
            level.border_from_trailing = y;
            level.force = point.force - point.tangent * excess;
            level.tangent = point.tangent;
            return level;
        }
        (excess < 0 ? low : high) = y;
        if (2 - y < smallest && excess < 0) break;  // stick of no extent, yet not sliding all over
        Scalar next = y - excess * (y - y_before) / (excess - excess_before);
        if (!(next > low && next < high)) next = (low + high) / 2;
        y_before = y;
        excess_before = excess;
        y = next;
    }
    level.found = false;
    return level;
}

}  // namespace detail

/// Steady rolling with friction at a creepage [-]: F_bar to fourth rather than second order in 1/n, by Richardson's
/// extrapolation from about 0.7 n to n elements. That works because the border is an edge of the mesh: on a mesh that
/// is not fitted, the error depends on where in its element the border lies.
///
/// For pressures that leave one slip zone at the trailing edge. Where the fitted solution violates its own conditions
/// by more than 0.05 (several slip zones, or stick that is vanishing), and without creepage, the plain solver's on
/// cosine_mesh(n) with alpha = 0.5 takes its place. alpha_L = 0 is what suits the fitted mesh: with 0.5 throughout, the
/// error is ten times larger. Below a creepage ratio of 5e-4 the plain solver is the better one (n = 40: an error of
/// 1e-4 instead of 5e-4).
///
/// kernel: of the contact's half-width in units of a. pressure: gives the means p_n [Pa] on any mesh, e.g.
/// [&](const Mesh<double>& mesh) { return hertz.mean_pressure(mesh); }; smooth between the edges of the contact.
/// Throws std::invalid_argument for n < 10, an odd n, a bad coefficient of friction or pressure, or as
/// assemble_G_prime.
template <class Scalar, LineKernel Kernel, PressureLaw<Scalar> Pressure>
FittedFrictionSolution<Scalar> solve_fitted_friction(const Contact<Scalar>& contact, Eigen::Index n,
                                                     const Kernel& kernel,
                                                     std::type_identity_t<Scalar> friction_coefficient,
                                                     const Pressure& pressure, std::type_identity_t<Scalar> creepage,
                                                     const Collocation& scheme = {.alpha_L = 0, .alpha_T = 0.5}) {
    detail::require(n >= 10 && n % 2 == 0, "solve_fitted_friction", "n", n, "be even and at least 10");
    const auto bound = [&](const Mesh<Scalar>& mesh) {
        return detail::friction_bound<Scalar>("solve_fitted_friction", {friction_coefficient, pressure(mesh)},
                                              mesh.size(), mesh.size(), contact.shear_modulus());
    };
    FittedFrictionSolution<Scalar> result{.mesh = cosine_mesh<Scalar>(n), .traction = {}, .slip = {}};
    result.traction.setZero(n);
    result.slip.setZero(n);
    if (!detail::is_finite(creepage)) return result;
    const Scalar sign = creepage < 0 ? Scalar(-1) : Scalar(1);

    using Problem = detail::BorderProblem<Scalar, Collocation, Kernel, decltype(bound)>;
    const Eigen::Index coarse_n = 2 * ((7 * n + 10) / 20);
    Problem coarse(coarse_n, scheme, kernel, bound), fine(n, scheme, kernel, bound);
    const detail::FittedLevel<Scalar> before =
        detail::fit_border(coarse, std::abs(creepage), Scalar(1), result.evaluations);
    const detail::FittedLevel<Scalar> last =
        detail::fit_border(fine, std::abs(creepage), before.border_from_trailing, result.evaluations);

    const Scalar ratio = static_cast<Scalar>(n) / static_cast<Scalar>(coarse_n);
    const auto extrapolate = [ratio](Scalar from, Scalar to) { return to + (to - from) / ((ratio - 1) * (ratio + 1)); };
    const Scalar force_unit = contact.half_length() * contact.shear_modulus();
    result.mesh = fine.mesh();
    result.border = last.border_from_trailing - 1;
    result.traction = sign * contact.shear_modulus() * fine.traction();
    const VectorX<Scalar> slip = fine.slip(std::abs(creepage));
    const Eigen::Index slipping = last.border_from_trailing < 2 ? fine.slip_count() : n;
    result.slip.head(slipping) = sign * slip.head(slipping);
    const Scalar force = extrapolate(before.force, last.force);
    result.force_per_width = sign * force_unit * force;
    result.force_error = force_unit * std::abs(force - last.force);
    result.tangent_per_width = force_unit * extrapolate(before.tangent, last.tangent);
    result.slip_work_per_width = -result.force_per_width * creepage;
    const Scalar excess = (fine.traction().cwiseAbs() - fine.bound()).maxCoeff() / fine.bound().maxCoeff();
    const Scalar wrong_slip = -slip.head(slipping).minCoeff() / std::abs(creepage);
    result.complementarity_residual = std::max({excess, wrong_slip, Scalar(0)});
    const bool finite = detail::is_finite(result.force_per_width) && detail::is_finite(result.tangent_per_width) &&
                        detail::is_finite(excess) && detail::is_finite(wrong_slip);
    result.fitted = before.found && last.found && finite && result.complementarity_residual <= Scalar(0.05);
    result.status = StepStatus::ok;
    if (result.fitted) return result;

    result.mesh = cosine_mesh<Scalar>(n);
    const SteadyFrictionModel<Scalar> model(contact, result.mesh, Collocation{.alpha_L = 0.5, .alpha_T = 0.5}, kernel,
                                            {friction_coefficient, pressure(result.mesh)});
    const FrictionState<Scalar> rest = model.at_rest();
    FrictionState<Scalar> state = rest;
    FrictionWorkspace<Scalar> workspace = model.workspace();
    const FrictionStep<Scalar> plain = model.solve(rest, creepage, state, workspace);
    result.traction = state.traction;
    result.slip = workspace.slip();
    result.border = result.force_error = std::numeric_limits<Scalar>::quiet_NaN();
    result.force_per_width = plain.force_per_width;
    result.tangent_per_width = plain.tangent_per_width;
    result.slip_work_per_width = -result.force_per_width * creepage;
    result.complementarity_residual = plain.complementarity_residual;
    result.status = plain.status;
    return result;
}

}  // namespace rollbem
