// Polynomial approach to harmonic creepage, Eqs. (17)-(27), plane kernel, in Chebyshev polynomials, where it costs
// O(order) and is accurate to rounding; apps/studies/monomial.hpp has the monomials of the paper. Dimensionless:
// a = G = V = 1.
#pragma once

#include <complex>
#include <concepts>
#include <type_traits>

#include <Eigen/Core>

#include "../closed_form/carter.hpp"
#include "../closed_form/detail/estimated_c11.hpp"
#include "../status.hpp"
#include "../types.hpp"
#include "detail/quotient.hpp"

namespace rollbem {

/// The lowest order at which the Chebyshev basis reaches the precision of Scalar. Beyond n = |s|, I_n(s) decreases over
/// a range that grows like |s|^(1/3), and faster than any power of |s|/n. Throws std::invalid_argument unless
/// |s| <= 1e8.
template <std::floating_point Scalar>
Eigen::Index default_polynomial_order(std::complex<Scalar> s);

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
    Complex traction(const EdgeDistances<Scalar>& position) const;

    /// p/(G xi) at x/a. Throws std::invalid_argument unless -1 <= x/a <= 1.
    Complex traction(Scalar x_over_a) const { return traction(EdgeDistances<Scalar>::at(x_over_a)); }

    /// u/(a xi) at x/a, Eq. (21). Throws std::invalid_argument unless -1 <= x/a <= 1.
    Complex displacement(Scalar x_over_a) const;

private:
    /// The polynomial of Eq. (17), which vanishes at x = 1, divided by 1 - x: nothing cancels at the leading edge.
    Complex quotient(const EdgeDistances<Scalar>& position) const;
};

/// Creep coefficient of the plane model under creepage xi e^{s V t/a}, s = i omega a/V in the harmonic case, by the
/// Chebyshev basis: solve_polynomial without storing the coefficients, and so without any allocation. `aspect` is b/a.
/// Throws std::invalid_argument unless s is finite, 0 <= poisson_ratio <= 0.5, 0 < aspect < inf, order >= 1 and either
/// Lambda > 0 or s = 0.
template <std::floating_point Scalar>
EstimatedC11<Scalar> polynomial_c11(std::type_identity_t<std::complex<Scalar>> s, Scalar poisson_ratio,
                                    std::type_identity_t<Scalar> aspect, Eigen::Index order);

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
                                            std::type_identity_t<Scalar> aspect, Eigen::Index order);

/// The polynomial approach at default_polynomial_order(s). Throws std::invalid_argument also if |s| > 1e8.
template <std::floating_point Scalar>
PolynomialSolution<Scalar> solve_polynomial(std::type_identity_t<std::complex<Scalar>> s, Scalar poisson_ratio,
                                            std::type_identity_t<Scalar> aspect) {
    return solve_polynomial(s, poisson_ratio, aspect, default_polynomial_order(s));
}

}  // namespace rollbem

#include "impl/polynomial.tpp"
