// Polynomial approach to harmonic creepage, Eqs. (17)-(27), plane kernel, in Chebyshev polynomials, where it costs
// O(order) and is accurate to rounding; apps/studies/monomial.hpp has the monomials of the paper. Dimensionless:
// a = G = V = 1.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <concepts>
#include <limits>
#include <type_traits>

#include <Eigen/Core>

#include "../closed_form/carter.hpp"
#include "../closed_form/detail/estimated_c11.hpp"
#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../status.hpp"
#include "../types.hpp"
#include "detail/quotient.hpp"

namespace rollbem {

/// The lowest order at which the Chebyshev basis reaches the precision of Scalar. Beyond n = |s|, I_n(s) decreases over
/// a range that grows like |s|^(1/3), and faster than any power of |s|/n. Throws std::invalid_argument unless
/// |s| <= 1e8.
template <std::floating_point Scalar>
Eigen::Index default_polynomial_order(std::complex<Scalar> s) {
    const Scalar modulus = std::abs(s);
    detail::require(detail::is_finite(modulus) && modulus <= Scalar(1e8), "default_polynomial_order", "|s|", modulus,
                    "be at most 1e8");
    const Scalar digits = Scalar(std::numeric_limits<Scalar>::digits) / 53;
    return static_cast<Eigen::Index>(std::ceil(modulus + digits * (12 * std::cbrt(modulus) + 20)));
}

/// Traction and displacement under creepage xi e^{s V t/a}, s = i omega a/V in the harmonic case.
template <std::floating_point Scalar>
struct PolynomialSolution {
    using Complex = std::complex<Scalar>;
    using Vector = VectorX<Complex>;

    enum class Basis { monomial, chebyshev } basis;
    Complex c11;                       ///< Eq. (30): force per unit width over -a G xi
    Vector traction_coefficients;      ///< c_j of Eq. (17) over G xi, the coefficients of x^j or of T_j; their sum is
                                       ///< zero
    Vector displacement_coefficients;  ///< u/(a xi), the coefficients of x^l (Eq. 22) or of T_l
    Scalar error_estimate;             ///< relative error of c11
    Scalar condition;                  ///< monomial: estimated 1-norm condition; Chebyshev: 1, no matrix is inverted
    Status status = Status::not_finite;

    /// p/(G xi), Eq. (17).
    Complex traction(const EdgeDistances<Scalar>& position) const {
        return quotient(position) * std::sqrt(position.leading / position.trailing);
    }

    /// p/(G xi) at x/a. Throws std::invalid_argument unless -1 <= x/a <= 1.
    Complex traction(Scalar x_over_a) const { return traction(EdgeDistances<Scalar>::at(x_over_a)); }

    /// u/(a xi) at x/a, Eq. (21). Throws std::invalid_argument unless -1 <= x/a <= 1.
    Complex displacement(Scalar x_over_a) const {
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

private:
    /// The polynomial of Eq. (17), which vanishes at x = 1, divided by 1 - x: nothing cancels at the leading edge.
    Complex quotient(const EdgeDistances<Scalar>& position) const {
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
};

namespace detail {

/// Lambda, after checking the requirements of every polynomial problem. Only the steady one allows Lambda <= 0.
template <std::floating_point Scalar>
Scalar polynomial_lambda(const char* who, std::complex<Scalar> s, Scalar poisson_ratio, Scalar aspect,
                         Eigen::Index order) {
    require_finite(who, "Re s", s.real());
    require_finite(who, "Im s", s.imag());
    require(order >= 1, who, "order", order, "be at least 1");
    return s == std::complex<Scalar>(0) ? plane_lambda(poisson_ratio, aspect)
                                        : stable_plane_lambda(who, poisson_ratio, aspect);
}

/// r_k = P_{k+1}/P_k from r_{k+1}, see solve_polynomial. A vanishing denominator means P_k = 0: r_k is then infinite,
/// and any huge number will do, because only P_k r_k matters.
template <std::floating_point Scalar>
std::complex<Scalar> chebyshev_ratio(std::complex<Scalar> s, Eigen::Index k, std::complex<Scalar> next) {
    const Scalar index = static_cast<Scalar>(k);
    std::complex<Scalar> denominator = Scalar(1) + s * next / (2 * (index + 2));
    if (denominator == std::complex<Scalar>(0)) {
        denominator = std::numeric_limits<Scalar>::epsilon() * std::numeric_limits<Scalar>::epsilon();
    }
    return s / (2 * index) / denominator;
}

/// (P_1 + ... + P_order)/P_1 from r_1 and P_order/P_1: the sum of the rows U_1, U_2, ... telescopes. Added term by term
/// it would cancel if Re s < 0.
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

/// Largest error estimate of a converged Chebyshev solution: at a sufficient order only rounding remains, which half
/// the digits distinguish from truncation.
template <std::floating_point Scalar>
Scalar chebyshev_tolerance() {
    return std::sqrt(std::numeric_limits<Scalar>::epsilon());
}

}  // namespace detail

/// Creep coefficient of the plane model under creepage xi e^{s V t/a}, s = i omega a/V in the harmonic case, by the
/// Chebyshev basis: solve_polynomial without storing the coefficients, and so without any allocation. `aspect` is b/a.
/// Throws std::invalid_argument unless s is finite, 0 <= poisson_ratio <= 0.5, 0 < aspect < inf, order >= 1 and either
/// Lambda > 0 or s = 0.
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

/// The creep coefficient at default_polynomial_order(s). Throws std::invalid_argument also if |s| > 1e8.
template <std::floating_point Scalar>
EstimatedC11<Scalar> polynomial_c11(std::type_identity_t<std::complex<Scalar>> s, Scalar poisson_ratio,
                                    std::type_identity_t<Scalar> aspect) {
    return polynomial_c11(s, poisson_ratio, aspect, default_polynomial_order(s));
}

/// The polynomial approach in the Chebyshev basis, traction (sum p_n T_n)/sqrt(1-x^2). There the kernel of Eq. (20) is
/// diagonal: with P_n = 2 (1-nu) p_n the displacement is Lambda P_0 + sum P_n T_n/n. Zero slip, Eq. (23), in
/// polynomials U_k of the second kind (T_n' = n U_{n-1}, T_n = (U_n - U_{n-2})/2) reads
///     U_0: P_1 - s (Lambda P_0 - P_2/4) = 1,   U_k: P_{k+1} - s (P_k/(2k) - P_{k+2}/(2(k+2))) = 0, 0 < k < order,
/// and p = 0 at the leading edge adds the dense row sum P_n = 0, Eq. (27). Elimination of this bordered band from the
/// last row upwards costs O(order), and is stable because the P_n are the minimal solution of the recurrence. Throws
/// std::invalid_argument unless s is finite, 0 <= poisson_ratio <= 0.5, 0 < aspect < inf, order >= 1 and either
/// Lambda > 0 or s = 0.
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

/// The polynomial approach at default_polynomial_order(s). Throws std::invalid_argument also if |s| > 1e8.
template <std::floating_point Scalar>
PolynomialSolution<Scalar> solve_polynomial(std::type_identity_t<std::complex<Scalar>> s, Scalar poisson_ratio,
                                            std::type_identity_t<Scalar> aspect) {
    return solve_polynomial(s, poisson_ratio, aspect, default_polynomial_order(s));
}

}  // namespace rollbem
