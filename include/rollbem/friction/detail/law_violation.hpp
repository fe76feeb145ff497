// Where and by how much the tractions and slip of a stick zone violate Coulomb's law. Internal.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "angular_points.hpp"
#include "stick_zone.hpp"

namespace rollbem::detail {

template <class Scalar>
struct Violation {
    Scalar largest = 0, integral = 0;  // over a zone, 0 ... 1
};

/// How far a function on a zone, 0 at its trailing and 1 at its leading end, rises above zero by more than rounding in
/// `unit`: at points that cluster at both ends, and at the vertices of the parabolas through the points about each
/// local maximum, so that peaks between the points are found. If there is a violation, it is measured on a dense set of
/// points.
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

/// How far a solution violates the law.
template <class Scalar>
struct LawCheck {
    Scalar residual;  // the largest violation, over the largest bound or over the creepage
    Scalar force;     // estimated effect of the violations
};

/// |p| <= bound and traction opposing the creepage in stick, slip in the direction of the creepage in slip.
template <class Scalar, class Bound, class SmoothSlope>
LawCheck<Scalar> check_law(PointsOfLevels<Scalar>& levels, int level, const StickZone<Scalar>& zone, const Bound& bound,
                           Scalar largest_bound, Scalar creepage, const SmoothSlope& smooth_slope) {
    const Scalar y = zone.y;
    Violation<Scalar> above, against;
    if (y > 0 && y < 2) {
        above = worst_violation(levels, level, largest_bound, [&](Scalar part) {
            const Scalar x = y - 1 + (2 - y) * part, p = zone.traction(x);
            return std::max(std::abs(p) - bound(x), p);
        });
    }
    if (y > 0) {
        against = worst_violation(levels, level, creepage,
                                  [&](Scalar part) { return -zone.slip(-1 + y * part, smooth_slope); });
    }
    return {std::max(largest_bound > 0 ? above.largest / largest_bound : Scalar(0),
                     creepage > 0 ? against.largest / creepage : Scalar(0)),
            above.integral * (2 - y) + against.integral * y / zone.strength};
}

}  // namespace rollbem::detail
