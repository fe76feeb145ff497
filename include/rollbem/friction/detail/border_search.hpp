// The border that belongs to a creepage, and how fine a problem it takes.
// No user includes this by itself.
#pragma once

#include "../../detail/language.hpp"

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

/// Accuracy of the stick border, level by level: M points of the pressure, and N unknowns for a smooth part that is
/// analytic up to a distance d. Chebyshev series on a zone of half-length h <= 1 converge like exp(-k asinh(d/h)), and
/// an integral of the solution, as the force is, twice as fast in the smallness of the interaction itself: N starts
/// where the series has e^-6 and grows from level to level until the force does not change.
template <class Scalar>
StickZoneRule<Scalar> stick_zone_rule(int level, const AngularPoints<Scalar>& points, Scalar distance) {
    if (!is_finite(distance)) return {points, 0, 0};
    const Scalar first = 4 + 6 / std::asinh(std::max(distance, Scalar(0.02)));
    const Eigen::Index N = std::min<Eigen::Index>(static_cast<Eigen::Index>(first) * (level + 2) / 2, 400);
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

/// A border that more points and unknowns do not move.
template <class Scalar, class Problem>
struct SettledBorder {
    Scalar y = -1;
    typename Problem::Point point{};                         // its force is that at the creepage sought
    Scalar error = std::numeric_limits<Scalar>::infinity();  // of the force: what the last level changed
    StickZoneRule<Scalar> rule;
};

/// Goes from level to level until the force at `creepage` >= 0 settles to the rounding of `load`.
template <class Scalar, class Problem>
SettledBorder<Scalar, Problem> settle_border(Problem& problem, PointsOfLevels<Scalar>& levels,
                                             const SmoothSplit<Scalar>& split, Scalar creepage, Scalar load,
                                             int& evaluations) {
    SettledBorder<Scalar, Problem> settled{.rule = stick_zone_rule<Scalar>(0, levels[0], split.distance)};
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
        settled.rule = stick_zone_rule<Scalar>(level, levels[level], split.distance);
        ++evaluations;
        point = problem.evaluate(y, settled.rule);
        settled.error = std::abs(force_at_creepage() - coarse);
        // the creepage of full sliding must settle too: it is infinite for a pressure that does not end at zero
        if (y == 2 && creepage < point.creepage + std::abs(point.creepage - coarse_creepage)) {
            settled.error += std::abs(point.creepage - coarse_creepage) / split.strength;
        }
        point.force = force_at_creepage();
        if (!is_finite(settled.error) || settled.error <= 64 * std::numeric_limits<Scalar>::epsilon() * load) break;
    }
    return settled;
}

}  // namespace rollbem::detail
