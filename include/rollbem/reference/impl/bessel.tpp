// Bodies of reference/bessel.hpp. Internal.
#pragma once

#include "../bessel.hpp"

#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

#include "../../closed_form/carter.hpp"
#include "../../closed_form/detail/plane_lambda.hpp"
#include "../../detail/require.hpp"
#include "../detail/bessel_functions.hpp"

namespace rollbem::reference {

inline std::complex<double> plane_c11(std::complex<double> s, double poisson_ratio, double aspect) {
    const double lambda = s == 0.0
                              ? plane_lambda(poisson_ratio, aspect)
                              : rollbem::detail::stable_plane_lambda("reference::plane_c11", poisson_ratio, aspect);
    detail::require_finite("reference::plane_c11", "Re s", s.real());
    detail::require_finite("reference::plane_c11", "Im s", s.imag());
    if (s.real() == 0 && std::abs(s.imag()) < detail::asymptotic_radius) {
        return detail::harmonic_c11(s.imag(), poisson_ratio, lambda);
    }
    return std::complex<double>(detail::laplace_c11(detail::Complex(s.real(), s.imag()), poisson_ratio, lambda));
}

inline std::vector<std::complex<double>> eigenvalues(std::size_t count, double poisson_ratio, double aspect) {
    const double lambda = rollbem::detail::stable_plane_lambda("reference::eigenvalues", poisson_ratio, aspect);
    detail::require(count > 0, "reference::eigenvalues", "count", count, "be positive");
    std::vector<std::complex<double>> result;
    for (const detail::Complex s : detail::eigenvalues(count, lambda)) {
        result.emplace_back(s);
    }
    return result;
}

inline ExactTraction::ExactTraction(std::complex<double> s, double poisson_ratio, double aspect) {
    c11_ = plane_c11(s, poisson_ratio, aspect);  // checks the arguments
    const long double pi = std::numbers::pi_v<long double>;
    const long double lambda = plane_lambda<long double>(poisson_ratio, aspect);
    const long double stiffness = 2 * (1 - static_cast<long double>(poisson_ratio));
    const detail::Complex point(s.real(), s.imag());
    const long double scale = std::abs(point.real());
    // for n above about 1.2 |s| + 40, I_n is below rounding; twice as many points keep aliases away from it
    const std::size_t order = static_cast<std::size_t>(1.2 * std::abs(s)) + 40;
    const std::size_t count = order + order / 2;
    std::vector<long double> cosines(2 * count);
    std::vector<detail::Complex> samples(count + 1);
    for (std::size_t k = 0; k < cosines.size(); ++k) {
        cosines[k] = std::cos(pi * static_cast<long double>(k) / static_cast<long double>(count));
    }
    for (std::size_t k = 0; k <= count; ++k) {
        const long double weight = (k == 0 || k == count ? 0.5L : 1.0L) / static_cast<long double>(count);
        samples[k] = std::exp(point * cosines[k] - scale) * weight;
    }
    std::vector<detail::Complex> bessel(order + 2);
    for (std::size_t n = 0; n < bessel.size(); ++n) {
        for (std::size_t k = 0; k <= count; ++k) {
            bessel[n] += samples[k] * cosines[n * k % cosines.size()];
        }
    }
    const detail::Complex sum = bessel[0] + bessel[1];
    const detail::Complex denominator = (bessel[0] + point * lambda * sum) * stiffness;
    coefficients_.resize(order + 1);
    coefficients_[0] = -sum / denominator;
    for (std::size_t n = 1; n <= order; ++n) {  // n I_n / s = (I_{n-1} - I_{n+1})/2 also holds at s = 0
        coefficients_[n] = (bessel[n - 1] - bessel[n + 1]) / denominator;
    }
}

inline auto ExactTraction::operator()(double x_over_a) const -> std::complex<double> {
    detail::require(std::abs(x_over_a) <= 1, "reference::ExactTraction", "x/a", x_over_a, "lie in [-1, 1]");
    // the coefficients add up to zero, so T_n may be replaced by T_n - 1 = -2 sin^2(n theta/2): nothing cancels
    // at the leading edge, theta = 0
    const long double half = std::atan2(std::sqrt(1 - static_cast<long double>(x_over_a)),
                                        std::sqrt(1 + static_cast<long double>(x_over_a)));
    if (half == 0) {
        return 0;
    }
    detail::Complex sum = 0;
    for (std::size_t n = 1; n < coefficients_.size(); ++n) {
        const long double sine = std::sin(static_cast<long double>(n) * half);
        sum -= 2 * sine * sine * coefficients_[n];
    }
    return std::complex<double>(sum / std::sin(2 * half));
}

}  // namespace rollbem::reference
