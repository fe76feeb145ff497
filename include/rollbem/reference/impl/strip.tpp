// Bodies of reference/strip.hpp. Internal.
#pragma once

#include "../strip.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>

#include "../../closed_form/detail/estimated_c11.hpp"
#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../../status.hpp"

namespace rollbem::reference {

namespace detail {

using rollbem::detail::require;

/// With p = q(x)/sqrt(1-x^2), theta_j = (2j-1) pi/2N and y_j = cos(theta_j), the quadrature (pi/N) sum f(y_j) q(y_j) is
/// exact to degree 2N-1, and at x_i = cos(i pi/N) it remains so for a Cauchy integral (Erdogan and Gupta 1972): the N-1
/// equations for du/dx use the kernel's slope directly. For the displacement the logarithm, which is diagonal in T_n
/// (T_0 -> 2 c1 ln 2, T_n -> 2 c1/n), is separated from a smooth remainder. The last equation is q(1) = 0, by
/// interpolation.
template <class Number>
Number strip_c11_once(Number s, double c1, double c2, double b, Eigen::Index order) {
    using Matrix = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;
    using Vector = Eigen::Matrix<Number, Eigen::Dynamic, 1>;
    const double pi = std::numbers::pi, count = static_cast<double>(order);
    const double step = pi / (2 * count);  // all angles are multiples of it
    const auto angle = [step](Eigen::Index k) { return static_cast<double>(k) * step; };

    // sum_{n=1}^{N-1} cos(n k step)/n
    std::vector<double> logarithm(static_cast<std::size_t>(4 * order), 0);
    if (s != Number(0)) {
        for (Eigen::Index k = 1; k < 4 * order; k += 2) {
            double& sum = logarithm[static_cast<std::size_t>(k)];
            for (Eigen::Index n = order - 1; n > 0; --n) {
                sum += std::cos(angle(n * k % (4 * order))) / static_cast<double>(n);
            }
        }
    }
    Matrix equations(order, order);
    for (Eigen::Index j = 0; j < order; ++j) {
        const Eigen::Index theta = 2 * j + 1;
        for (Eigen::Index i = 1; i < order; ++i) {
            const Eigen::Index phi = 2 * i, sum = phi + theta, difference = std::abs(phi - theta);
            const double x = 2 * std::sin(angle(sum) / 2) * std::sin(angle(theta - phi) / 2);  // x_i - y_j
            const double r = std::hypot(x, b);
            Number entry = -2 * (c1 * b / (x * r) + c2 * (b / r) * (x / r) / r) / count;
            if (s != Number(0)) {
                const double rest = c1 * std::log(b + r) + c2 * b / r;
                const double singular = c1 * (std::numbers::ln2 + logarithm[static_cast<std::size_t>(sum)] +
                                              logarithm[static_cast<std::size_t>(difference)]);
                entry -= s * (2 * (rest + singular) / count);
            }
            equations(i - 1, j) = entry;
        }
        equations(order - 1, j) = (j % 2 == 0 ? 1 : -1) / std::tan(angle(theta) / 2) / count;
    }
    Vector creepage = Vector::Ones(order);
    creepage[order - 1] = 0;
    const Vector q = Eigen::PartialPivLU<Eigen::Ref<Matrix>>(equations).solve(creepage);
    return -(pi / count) * q.sum();
}

}  // namespace detail

inline EstimatedC11<double> strip_c11(std::complex<double> s, double poisson_ratio, double aspect) {
    rollbem::detail::require_poisson_ratio("reference::strip_c11", poisson_ratio);
    detail::require(rollbem::detail::is_finite(aspect) && aspect >= 0.005, "reference::strip_c11", "aspect", aspect,
                    "be at least 0.005 and finite");
    detail::require(std::abs(s) <= 1000, "reference::strip_c11", "|s|", std::abs(s), "be at most 1000");
    const double c1 = 1 - poisson_ratio, c2 = poisson_ratio;
    const Eigen::Index order =
        3 * static_cast<Eigen::Index>(std::ceil(12 + std::abs(s) / 2 + 7 / (std::min)(aspect, 1.0)));
    const auto solve = [&](Eigen::Index at) -> std::complex<double> {
        if (s == 0.0) return detail::strip_c11_once<double>(0, c1, c2, aspect, at);
        return detail::strip_c11_once<std::complex<double>>(s, c1, c2, aspect, at);
    };
    const std::complex<double> c11 = solve(order), lower = solve(order / 3 * 2);
    const double change = std::abs(lower / c11 - 1.0);
    if (!rollbem::detail::is_finite(change)) return {c11, change, Status::not_finite};
    const bool converged = change <= std::sqrt(std::numeric_limits<double>::epsilon());
    return {c11, change, converged ? Status::ok : Status::not_converged};
}

}  // namespace rollbem::reference
