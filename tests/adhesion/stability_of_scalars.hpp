// A pencil in any scalar type, and the comparison of two of its spectra.
// Shared by the tests of the scalar types, which are separate files because each QZ takes long to compile.
#pragma once

#include <cmath>
#include <complex>

#include <rollbem/compiled/stability.hpp>

#include "support/catch.hpp"
#include "support/scalars.hpp"

namespace rollbem {

template <class Scalar>
RollingSystem<Scalar> recommended(Eigen::Index n, double alpha_T = 0.63) {
    return rolling_system(uniform_mesh<Scalar>(n), Collocation{.alpha_L = 0, .alpha_T = alpha_T},
                          StripKernel<Scalar>(1000, Scalar(0.75), Scalar(0.25)));
}

// Every settled eigenvalue of `working` has a partner in the spectrum of `wide`, within its uncertainty and with the
// same sign of the real part. Returns how many were settled.
template <class Scalar, class Wide>
Eigen::Index compare_settled(const StabilityResult<Scalar>& working, const StabilityResult<Wide>& wide) {
    const VectorX<std::complex<Scalar>> nu = working.eigenvalues();
    const VectorX<std::complex<Wide>> reference = wide.eigenvalues();
    Eigen::Index settled = 0;
    for (Eigen::Index k = 0; k < nu.size(); ++k) {
        if (!(std::abs(nu[k].real()) > working.uncertainty[k])) continue;
        ++settled;
        const std::complex<Wide> value(nu[k].real(), nu[k].imag());
        Eigen::Index partner = 0;
        const Wide distance = (reference.array() - value).abs().minCoeff(&partner);
        CAPTURE(k, nu[k], working.uncertainty[k], static_cast<double>(distance));
        CHECK(distance <= static_cast<Wide>(working.uncertainty[k]));
        CHECK((nu[k].real() > 0) == (reference[partner].real() > 0));
    }
    CHECK(settled == nu.size() - *working.uncertain_count);
    return settled;
}

}  // namespace rollbem
