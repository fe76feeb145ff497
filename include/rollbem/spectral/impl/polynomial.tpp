// Bodies of spectral/polynomial.hpp. Internal.
#pragma once

#include "../polynomial.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <concepts>
#include <limits>
#include <type_traits>

#include <Eigen/Core>

#include "../../closed_form/carter.hpp"
#include "../../closed_form/detail/estimated_c11.hpp"
#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../../status.hpp"
#include "../../types.hpp"
#include "../detail/quotient.hpp"

namespace rollbem::detail {

/// Lambda, after checking the requirements of every polynomial problem. Only the steady one allows Lambda <= 0.
template <std::floating_point Scalar>
Scalar polynomial_lambda(const char* who, std::complex<Scalar> s, Scalar poisson_ratio, Scalar aspect,
                         Eigen::Index order);

/// r_k = P_{k+1}/P_k from r_{k+1}, see solve_polynomial. A vanishing denominator means P_k = 0: r_k is then infinite,
/// and any huge number will do, because only P_k r_k matters.
template <std::floating_point Scalar>
std::complex<Scalar> chebyshev_ratio(std::complex<Scalar> s, Eigen::Index k, std::complex<Scalar> next);

/// (P_1 + ... + P_order)/P_1 from r_1 and P_order/P_1: the sum of the rows U_1, U_2, ... telescopes. Added term by term
/// it would cancel if Re s < 0.
template <std::floating_point Scalar>
std::complex<Scalar> chebyshev_sum(std::complex<Scalar> s, Eigen::Index order, std::complex<Scalar> ratio,
                                   std::complex<Scalar> tail);

template <std::floating_point Scalar>
Status polynomial_status(std::complex<Scalar> c11, Scalar error_estimate, Scalar tolerance);

/// Largest error estimate of a converged Chebyshev solution: at a sufficient order only rounding remains, which half
/// the digits distinguish from truncation.
template <std::floating_point Scalar>
Scalar chebyshev_tolerance() {
    return std::sqrt(std::numeric_limits<Scalar>::epsilon());
}

}  // namespace rollbem::detail

namespace rollbem {

template <std::floating_point Scalar>
Eigen::Index default_polynomial_order(std::complex<Scalar> s) {
    const Scalar modulus = std::abs(s);
    detail::require(detail::is_finite(modulus) && modulus <= Scalar(1e8), "default_polynomial_order", "|s|", modulus,
                    "be at most 1e8");
    const Scalar digits = Scalar(std::numeric_limits<Scalar>::digits) / 53;
    return static_cast<Eigen::Index>(std::ceil(modulus + digits * (12 * std::cbrt(modulus) + 20)));
}

}  // namespace rollbem

namespace rollbem::detail {

template <std::floating_point Scalar>
Scalar polynomial_lambda(const char* who, std::complex<Scalar> s, Scalar poisson_ratio, Scalar aspect,
                         Eigen::Index order) {
    require_finite(who, "Re s", s.real());
    require_finite(who, "Im s", s.imag());
    require(order >= 1, who, "order", order, "be at least 1");
    return s == std::complex<Scalar>(0) ? plane_lambda(poisson_ratio, aspect)
                                        : stable_plane_lambda(who, poisson_ratio, aspect);
}

template <std::floating_point Scalar>
std::complex<Scalar> chebyshev_ratio(std::complex<Scalar> s, Eigen::Index k, std::complex<Scalar> next) {
    const Scalar index = static_cast<Scalar>(k);
    std::complex<Scalar> denominator = Scalar(1) + s * next / (2 * (index + 2));
    if (denominator == std::complex<Scalar>(0)) {
        denominator = std::numeric_limits<Scalar>::epsilon() * std::numeric_limits<Scalar>::epsilon();
    }
    return s / (2 * index) / denominator;
}

template <std::floating_point Scalar>
std::complex<Scalar> chebyshev_sum(std::complex<Scalar> s, Eigen::Index order, std::complex<Scalar> ratio,
                                   std::complex<Scalar> tail) {
    if (order == 1) return Scalar(1);
    return Scalar(1) + s * (Scalar(0.5) + ratio / Scalar(4) - tail / static_cast<Scalar>(2 * order));
}

template <std::floating_point Scalar>
Status polynomial_status(std::complex<Scalar> c11, Scalar error_estimate, Scalar tolerance) {
    if (!is_finite(c11)) return Status::not_finite;
    return is_finite(error_estimate) && error_estimate <= tolerance ? Status::ok : Status::not_converged;
}

}  // namespace rollbem::detail

namespace rollbem {

template <std::floating_point Scalar>
EstimatedC11<Scalar> polynomial_c11(std::type_identity_t<std::complex<Scalar>> s, Scalar poisson_ratio,
                                    std::type_identity_t<Scalar> aspect, Eigen::Index order) {
    using Complex = std::complex<Scalar>;
    const Scalar lambda = detail::polynomial_lambda("polynomial_c11", s, poisson_ratio, aspect, order);
    Complex ratio = 0;  // r_k
    Complex tail = 1;   // P_order/P_k
    for (Eigen::Index k = order - 1; k > 0; --k) {
        ratio = detail::chebyshev_ratio(s, k, ratio);
        tail *= ratio;
    }
    const Complex sum = detail::chebyshev_sum(s, order, ratio, tail);
    const Complex denominator = Scalar(1) + s * (lambda * sum + ratio / Scalar(4));
    EstimatedC11<Scalar> result{};
    result.c11 = steady_c11(poisson_ratio) * sum / denominator;
    // relative errors of the sum (truncation, rounding), amplified near a pole, and the rounding of the denominator;
    // the last factor turns errors relative to the computed sum into errors relative to the exact one
    const Scalar modulus = std::abs(s);
    const Scalar rounding = 4 * std::numeric_limits<Scalar>::epsilon();
    const Scalar dropped = std::abs(tail) * modulus * (1 + modulus) / static_cast<Scalar>(2 * order);
    const Scalar sum_error =
        (dropped + rounding * (1 + modulus * (2 + std::abs(ratio)) / 4)) / std::abs(sum) + rounding;
    const Scalar rest = 1 + modulus * std::abs(ratio) / 4;
    result.error_estimate = (sum_error * (1 + rest / std::abs(denominator)) +
                             rounding * modulus * lambda * std::abs(sum) / std::abs(denominator)) /
                            (std::max)(1 - sum_error, Scalar(0));
    result.status = detail::polynomial_status(result.c11, result.error_estimate, detail::chebyshev_tolerance<Scalar>());
    return result;
}

template <std::floating_point Scalar>
PolynomialSolution<Scalar> solve_polynomial(std::type_identity_t<std::complex<Scalar>> s, Scalar poisson_ratio,
                                            std::type_identity_t<Scalar> aspect, Eigen::Index order) {
    using Complex = std::complex<Scalar>;
    using Vector = typename PolynomialSolution<Scalar>::Vector;
    const Scalar lambda = detail::polynomial_lambda("solve_polynomial", s, poisson_ratio, aspect, order);
    Vector traction(order + 1);
    Vector displacement(order + 1);
    Complex ratio = 0;
    for (Eigen::Index k = order - 1; k > 0; --k) {
        ratio = detail::chebyshev_ratio(s, k, ratio);
        traction[k + 1] = ratio;
    }
    traction[1] = 1;
    for (Eigen::Index n = 2; n <= order; ++n) traction[n] *= traction[n - 1];
    const Complex sum = detail::chebyshev_sum(s, order, ratio, Complex(traction[order]));
    traction[0] = -sum;
    traction /= Scalar(1) + s * (lambda * sum + ratio / Scalar(4));
    displacement[0] = lambda * traction[0];
    for (Eigen::Index n = 1; n <= order; ++n) displacement[n] = traction[n] / static_cast<Scalar>(n);
    traction /= 2 * (1 - poisson_ratio);
    const EstimatedC11<Scalar> scalar = polynomial_c11(s, poisson_ratio, aspect, order);
    return {PolynomialSolution<Scalar>::Basis::chebyshev,
            scalar.c11,
            traction,
            displacement,
            scalar.error_estimate,
            Scalar(1),
            scalar.status};
}

template <std::floating_point Scalar>
auto PolynomialSolution<Scalar>::traction(const EdgeDistances<Scalar>& position) const -> Complex {
    return quotient(position) * std::sqrt(position.leading / position.trailing);
}

template <std::floating_point Scalar>
auto PolynomialSolution<Scalar>::displacement(Scalar x_over_a) const -> Complex {
    detail::require(detail::is_finite(x_over_a) && std::abs(x_over_a) <= Scalar(1), "PolynomialSolution", "x/a",
                    x_over_a, "lie in [-1, 1]");
    const Vector& u = displacement_coefficients;
    Complex next = 0;
    Complex current = 0;
    for (Eigen::Index n = u.size() - 1; n > 0; --n) {
        const Complex previous =
            basis == Basis::monomial ? u[n] + x_over_a * current : u[n] + 2 * x_over_a * current - next;
        next = current;
        current = previous;
    }
    return basis == Basis::monomial ? u[0] + x_over_a * current : u[0] + x_over_a * current - next;
}

template <std::floating_point Scalar>
auto PolynomialSolution<Scalar>::quotient(const EdgeDistances<Scalar>& position) const -> Complex {
    const Vector& c = traction_coefficients;
    if (basis == Basis::monomial) {  // synthetic division: minus the partial sums of c_j, highest first
        const Scalar x = position.leading < position.trailing ? 1 - position.leading : position.trailing - 1;
        Complex partial = 0;
        Complex value = 0;
        for (Eigen::Index j = c.size() - 1; j > 0; --j) {
            partial += c[j];
            value = value * x + partial;
        }
        return -value;
    }
    return detail::quotient_by_leading(c, position.leading);
}

}  // namespace rollbem
