// Bodies of reference/bessel.hpp. Internal.
#pragma once

#include "../bessel.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <span>
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

template <typename Transform>
double invert_laplace(const Transform& transform, double q, int terms) {
    using detail::Complex;
    detail::require_positive("reference::invert_laplace", "q/a", q);
    detail::require(terms > 0, "reference::invert_laplace", "terms", terms, "be positive");
    const long double period = 2 * static_cast<long double>(q);
    const long double abscissa = std::log(1e14L) / (2 * period);
    const std::size_t count = 2 * static_cast<std::size_t>(terms) + 1;
    const long double pi = std::numbers::pi_v<long double>;

    std::vector<Complex> series(count);
    for (std::size_t k = 0; k < count; ++k) {
        series[k] = transform(Complex(abscissa, pi * static_cast<long double>(k) / period));
    }
    series[0] /= 2.0L;

    // Quotient-difference scheme: the continued fraction d_0/(1 + d_1 z/(1 + d_2 z/(1 + ...))) of sum series_k z^k
    std::vector<Complex> fraction(count);
    std::vector<Complex> e(count);
    std::vector<Complex> quotient(count);
    for (std::size_t k = 0; k + 1 < count; ++k) {
        quotient[k] = series[k + 1] / series[k];
    }
    fraction[0] = series[0];
    fraction[1] = -quotient[0];
    for (std::size_t r = 1; 2 * r < count; ++r) {
        const std::size_t length = count - 2 * r;
        for (std::size_t k = 0; k < length; ++k) {
            e[k] = quotient[k + 1] - quotient[k] + e[k + 1];
        }
        fraction[2 * r] = -e[0];
        if (2 * r + 1 < count) {
            for (std::size_t k = 0; k + 1 < length; ++k) {
                quotient[k] = quotient[k + 1] * e[k + 1] / e[k];
            }
            fraction[2 * r + 1] = -quotient[0];
        }
    }
    const Complex z = std::exp(Complex(0, pi * static_cast<long double>(q) / period));
    Complex numerator_old = 0;
    Complex numerator = fraction[0];
    Complex denominator_old = 1;
    Complex denominator = 1;
    for (std::size_t k = 1; k < count; ++k) {
        Complex weight = fraction[k] * z;
        if (k + 1 == count) {  // the tail of the fraction, estimated as if it continued periodically
            const Complex h = (1.0L + z * (fraction[k - 1] - fraction[k])) / 2.0L;
            weight = -h * (1.0L - std::sqrt(1.0L + z * fraction[k] / (h * h)));
        }
        const Complex numerator_new = numerator + weight * numerator_old;
        const Complex denominator_new = denominator + weight * denominator_old;
        numerator_old = numerator;
        numerator = numerator_new;
        denominator_old = denominator;
        denominator = denominator_new;
    }
    return static_cast<double>(std::exp(abscissa * q) / period * (numerator / denominator).real());
}

inline double step_response_de_hoog(double q_over_a, double poisson_ratio, double aspect) {
    const double lambda =
        rollbem::detail::stable_plane_lambda("reference::step_response_de_hoog", poisson_ratio, aspect);
    return invert_laplace([&](detail::Complex s) { return detail::laplace_c11(s, poisson_ratio, lambda) / s; },
                          q_over_a);
}

inline StepResponse::StepResponse(double poisson_ratio, double aspect, std::size_t modes)
    : poisson_ratio_(poisson_ratio),
      lambda_(rollbem::detail::stable_plane_lambda("StepResponse", poisson_ratio, aspect)) {
    detail::require(modes > 0, "StepResponse", "modes", modes, "be positive");
    const long double steady = steady_c11<long double>(poisson_ratio);
    const long double lambda = lambda_;
    for (const detail::Complex s : detail::eigenvalues(modes, lambda)) {
        const long double weight = s.imag() > 0 ? 2 : 1;  // a conjugate pair contributes twice the real part
        const detail::Complex amplitude = weight * steady / (s * (1.0L - lambda * (lambda - 2) * s));
        modes_.push_back({std::complex<double>(s), std::complex<double>(amplitude)});
    }
    // slowest decay first: sorted by modulus, a distant real eigenvalue would come between pairs that decay more
    // slowly
    std::sort(modes_.begin(), modes_.end(),
              [](const Mode& left, const Mode& right) { return left.eigenvalue.real() > right.eigenvalue.real(); });
    make_taylor_coefficients();
}

inline double StepResponse::step(double q_over_a) const {
    if (!(q_over_a > 0)) {
        return 0;
    }
    if (q_over_a <= taylor_limit) {
        return taylor(q_over_a, 1);
    }
    return steady_c11(poisson_ratio_) +
           modal_sum(q_over_a, [](std::complex<double>) { return std::complex<double>(1); });
}

inline double StepResponse::ramp(double q_over_a) const {
    if (!(q_over_a > 0)) {
        return 0;
    }
    if (q_over_a <= taylor_limit) {
        return taylor(q_over_a, 2);
    }
    // c11(s)/s^2 has a double pole at 0: c11(0) q + c11'(0), and c11'(0) = c11(0) (1/2 - Lambda)
    return steady_c11(poisson_ratio_) * (q_over_a + 0.5 - lambda_) +
           modal_sum(q_over_a, [](std::complex<double> s) { return 1.0 / s; });
}

inline double StepResponse::sine(double omega, double q_over_a) const {
    detail::require_positive("StepResponse", "omega", omega);
    if (!(q_over_a > 0)) {
        return 0;
    }
    // the Taylor series loses digits like e^{omega q}
    if (q_over_a <= taylor_limit && omega * q_over_a <= 16) {
        return taylor_sine(omega, q_over_a);
    }
    const long double phase = static_cast<long double>(omega) * q_over_a;
    const detail::Complex harmonic = detail::laplace_c11(detail::Complex(0, omega), poisson_ratio_, lambda_) *
                                     detail::Complex(std::cos(phase), std::sin(phase));
    return static_cast<double>(harmonic.imag()) +
           modal_sum(q_over_a, [omega](std::complex<double> s) { return s * omega / (s * s + omega * omega); });
}

inline double StepResponse::history(std::span<const double> points, std::span<const double> creepage,
                                    double q_over_a) const {
    detail::require(!points.empty(), "StepResponse", "number of points", points.size(), "be positive");
    detail::require(points.size() == creepage.size(), "StepResponse", "number of creepages", creepage.size(),
                    "equal the number of points");
    double force = creepage[0] * step(q_over_a - points[0]);
    for (std::size_t j = 1; j < points.size() && points[j - 1] < q_over_a; ++j) {
        const double length = points[j] - points[j - 1];
        detail::require(length >= 0, "StepResponse", "q_j - q_{j-1}", length, "be at least 0");
        const double rise = creepage[j] - creepage[j - 1];
        if (rise != 0) {
            force += length > 0 ? rise / length * (ramp(q_over_a - points[j - 1]) - ramp(q_over_a - points[j]))
                                : rise * step(q_over_a - points[j]);
        }
    }
    return force;
}

inline void StepResponse::make_taylor_coefficients() {
    std::vector<long double> a0(taylor_terms);
    std::vector<long double> sum(taylor_terms);
    long double c0 = 1;
    long double c1 = 1;
    for (std::size_t k = 0; k < taylor_terms; ++k) {
        a0[k] = c0;
        sum[k] = c0 + c1;
        const long double odd = 2 * static_cast<long double>(k) + 1;
        const long double divisor = 8 * static_cast<long double>(k + 1);
        c0 *= odd * odd / divisor;
        c1 *= (odd * odd - 4) / divisor;
    }
    taylor_.resize(taylor_terms);
    const long double lambda = lambda_;
    for (std::size_t j = 0; j < taylor_terms; ++j) {
        long double rest = sum[j];
        for (std::size_t i = 0; i < j; ++i) {
            rest -= taylor_[i] * (lambda * sum[j - i] + a0[j - i - 1]);
        }
        taylor_[j] = rest / (lambda * sum[0]);
    }
    for (long double& coefficient : taylor_) {
        coefficient *= steady_c11<long double>(poisson_ratio_);
    }
}

inline double StepResponse::taylor(double q, int power) const {
    long double sum = 0;
    long double monomial = power == 2 ? static_cast<long double>(q) * q / 2 : static_cast<long double>(q);
    for (std::size_t j = 0; j < taylor_terms; ++j) {
        sum += taylor_[j] * monomial;
        monomial *= static_cast<long double>(q) / static_cast<long double>(j + 1 + static_cast<std::size_t>(power));
    }
    return static_cast<double>(sum);
}

inline double StepResponse::taylor_sine(double omega, double q) const {
    const long double phase_squared = static_cast<long double>(omega) * omega * q * q;
    long double sum = 0;
    long double outer = static_cast<long double>(omega) * q * q / 2;  // omega q q^(j+1)/(j+2)!
    for (std::size_t j = 0; j < taylor_terms; ++j) {
        long double inner = outer;
        long double total = 0;
        for (std::size_t i = 0; std::abs(inner) > 1e-22L * std::abs(outer); ++i) {
            total += inner;
            const long double next = static_cast<long double>(j + 2 * i + 3);
            inner *= -phase_squared / (next * (next + 1));
        }
        sum += taylor_[j] * total;
        outer *= static_cast<long double>(q) / static_cast<long double>(j + 3);
    }
    return static_cast<double>(sum);
}

template <typename Factor>
double StepResponse::modal_sum(double q, const Factor& factor) const {
    double sum = 0;
    for (const Mode& mode : modes_) {
        const std::complex<double> weight = mode.amplitude * factor(mode.eigenvalue);
        sum += (weight * std::exp(mode.eigenvalue * q)).real();
        if (std::abs(weight) * std::exp(mode.eigenvalue.real() * q) < 1e-20) {
            break;
        }
    }
    return sum;
}

}  // namespace rollbem::reference
