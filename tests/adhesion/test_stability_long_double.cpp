// rollbem/adhesion/stability.hpp against itself in long double
#include <cmath>
#include <complex>

#include <rollbem/compiled/stability.hpp>

#include "support/catch.hpp"
#include "support/scalars.hpp"

namespace {

using namespace rollbem;

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
    CHECK(settled == nu.size() - working.uncertain_count);
    return settled;
}

TEST_CASE("Signs settled in double agree with long double", "[stability]") {
    for (const int n : {20, 40, 80, 160}) {
        const StabilityResult<double> working = judge_stability<double>(recommended<double>(n));
        const StabilityResult<long double> wide = judge_stability<long double>(recommended<long double>(n));
        CAPTURE(n, working.uncertain_count, wide.uncertain_count);
        const Eigen::Index settled = compare_settled(working, wide);
        CHECK(settled >= n / 2);
        CHECK(wide.uncertain_count <= working.uncertain_count);
        CHECK(working.unstable_count == wide.unstable_count);
        CHECK(working.settled_unstable_count == (n == 160 ? 2 : 0));
        if (n <= 40) CHECK(settled == n);
    }
}

}  // namespace
