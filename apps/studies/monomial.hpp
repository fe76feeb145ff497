// The polynomial approach in monomials as in the paper, Eqs. (17)-(27), plane kernel, for comparison with the Chebyshev
// basis of spectral/polynomial.hpp. Dimensionless: a = G = V = 1.
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

#include <rollbem/detail/finite.hpp>
#include <rollbem/detail/require.hpp>
#include <rollbem/spectral/polynomial.hpp>
#include <rollbem/status.hpp>
#include <rollbem/types.hpp>

namespace rollbem::studies {

/// Advice about the status of a polynomial solution, as a clause for a message: ill_conditioned is for monomials whose
/// matrix is close to singular, not_converged for an order that is too low or monomials that have broken down.
inline const char* polynomial_advice(Status status) {
    switch (status) {
        case Status::ok: return "nothing: the solution can be used";
        case Status::ill_conditioned:
            return "the monomial basis has broken down at this order (ill-conditioned); use the Chebyshev basis";
        case Status::not_converged:
            return "its error is too large; raise the order, or use the Chebyshev basis at its default order";
        default: break;
    }
    return "the result is not finite; use the Chebyshev basis at its default order";
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

}  // namespace rollbem::studies

namespace rollbem::detail {

/// Condition above which the status is ill_conditioned; 1e12 in double.
template <std::floating_point Scalar>
inline constexpr Scalar largest_monomial_condition = (std::min)(Scalar(1e12),
                                                                Scalar(2e-4) / std::numeric_limits<Scalar>::epsilon());

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
    solution.basis = PolynomialSolution<Scalar>::Basis::monomial;
    solution.traction_coefficients = lu.solve(creepage);
    solution.displacement_coefficients = b.transpose().template cast<Complex>() * solution.traction_coefficients;
    const Complex mean =
        studies::monomial_moments<Scalar>(order).template cast<Complex>().dot(solution.traction_coefficients);
    solution.c11 = -std::numbers::pi_v<Scalar> * mean;
    solution.condition = 1 / lu.rcond();
    return solution;
}

}  // namespace rollbem::detail

namespace rollbem::studies {

/// The polynomial approach in monomials: Eqs. (25)-(27) with the factors 1 and l+1 due to the derivative. The error
/// estimate is the difference from polynomial_c11 at its default order, plus polynomial_c11's own estimate: orders of
/// monomials cannot judge one another, as orders that are too low have similar errors, and higher ones round alike. The
/// status is ill_conditioned above a condition of 1e12, not_converged where the estimate is more than a part of 16
/// million; monomials break down by cancellation before the matrix looks singular. Throws std::invalid_argument unless
/// s, poisson_ratio, aspect and order are as in polynomial_c11 and |s| <= 1e8.
template <std::floating_point Scalar>
PolynomialSolution<Scalar> solve_monomial(std::type_identity_t<std::complex<Scalar>> s, Scalar poisson_ratio,
                                          std::type_identity_t<Scalar> aspect, Eigen::Index order) {
    detail::polynomial_lambda("solve_monomial", s, poisson_ratio, aspect, order);
    const EstimatedC11<Scalar> chebyshev = polynomial_c11(s, poisson_ratio, aspect);
    PolynomialSolution<Scalar> solution =
        detail::solve_monomial_once<Scalar>(s, displacement_matrix(order, poisson_ratio, aspect));
    const Scalar difference = std::abs(solution.c11 / chebyshev.c11 - Scalar(1));
    solution.error_estimate = difference + (1 + difference) * chebyshev.error_estimate;
    const Scalar tolerance = std::cbrt(std::numeric_limits<Scalar>::epsilon()) / 100;
    solution.status = detail::polynomial_status(solution.c11, solution.error_estimate, tolerance);
    if (solution.status != Status::not_finite &&
        !(detail::is_finite(solution.condition) && solution.condition <= detail::largest_monomial_condition<Scalar>)) {
        solution.status = Status::ill_conditioned;
    }
    return solution;
}

}  // namespace rollbem::studies
