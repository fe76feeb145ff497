// Full sliding of an elliptic contact under Hertz's pressure: the limit of steady rolling for large creepages and spin.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "../scene/force.hpp"

namespace rollbem {

/// -F_x/(mu N), -F_y/(mu N), -M_z/(mu N c), c = sqrt(a b), of an ellipse that slips everywhere, by its rigid slip
/// (longitudinal - spin y, lateral + spin x): creepages in any common unit, spin times c in the same unit. Zero without
/// creepage and spin. a_over_b must be positive and finite.
///
/// Along a line through the pole, where the rigid slip vanishes, the direction of slip is constant, and moments of the
/// pressure over the whole chord have a closed form. The remaining integral over the direction of the line has a smooth
/// integrand and is taken to 1e-6 for a/b = 0.1 ... 10. Spin alone on a circle: 3 pi/16.
template <class Scalar>
TangentialForce<Scalar> full_sliding(Scalar a_over_b, Scalar longitudinal, Scalar lateral, Scalar spin) {
    using std::abs, std::cos, std::sin, std::sqrt;
    const Scalar pi = std::numbers::pi_v<Scalar>;
    const Scalar largest = (std::max)({abs(longitudinal), abs(lateral), abs(spin)});
    if (largest == 0) return {0, 0, 0};
    int exponent = 0;
    std::frexp(largest, &exponent);
    // exact, and none overflows
    for (Scalar* one : {&longitudinal, &lateral, &spin}) *one = std::ldexp(*one, -exponent);
    const Scalar a = sqrt(a_over_b), b = 1 / a;  // c = 1
    const Scalar sign = spin < 0 ? -1 : 1, rate = abs(spin);
    // the pole times the spin, where the ellipse is the unit circle
    const Scalar pole_x = -sign * lateral / a, pole_y = sign * longitudinal / b, pole = std::hypot(pole_x, pole_y);
    TangentialForce<Scalar> sum{0, 0, 0};
    const int count =
        48 + static_cast<int>(6 * std::clamp((std::max)(a_over_b, 1 / a_over_b), Scalar(1), Scalar(1000)));
    const bool overflows = a_over_b < (std::numeric_limits<Scalar>::min)();  // b^2 does, and a is nothing beside b
    // a chord in the direction e at the distance `offset` from the middle; `lever`: its middle seen from the pole
    const auto add = [&](Scalar e_x, Scalar e_y, Scalar offset, Scalar force, Scalar moment) {
        const Scalar length = std::hypot(a * e_x, b * e_y);
        sum.longitudinal -= sign * force * b * e_y / length;
        sum.lateral += sign * force * a * e_x / length;
        const Scalar skew = overflows ? force * offset * (b * e_x) * (b * e_y / length)
                                      : force * offset * e_x * e_y * (b * b - a * a) / length;
        sum.moment += sign * (skew + moment * length / 4);
    };
    if (pole < rate) {  // the pole lies inside
        const Scalar x = pole_x / rate, y = pole_y / rate;
        for (int i = 0; i < count; ++i) {
            const Scalar angle = pi * static_cast<Scalar>(i) / static_cast<Scalar>(count);
            const Scalar e_x = cos(angle), e_y = sin(angle);
            const Scalar offset = e_x * y - e_y * x, square = (1 - offset) * (1 + offset);
            const Scalar weight = 3 * pi / (4 * static_cast<Scalar>(count)) * square;
            add(e_x, e_y, offset, -weight * (x * e_x + y * e_y), weight * square);
        }
    } else {  // outside, or at infinity without spin
        Scalar total = 0;
        for (int i = 0; i < count; ++i) {
            const Scalar angle =
                pi * ((static_cast<Scalar>(i) + Scalar(0.5)) / static_cast<Scalar>(count) - Scalar(0.5));
            const Scalar offset = sin(angle), chord = cos(angle), square = chord * chord;
            const Scalar sine = offset * (rate / pole), cosine = sqrt((1 - sine) * (1 + sine));
            const Scalar weight = 3 * pi / (4 * static_cast<Scalar>(count)) * square * chord;
            add((sine * pole_y - cosine * pole_x) / pole, -(cosine * pole_y + sine * pole_x) / pole, offset, weight,
                weight * square * (rate / pole) / cosine);
            total += weight;
        }
        sum.longitudinal /= total;  // 1 except for the error of the sum: without spin the force is exactly mu N
        sum.lateral /= total;
        sum.moment /= total;
    }
    return sum;
}

}  // namespace rollbem
