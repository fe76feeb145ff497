// Steady rolling with an exact border, where a single border separates slip behind it from stick ahead of it.
// Dimensionless, a = G = 1. Internal.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include <Eigen/Core>

#include <rollbem/detail/finite.hpp>
#include <rollbem/elasticity/line_kernel.hpp>

#include "angular_points.hpp"
#include "stick_zone.hpp"
#include "stick_zone_problem.hpp"

namespace rollbem::detail {

/// The narrowest strip, by the distance d/a of its smooth part, that these orders resolve.
template <class Scalar>
inline constexpr Scalar least_distance = Scalar(0.02);

/// Accuracy of the stick border, level by level: the points of the pressure, and the orders for a smooth part that is
/// analytic up to a distance d. All rates are the slowest ones, which belong to a zone of half-length 1.
///
/// - N unknowns: their sum is singular at the corners +-1 +-id and converges like exp(-k r), where r is the logarithm
///   of the parameter of the Bernstein ellipse through the corners, cosh r = (sqrt(4 + d^2) + d)/2; the force converges
///   twice as fast. N starts where the sum is accurate to e^-14 and doubles, which makes the force accurate to rounding
///   in any scalar type.
/// - P points for the integrals of the unknowns, whose integrands are singular at a distance d from any point of the
///   zone: accurate to rounding for 2P - N = ln(1/eps)/asinh(d).
/// - K points for the integrals of the known tractions, which may have kinks: their number grows with the points of the
///   pressure.
template <class Scalar>
void set_level(StickZoneRule<Scalar>& rule, int level, const AngularPoints<Scalar>& points, Scalar distance) {
    if (!is_finite(distance)) return rule.set(points, 0, 0, 0);
    const Scalar digits = -std::log(std::numeric_limits<Scalar>::epsilon());
    const Scalar ellipse = std::acosh((std::sqrt(4 + distance * distance) + distance) / 2), line = std::asinh(distance);
    const auto N = static_cast<Eigen::Index>(4 + 14 / ellipse) * ((std::min)(level, 2) + 2) / 2;
    const auto P = (std::max)(2 * N, (N + static_cast<Eigen::Index>(digits / line)) / 2 + 5);
    const auto K = std::min<Eigen::Index>(static_cast<Eigen::Index>(4 + 12 / line) * (level + 2) / 2, 1000);
    rule.set(points, N, P, (std::max)(std::min<Eigen::Index>(points.size(), 512), K));
}

/// The border whose creepage is `creepage` > 0, starting from `y`: secant steps within a bracket, and bisection if they
/// leave it or do not halve it in three steps. Full sliding if the creepage is large enough.
template <class Scalar, class Problem>
std::pair<Scalar, typename Problem::Point> find_border(Problem& problem, const StickZoneRule<Scalar>& rule,
                                                       Scalar creepage, Scalar y, int& evaluations) {
    // x/a is rounded, which matters if the distance y to the trailing edge is small
    const Scalar rounding = 4 * std::numeric_limits<Scalar>::epsilon();
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
        if (!is_finite(excess) || std::abs(excess) <= rounding * (1 + 1 / y) * creepage) break;
        (excess < 0 ? low : high) = y;
        (excess < 0 ? low_excess : high_excess) = excess;
        if (high - low <= rounding * (std::min)(high, Scalar(1))) break;
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

/// A border that has converged with the numbers of points and unknowns.
template <class Scalar, class Problem>
struct SettledBorder {
    Scalar y = -1;
    typename Problem::Point point{};                         // its force holds at the given creepage
    Scalar error = std::numeric_limits<Scalar>::infinity();  // error of the force: its change in the last level
    StickZoneRule<Scalar> rule;
};

/// Refines level by level until the force at `creepage` >= 0 converges to the rounding of `load`.
template <class Scalar, class Problem>
SettledBorder<Scalar, Problem> settle_border(Problem& problem, PointsOfLevels<Scalar>& levels,
                                             const SmoothSplit<Scalar>& split, Scalar creepage, Scalar load,
                                             int& evaluations) {
    SettledBorder<Scalar, Problem> settled;
    set_level<Scalar>(settled.rule, 0, levels[0], split.distance);
    Scalar& y = settled.y;
    typename Problem::Point& point = settled.point;
    const auto force_at_creepage = [&] {
        return y < 2 ? point.force + point.tangent * (creepage - point.creepage) : point.force;
    };
    for (int level = 1; level < levels.count; ++level) {
        if (creepage > 0) {
            std::tie(y, point) = find_border(problem, settled.rule, creepage, y, evaluations);
        } else {
            y = 0;
            point = problem.evaluate(y, settled.rule);
        }
        const Scalar coarse = force_at_creepage(), coarse_creepage = point.creepage;
        set_level<Scalar>(settled.rule, level, levels[level], split.distance);
        ++evaluations;
        point = problem.evaluate(y, settled.rule);
        settled.error = std::abs(force_at_creepage() - coarse);
        // the creepage of full sliding must also converge: it is infinite if the pressure does not vanish at the edge
        if (y == 2 && creepage < point.creepage + std::abs(point.creepage - coarse_creepage)) {
            settled.error += std::abs(point.creepage - coarse_creepage) / split.strength;
        }
        point.force = force_at_creepage();
        if (!is_finite(settled.error) || settled.error <= 64 * std::numeric_limits<Scalar>::epsilon() * load) break;
    }
    return settled;
}

template <class Scalar>
struct Violation {
    Scalar largest = 0, integral = 0;  // over a zone, 0 ... 1
};

/// The largest value above zero, and the integral of values above zero, of a function on a zone from its trailing end 0
/// to its leading end 1. The function is sampled at points that cluster at both ends, and at the vertices of the
/// parabolas through the points about each local maximum, so that peaks between the points are found. A violation
/// beyond rounding, in units of `unit`, is measured again on a dense set of points.
template <class Scalar, class Function>
Violation<Scalar> worst_violation(PointsOfLevels<Scalar>& levels, int level, Scalar unit, const Function& f) {
    constexpr int dense = 5;  // 512 points
    level = (std::min)(level, dense);
    const AngularPoints<Scalar>& points = levels[level];
    const Eigen::Index M = points.size();
    const Scalar rounding = 256 * std::numeric_limits<Scalar>::epsilon() * unit;
    Violation<Scalar> violation;
    Scalar last = 0, before = 0;
    const auto see = [&](Scalar value) { violation.largest = (std::max)(violation.largest, value); };
    for (Eigen::Index j = 0; j < M; ++j) {
        const Scalar value = f(points.rise[j]);
        see(value);
        if (!is_finite(value)) return {value, value};
        violation.integral += (std::max)(value, Scalar(0)) * points.weight(j);
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

/// The violation of the law by a solution.
template <class Scalar>
struct LawCheck {
    Scalar residual;  // the largest violation, over the largest bound or over the creepage
    Scalar force;     // estimated effect of the violations
};

/// Checks |p| <= bound and traction opposing the creepage in stick, slip in the direction of the creepage in slip.
template <class Scalar, class Bound, class SmoothSlope>
LawCheck<Scalar> check_law(PointsOfLevels<Scalar>& levels, int level, const StickZone<Scalar>& zone, const Bound& bound,
                           Scalar largest_bound, Scalar creepage, const SmoothSlope& smooth_slope) {
    const Scalar y = zone.y;
    Violation<Scalar> above, against;
    if (y > 0 && y < 2) {
        above = worst_violation(levels, level, largest_bound, [&](Scalar part) {
            const Scalar x = y - 1 + (2 - y) * part, p = zone.traction(x);
            return (std::max)(std::abs(p) - bound(x), p);
        });
    }
    if (y > 0) {
        against = worst_violation(levels, level, creepage,
                                  [&](Scalar part) { return -zone.slip(-1 + y * part, smooth_slope); });
    }
    return {(std::max)(largest_bound > 0 ? above.largest / largest_bound : Scalar(0),
                       creepage > 0 ? against.largest / creepage : Scalar(0)),
            above.integral * (2 - y) + against.integral * y / zone.strength};
}

/// An exact solution for solve_stick_border, for creepage >= 0.
template <class Scalar>
struct ExactBorder {
    StickZone<Scalar> zone;
    Scalar force, force_error, tangent;
    Scalar residual;  // violation of the law
    Eigen::Index coefficients, unknowns;
};

/// Empty if the pressure jumps, the force does not converge to `tolerance` or the law is violated.
template <class Scalar, class Kernel>
std::optional<ExactBorder<Scalar>> find_exact_border(const Kernel& kernel, const std::function<Scalar(Scalar)>& bound,
                                                     const PressureScan<Scalar>& scan, PointsOfLevels<Scalar>& levels,
                                                     Scalar creepage, int& evaluations) {
    const SmoothSplit<Scalar> split = kernel.smooth_split();
    if (scan.jumps || split.compliance != 0 || !(split.strength > 0) || !(split.distance >= least_distance<Scalar>))
        return std::nullopt;

    StickZoneProblem<Scalar, Kernel, std::function<Scalar(Scalar)>> problem(kernel, bound);
    const auto [y, point, settled_to, rule] = settle_border(problem, levels, split, creepage, scan.load, evaluations);
    if (!is_finite(settled_to) || !is_finite(point.tangent)) return std::nullopt;

    const StickZone<Scalar>& zone = problem.zone(y < 2 ? point.creepage : creepage, rule);
    const LawCheck<Scalar> law = check_law(levels, (std::max)(scan.level, levels.of(*rule.points)), zone, bound,
                                           scan.largest, creepage, [&](Scalar x) { return kernel.smooth_slope(x); });
    const Scalar error = settled_to + law.force;
    const Scalar tolerance = (std::max)(Scalar(1e-6), 64 * std::numeric_limits<Scalar>::epsilon()) * scan.load;
    const bool holds =
        is_finite(law.force) && is_finite(law.residual) && error <= tolerance && law.residual <= Scalar(0.01);
    if (!holds) return std::nullopt;
    return ExactBorder<Scalar>{zone,         point.force,         error,        point.tangent,
                               law.residual, rule.points->size(), rule.unknowns};
}

}  // namespace rollbem::detail
