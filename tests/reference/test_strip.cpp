// rollbem/reference/strip.hpp
#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/reference/bessel.hpp>

#include "support/catch.hpp"
#include "support/strip_instances.hpp"

namespace strip_tests {
namespace {

using rollbem::reference::strip_c11;
using Complex = std::complex<double>;

TEST_CASE("A wide strip agrees with the plane, steady and at any frequency", "[strip]") {
    for (const double nu : {0.0, 0.28, 0.5}) {
        CHECK(std::abs(strip_c11(0, nu, 1e12).c11 / rollbem::steady_c11(nu) - 1.0) < 1e-14);
        for (const Complex s : {Complex(0, 1e-6), Complex(0, 1), Complex(0, -3), Complex(0, 100), Complex(0.5, 2)}) {
            const rollbem::EstimatedC11<double> strip = strip_c11(s, nu, 1e8);
            CAPTURE(nu, s, strip.error_estimate);
            CHECK(std::abs(strip.c11 / rollbem::reference::plane_c11(s, nu, 1e8) - 1.0) < 1e-12);
        }
    }
}

TEST_CASE("The effect of width is proportional to (a/b)^2, and narrow strips converge", "[strip]") {
    const auto excess = [](double b) { return strip_c11(0, 0.28, b).c11.real() / rollbem::steady_c11(0.28) - 1; };
    CHECK(std::abs(excess(100) / excess(200) - 4) < 0.01);
    CHECK(std::abs(excess(400) / excess(800) - 4) < 0.001);
    double wider = std::numeric_limits<double>::infinity();
    for (const double b : {0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0}) {
        for (const Complex s : {Complex(0), Complex(0, 5)}) {
            CAPTURE(b, s);
            CHECK(strip_c11(s, 0.28, b).error_estimate < 1e-11);
            CHECK(strip_c11(s, 0.28, b).status == rollbem::Status::ok);
        }
        const double c11 = strip_c11(0, 0.28, b).c11.real();
        CHECK(c11 < wider);  // the wider, the less stiff
        wider = c11;
    }
}

TEST_CASE("The response of a narrow strip is conjugate-symmetric and tends to the steady one", "[strip]") {
    CHECK(strip_c11(Complex(0, 2), 0.25, 0.3).c11 == std::conj(strip_c11(Complex(0, -2), 0.25, 0.3).c11));
    // no jump between low frequency and the steady equations, which are set up separately
    CHECK(std::abs(strip_c11(Complex(0, 1e-12), 0.25, 0.3).c11 / strip_c11(0, 0.25, 0.3).c11 - 1.0) < 1e-10);
}

TEST_CASE("The error estimate shows where the order is too low", "[strip]") {
    for (const double b : {1.0, 10.0, 1e8}) {
        const rollbem::EstimatedC11<double> strip = strip_c11(Complex(0, 200), 0.28, b);
        CAPTURE(b, strip.error_estimate);
        CHECK(strip.error_estimate > 1e-12);
        CHECK(strip.error_estimate < 1e-9);
    }
}

TEST_CASE("Strips reject arguments out of their domain", "[strip]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(strip_c11(0, 0.6, 1), "reference::strip_c11: poisson_ratio = 0.6 must lie in [0, 0.5]");
    CHECK_THROWS_WITH(strip_c11(0, 0.25, 0.001),
                      "reference::strip_c11: aspect = 0.001 must be at least 0.005 and finite");
    CHECK_THROWS_WITH(strip_c11(2000, 0.25, 1), "reference::strip_c11: |s| = 2000 must be at most 1000");
    CHECK_THROWS_AS(strip_c11(Complex(0, nan), 0.25, 1), std::invalid_argument);
    CHECK_THROWS_AS(strip_c11(0, nan, 1), std::invalid_argument);
    CHECK_THROWS_AS(strip_c11(0, 0.25, nan), std::invalid_argument);
    CHECK_THROWS_AS(strip_c11(0, 0.25, std::numeric_limits<double>::infinity()), std::invalid_argument);
}

}  // namespace
}  // namespace strip_tests
