// Exact response of the plane model to non-steady creepage, in Bessel functions: c11, traction and eigenvalues; and its
// force histories over the distance rolled q = V t/a after a step, a ramp, a sine and piecewise linear creepage. Needs
// GSL; includes nothing of the discretised problem, so that the two cannot share errors. Dimensionless: a = G = V = 1.
#pragma once

#include <complex>
#include <cstddef>
#include <span>
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

/// Inverse Laplace transform at q > 0 by de Hoog, Knight and Stokes' accelerated Fourier series (SIAM J. Sci. Stat.
/// Comput. 3, 1982). `transform` maps std::complex<long double> to the same type; all its singularities lie in
/// Re s <= 0. Uses 2 terms + 1 evaluations on Re s = ln(1e14)/(4q). Throws std::invalid_argument unless 0 < q < inf and
/// terms > 0.
template <typename Transform>
double invert_laplace(const Transform& transform, double q, int terms = 40);

/// Step response of the force by de Hoog's method: -F/(a G xi) at q/a > 0 after a step of creepage xi at q = 0. An
/// independent check of StepResponse; most accurate for q/a < 2. Throws std::invalid_argument unless 0 < q/a < inf,
/// 0 <= poisson_ratio <= 0.5, 0 < aspect < inf and Lambda > 0.
double step_response_de_hoog(double q_over_a, double poisson_ratio, double aspect);

/// Force histories -F/(a G xi_ref) from rest, exact for the plane kernel. For q/a <= 1.5 by the Taylor series about
/// q = 0 (its radius of convergence is 2, the distance in which a particle passes through the contact), for larger q/a
/// by the modal series C + sum C/(s_k (1 - Lambda (Lambda-2) s_k)) e^{s_k q}, C = pi/(2(1-nu)). The error
/// (docs/measured.md) is largest just below and at q/a = 2, where the response has a kink in its second derivative and
/// the series decays like k^-3.
class StepResponse {
public:
    /// Throws std::invalid_argument unless modes > 0, 0 <= poisson_ratio <= 0.5, 0 < aspect < inf and Lambda > 0.
    StepResponse(double poisson_ratio, double aspect, std::size_t modes = 4000);

    /// -F/(a G xi) at q/a after a step of creepage xi at q = 0; zero for q <= 0.
    double step(double q_over_a) const;

    /// -F/(a G rate) at q/a for creepage rate * q from rest: the integral of the step response.
    double ramp(double q_over_a) const;

    /// -F/(a G amplitude) at q/a for creepage amplitude * sin(omega q) from rest; omega in V/a. Throws
    /// std::invalid_argument unless omega is positive and finite.
    double sine(double omega, double q_over_a) const;

    /// -F/(a G) at q/a for a piecewise linear creepage through the points (q_j, creepage_j), zero before q_0 and
    /// constant after the last; equal successive q_j make a jump. Convolution with the step response: exact except for
    /// the errors of step and ramp. Throws std::invalid_argument if the lists are empty or differ in length, or if q_j
    /// decrease.
    double history(std::span<const double> points, std::span<const double> creepage, double q_over_a) const;

private:
    struct Mode {
        std::complex<double> eigenvalue;
        std::complex<double> amplitude;  ///< amplitude in the step response, doubled for a conjugate pair
    };

    static constexpr double taylor_limit = 1.5;
    static constexpr std::size_t taylor_terms = 160;  // (taylor_limit/2)^160 = 1e-20

    /// Power series of c11 in t = 1/s: c11 = C t n/(Lambda n + t a0), n and a0 the Hankel series of I0 + I1 and I0.
    void make_taylor_coefficients();

    /// Inverse of c11(s)/s^power: t^(j+1+power) -> q^(j+power)/(j+power)!.
    double taylor(double q, int power) const;

    /// Inverse of c11(s) omega/(s^2 + omega^2), with omega/(s^2 + omega^2) = sum (-1)^i omega^(2i+1) t^(2i+2).
    double taylor_sine(double omega, double q) const;

    /// Real part of sum amplitude factor(s) e^{s q}, up to the first term far below rounding.
    template <typename Factor>
    double modal_sum(double q, const Factor& factor) const;

    double poisson_ratio_;
    double lambda_;
    std::vector<Mode> modes_;          ///< sorted by descending real part
    std::vector<long double> taylor_;  ///< c11(s) = sum taylor_j s^-(j+1) for s -> infinity
};

}  // namespace rollbem::reference

#include "impl/bessel.tpp"
