// rollbem/problem/stability.hpp
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "../support/catch.hpp"
#include "rollbem/problem/stability.hpp"
#include "rollbem/problem/stability_count.hpp"

namespace {

using namespace rollbem;

template <class Scalar>
InfluenceMatrices<Scalar> recommended(Eigen::Index n, double alpha_T = 0.63) {
    return assemble(uniform_mesh<Scalar>(n), Collocation{.alpha_L = 0, .alpha_T = alpha_T},
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

TEST_CASE("Signs settled in double are those of long double", "[stability]") {
    for (const int n : {20, 40, 80, 160}) {
        const StabilityResult<double> working = solve_stability(recommended<double>(n), {.settle_signs = true});
        const StabilityResult<long double> wide = solve_stability(recommended<long double>(n), {.settle_signs = true});
        CAPTURE(n, *working.uncertain_count, *wide.uncertain_count);
        const Eigen::Index settled = compare_settled(working, wide);
        CHECK(settled >= n / 2);
        CHECK(*wide.uncertain_count <= *working.uncertain_count);
        CHECK(working.unstable_count == wide.unstable_count);
        CHECK(*working.settled_unstable_count == (n == 160 ? 2 : 0));
        if (n <= 40) CHECK(settled == n);
    }
}

TEST_CASE("Signs settled in float are those of double", "[stability]") {
    for (const int n : {5, 10, 20, 40}) {
        for (const double alpha_T : {0.5, 0.63, 0.95}) {
            const StabilityResult<float> working =
                solve_stability(recommended<float>(n, alpha_T), {.settle_signs = true});
            const StabilityResult<double> wide = solve_stability(recommended<double>(n, alpha_T));
            CAPTURE(n, alpha_T);
            CHECK(compare_settled(working, wide) >= n / 4);
        }
    }
}

TEMPLATE_TEST_CASE("Both routes count alike in every scalar type", "[stability]", float, long double) {
    for (const double alpha_T : {0.5, 0.63, 1.0}) {
        const InfluenceMatrices<TestType> matrices = recommended<TestType>(20, alpha_T);
        CHECK(count_unstable(matrices).status == Status::ok);
        CHECK(count_unstable(matrices).unstable_count == solve_stability(matrices).unstable_count);
    }
}

}  // namespace
