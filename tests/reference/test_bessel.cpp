// rollbem/reference/bessel.hpp
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include <gsl/gsl_errno.h>

#include <rollbem/detail/gauss_legendre.hpp>
#include <rollbem/reference/bessel.hpp>

#include "support/catch.hpp"

namespace bessel_tests {
namespace {

using namespace rollbem;
using reference::detail::asymptotic_radius;
using reference::detail::scaled_bessel;
using LongComplex = std::complex<long double>;
using Complex = std::complex<double>;

[[maybe_unused]] auto* const off = gsl_set_error_handler_off();  // underflow is no error

double relative_error(Complex value, Complex exact) { return std::abs(value / exact - 1.0); }

TEST_CASE("Complex I_n agree with their power series", "[bessel]") {
    for (const LongComplex s : {LongComplex(0, 0), LongComplex(1, 0), LongComplex(-0.5L, 3), LongComplex(4, -7),
                                LongComplex(0, 9), LongComplex(-8, 0)}) {
        LongComplex i0 = 0;
        LongComplex i1 = 0;
        LongComplex term = 1;  // (s/2)^(2k)/k!^2
        for (int k = 0; k < 60; ++k) {
            i0 += term;
            i1 += term * s / 2.0L / static_cast<long double>(k + 1);
            term *= s * s / 4.0L / static_cast<long double>((k + 1) * (k + 1));
        }
        const long double scale = std::exp(-std::abs(s.real()));
        const auto bessel = scaled_bessel(s);
        CAPTURE(s);
        CHECK(std::abs(bessel.i0 - i0 * scale) < 1e-16L);
        CHECK(std::abs(bessel.i1 - i1 * scale) < 1e-16L);
        CHECK(std::abs(bessel.sum - (i0 + i1) * scale) < 1e-16L);
    }
}

TEST_CASE("Hankel's expansions agree with the trapezoidal rule beyond their radius", "[bessel]") {
    for (int k = 0; k <= 6; ++k) {
        for (const long double radius : {asymptotic_radius, 60.0L, 200.0L}) {
            const LongComplex s = k == 6 ? LongComplex(-radius, 0)  // polar would round to a point below the axis
                                         : std::polar(radius, std::numbers::pi_v<long double> * k / 6);
            const auto trapezoidal = reference::detail::trapezoidal_bessel(s);
            const auto hankel = reference::detail::hankel_bessel(s);
            const auto close = [&](LongComplex a, LongComplex b) { return std::abs(a - b) < 5e-20L * radius; };
            CAPTURE(k, static_cast<double>(radius));
            CHECK(close(trapezoidal.i0, hankel.i0));
            CHECK(close(trapezoidal.i1, hankel.i1));
            CHECK(close(trapezoidal.sum, hankel.sum));
        }
    }
}

TEST_CASE("The c11 by J0 and J1 equals that at imaginary s", "[bessel]") {
    double largest = 0;
    for (const double nu : {0.0, 0.25, 0.5}) {
        for (const double aspect : {0.3, 10.0, 1e6}) {
            for (const double z : {0.0, 1e-300, 1e-3, 0.1, 1.0, 5.0, 20.0, 39.9, 40.1, 200.0, 1e4, -3.0}) {
                const double lambda = plane_lambda(nu, aspect);
                const Complex by_integrals(reference::detail::laplace_c11({0, z}, nu, lambda));
                largest =
                    std::max(largest, relative_error(reference::detail::harmonic_c11(z, nu, lambda), by_integrals));
                largest = std::max(largest, relative_error(reference::plane_c11({0, z}, nu, aspect), by_integrals));
            }
        }
    }
    CAPTURE(largest * 1e15);
    CHECK(largest < 3e-15);
}

TEST_CASE("The exact c11 has its limits and symmetries", "[bessel]") {
    const double nu = 0.25;
    const double aspect = 1000;
    CHECK(reference::plane_c11(0, nu, aspect) == Complex(steady_c11(nu)));
    CHECK(reference::plane_c11(0, nu, 0.1) == Complex(steady_c11(nu)));  // Lambda < 0 matters to moving creepage only
    const double z = 1e5;
    CHECK(std::abs(reference::plane_c11({0, z}, nu, aspect)) * z * plane_lambda(nu, aspect) / steady_c11(nu) ==
          Approx(1).epsilon(2e-5));
    CHECK(reference::plane_c11({0, -2}, nu, aspect) == std::conj(reference::plane_c11({0, 2}, nu, aspect)));
    CHECK(relative_error(reference::plane_c11({-1, -2}, nu, aspect),
                         std::conj(reference::plane_c11({-1, 2}, nu, aspect))) < 1e-15);
    CHECK(reference::plane_c11({-1, -50}, nu, aspect) == std::conj(reference::plane_c11({-1, 50}, nu, aspect)));
    // first order in s: c11 = C (1 + s (1/2 - Lambda))
    const Complex slope = (reference::plane_c11(1e-5, nu, aspect) - reference::plane_c11(-1e-5, nu, aspect)) / 2e-5;
    CHECK(relative_error(slope, steady_c11(nu) * (0.5 - plane_lambda(nu, aspect))) < 1e-7);
}

/// Number of zeros of D(s) = I0 + s Lambda (I0 + I1) with |s| < radius by the argument principle: the change of phase
/// summed over small steps; the positive scaling of the Bessel functions does not affect it.
int count_zeros(double radius, double lambda) {
    const int steps = static_cast<int>(12 * radius) + 200;
    long double phase = 0;
    LongComplex last = 0;
    for (int k = 0; k <= steps; ++k) {
        const LongComplex s = std::polar<long double>(radius, 2 * std::numbers::pi_v<long double> * k / steps);
        const auto bessel = scaled_bessel(s);
        const LongComplex value = bessel.i0 + s * static_cast<long double>(lambda) * bessel.sum;
        if (k > 0) {
            phase += std::arg(value / last);
        }
        last = value;
    }
    return static_cast<int>(std::lround(phase / (2 * std::numbers::pi_v<long double>)));
}

TEST_CASE("No exact eigenvalue is missed or found twice", "[bessel]") {
    // a second real eigenvalue appears near Lambda = 1.6 and tends to minus infinity as Lambda -> 2
    for (const double lambda : {0.05, 1.5, 1.65, 1.8, 1.9, 1.98, 1.995, 2.0, 2.01, 2.5, 6.3, 700.0}) {
        const double aspect = std::exp(lambda) / 4;  // nu = 0
        const std::vector<Complex> values = reference::eigenvalues(60, 0, aspect);
        for (std::size_t n = 1; n < values.size(); ++n) {
            CHECK(std::abs(values[n] - values[n - 1]) > 0.05);
        }
        for (const Complex s : values) {
            CAPTURE(lambda, s);
            CHECK(s.real() < 0);
            CHECK(std::abs(reference::detail::newton_step(LongComplex(s.real(), s.imag()), lambda)) <
                  1e-15L * std::abs(s) * (std::abs(s.imag()) > 0 ? 4 : 1000));
        }
        for (const double radius : {2.0, 10.0, 38.3, 41.1, 44.0, 100.0, 170.0}) {
            int expected = 0;
            for (const Complex s : values) {
                expected += std::abs(s) < radius ? (s.imag() > 0 ? 2 : 1) : 0;
            }
            CAPTURE(lambda, radius);
            CHECK(count_zeros(radius, lambda) == expected);
        }
    }
}

TEST_CASE("The exact solutions reject invalid input", "[bessel]") {
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    CHECK_THROWS_AS(reference::plane_c11({0, nan}, 0.25, 100), std::invalid_argument);
    CHECK_THROWS_AS(reference::plane_c11({0, 1}, 0.7, 100), std::invalid_argument);
    CHECK_THROWS_AS(reference::plane_c11({0, 1}, 0.25, infinity), std::invalid_argument);
    CHECK_THROWS_WITH(reference::plane_c11(1, 0.25, 0.1), Catch::Matchers::ContainsSubstring("Lambda"));
    CHECK_THROWS_AS(reference::plane_c11({0, infinity}, 0.25, 100), std::invalid_argument);
    CHECK_THROWS_AS(reference::eigenvalues(0, 0.25, 100), std::invalid_argument);
}

using reference::StepResponse;
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
    const auto rule = detail::gauss_legendre<double>(200);
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
}  // namespace bessel_tests
