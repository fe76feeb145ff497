// apps/studies/critical_alpha.hpp
#include <cmath>
#include <complex>
#include <optional>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/line.hpp>

#include "studies/critical_alpha.hpp"
#include "support/catch.hpp"

namespace stability_critical_tests {
namespace {

using namespace rollbem;
using namespace rollbem::studies;

StripKernel<double> strip() { return {1000, 0.75, 0.25}; }
PlaneKernel<double> plane(double aspect) { return {aspect, 0.75, 0.25}; }

const auto collocation = [](double alpha_T) { return Collocation{.alpha_L = 0, .alpha_T = alpha_T}; };
const auto equal = [](double alpha) { return Collocation{.alpha_L = alpha, .alpha_T = alpha}; };
const auto galerkin = [](double alpha_T) { return Galerkin{.alpha_L = 0, .alpha_T = alpha_T}; };

template <Derivative derivative>
Galerkin seven_points(double alpha_T) {
    return {.alpha_L = 0, .alpha_T = alpha_T, .derivative = derivative, .quadrature = 7};
}

TEST_CASE("The second unstable interval at n = 40 starts at alpha_T = 0.784", "[stability]") {
    const std::optional<double> found = critical_alpha_T(uniform_mesh(40), collocation, strip(), {.first = 0.777});
    CHECK(std::abs(found.value_or(-1) - 0.784) < 6e-4);
}

TEST_CASE("Scanning by strides finds the same critical alpha_T as scanning every step", "[stability]") {
    const auto check = [](const auto& mesh, const auto& scheme_of) {
        const std::optional<double> strided = critical_alpha_T(mesh, scheme_of, strip());
        std::optional<double> every;  // ranges of one step leave nothing to stride over
        for (int k = 0; k < 2400 && !every; ++k) {
            every = critical_alpha_T(mesh, scheme_of, strip(), {.first = 0.3 + k * 5e-4, .last = 0.3 + (k + 1) * 5e-4});
        }
        CHECK(strided.has_value() == every.has_value());
        CHECK(std::abs(strided.value_or(0) - every.value_or(0)) < 1e-12);
        CAPTURE(mesh.size(), strided.value_or(-1));
        if (!strided) return;
        CHECK(judge_stability(rolling_system(mesh, scheme_of(*strided), strip())).certainly_unstable());
        CHECK_FALSE(judge_stability(rolling_system(mesh, scheme_of(*strided - 1e-5), strip())).certainly_unstable());
    };
    for (const int n : {4, 9}) {
        check(uniform_mesh(n), collocation);
        check(uniform_mesh(n), equal);
        check(uniform_mesh(n), galerkin);
        check(cosine_mesh(n), collocation);
        check(cosine_mesh(n), equal);
        check(knothe_mesh(n, 0.4), collocation);
    }
}

TEST_CASE("The search for a critical alpha_T respects its range and rejects invalid options", "[stability]") {
    const auto mesh = uniform_mesh(20);
    CHECK(critical_alpha_T(mesh, collocation, strip(), {.first = 0.95}) == 0.95);
    CHECK_FALSE(critical_alpha_T(mesh, collocation, strip(), {.last = 0.89}).has_value());
    // a range of one point, and one whose only step is less than a whole one after round-off
    CHECK(critical_alpha_T(mesh, collocation, strip(), {.first = 0.95, .last = 0.95}) == 0.95);
    CHECK_FALSE(critical_alpha_T(mesh, collocation, strip(), {.first = 0.5, .last = 0.5}).has_value());
    const CriticalAlphaOptions one_step{.first = 0.8, .last = 0.9, .step = 0.1};
    CHECK(critical_alpha_T(mesh, collocation, strip(), one_step).value_or(-1) == Approx(0.8974).margin(6e-5));
    CHECK_THROWS_AS(critical_alpha_T(mesh, collocation, strip(), {.first = 1, .last = 0.5}), std::invalid_argument);
    CHECK_THROWS_WITH(critical_alpha_T(mesh, collocation, strip(), {.step = 0}),
                      "critical_alpha_T: step = 0 must be positive and finite");
    CHECK_THROWS_AS(critical_alpha_T(mesh, collocation, strip(), {.tolerance = 0}), std::invalid_argument);
    CHECK_THROWS_AS(critical_alpha_T(mesh, collocation, plane(0.1)), std::invalid_argument);
}

TEST_CASE("The spectrum of a good scheme converges to the exact one", "[stability]") {
    // zeros of I0(s) + s Lambda (I0(s) + I1(s)), b/a = 100, nu = 0.25
    const Collocation scheme{.alpha_L = 0.5, .alpha_T = 0.5};
    const auto spectrum = [&](int n) {
        return solve_stability(rolling_system(cosine_mesh(n), scheme, plane(100))).eigenvalues();
    };
    const VectorX<std::complex<double>> of_100 = spectrum(100), of_200 = spectrum(200);
    const auto error = [](const VectorX<std::complex<double>>& eigenvalues, std::complex<double> exact) {
        return (eigenvalues.array() - exact).abs().minCoeff() / std::abs(exact);
    };
    for (const std::complex<double> exact :
         {std::complex<double>(-0.17302005735, 0), {-1.46935559502, 2.98100869072}, {-1.80867424789, 6.17549758306}}) {
        const double coarse = error(of_100, exact), fine = error(of_200, exact);
        CAPTURE(exact, coarse, fine);
        CHECK(fine < 3e-4);
        CHECK(fine > 1e-6);
        CHECK(std::abs(coarse / fine - 4) < 0.4);  // second order
    }
}

}  // namespace
}  // namespace stability_critical_tests
