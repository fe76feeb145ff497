// Gauss-Legendre quadrature on [-1, 1] in any floating-point type.
// Nodes by Newton's method on the three-term recurrence, from the classical starting values.
#pragma once

#include "language.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Core>

namespace rollbem::detail {

template <class Scalar>
struct QuadratureRule {
    Eigen::Array<Scalar, Eigen::Dynamic, 1> nodes;    ///< increasing, in [-1, 1]
    Eigen::Array<Scalar, Eigen::Dynamic, 1> weights;  ///< positive, sum 2
};

/// The rule of `count` >= 1 points, exact for polynomials up to degree 2 count - 1.
template <class Scalar>
QuadratureRule<Scalar> gauss_legendre(Eigen::Index count) {
    QuadratureRule<Scalar> rule;
    rule.nodes.resize(count);
    rule.weights.resize(count);
    for (Eigen::Index i = 0; 2 * i < count; ++i) {
        Scalar x = 2 * i + 1 == count ? Scalar(0)
                                      : std::cos(std::numbers::pi_v<Scalar> * (Scalar(i) + Scalar(0.75)) /
                                                 (static_cast<Scalar>(count) + Scalar(0.5)));
        Scalar slope = 1;
        // Newton converges quadratically from these values: four steps reach rounding, the rest are a safeguard
        for (int step = 0; step < 10; ++step) {
            Scalar previous = 0, value = 1;
            for (Eigen::Index k = 1; k <= count; ++k) {
                const Scalar next =
                    (static_cast<Scalar>(2 * k - 1) * x * value - static_cast<Scalar>(k - 1) * previous) /
                    static_cast<Scalar>(k);
                previous = value;
                value = next;
            }
            slope = static_cast<Scalar>(count) * (previous - x * value) / ((1 - x) * (1 + x));
            const Scalar correction = value / slope;
            x -= correction;
            if (std::abs(correction) <= std::numeric_limits<Scalar>::epsilon()) break;
        }
        rule.nodes[i] = -x;
        rule.nodes[count - 1 - i] = x;
        rule.weights[i] = rule.weights[count - 1 - i] = 2 / ((1 - x) * (1 + x) * slope * slope);
    }
    return rule;
}

}  // namespace rollbem::detail

#ifdef ROLLBEM_COMPILED
namespace rollbem {
extern template detail::QuadratureRule<double> detail::gauss_legendre<double>(Eigen::Index);
}  // namespace rollbem
#endif
