// Creep coefficient of the strip of finite half-width, steady or harmonic, by an independent spectral method: traction
// in Chebyshev polynomials over sqrt(1 - x^2). Shares nothing with the assembly. Dimensionless: a = G = V = 1.
#pragma once

#include <complex>

#include "../closed_form/detail/estimated_c11.hpp"

namespace rollbem::reference {

/// Creep coefficient of a rectangle 2a x 2b under creepage xi e^{s V t/a} (s = i omega a/V in the harmonic case, 0 in
/// the steady one), on its middle line, strip kernel. It tends to pi/(2(1-nu)) for b >> a. The singularities of the
/// smooth remainder lie at a distance b from the contact, so that the order of the dense system grows like 1/b. The
/// error estimate is the relative difference from the result of two thirds of the order; above 1.5e-8 the status is
/// not_converged. Throws std::invalid_argument unless |s| <= 1000, 0 <= poisson_ratio <= 0.5 and 0.005 <= aspect < inf.
EstimatedC11<double> strip_c11(std::complex<double> s, double poisson_ratio, double aspect);

}  // namespace rollbem::reference

#include "impl/strip.tpp"
