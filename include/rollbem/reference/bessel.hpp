// Exact response of the plane model to non-steady creepage, in Bessel functions: c11, traction and eigenvalues. Needs
// GSL; includes nothing of the discretised problem, so that the two cannot share errors. Dimensionless: a = G = V = 1.
#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "detail/bessel_functions.hpp"

/// Independent references. With u = A e^{sx} - xi/s the zero-slip condition du/dx - s u = xi holds for any A; the
/// logarithmic kernel is diagonal in Chebyshev polynomials over sqrt(1-x^2) (T_0 -> 2 (1-nu) Lambda,
/// T_n -> 2 (1-nu)/n), e^{sx} = I0(s) + 2 sum I_n(s) T_n(x), and p = 0 at the leading edge fixes A. Hence, with
/// D = I0 + s Lambda (I0+I1), c11(s) = pi/(2(1-nu)) (I0+I1)/D for any complex s; s = i omega a/V is the harmonic case.
namespace rollbem::reference {

/// Exact creep coefficient of the plane model under creepage xi e^{s V t/a}; s = i omega a/V is the harmonic case,
/// s = 0 the steady one; `aspect` is b/a. Exact to rounding: by GSL's J0 and J1 for harmonic creepage with |s| < 40,
/// otherwise from the integrals of I_n by the trapezoidal rule or, for |s| >= 40, Hankel's expansions. The poles are
/// the eigenvalues. Throws std::invalid_argument unless s is finite, 0 <= poisson_ratio <= 0.5, 0 < aspect < inf and
/// either Lambda > 0 or s = 0.
std::complex<double> plane_c11(std::complex<double> s, double poisson_ratio, double aspect);

/// Exact eigenvalues nu_k a of G' p = nu G p for the plane kernel: the `count` zeros of I0 + s Lambda (I0 + I1) with Im
/// s >= 0 of least modulus, ascending; each with Im s > 0 represents a conjugate pair. All have Re s < 0. Throws
/// std::invalid_argument unless count > 0, 0 <= poisson_ratio <= 0.5, 0 < aspect < inf and Lambda > 0.
std::vector<std::complex<double>> eigenvalues(std::size_t count, double poisson_ratio, double aspect);

/// Exact traction p/(G xi) under creepage xi e^{s V t/a}: (sum p_n T_n(x))/sqrt(1-x^2) with p_0 = -(I0+I1)/(2(1-nu) D)
/// and p_n = n I_n/((1-nu) s D). It is zero at the leading edge and infinite at the trailing edge.
class ExactTraction {
public:
    /// `s` in V/a; s = i omega a/V for harmonic creepage, 0 for steady. Throws std::invalid_argument
    /// unless s is finite, 0 <= poisson_ratio <= 0.5, 0 < aspect < inf and either Lambda > 0 or s = 0.
    ExactTraction(std::complex<double> s, double poisson_ratio, double aspect);

    /// p/(G xi) at x/a. Throws std::invalid_argument unless -1 <= x/a <= 1.
    std::complex<double> operator()(double x_over_a) const;

    /// c11 = -F/(a G xi) from the mean of the traction, F = pi p_0.
    std::complex<double> c11() const { return c11_; }

private:
    std::complex<double> c11_;
    std::vector<detail::Complex> coefficients_;  ///< coefficients of T_n, n = 0, 1, ...
};

}  // namespace rollbem::reference

#include "impl/bessel.tpp"
