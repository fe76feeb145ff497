// Steady rolling with friction where slip lies at the trailing edge and stick ahead of it, as under Hertz's pressure:
// the border, the force and the tractions exactly, by series instead of elements.
#pragma once

#include "../detail/language.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>

#include "../detail/finite.hpp"
#include "../elasticity/line_kernel.hpp"
#include "../normal/hertz.hpp"
#include "detail/stick_zone.hpp"
#include "steady.hpp"

namespace rollbem {

/// A pressure known at every point: p_n [Pa] at x/a in [-1, 1], finite and not negative, and its mean on each element
/// of any mesh, for where elements have to take over. HertzPressure and PressureTable are such laws.
template <class Pressure, class Scalar>
concept PressureLaw = requires(const Pressure& pressure, Scalar x_over_a, const Mesh<Scalar>& mesh) {
    { pressure(x_over_a) } -> std::convertible_to<Scalar>;
    { pressure(mesh) } -> std::convertible_to<ArrayX<Scalar>>;
};

/// Steady rolling with friction at one creepage: exact, or by elements where the picture does not hold.
template <class Scalar_>
struct StickBorderSolution {
    using Scalar = Scalar_;

    static constexpr Scalar none = std::numeric_limits<Scalar>::quiet_NaN();

    bool exact = false;  ///< whether the picture held; if not, all results are those of the solver on elements
    /// x/a at which stick begins [-]: -1 without creepage, 1 for full sliding; not a number unless exact.
    Scalar border = none;
    /// F_bar on body 1 [N/m]. Not a number, as all that follows, where the creepage is not finite.
    Scalar force_per_width = none;
    /// Estimate of the error of F_bar [N/m]: what more coefficients change, and what the violations of the law between
    /// them would. Not a number unless exact.
    Scalar force_error = none;
    Scalar tangent_per_width = none;  ///< d F_bar / d creepage [N/m]
    /// Work that slip turns into heat per unit width and distance rolled [J/m^2]: -F_bar xi, as in steady rolling the
    /// elastic energy does not change.
    Scalar slip_work_per_width = none;
    /// Largest violation at the sampled points of |p| <= mu p_n (over the largest mu p_n) and of the slip's direction
    /// (over |xi|).
    Scalar complementarity_residual = none;
    Eigen::Index coefficients = 0;  ///< points of the pressure in the slip zone; 0 unless exact
    Eigen::Index unknowns = 0;      ///< of the linear system for the kernel's smooth part; 0 for the plane kernel
    int evaluations = 0;            ///< borders tried
    StepStatus status = StepStatus::not_finite;

    /// Traction p on body 1 [Pa] at x/a in [-1, 1]; of an element that of its extent. Not a number where the status is
    /// neither ok nor no_solution, or outside.
    Scalar traction(Scalar x_over_a) const {
        if (!defined_at(x_over_a)) return none;
        if (elements) return elements->traction[elements->index(x_over_a)];
        const Scalar p = x_over_a > border ? zone.traction(x_over_a) : -bound(x_over_a);
        return sign * shear_modulus * p;
    }
    /// Slip s/V [-] at x/a, zero in stick. Not a number where the traction is not.
    Scalar slip(Scalar x_over_a) const {
        if (!defined_at(x_over_a)) return none;
        if (elements) return elements->slip[elements->index(x_over_a)];
        return x_over_a > border || !(zone.y > 0) ? Scalar(0) : sign * zone.slip(x_over_a, smooth_slope);
    }

    /// What took over.
    struct Elements {
        Mesh<Scalar> mesh;
        VectorX<Scalar> traction;  ///< [Pa], trailing to leading
        VectorX<Scalar> slip;      ///< s/V [-]

        Eigen::Index index(Scalar x_over_a) const {
            const Scalar* const first = mesh.edges_from_trailing().data();
            const Eigen::Index edge = std::upper_bound(first, first + mesh.size(), 1 + x_over_a) - first;
            return std::max<Eigen::Index>(edge - 1, 0);
        }
    };
    std::optional<Elements> elements;  ///< nothing where the solution is exact

    // what traction() and slip() of an exact solution are evaluated from
    detail::StickZone<Scalar> zone;
    std::function<Scalar(Scalar)> bound, smooth_slope;
    Scalar sign = 1, shear_modulus = 1;

private:
    bool defined_at(Scalar x) const {
        const bool solved = status == StepStatus::ok || status == StepStatus::no_solution;
        return solved && detail::is_finite(x) && x >= -1 && x <= 1;
    }
};

namespace detail {

/// The points of every level, made when they are first asked for.
template <class Scalar>
class PointsOfLevels {
public:
    static constexpr int count = 9;  // 16, 32 ... 4096 points

    const AngularPoints<Scalar>& operator[](int level) {
        std::optional<AngularPoints<Scalar>>& points = points_[static_cast<std::size_t>(level)];
        if (!points) points.emplace(Eigen::Index(16) << level);
        return *points;
    }

    int of(const AngularPoints<Scalar>& points) const {
        int level = 0;
        while ((Eigen::Index(16) << level) < points.size()) ++level;
        return level;
    }

private:
    std::array<std::optional<AngularPoints<Scalar>>, count> points_;
};

template <class Scalar>
struct PressureScan {
    Scalar load = 0;     // integral over x/a
    Scalar largest = 0;  // of the values seen
    bool jumps = true;
    int level = 0;  // at which it settled, or the last
};

/// Integral of a bound over the contact by the midpoint rule in the angle, the number of points doubled until it
/// settles. With a kink the last doubling changes it like 1/M^2, with a jump J by J pi/(2 M) or nearly wherever the
/// jump lies.
template <class Scalar, class Bound>
PressureScan<Scalar> scan_pressure(const Bound& bound, PointsOfLevels<Scalar>& levels) {
    PressureScan<Scalar> scan;
    for (int level = 0; level < PointsOfLevels<Scalar>::count; ++level) {
        const AngularPoints<Scalar>& points = levels[level];
        Scalar load = 0;
        for (Eigen::Index j = 0; j < points.size(); ++j) {
            const Scalar value = bound(points.cosine[j]);
            require(is_finite(value) && value >= 0, "solve_stick_border", "mu p_n / G", value,
                    "be finite and not negative");
            scan.largest = std::max(scan.largest, value);
            load += 2 * points.weight(j) * value;
        }
        const Scalar change = std::abs(load - scan.load);
        scan.load = load;
        scan.level = level;
        if (level == 0) continue;
        const Scalar jump = change * 2 * static_cast<Scalar>(points.size()) / std::numbers::pi_v<Scalar>;
        scan.jumps = jump > Scalar(0.004) * scan.largest;
        if (change <= 64 * std::numeric_limits<Scalar>::epsilon() * load) break;
    }
    return scan;
}

template <class Scalar>
struct Violation {
    Scalar largest = 0, integral = 0;  // over the part of a zone, 0 ... 1
};

/// How far a function of the part of a zone, 0 at its trailing and 1 at its leading end, rises above zero by more than
/// rounding in `unit`: at points that gather at both ends, and at the vertices of the parabolas through those about
/// each local maximum, so that what rises between the points is found. Where something does, on a dense set.
template <class Scalar, class Function>
Violation<Scalar> worst_violation(PointsOfLevels<Scalar>& levels, int level, Scalar unit, const Function& f) {
    constexpr int dense = 5;  // 512 points
    level = std::min(level, dense);
    const AngularPoints<Scalar>& points = levels[level];
    const Eigen::Index M = points.size();
    const Scalar rounding = 256 * std::numeric_limits<Scalar>::epsilon() * unit;
    Violation<Scalar> violation;
    Scalar last = 0, before = 0;
    const auto see = [&](Scalar value) { violation.largest = std::max(violation.largest, value); };
    for (Eigen::Index j = 0; j < M; ++j) {
        const Scalar value = f(points.rise[j]);
        see(value);
        if (!is_finite(value)) return {value, value};
        violation.integral += std::max(value, Scalar(0)) * points.weight(j);
        if (j > 1 && last >= before && last >= value && (last > before || last > value)) {
            const Scalar shift = (value - before) / (2 * (2 * last - before - value));
            const Scalar half = (static_cast<Scalar>(j) - Scalar(0.5) + shift) / static_cast<Scalar>(2 * M);
            const Scalar cosine = std::cos(half * std::numbers::pi_v<Scalar>);
            see(f(cosine * cosine));
        }
        before = last;
        last = value;
    }
    if (violation.largest > rounding && level < dense) return worst_violation(levels, dense, unit, f);
    return violation;
}

/// The most unknowns of the smooth part: what strips below b/a of about 0.03 would need more of.
inline constexpr Eigen::Index most_stick_zone_unknowns = 400;

/// Accuracy of the stick border, level by level: M points of the pressure, and N unknowns for a smooth part that is
/// analytic up to a distance d. Chebyshev series on a zone of half-length h <= 1 converge like exp(-k asinh(d/h)), and
/// an integral of the solution, as the force is, twice as fast in the smallness of the interaction itself: N starts
/// where the series has e^-6 and grows from level to level until the force does not change.
template <class Scalar>
StickZoneRule<Scalar> stick_zone_rule(int level, const AngularPoints<Scalar>& points, Scalar distance) {
    if (!is_finite(distance)) return {points, 0, 0};
    const Scalar first = 4 + 6 / std::asinh(std::max(distance, Scalar(0.02)));
    const Eigen::Index N =
        std::min<Eigen::Index>(static_cast<Eigen::Index>(first) * (level + 2) / 2, most_stick_zone_unknowns);
    return {points, N, std::max<Eigen::Index>(std::min<Eigen::Index>(points.size(), 512), N)};
}

/// The border whose creepage is `creepage` > 0, from `y` on: secant steps within a bracket, bisection where they leave
/// it or do not halve it in three steps. Full sliding where the creepage suffices for it.
template <class Scalar, class Problem>
std::pair<Scalar, typename Problem::Point> find_border(Problem& problem, const StickZoneRule<Scalar>& rule,
                                                       Scalar creepage, Scalar y, int& evaluations) {
    // x/a is rounded, which is felt where the distance y to the trailing edge is small
    const Scalar small = 4 * std::numeric_limits<Scalar>::epsilon();
    ++evaluations;
    typename Problem::Point point = problem.evaluate(2, rule);
    if (creepage >= point.creepage) return {Scalar(2), point};
    Scalar low = 0, high = 2, low_excess = -creepage, high_excess = point.creepage - creepage;
    if (!(y > 0 && y < 2)) y = 2 * creepage / point.creepage;
    Scalar y_before = high, excess_before = high_excess;
    Scalar width_before = 2;
    for (int iteration = 0; iteration < 100; ++iteration) {
        if (!(y > low && y < high)) y = low + (high - low) / 2;
        ++evaluations;
        point = problem.evaluate(y, rule);
        const Scalar excess = point.creepage - creepage;
        if (!is_finite(excess) || std::abs(excess) <= small * (1 + 1 / y) * creepage) break;
        (excess < 0 ? low : high) = y;
        (excess < 0 ? low_excess : high_excess) = excess;
        if (high - low <= small * std::min(high, Scalar(1))) break;
        Scalar next = y - excess * (y - y_before) / (excess - excess_before);
        if (!(next > low && next < high)) next = low - low_excess * (high - low) / (high_excess - low_excess);
        if (iteration % 3 == 2) {
            if (high - low > width_before / 2) next = low + (high - low) / 2;
            width_before = high - low;
        }
        y_before = y;
        excess_before = excess;
        y = next;
    }
    return {y, point};
}

}  // namespace detail

/// Steady rolling with friction at a creepage [-] by the exact border between slip, behind, and stick, ahead of it.
///
/// For pressures without jumps inside the contact (they need not vanish at its ends) that leave one slip zone at the
/// trailing edge. The pressure counts in the slip zone alone, where its points are doubled until the force settles:
/// Hertz's and other analytic pressures over sqrt(1 - x^2) reach rounding with 32, tables, whose kinks converge like
/// 1/M^2, 1e-6 with up to 4096. Where the pressure jumps, the estimated error exceeds 1e-6 mu N or the law is violated
/// (several zones of stick or slip, slip against the traction, |p| above the bound), the solver on
/// cosine_mesh(fallback_elements) with alpha = 0.5 takes its place, and the result says so. That is so, too, for strips
/// much narrower than b/a = 0.02 once slip counts: they would need more unknowns than there are.
///
/// kernel: of the contact's half-width in units of a. pressure: p_n [Pa] at every point and its means, e.g.
/// hertz.pressure(); the result keeps a copy. Throws std::invalid_argument for fallback_elements < 1, a coefficient of
/// friction or a pressure that is negative or not finite, or a pressure that is zero everywhere.
template <class Scalar, SlopeSplitKernel Kernel, PressureLaw<Scalar> Pressure>
StickBorderSolution<Scalar> solve_stick_border(const Contact<Scalar>& contact, const Kernel& kernel,
                                               std::type_identity_t<Scalar> friction_coefficient,
                                               const Pressure& pressure, std::type_identity_t<Scalar> creepage,
                                               Eigen::Index fallback_elements = 40) {
    constexpr const char* who = "solve_stick_border";
    detail::require(fallback_elements >= 1, who, "fallback_elements", fallback_elements, "be at least 1");
    detail::require(detail::is_finite(friction_coefficient) && friction_coefficient >= 0, who, "friction_coefficient",
                    friction_coefficient, "be finite and not negative");
    const auto bound = [&, scale = friction_coefficient / contact.shear_modulus()](Scalar x) -> Scalar {
        return scale * pressure(x);
    };
    const auto smooth_slope = [&kernel](Scalar x) { return kernel.smooth_slope(x); };
    detail::PointsOfLevels<Scalar> levels;
    const detail::PressureScan<Scalar> scan = detail::scan_pressure<Scalar>(bound, levels);
    detail::require(scan.largest > 0 || friction_coefficient == 0, who, "largest normal_pressure", scan.largest,
                    "be positive");

    StickBorderSolution<Scalar> result;
    result.shear_modulus = contact.shear_modulus();
    if (!detail::is_finite(creepage)) return result;
    result.sign = creepage < 0 ? Scalar(-1) : Scalar(1);
    const Scalar xi = std::abs(creepage), force_unit = contact.half_length() * contact.shear_modulus();
    const Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
    const Scalar tolerance = std::max(Scalar(1e-6), 64 * epsilon) * scan.load;

    using Problem = detail::StickZoneProblem<Scalar, Kernel, decltype(bound)>;
    Problem problem(kernel, bound);
    Scalar y = -1, error = std::numeric_limits<Scalar>::infinity();
    typename Problem::Point point{};
    const auto rule_of = [&](int level) {
        return detail::stick_zone_rule<Scalar>(level, levels[level], kernel.smooth_split().distance);
    };
    const auto force_at_creepage = [&] {
        return y < 2 ? point.force + point.tangent * (xi - point.creepage) : point.force;
    };
    std::optional<detail::StickZoneRule<Scalar>> rule;
    if (!scan.jumps && kernel.smooth_split().strength > 0) rule = rule_of(0);
    for (int level = 1; level < levels.count && rule; ++level) {
        if (xi > 0) {
            std::tie(y, point) = detail::find_border(problem, *rule, xi, y, result.evaluations);
        } else {
            y = 0;
            point = problem.evaluate(y, *rule);
        }
        const Scalar coarse = force_at_creepage(), coarse_creepage = point.creepage;
        rule = rule_of(level);
        ++result.evaluations;
        point = problem.evaluate(y, *rule);
        result.coefficients = rule->points->size();
        result.unknowns = rule->unknowns;
        error = std::abs(force_at_creepage() - coarse);
        // the creepage of full sliding must settle too: it is infinite for a pressure that does not end at zero
        if (y == 2 && xi < point.creepage + std::abs(point.creepage - coarse_creepage)) {
            error += std::abs(point.creepage - coarse_creepage) / kernel.smooth_split().strength;
        }
        point.force = force_at_creepage();
        if (!detail::is_finite(error) || error <= 64 * epsilon * scan.load) break;
    }

    // where the unknowns have come to their most, the last levels do not tell what more of them would change
    if (rule && rule->unknowns == detail::most_stick_zone_unknowns) {
        const Scalar force = point.force;
        const Eigen::Index fewer = rule->unknowns * 2 / 3;
        result.evaluations += 2;
        point = problem.evaluate(y, {*rule->points, fewer, rule->eta.size()});
        error += std::abs(force_at_creepage() - force);
        point = problem.evaluate(y, *rule);
        point.force = force;
    }

    result.exact = rule && detail::is_finite(error) && detail::is_finite(point.tangent);
    if (result.exact) {
        result.border = y - 1;
        result.zone = problem.zone(y < 2 ? point.creepage : xi, *rule);
        const int level = std::max(scan.level, levels.of(*rule->points));
        detail::Violation<Scalar> above, against;
        if (y > 0 && y < 2) {
            above = detail::worst_violation(levels, level, scan.largest, [&](Scalar part) {
                const Scalar x = y - 1 + (2 - y) * part, p = result.zone.traction(x);
                return std::max(std::abs(p) - bound(x), p);
            });
        }
        if (y > 0) {
            against = detail::worst_violation(
                levels, level, xi, [&](Scalar part) { return -result.zone.slip(-1 + y * part, smooth_slope); });
        }
        const Scalar violation = above.integral * (2 - y) + against.integral * y / kernel.smooth_split().strength;
        result.complementarity_residual = std::max(scan.largest > 0 ? above.largest / scan.largest : Scalar(0),
                                                   xi > 0 ? against.largest / xi : Scalar(0));
        error += violation;
        result.exact = detail::is_finite(violation) && detail::is_finite(result.complementarity_residual) &&
                       error <= tolerance && result.complementarity_residual <= Scalar(0.01);
    }
    if (result.exact) {
        result.force_per_width = result.sign * force_unit * point.force;
        result.force_error = force_unit * error;
        result.tangent_per_width = force_unit * point.tangent;
        result.slip_work_per_width = -result.force_per_width * creepage;
        result.bound = [pressure, scale = friction_coefficient / contact.shear_modulus()](Scalar x) -> Scalar {
            return scale * pressure(x);
        };
        result.smooth_slope = [kernel](Scalar x) { return kernel.smooth_slope(x); };
        result.status = StepStatus::ok;
        return result;
    }

    result.border = result.none;
    result.coefficients = result.unknowns = 0;
    result.zone = {};
    const Mesh<Scalar> mesh = cosine_mesh<Scalar>(fallback_elements);
    const SteadyFrictionModel<Scalar> model(contact, mesh, Collocation{.alpha_L = 0.5, .alpha_T = 0.5}, kernel,
                                            {friction_coefficient, pressure(mesh)});
    const FrictionState<Scalar> rest = model.at_rest();
    FrictionState<Scalar> state = rest;
    FrictionWorkspace<Scalar> workspace = model.workspace();
    const FrictionStep<Scalar> plain = model.solve(rest, creepage, state, workspace);
    result.elements.emplace(typename StickBorderSolution<Scalar>::Elements{mesh, state.traction, workspace.slip()});
    result.force_per_width = plain.force_per_width;
    result.tangent_per_width = plain.tangent_per_width;
    result.slip_work_per_width = -result.force_per_width * creepage;
    result.complementarity_residual = plain.complementarity_residual;
    result.status = plain.status;
    return result;
}

}  // namespace rollbem
