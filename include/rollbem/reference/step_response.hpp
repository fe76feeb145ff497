// Exact force histories of the plane model: the response to a step, a ramp, a sine and piecewise linear creepage as
// functions of the distance rolled q = V t/a, by the modal series and a Taylor series; de Hoog's method as an
// independent check.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "../closed_form/carter.hpp"
#include "../detail/require.hpp"
#include "bessel.hpp"

namespace rollbem::reference {

/// Inverse Laplace transform at q > 0 by de Hoog, Knight and Stokes' accelerated Fourier series (SIAM J. Sci. Stat.
/// Comput. 3, 1982). `transform` maps std::complex<long double> to the same type; all its singularities lie in
/// Re s <= 0. Uses 2 terms + 1 evaluations on Re s = ln(1e14)/(4q). Throws std::invalid_argument unless 0 < q < inf and
/// terms > 0.
template <typename Transform>
double invert_laplace(const Transform& transform, double q, int terms = 40) {
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

/// Step response of the force by de Hoog's method: -F/(a G xi) at q/a > 0 after a step of creepage xi at q = 0. An
/// independent check of StepResponse; most accurate for q/a < 2. Throws std::invalid_argument unless 0 < q/a < inf,
/// 0 <= poisson_ratio <= 0.5, 0 < aspect < inf and Lambda > 0.
inline double step_response_de_hoog(double q_over_a, double poisson_ratio, double aspect) {
    const double lambda =
        rollbem::detail::stable_plane_lambda("reference::step_response_de_hoog", poisson_ratio, aspect);
    return invert_laplace([&](detail::Complex s) { return detail::laplace_c11(s, poisson_ratio, lambda) / s; },
                          q_over_a);
}

/// Force histories -F/(a G xi_ref) from rest, exact for the plane kernel. For q/a <= 1.5 by the Taylor series about
/// q = 0 (its radius of convergence is 2, the distance in which a particle passes through the contact), for larger q/a
/// by the modal series C + sum C/(s_k (1 - Lambda (Lambda-2) s_k)) e^{s_k q}, C = pi/(2(1-nu)). The error
/// (docs/measured.md) is largest just below and at q/a = 2, where the response has a kink in its second derivative and
/// the series decays like k^-3.
class StepResponse {
public:
    /// Throws std::invalid_argument unless modes > 0, 0 <= poisson_ratio <= 0.5, 0 < aspect < inf and Lambda > 0.
    StepResponse(double poisson_ratio, double aspect, std::size_t modes = 4000)
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

    /// -F/(a G xi) at q/a after a step of creepage xi at q = 0; zero for q <= 0.
    double step(double q_over_a) const {
        if (!(q_over_a > 0)) {
            return 0;
        }
        if (q_over_a <= taylor_limit) {
            return taylor(q_over_a, 1);
        }
        return steady_c11(poisson_ratio_) +
               modal_sum(q_over_a, [](std::complex<double>) { return std::complex<double>(1); });
    }

    /// -F/(a G rate) at q/a for creepage rate * q from rest: the integral of the step response.
    double ramp(double q_over_a) const {
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

    /// -F/(a G amplitude) at q/a for creepage amplitude * sin(omega q) from rest; omega in V/a. Throws
    /// std::invalid_argument unless omega is positive and finite.
    double sine(double omega, double q_over_a) const {
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

    /// -F/(a G) at q/a for a piecewise linear creepage through the points (q_j, creepage_j), zero before q_0 and
    /// constant after the last; equal successive q_j make a jump. Convolution with the step response: exact except for
    /// the errors of step and ramp. Throws std::invalid_argument if the lists are empty or differ in length, or if q_j
    /// decrease.
    double history(std::span<const double> points, std::span<const double> creepage, double q_over_a) const {
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

private:
    struct Mode {
        std::complex<double> eigenvalue;
        std::complex<double> amplitude;  ///< amplitude in the step response, doubled for a conjugate pair
    };

    static constexpr double taylor_limit = 1.5;
    static constexpr std::size_t taylor_terms = 160;  // (taylor_limit/2)^160 = 1e-20

    /// Power series of c11 in t = 1/s: c11 = C t n/(Lambda n + t a0), n and a0 the Hankel series of I0 + I1 and I0.
    void make_taylor_coefficients() {
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

    /// Inverse of c11(s)/s^power: t^(j+1+power) -> q^(j+power)/(j+power)!.
    double taylor(double q, int power) const {
        long double sum = 0;
        long double monomial = power == 2 ? static_cast<long double>(q) * q / 2 : static_cast<long double>(q);
        for (std::size_t j = 0; j < taylor_terms; ++j) {
            sum += taylor_[j] * monomial;
            monomial *= static_cast<long double>(q) / static_cast<long double>(j + 1 + static_cast<std::size_t>(power));
        }
        return static_cast<double>(sum);
    }

    /// Inverse of c11(s) omega/(s^2 + omega^2), with omega/(s^2 + omega^2) = sum (-1)^i omega^(2i+1) t^(2i+2).
    double taylor_sine(double omega, double q) const {
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

    /// Real part of sum amplitude factor(s) e^{s q}, up to the first term far below rounding.
    template <typename Factor>
    double modal_sum(double q, const Factor& factor) const {
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

    double poisson_ratio_;
    double lambda_;
    std::vector<Mode> modes_;          ///< sorted by descending real part
    std::vector<long double> taylor_;  ///< c11(s) = sum taylor_j s^-(j+1) for s -> infinity
};

}  // namespace rollbem::reference
