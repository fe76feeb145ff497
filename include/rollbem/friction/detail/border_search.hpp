// The border at a given creepage, and the resolution that it needs. Internal.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../elasticity/kernel_concepts.hpp"
#include "angular_points.hpp"
#include "stick_zone_problem.hpp"

namespace rollbem::detail {

/// The narrowest strip, by the distance d/a of its smooth part, that these orders resolve.
template <class Scalar>
inline constexpr Scalar least_distance = Scalar(0.02);

/// Accuracy of the stick border, level by level: the points of the pressure, and the orders for a smooth part that is
/// analytic up to a distance d. All rates are the slowest ones, those of a zone of half-length 1.
///
/// N unknowns: their sum is singular at the corners +-1 +-id and converges like exp(-k r), where r is the logarithm of
/// the parameter of the Bernstein ellipse through the corners, cosh r = (sqrt(4 + d^2) + d)/2; the force converges
/// twice as fast. N starts where the sum is accurate to e^-14 and doubles, which makes the force accurate to rounding
/// in any scalar type.
/// P points for the integrals of the unknowns, whose integrands are singular at a distance d from any point of the
/// zone: accurate to rounding for 2P - N = ln(1/eps)/asinh(d).
/// K points for the integrals of the known tractions, which may have kinks: their number grows with the points of the
/// pressure.
template <class Scalar>
void set_level(StickZoneRule<Scalar>& rule, int level, const AngularPoints<Scalar>& points, Scalar distance) {
    if (!is_finite(distance)) return rule.set(points, 0, 0, 0);
    const Scalar digits = -std::log(std::numeric_limits<Scalar>::epsilon());
    const Scalar ellipse = std::acosh((std::sqrt(4 + distance * distance) + distance) / 2), line = std::asinh(distance);
    const auto N = static_cast<Eigen::Index>(4 + 14 / ellipse) * (std::min(level, 2) + 2) / 2;
    const auto P = std::max(2 * N, (N + static_cast<Eigen::Index>(digits / line)) / 2 + 5);
    const auto K = std::min<Eigen::Index>(static_cast<Eigen::Index>(4 + 12 / line) * (level + 2) / 2, 1000);
    rule.set(points, N, P, std::max(std::min<Eigen::Index>(points.size(), 512), K));
}

/// The border whose creepage is `creepage` > 0, starting from `y`: secant steps within a bracket, and bisection if they
/// leave it or do not halve it in three steps. Full sliding if the creepage is large enough.
template <class Scalar, class Problem>
std::pair<Scalar, typename Problem::Point> find_border(Problem& problem, const StickZoneRule<Scalar>& rule,
                                                       Scalar creepage, Scalar y, int& evaluations) {
    // x/a is rounded, which matters if the distance y to the trailing edge is small
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

/// A border that has converged with the numbers of points and unknowns.
template <class Scalar, class Problem>
struct SettledBorder {
    Scalar y = -1;
    typename Problem::Point point{};                         // its force is that at the given creepage
    Scalar error = std::numeric_limits<Scalar>::infinity();  // of the force: its change in the last level
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

}  // namespace rollbem::detail
