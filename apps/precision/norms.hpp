// The norms that errors of precision_study are measured in.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/discretisation/mesh.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/types.hpp>

#include "scene.hpp"

namespace precision {

/// Of tractions that are constant on each element: the root of the integral of p^2 sqrt(1 - x^2).
inline double weighted_norm(const rollbem::Mesh<double>& mesh, const rollbem::ArrayX<double>& traction) {
    return std::sqrt((traction.square() * mesh.widths() * rollbem::mean_hertz_pressure(mesh)).sum());
}

/// The same norm of the difference of traction(x/a) from Carter's, relative to the norm of Carter's: with
/// x = cos(theta) the integral of (p sin(theta))^2, by the midpoint rule.
template <class Traction>
double traction_error(double poisson_ratio, const Traction& traction) {
    constexpr int points = 64;
    double error = 0, size = 0;
    for (int k = 0; k < points; ++k) {
        const double x = std::cos((k + 0.5) * std::numbers::pi / points);
        const double exact = rollbem::carter_traction(x, poisson_ratio);
        error += std::norm(traction(x) - exact) * (1 - x * x);
        size += exact * exact * (1 - x * x);
    }
    return std::sqrt(error / size);
}

/// The error of what a problem's quantity consists of: relative, that of a complex number as its absolute value; of a
/// response to a step the largest; of a force as a vector |difference| over |exact|; of forces over mu N_0 under a load
/// that varies the largest difference.
inline double error_of(Problem problem, const Values& found, const Values& exact) {
    if (problem == Problem::harmonic) return std::abs(found[0] / exact[0] - 1.0);
    if (problem == Problem::steady || problem == Problem::friction) return found[0].real() / exact[0].real() - 1;
    if (problem == Problem::combined_friction) {
        return std::hypot(found[0].real() - exact[0].real(), found[1].real() - exact[1].real()) /
               std::hypot(exact[0].real(), exact[1].real());
    }
    double largest = 0;
    for (std::size_t k = 0; k < exact.size(); ++k) {
        const double own = found[k].real(), other = exact[k].real();
        const double difference = std::abs(problem == Problem::step ? own / other - 1 : own - other);
        if (std::isnan(difference)) return difference;
        largest = std::max(largest, difference);
    }
    return largest;
}

}  // namespace precision
