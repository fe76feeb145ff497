// Integrals of Hertz's pressure on a line. Internal.
#pragma once

#include <cmath>

#include "../../detail/angle_minus_sine.hpp"

namespace rollbem::detail {

/// A part of the interval -1 ... 1: the distances of its two ends from -1 (trailing) and from 1 (leading), and its
/// width.
struct UnitStretch {
    double trailing_1, leading_1;
    double trailing_2, leading_2;
    double width;
};

/// Integrals over a part of the interval of sqrt(1 - x^2) and of 1/sqrt(1 - x^2); the second is the angle of the part,
/// pi in total.
struct SemicircleIntegrals {
    double area, angle;
};

/// The integrals without cancellation at the edges: with x = -cos(theta), mean m and half difference h of theta, the
/// area is (h - sin h) + sin(h) (1 - cos(h) cos(2m)), a sum of positive terms.
inline SemicircleIntegrals integrate_semicircle(const UnitStretch& stretch) {
    // sines and cosines of theta/2 at both ends are square roots of half the distances from the ends of the contact
    const double sine_1 = std::sqrt(stretch.trailing_1 / 2), cosine_1 = std::sqrt(stretch.leading_1 / 2);
    const double sine_2 = std::sqrt(stretch.trailing_2 / 2), cosine_2 = std::sqrt(stretch.leading_2 / 2);
    const double sine_mean = sine_2 * cosine_1 + cosine_2 * sine_1;
    const double sine_half = stretch.width / (2 * sine_mean);
    const double cosine_half = cosine_1 * cosine_2 + sine_1 * sine_2;
    const double half = std::atan2(sine_half, cosine_half);
    const double half_minus_sine = angle_minus_sine(half, sine_half);
    // 1 - cos(h) cos(2m) = (1 - cos h) + 2 cos(h) sin^2 m
    const double versine = sine_half * sine_half / (1 + cosine_half);
    return {half_minus_sine + sine_half * (versine + 2 * cosine_half * sine_mean * sine_mean), 2 * half};
}

}  // namespace rollbem::detail
