// Polynomial approach to harmonic creepage, Eqs. (17)-(27), plane kernel: in monomials as in the paper, and in
// Chebyshev polynomials, where it costs O(order) and is accurate to rounding. Dimensionless: a = G = V = 1.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <concepts>
#include <limits>
#include <numbers>
#include <type_traits>

#include <Eigen/Core>
#include <Eigen/LU>

#include "../closed_form/carter.hpp"
#include "../closed_form/estimated_c11.hpp"
#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../status.hpp"
#include "../types.hpp"
#include "detail/quotient.hpp"

namespace rollbem {

enum class PolynomialBasis { monomial, chebyshev };

/// What to do about the status of a polynomial solution, as a clause for a message: ill_conditioned is for monomials
/// whose matrix is close to singular, not_converged for an order that is too low or monomials that have broken down.
inline const char* advice(Status status) {
    switch (status) {
        case Status::ok: return "nothing: the solution can be used";
        case Status::ill_conditioned:
            return "the monomial basis has broken down at this order (ill-conditioned); use the Chebyshev basis";
        case Status::not_converged:
            return "the result changes with the order; raise it, or use the Chebyshev basis at its default order";
        default: break;
    }
    return "the result is not finite; use the Chebyshev basis at its default order";
}

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

    PolynomialBasis basis;
    Complex c11;                       ///< Eq. (30): force per unit width over -a G xi
    Vector traction_coefficients;      ///< c_j of Eq. (17) over G xi, of x^j or of T_j; their sum is zero
    Vector displacement_coefficients;  ///< u/(a xi), of x^l (Eq. 22) or of T_l
    Scalar error_estimate;             ///< of c11, relative
    Scalar condition;                  ///< monomial: estimated 1-norm condition; Chebyshev: 1, no matrix is inverted
    Status status = Status::not_finite;

    /// p/(G xi), Eq. (17).
    Complex traction(const EdgeDistances<Scalar>& position) const {
        return quotient(position) * std::sqrt(position.leading / position.trailing);
    }

    /// The same at x/a. Throws std::invalid_argument unless -1 <= x/a <= 1.
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
                basis == PolynomialBasis::monomial ? u[n] + x_over_a * current : u[n] + 2 * x_over_a * current - next;
            next = current;
            current = previous;
        }
        return basis == PolynomialBasis::monomial ? u[0] + x_over_a * current : u[0] + x_over_a * current - next;
    }

private:
    /// The polynomial of Eq. (17), which vanishes at x = 1, divided by 1 - x: nothing cancels at the leading edge.
    Complex quotient(const EdgeDistances<Scalar>& position) const {
        const Vector& c = traction_coefficients;
        if (basis == PolynomialBasis::monomial) {  // synthetic division: minus the partial sums of c_j, highest first
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

/// Lambda, after checking what every polynomial problem requires. Only the steady one allows Lambda <= 0.
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

/// Chebyshev: at a sufficient order only rounding remains, so half the digits distinguish it from truncation.
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
    // errors of the sum (truncation, rounding), amplified near a pole, and the rounding of the denominator
    const Scalar modulus = std::abs(s);
    const Scalar rounding = 4 * std::numeric_limits<Scalar>::epsilon();
    const Scalar dropped = std::abs(tail) * modulus * (1 + modulus) / static_cast<Scalar>(2 * order);
    const Scalar sum_error = dropped + rounding * (1 + modulus * (2 + std::abs(ratio)) / 4);
    const Scalar rest = 1 + modulus * std::abs(ratio) / 4;
    result.error_estimate = (sum_error / std::abs(sum) + rounding) * (1 + rest / std::abs(denominator)) +
                            rounding * modulus * lambda * std::abs(sum) / std::abs(denominator);
    result.status = detail::polynomial_status(result.c11, result.error_estimate, detail::chebyshev_tolerance<Scalar>());
    return result;
}

/// The same at default_polynomial_order(s). Throws std::invalid_argument also if |s| > 1e8.
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
    return {PolynomialBasis::chebyshev, scalar.c11, traction,     displacement,
            scalar.error_estimate,      Scalar(1),  scalar.status};
}

/// The same at default_polynomial_order(s). Throws std::invalid_argument also if |s| > 1e8.
template <std::floating_point Scalar>
PolynomialSolution<Scalar> solve_polynomial(std::type_identity_t<std::complex<Scalar>> s, Scalar poisson_ratio,
                                            std::type_identity_t<Scalar> aspect) {
    return solve_polynomial(s, poisson_ratio, aspect, default_polynomial_order(s));
}

/// The homogeneous problem in the Chebyshev basis as a standard eigenproblem M P = (1/s) P, P = (P_1, ..., P_order),
/// P_0 = -sum P_n: order x order, upper Hessenberg. 1/eigenvalue converges to the exact nu_k a of G' p = nu G p with
/// the plane kernel, the smallest first. Throws std::invalid_argument unless order >= 1, 0 <= poisson_ratio <= 0.5,
/// 0 < aspect < inf and Lambda > 0.
template <std::floating_point Scalar>
MatrixX<Scalar> chebyshev_pencil(Eigen::Index order, Scalar poisson_ratio, Scalar aspect) {
    const Scalar lambda =
        detail::polynomial_lambda("chebyshev_pencil", std::complex<Scalar>(1), poisson_ratio, aspect, order);
    MatrixX<Scalar> matrix = MatrixX<Scalar>::Zero(order, order);
    matrix.row(0).setConstant(-lambda);
    for (Eigen::Index k = 0; k < order; ++k) {  // row k is that of U_k, column j of P_{j+1}
        if (k > 0) matrix(k, k - 1) = Scalar(0.5) / static_cast<Scalar>(k);
        if (k + 1 < order) matrix(k, k + 1) -= Scalar(0.5) / static_cast<Scalar>(k + 2);
    }
    return matrix;
}

/// Moments mu_j = (1/pi) int x^j/sqrt(1-x^2) dx, j = 0 ... order: binomial(j, j/2)/2^j for even j, 0 for odd. Throws
/// std::invalid_argument if order < 0.
template <std::floating_point Scalar>
VectorX<Scalar> monomial_moments(Eigen::Index order) {
    detail::require(order >= 0, "monomial_moments", "order", order, "be at least 0");
    VectorX<Scalar> moments = VectorX<Scalar>::Zero(order + 1);
    moments[0] = 1;
    for (Eigen::Index j = 2; j <= order; j += 2) {
        moments[j] = moments[j - 2] * static_cast<Scalar>(j - 1) / static_cast<Scalar>(j);
    }
    return moments;
}

/// B of Eq. (19), (order+1) x (order+1) and lower triangular: row j holds the coefficients of x^l in U_j/a (G = 1).
/// Exact: expanding x^j in Chebyshev polynomials, applying the diagonal kernel and transforming back gives dU_j/dx = 2
/// (1-nu) sum_l mu_{j-1-l} x^l, free of cancellation, and U_j(0) by the derivative of mu_j with respect to j. Throws
/// std::invalid_argument unless order >= 0, 0 <= poisson_ratio <= 0.5 and 0 < aspect < inf.
template <std::floating_point Scalar>
MatrixX<Scalar> displacement_matrix(Eigen::Index order, Scalar poisson_ratio, Scalar aspect) {
    using Matrix = MatrixX<Scalar>;
    const Scalar stiffness = 2 * (1 - poisson_ratio);
    const Scalar ln2 = std::numbers::ln2_v<Scalar>;
    const Scalar level = plane_lambda(poisson_ratio, aspect) - ln2;
    const VectorX<Scalar> moments = monomial_moments<Scalar>(order);
    Matrix b = Matrix::Zero(order + 1, order + 1);
    Scalar logarithmic = -ln2;  // (1/pi) int x^j ln|x|/sqrt(1-x^2) dx, even j
    for (Eigen::Index j = 0; j <= order; ++j) {
        if (j % 2 == 0) {
            if (j > 0) {
                const Scalar index = static_cast<Scalar>(j);
                logarithmic = logarithmic * (index - 1) / index + moments[j - 2] / (index * index);
            }
            b(j, 0) = stiffness * (level * moments[j] - logarithmic);
        }
        for (Eigen::Index l = 1; l <= j; ++l) b(j, l) = stiffness * moments[j - l] / static_cast<Scalar>(l);
    }
    return b;
}

/// Thresholds of solve_monomial.
template <std::floating_point Scalar>
struct MonomialOptions {
    /// Condition above which the status is ill_conditioned; 1e12 in double.
    Scalar largest_condition = (std::min)(Scalar(1e12), Scalar(2e-4) / std::numeric_limits<Scalar>::epsilon());
    /// Relative difference of c11 between order and order + 10 above which the status is not_converged.
    Scalar tolerance = std::cbrt(std::numeric_limits<Scalar>::epsilon()) / 100;
};

namespace detail {

template <std::floating_point Scalar>
PolynomialSolution<Scalar> solve_monomial_once(std::complex<Scalar> s, const Eigen::Ref<const MatrixX<Scalar>>& b) {
    using Complex = std::complex<Scalar>;
    using Vector = typename PolynomialSolution<Scalar>::Vector;
    using Matrix = MatrixX<Complex>;
    const Eigen::Index order = b.rows() - 1;
    Matrix matrix(order + 1, order + 1);
    for (Eigen::Index l = 0; l < order; ++l) {
        // the derivative of (x/a)^l gives the factor l, which is missing in Eqs. (24)-(26)
        matrix.row(l) = static_cast<Scalar>(l + 1) * b.col(l + 1).transpose().template cast<Complex>() -
                        s * b.col(l).transpose().template cast<Complex>();
    }
    matrix.row(order).setOnes();
    const Eigen::PartialPivLU<Matrix> lu(matrix);
    const Vector creepage = Vector::Unit(order + 1, 0);
    PolynomialSolution<Scalar> solution{};
    solution.basis = PolynomialBasis::monomial;
    solution.traction_coefficients = lu.solve(creepage);
    solution.displacement_coefficients = b.transpose().template cast<Complex>() * solution.traction_coefficients;
    const Complex mean = monomial_moments<Scalar>(order).template cast<Complex>().dot(solution.traction_coefficients);
    solution.c11 = -std::numbers::pi_v<Scalar> * mean;
    solution.condition = 1 / lu.rcond();
    return solution;
}

}  // namespace detail

/// The polynomial approach in monomials with a given B (from displacement_matrix, or fitted to Eq. (20)), which
/// determines the order: Eqs. (25)-(27) with the factors 1 and l+1 due to the derivative. The error estimate is the
/// difference from order + 10 with the exact B, plus rounding. The status is ill_conditioned or not_converged according
/// to `options`; monomials break down by cancellation before the matrix looks singular. Throws std::invalid_argument
/// unless B is square and at least 2 x 2, and s, poisson_ratio and aspect are as in polynomial_c11.
template <std::floating_point Scalar>
PolynomialSolution<Scalar> solve_monomial(std::type_identity_t<std::complex<Scalar>> s, Scalar poisson_ratio,
                                          std::type_identity_t<Scalar> aspect,
                                          const Eigen::Ref<const MatrixX<Scalar>>& b,
                                          const MonomialOptions<Scalar>& options = {}) {
    detail::require(b.rows() == b.cols(), "solve_monomial", "columns of B", b.cols(), "equal its rows");
    const Eigen::Index order = b.rows() - 1;
    detail::polynomial_lambda("solve_monomial", s, poisson_ratio, aspect, order);
    PolynomialSolution<Scalar> solution = detail::solve_monomial_once<Scalar>(s, b);
    const PolynomialSolution<Scalar> higher =
        detail::solve_monomial_once<Scalar>(s, displacement_matrix(order + 10, poisson_ratio, aspect));
    const Scalar rounding = 4 * std::numeric_limits<Scalar>::epsilon();  // both orders may round alike
    solution.error_estimate = std::abs(solution.c11 - higher.c11) / std::abs(solution.c11) + rounding;
    solution.status = detail::polynomial_status(solution.c11, solution.error_estimate, options.tolerance);
    if (solution.status != Status::not_finite &&
        !(detail::is_finite(solution.condition) && solution.condition <= options.largest_condition)) {
        solution.status = Status::ill_conditioned;
    }
    return solution;
}

/// The same with the exact B of a given order.
template <std::floating_point Scalar>
PolynomialSolution<Scalar> solve_monomial(std::type_identity_t<std::complex<Scalar>> s, Scalar poisson_ratio,
                                          std::type_identity_t<Scalar> aspect, Eigen::Index order,
                                          const MonomialOptions<Scalar>& options = {}) {
    detail::polynomial_lambda("solve_monomial", s, poisson_ratio, aspect, order);
    return solve_monomial<Scalar>(s, poisson_ratio, aspect, displacement_matrix(order, poisson_ratio, aspect), options);
}

}  // namespace rollbem
