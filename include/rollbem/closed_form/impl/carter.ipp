// Bodies of closed_form/carter.hpp. Internal.
#pragma once

#include "../carter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace rollbem {

ROLLBEM_DECL TangentialForce full_sliding(double a_over_b, double longitudinal, double lateral, double spin) {
    using std::abs, std::cos, std::sin, std::sqrt;
    const double pi = std::numbers::pi;
    const double largest = (std::max)({abs(longitudinal), abs(lateral), abs(spin)});
    if (largest == 0) return {0, 0, 0};
    int exponent = 0;
    std::frexp(largest, &exponent);
    // exact, and none overflows
    for (double* one : {&longitudinal, &lateral, &spin}) *one = std::ldexp(*one, -exponent);
    const double a = sqrt(a_over_b), b = 1 / a;  // c = 1
    const double sign = spin < 0 ? -1 : 1, rate = abs(spin);
    // the pole times the spin, where the ellipse is the unit circle
    const double pole_x = -sign * lateral / a, pole_y = sign * longitudinal / b, pole = std::hypot(pole_x, pole_y);
    TangentialForce sum{0, 0, 0};
    const int count = 48 + static_cast<int>(6 * std::clamp((std::max)(a_over_b, 1 / a_over_b), 1.0, 1000.0));
    const bool overflows = a_over_b < (std::numeric_limits<double>::min)();  // b^2 does, and a is nothing beside b
    // a chord in the direction e at the distance `offset` from the middle; `lever`: its middle seen from the pole
    const auto add = [&](double e_x, double e_y, double offset, double force, double moment) {
        const double length = std::hypot(a * e_x, b * e_y);
        sum.longitudinal -= sign * force * b * e_y / length;
        sum.lateral += sign * force * a * e_x / length;
        const double skew = overflows ? force * offset * (b * e_x) * (b * e_y / length)
                                      : force * offset * e_x * e_y * (b * b - a * a) / length;
        sum.moment += sign * (skew + moment * length / 4);
    };
    if (pole < rate) {  // the pole lies inside
        const double x = pole_x / rate, y = pole_y / rate;
        for (int i = 0; i < count; ++i) {
            const double angle = pi * static_cast<double>(i) / static_cast<double>(count);
            const double e_x = cos(angle), e_y = sin(angle);
            const double offset = e_x * y - e_y * x, square = (1 - offset) * (1 + offset);
            const double weight = 3 * pi / (4 * static_cast<double>(count)) * square;
            add(e_x, e_y, offset, -weight * (x * e_x + y * e_y), weight * square);
        }
    } else {  // outside, or at infinity without spin
        double total = 0;
        for (int i = 0; i < count; ++i) {
            const double angle = pi * ((static_cast<double>(i) + 0.5) / static_cast<double>(count) - 0.5);
            const double offset = sin(angle), chord = cos(angle), square = chord * chord;
            const double sine = offset * (rate / pole), cosine = sqrt((1 - sine) * (1 + sine));
            const double weight = 3 * pi / (4 * static_cast<double>(count)) * square * chord;
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
