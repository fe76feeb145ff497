// Points of the midpoint rule in an angle, doubled from level to level, and a pressure's load integrated with them.
// Internal.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>

#include <Eigen/Core>

#include <rollbem/detail/require.hpp>
#include <rollbem/types.hpp>

namespace rollbem::detail {

/// The M points phi = (j + 1/2) pi/M of the midpoint rule in an angle, which are Gauss-Chebyshev points in its cosine.
template <class Scalar>
struct AngularPoints {
    ArrayX<Scalar> cosine, rise;  // cos(phi), and (1 + cos(phi))/2 without cancellation

    explicit AngularPoints(Eigen::Index M) : cosine(M), rise(M) {
        for (Eigen::Index j = 0; j < M; ++j) {
            const Scalar half = std::cos((Scalar(2 * j + 1) / Scalar(4 * M)) * std::numbers::pi_v<Scalar>);
            rise[j] = half * half;
            cosine[j] = 2 * rise[j] - 1;
        }
    }
    Eigen::Index size() const { return rise.size(); }
    /// Weight in the integral of a function of (1 + cos(phi))/2 = 0 ... 1.
    Scalar weight(Eigen::Index j) const {
        return std::sqrt(rise[j] * (1 - rise[j])) * std::numbers::pi_v<Scalar> / static_cast<Scalar>(size());
    }
};

/// The points of every level, computed on first use.
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
    Scalar largest = 0;  // largest sampled value
    bool jumps = true;
    int level = 0;  // level at which it converged, or the last one
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
            scan.largest = (std::max)(scan.largest, value);
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
