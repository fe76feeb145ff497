// h - sin(h) without cancellation, which integrals of half ellipses and of Carter's traction need.
#pragma once

#include "language.hpp"

namespace rollbem::detail {

/// angle - sine, where sine = sin(angle) and 0 <= angle, to a few units in the last place however small the angle.
template <class Scalar>
Scalar angle_minus_sine(Scalar angle, Scalar sine) {
    if (angle >= Scalar(0.5)) return angle - sine;
    // Taylor series: eight terms leave less than 0.5^19/19!, below long double's epsilon
    Scalar term = angle * angle * angle / 6;
    Scalar sum = term;
    for (int k = 4; k <= 16; k += 2) {
        term *= -angle * angle / Scalar(k * (k + 1));
        sum += term;
    }
    return sum;
}

}  // namespace rollbem::detail
