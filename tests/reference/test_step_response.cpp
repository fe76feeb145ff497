// rollbem/reference/bessel.hpp
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <gsl/gsl_errno.h>

#include <rollbem/detail/gauss_legendre.hpp>
#include <rollbem/reference/bessel.hpp>

#include "support/catch.hpp"

namespace step_response_tests {
namespace {

using namespace rollbem;
using reference::StepResponse;
using LongComplex = std::complex<long double>;

[[maybe_unused]] auto* const off = gsl_set_error_handler_off();  // underflow is no error
constexpr double poisson_ratio = 0.25;

TEST_CASE("De Hoog's method inverts known transforms", "[step_response]") {
    for (const double q : {0.01, 1.0, 7.0}) {
        CAPTURE(q);
        CHECK(reference::invert_laplace([](LongComplex s) { return 1.0L / (s + 1.0L); }, q) ==
              Approx(std::exp(-q)).epsilon(1e-11));
        CHECK(reference::invert_laplace([](LongComplex s) { return 1.0L / (s * s); }, q) == Approx(q).epsilon(1e-11));
        CHECK(reference::invert_laplace([](LongComplex s) { return 1.0L / std::sqrt(s); }, q) ==
              Approx(1 / std::sqrt(std::numbers::pi * q)).epsilon(1e-10));
    }
}

TEST_CASE("The step response is zero before the step, and tends to steady rolling", "[step_response]") {
    const StepResponse response(poisson_ratio, 100);
    CHECK(response.step(0) == 0);
    CHECK(response.step(-1) == 0);
    CHECK(response.step(1000) == Approx(steady_c11(poisson_ratio)).epsilon(1e-14));
}

TEST_CASE("The series and de Hoog's method agree on step, ramp and sine", "[step_response]") {
    for (const double aspect : {1.0, 10.0, 100.0, 1e6}) {
        const StepResponse response(poisson_ratio, aspect);
        const long double lambda = plane_lambda(poisson_ratio, aspect);
        const auto c11 = [lambda](LongComplex s) { return reference::detail::laplace_c11(s, poisson_ratio, lambda); };
        for (const double q : {1e-3, 0.1, 0.7, 1.4999, 1.5001, 1.7, 1.9, 2.5, 3.0, 5.0, 9.0}) {
            CAPTURE(aspect, q);
            CHECK(response.step(q) ==
                  Approx(reference::step_response_de_hoog(q, poisson_ratio, aspect)).epsilon(2e-10));
            const double ramp = reference::invert_laplace([&](LongComplex s) { return c11(s) / (s * s); }, q);
            CHECK(response.ramp(q) == Approx(ramp).epsilon(2e-10));
            for (const double omega : {0.5, 2.0}) {
                const long double w = omega;
                const double sine =
                    reference::invert_laplace([&](LongComplex s) { return c11(s) * w / (s * s + w * w); }, q);
                CHECK(std::abs(response.sine(omega, q) - sine) < 2e-10);
            }
        }
    }
}

TEST_CASE("The modal series meets the Taylor series, and has enough modes where it converges slowly",
          "[step_response]") {
    for (const double aspect : {0.3, 1.32, 10.0, 100.0}) {
        const StepResponse response(poisson_ratio, aspect), doubled(poisson_ratio, aspect, 8000);
        CHECK(std::abs(response.step(std::nextafter(1.5, 2)) - response.step(1.5)) < 1e-10);
        for (const double q : {1.9, 1.99, 2.0, 2.01, 4.0}) {
            CAPTURE(aspect, q);
            CHECK(std::abs(response.step(q) - doubled.step(q)) < (aspect >= 10 ? 1e-10 : 1e-8));
        }
    }
}

TEST_CASE("A fast sine from rest agrees with Duhamel's integral", "[step_response]") {
    // the Taylor series would lose digits to cancellation like e^{omega q}
    const StepResponse response(poisson_ratio, 100);
    const auto rule = rollbem::detail::gauss_legendre<double>(200);
    for (const double omega : {15.0, 30.0, 60.0, 100.0}) {
        for (const double q : {0.3, 0.7, 1.0, 1.45}) {
            double sum = 0;
            for (Eigen::Index k = 0; k < rule.nodes.size(); ++k) {
                const double t = q / 2 * (1 + rule.nodes[k]);
                sum += rule.weights[k] * q / 2 * response.step(q - t) * omega * std::cos(omega * t);
            }
            CAPTURE(omega, q, sum);
            CHECK(std::abs(response.sine(omega, q) - sum) < 1e-11);
        }
    }
}

TEST_CASE("Piecewise linear histories are superpositions of steps and ramps", "[step_response]") {
    const StepResponse response(poisson_ratio, 100);
    // a jump to 2, a ramp down to -1 between q = 1 and 3, a jump to 0.5 at 4
    const std::vector<double> points{0.5, 1, 3, 4, 4};
    const std::vector<double> creepage{2, 2, -1, -1, 0.5};
    for (const double q : {0.2, 0.8, 2.0, 3.5, 4.0, 6.0, 30.0}) {
        const double expected = 2 * response.step(q - 0.5) - 1.5 * (response.ramp(q - 1) - response.ramp(q - 3)) +
                                1.5 * response.step(q - 4);
        CAPTURE(q);
        CHECK(std::abs(response.history(points, creepage, q) - expected) < 1e-14);
    }
}

TEST_CASE("Responses to histories reject invalid input", "[step_response]") {
    CHECK_THROWS_WITH(StepResponse(poisson_ratio, 0.1), Catch::Matchers::ContainsSubstring("Lambda"));
    CHECK_THROWS_AS(StepResponse(poisson_ratio, 100, 0), std::invalid_argument);
    CHECK_THROWS_AS(reference::step_response_de_hoog(0, poisson_ratio, 100), std::invalid_argument);
    const StepResponse response(poisson_ratio, 100, 10);
    CHECK_THROWS_AS(response.sine(-1, 1), std::invalid_argument);
    const std::vector<double> one{0}, two{0, 1}, descending{1, 0};
    CHECK_THROWS_AS(response.history(one, two, 1), std::invalid_argument);
    CHECK_THROWS_AS(response.history({}, {}, 1), std::invalid_argument);
    CHECK_THROWS_AS(response.history(descending, two, 2), std::invalid_argument);
}

}  // namespace
}  // namespace step_response_tests
