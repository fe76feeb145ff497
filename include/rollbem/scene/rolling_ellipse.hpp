// The ellipse with axes along and across the rolling direction that replaces a turned one.
#pragma once

#include <cmath>

#include "semi_axes.hpp"

namespace rollbem {

/// Semi-axes a', b' along x and y, with their derivatives.
struct RollingEllipse {
    SemiAxes axes;            ///< a', b' [m]
    SemiAxes by_half_length;  ///< d a'/da, d b'/da [-]
    SemiAxes by_half_width;   ///< d a'/db, d b'/db [-]
    SemiAxes by_turn;         ///< d a'/d turn, d b'/d turn [m/rad]
};

/// The ellipse along x and y that replaces an ellipse whose axis a is turned from x towards y by `turn` [rad]. Both
/// have the same area, and the same ratio of their extents along x and y, sqrt(a^2 cos^2 + b^2 sin^2) and sqrt(a^2
/// sin^2 + b^2 cos^2), which is also the ratio of the roots of the second moments. Creepages and forces stay in rolling
/// axes. Without a turn the result is exactly the ellipse itself.
///
/// Rolling in the axes of the turned ellipse instead, with creepages turned into them and forces back, has larger
/// errors, as it turns the rolling direction as well: even a circle under spin would then get a longitudinal force. Two
/// forces due to the lack of symmetry are neglected here: along x by lateral creepage and spin, and across by
/// longitudinal creepage. They grow with the turn; docs/vehicle-measured.md has the errors.
inline RollingEllipse rolling_ellipse(const SemiAxes& turned, double turn) noexcept {
    const double a = turned.half_length, b = turned.half_width, cosine = std::cos(turn), sine = std::sin(turn);
    // extents over a and b
    const double along = std::hypot(cosine, b / a * sine), across = std::hypot(cosine, a / b * sine);
    const double scale = std::sqrt(along / across);
    RollingEllipse result{.axes = {a * scale, b / scale}, .by_half_length{}, .by_half_width{}, .by_turn{}};
    const auto [length, width] = result.axes;
    // a'^2 = a b e, e the ratio of the extents; derivatives of ln e by ln a (minus the derivative by ln b) and by the
    // turn
    const double x = cosine / along, y = sine / across;
    const double by_log_a = x * x - a / b * y * (a / b * y);
    const double slope = -(a / b - b / a) * sine * cosine * (b / a / (along * along) + a / b / (across * across));
    result.by_half_length = {length * (1 + by_log_a) / (2 * a), width * (1 - by_log_a) / (2 * a)};
    result.by_half_width = {length * (1 - by_log_a) / (2 * b), width * (1 + by_log_a) / (2 * b)};
    result.by_turn = {length * slope / 2, -width * slope / 2};
    return result;
}

}  // namespace rollbem
