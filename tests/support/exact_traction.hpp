// The exact traction of the plane model under harmonic or growing creepage, by Bessel functions.
#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

#include <rollbem/closed_form/detail/plane_lambda.hpp>
#include <rollbem/reference/bessel.hpp>

namespace rollbem::reference {

/// Exact traction p/(G xi) under creepage xi e^{s V t/a}: (sum p_n T_n(x))/sqrt(1-x^2) with p_0 = -(I0+I1)/(2(1-nu) D)
/// and p_n = n I_n/((1-nu) s D). It is zero at the leading edge and infinite at the trailing edge.
class ExactTraction {
public:
    /// `s` in V/a; s = i omega a/V for harmonic creepage, 0 for steady.
    ExactTraction(std::complex<double> s, double poisson_ratio, double aspect) {
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
            for (std::size_t k = 0; k <= count; ++k) bessel[n] += samples[k] * cosines[n * k % cosines.size()];
        }
        const detail::Complex sum = bessel[0] + bessel[1];
        const detail::Complex denominator = (bessel[0] + point * lambda * sum) * stiffness;
        coefficients_.resize(order + 1);            // that of T_0 does not matter
        for (std::size_t n = 1; n <= order; ++n) {  // n I_n / s = (I_{n-1} - I_{n+1})/2 also holds at s = 0
            coefficients_[n] = (bessel[n - 1] - bessel[n + 1]) / denominator;
        }
    }

    /// p/(G xi) at x/a, -1 <= x/a <= 1.
    std::complex<double> operator()(double x_over_a) const {
        // the coefficients add up to zero, so T_n may be replaced by T_n - 1 = -2 sin^2(n theta/2): nothing cancels
        // at the leading edge, theta = 0
        const long double half = std::atan2(std::sqrt(1 - static_cast<long double>(x_over_a)),
                                            std::sqrt(1 + static_cast<long double>(x_over_a)));
        if (half == 0) return 0;
        detail::Complex sum = 0;
        for (std::size_t n = 1; n < coefficients_.size(); ++n) {
            const long double sine = std::sin(static_cast<long double>(n) * half);
            sum -= 2 * sine * sine * coefficients_[n];
        }
        return std::complex<double>(sum / std::sin(2 * half));
    }

private:
    std::vector<detail::Complex> coefficients_;  ///< coefficients of T_n, n = 0, 1, ...
};

}  // namespace rollbem::reference
