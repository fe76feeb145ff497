// Complete elliptic integrals and the shape of Hertz's ellipse. Internal.
#pragma once

#include "../../detail/language.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace rollbem::detail {

/// Complete elliptic integrals of the modulus e = sqrt(1 - kappa^2), by the arithmetic-geometric mean (Abramowitz &
/// Stegun 17.6): K, D = (K - E)/e^2, B = K - D and C = (D - B)/e^2, all without cancellation as e tends to 0.
struct EllipticIntegrals {
    double K, D, B, C;

    /// 0 < kappa <= 1, kappa = b/a of an ellipse with the longer semi-axis a.
    explicit EllipticIntegrals(double kappa) {
        // 1 - E/K = sum of 2^(n-1) c_n^2, c_0 = e; half_sum is the sum without its first term, over e^4
        double mean = (1 + kappa) / 2, geometric = std::sqrt(kappa), c = (1 - kappa) / 2;
        double term = 1 / (4 * (1 + kappa) * (1 + kappa)), sum = term;
        while (c > std::numeric_limits<double>::epsilon() * mean) {
            const double next = (mean + geometric) / 2;
            geometric = std::sqrt(mean * geometric);
            mean = next;
            term *= 2 * (c / (4 * mean)) * (c / (4 * mean));
            c = c * c / (4 * mean);
            sum += term;
        }
        const double e_squared = (1 - kappa) * (1 + kappa);
        K = std::numbers::pi / (2 * mean);
        C = 2 * K * sum;
        D = (K + e_squared * C) / 2;
        B = (K - e_squared * C) / 2;
    }
};

/// kappa = (shorter over longer semi-axis) for the ratio q of the smaller to the larger principal curvature, 0 < q <=
/// 1: q = kappa^2 D/B. Newton's method for ln kappa, whose slope lies between 1.5 and 2.
inline double ellipse_of_curvatures(double q) {
    double log_kappa = std::log(q) * 0.6;
    for (int step = 0; step < 60; ++step) {
        const double kappa = std::exp(log_kappa);
        const EllipticIntegrals at(kappa);
        const double excess = 2 * log_kappa + std::log(at.D / at.B / q);
        const double change = excess / (1 + at.C / at.D + kappa * kappa * at.C / at.B);
        log_kappa = (std::min)(log_kappa - change, 0.0);
        if (std::abs(change) <= 4 * std::numeric_limits<double>::epsilon() * (1 + std::abs(log_kappa))) break;
    }
    return std::exp(log_kappa);
}

}  // namespace rollbem::detail
