// The ellipse with axes along the rolling direction and across it that takes the place of a turned one.
#pragma once

#include <cmath>

#include "semi_axes.hpp"

namespace rollbem {

/// Semi-axes a', b' along x and y, with their derivatives.
template <class Scalar>
struct RollingEllipse {
    SemiAxes<Scalar> axes;            ///< a', b' [m]
    SemiAxes<Scalar> by_half_length;  ///< d a'/da, d b'/da [-]
    SemiAxes<Scalar> by_half_width;   ///< d a'/db, d b'/db [-]
    SemiAxes<Scalar> by_turn;         ///< d a'/d turn, d b'/d turn [m/rad]
};

/// The ellipse along x and y with the area of one whose axis a is turned from x towards y by `turn` [rad], and with the
/// ratio of its extents along x and y, sqrt(a^2 cos^2 + b^2 sin^2) and sqrt(a^2 sin^2 + b^2 cos^2), which is that of
/// the roots of its second moments. Creepages and forces stay in rolling axes. Without a turn it is the ellipse itself,
/// exactly.
///
/// Rolling in the axes of the turned ellipse instead, with creepages turned into them and forces back, has up to five
/// times the error, since that turns the rolling direction as well: even a circle under spin would then get a
/// longitudinal force. Neglected here are the forces along x by lateral creepage and spin, and those across by
/// longitudinal creepage, that the lack of symmetry makes; they grow with the turn, docs/vehicle.md has the errors.
template <class Scalar>
RollingEllipse<Scalar> rolling_ellipse(const SemiAxes<Scalar>& turned, Scalar turn) noexcept {
    const Scalar a = turned.half_length, b = turned.half_width, cosine = std::cos(turn), sine = std::sin(turn);
    // extents over a and b
    const Scalar along = std::hypot(cosine, b / a * sine), across = std::hypot(cosine, a / b * sine);
    const Scalar scale = std::sqrt(along / across);
    RollingEllipse<Scalar> result{.axes = {a * scale, b / scale}, .by_half_length{}, .by_half_width{}, .by_turn{}};
    const auto [length, width] = result.axes;
    // a'^2 = a b e, e the ratio of the extents; d ln e by ln a, which is - d ln e by ln b, and by the turn
    const Scalar x = cosine / along, y = sine / across;
    const Scalar by_log_a = x * x - a / b * y * (a / b * y);
    const Scalar slope = -(a / b - b / a) * sine * cosine * (b / a / (along * along) + a / b / (across * across));
    result.by_half_length = {length * (1 + by_log_a) / (2 * a), width * (1 - by_log_a) / (2 * a)};
    result.by_half_width = {length * (1 - by_log_a) / (2 * b), width * (1 + by_log_a) / (2 * b)};
    result.by_turn = {length * slope / 2, -width * slope / 2};
    return result;
}

}  // namespace rollbem
