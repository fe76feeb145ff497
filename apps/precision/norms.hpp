// The norms that errors of precision_study are measured in.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/discretisation/mesh.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/types.hpp>

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

/// The largest relative difference of two series.
template <class Series, class Exact>
double largest_difference(const Series& forces, const Exact& exact) {
    double largest = 0;
    for (std::size_t k = 0; k < forces.size(); ++k) {
        const double difference = std::abs(forces[k] / exact[k] - 1);
        if (std::isnan(difference)) return difference;
        largest = std::max(largest, difference);
    }
    return largest;
}

/// |difference| of two vectors over the second.
inline double vector_error(const std::vector<double>& force, const std::vector<double>& exact) {
    return std::hypot(force[0] - exact[0], force[1] - exact[1]) / std::hypot(exact[0], exact[1]);
}

/// The largest absolute difference of two series: they are forces over mu N_0.
inline double series_error(const std::vector<double>& forces, const std::vector<double>& exact) {
    double largest = 0;
    for (std::size_t k = 0; k < exact.size(); ++k) {
        const double difference = std::abs(forces[k] - exact[k]);
        if (std::isnan(difference)) return difference;
        largest = std::max(largest, difference);
    }
    return largest;
}

}  // namespace precision
