// Properties of a pressure known at every point: its load, and whether it jumps. Internal.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Core>

#include "../../detail/require.hpp"
#include "angular_points.hpp"

namespace rollbem::detail {

template <class Scalar>
struct PressureScan {
    Scalar load = 0;     // integral over x/a
    Scalar largest = 0;  // of the sampled values
    bool jumps = true;
    int level = 0;  // at which it converged, or the last
};

/// Integral of a bound over the contact by the midpoint rule in the angle, the number of points doubled until it
/// converges. With a kink the last doubling changes it like 1/M^2, with a jump J by about J pi/(2 M) wherever the jump
/// lies.
template <class Scalar, class Bound>
PressureScan<Scalar> scan_pressure(const Bound& bound, PointsOfLevels<Scalar>& levels) {
    PressureScan<Scalar> scan;
    for (int level = 0; level < PointsOfLevels<Scalar>::count; ++level) {
        const AngularPoints<Scalar>& points = levels[level];
        Scalar load = 0;
        for (Eigen::Index j = 0; j < points.size(); ++j) {
            const Scalar value = bound(points.cosine[j]);
            require_not_negative("solve_stick_border", "mu p_n / G", value);
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

}  // namespace rollbem::detail
