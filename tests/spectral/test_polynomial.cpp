// rollbem/spectral/polynomial.hpp
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include <gsl/gsl_errno.h>

#include <rollbem/reference/bessel.hpp>

#include "studies/monomial.hpp"
#include "support/catch.hpp"
#include "support/exact_traction.hpp"

namespace polynomial_tests {
namespace {

using namespace rollbem;
using namespace rollbem::studies;
using Complex = std::complex<double>;

[[maybe_unused]] auto* const off = gsl_set_error_handler_off();  // underflow is no error

double relative_error(Complex value, Complex exact) { return std::abs(value / exact - 1.0); }

TEST_CASE("The Chebyshev basis agrees with the Bessel functions at real frequencies", "[polynomial]") {
    double largest = 0;
    for (const double nu : {0.0, 0.25, 0.5}) {
        for (const double aspect : {0.3, 1.0, 10.0, 100.0, 1e4, 1e8}) {
            for (const double z : {1e-300, 1e-6, 0.1, 1.0, 2.404825557695773, 3.831705970207512, 7.0, 20.0, 50.0, 100.0,
                                   200.0, -1.0, -50.0}) {
                const Complex s(0, z);
                const Complex exact = reference::plane_c11({0, z}, nu, aspect);
                const auto order = static_cast<Eigen::Index>(std::ceil(2 * std::abs(z) + 40));
                const EstimatedC11<double> given = polynomial_c11(s, nu, aspect, order);
                const EstimatedC11<double> automatic = polynomial_c11(s, nu, aspect);
                largest = std::max({largest, relative_error(given.c11, exact), relative_error(automatic.c11, exact)});
                CHECK(given.status == Status::ok);
                CHECK(automatic.status == Status::ok);
            }
        }
    }
    CAPTURE(largest * 1e15);
    CHECK(largest < 5e-15);
}

TEST_CASE("The Chebyshev basis handles a pivot that is exactly zero", "[polynomial]") {
    // the second to last pivot is 1 + s^2/(4 order (order - 1)), which rounds to zero at these orders
    for (const Eigen::Index order : {6, 13, 40}) {
        const double y = 2 * std::sqrt(static_cast<double>(order * (order - 1)));
        const Complex s(0, y);
        REQUIRE(1.0 + s * (s / static_cast<double>(2 * (order - 1))) / static_cast<double>(2 * order) == 0.0);
        const EstimatedC11<double> at = polynomial_c11(s, 0.25, 100.0, order);
        const EstimatedC11<double> near = polynomial_c11(Complex(0, y * (1 + 1e-9)), 0.25, 100.0, order);
        CAPTURE(order, at.c11, near.c11);
        CHECK(relative_error(at.c11, near.c11) < 1e-7);
        CHECK(relative_error(solve_polynomial(s, 0.25, 100.0, order).c11, near.c11) < 1e-7);
        CHECK(solve_polynomial(s, 0.25, 100.0, order).traction_coefficients.allFinite());
    }
}

TEST_CASE("The error estimate of the Chebyshev basis bounds the error at every order and complex s", "[polynomial]") {
    int count = 0;
    int violations = 0;
    double slackest = 0;
    for (const double z : {0.0, 1e-3, 1.0, 3.02, 30.0, 100.0}) {
        for (const double re : {0.0, -1.0, -1.38, -10.0, -60.0, 5.0, 40.0}) {
            for (const double aspect : {0.5, 100.0}) {  // with 0.5 near a pole
                const Complex s(re, z);
                const Complex exact = reference::plane_c11(s, 0.25, aspect);
                for (Eigen::Index order = 1; order < static_cast<Eigen::Index>(2 * z + 60); ++order) {
                    const EstimatedC11<double> solution = polynomial_c11(s, 0.25, aspect, order);
                    const double error = relative_error(solution.c11, exact);
                    ++count;
                    violations += error > solution.error_estimate ? 1 : 0;
                    if (solution.status == Status::ok) {
                        slackest = std::max(slackest, error);
                    }
                }
                const EstimatedC11<double> automatic = polynomial_c11(s, 0.25, aspect);
                CAPTURE(s, aspect, automatic.error_estimate);
                CHECK(relative_error(automatic.c11, exact) < 1e-12);
                CHECK(automatic.error_estimate < 1e-11);
            }
        }
    }
    CAPTURE(count, slackest);
    CHECK(violations == 0);
    CHECK(slackest < 1.5e-8);
}

TEST_CASE("The Chebyshev coefficients solve the bordered system", "[polynomial]") {
    const double nu = 0.3;
    const double aspect = 20;
    for (const Complex s : {Complex(0, 0), Complex(0, 2), Complex(-3, 40), Complex(5, -1)}) {
        for (const Eigen::Index order : {1, 2, 3, 30, 90}) {
            const PolynomialSolution<double> solution = solve_polynomial(s, nu, aspect, order);
            const Eigen::VectorXcd p = 2 * (1 - nu) * solution.traction_coefficients;
            const auto at = [&](Eigen::Index n) { return n <= order ? p[n] : Complex(0); };
            double residual = std::abs(at(1) - s * (plane_lambda(nu, aspect) * at(0) - at(2) / 4.0) - 1.0);
            for (Eigen::Index k = 1; k < order; ++k) {
                const double n = static_cast<double>(k);
                residual = std::max(residual, std::abs(at(k + 1) - s * (at(k) / (2 * n) - at(k + 2) / (2 * (n + 2)))));
            }
            CAPTURE(s, order, residual, p.cwiseAbs().maxCoeff());
            CHECK(residual < 1e-14 * (1 + std::abs(s) * 10 * p.cwiseAbs().maxCoeff()));
            CHECK(std::abs(p.sum()) < 1e-14 * p.cwiseAbs().sum() * (1 + std::abs(s)));
            CHECK(relative_error(solution.c11, -std::numbers::pi * solution.traction_coefficients[0]) < 1e-14);
        }
    }
}

TEST_CASE("Tractions and displacements of both bases agree with the exact ones", "[polynomial]") {
    const double nu = 0.25;
    const double aspect = 100;
    for (const double z : {0.0, 0.5, 3.0}) {
        const Complex s(0, z);
        const reference::ExactTraction exact(s, nu, aspect);
        const PolynomialSolution<double> chebyshev = solve_polynomial(s, nu, aspect);
        const PolynomialSolution<double> monomial = solve_monomial<double>(s, nu, aspect, 30);
        for (const double x : {-1 + 1e-9, -0.999, -0.5, 0.0, 0.3, 0.9, 1 - 1e-8}) {
            CAPTURE(z, x);
            CHECK(relative_error(chebyshev.traction(x), exact(x)) < 1e-13);
            CHECK(relative_error(monomial.traction(x), exact(x)) < 1e-13);
            CHECK(relative_error(monomial.displacement(x), chebyshev.displacement(x)) < 1e-13);
            if (z == 0) {
                CHECK(std::abs(chebyshev.traction(x) / carter_traction(x, nu) - 1.0) < 1e-14);
            }
        }
        CHECK(chebyshev.traction(1.0) == Complex(0));
        CHECK(monomial.traction(1.0) == Complex(0));
        for (const double beyond : {-1.001, 1.5}) {
            CHECK_THROWS_AS(chebyshev.displacement(beyond), std::invalid_argument);
            CHECK_THROWS_AS(chebyshev.traction(beyond), std::invalid_argument);
        }
    }
    const reference::ExactTraction fast(Complex(0, 150), nu, aspect);
    const PolynomialSolution<double> chebyshev = solve_polynomial(Complex(0, 150), nu, aspect);
    for (const double x : {-0.999, -0.5, 0.0, 0.9, 1 - 1e-8}) {
        CHECK(relative_error(chebyshev.traction(x), fast(x)) < 1e-12);
    }
}

TEST_CASE("Monomials break down before their matrix looks singular, and report it", "[polynomial]") {
    const Complex s(0, 50);
    const Complex exact = reference::plane_c11({0, 50}, 0.25, 100.0);
    const PolynomialSolution<double> monomial = solve_monomial<double>(s, 0.25, 100.0, 60);
    const double error = relative_error(monomial.c11, exact);
    CAPTURE(error, monomial.condition, monomial.error_estimate);
    CHECK(error > 1e-4);
    CHECK(monomial.condition < 1e7);
    CHECK(monomial.status == Status::not_converged);
    CHECK_THAT(std::string(polynomial_advice(monomial.status)), Catch::Matchers::ContainsSubstring("Chebyshev basis"));
    CHECK(relative_error(polynomial_c11(s, 0.25, 100.0, 60).c11, exact) < error / 10);
    CHECK(relative_error(polynomial_c11(s, 0.25, 100.0, 140).c11, exact) < 1e-14);

    const PolynomialSolution<double> singular = solve_monomial<double>(s, 0.25, 100.0, 140);
    CAPTURE(singular.condition);
    CHECK(singular.status == Status::ill_conditioned);
    CHECK_THAT(std::string(polynomial_advice(singular.status)), Catch::Matchers::ContainsSubstring("Chebyshev basis"));
}

TEST_CASE("The error estimate of monomials bounds the error at every order and frequency", "[polynomial]") {
    for (const double z : {0.01, 0.3, 1.0, 4.0, 7.0, 10.0, 12.0, 20.0, 30.0, 50.0}) {
        const Complex exact = reference::plane_c11({0, z}, 0.28, 1000.0);
        for (const Eigen::Index order : {1, 2, 3, 4, 5, 8, 12, 15, 20, 30, 40, 50, 60, 80, 100}) {
            const PolynomialSolution<double> monomial = solve_monomial<double>(Complex(0, z), 0.28, 1000.0, order);
            const double error = relative_error(monomial.c11, exact);
            CAPTURE(z, order, error, monomial.error_estimate);
            CHECK(error <= monomial.error_estimate);
            CHECK(monomial.error_estimate < error + 1e-13);
            if (monomial.status == Status::ok) CHECK(error < 6.1e-8);
        }
    }
    CHECK_THROWS_AS(solve_monomial<double>(Complex(0, 2e8), 0.28, 1000.0, 5), std::invalid_argument);
}

TEST_CASE("The Chebyshev basis gives the digits of long double in long double", "[polynomial]") {
    const std::complex<long double> s(0, 1);
    const auto chebyshev = solve_polynomial(s, 0.25L, 100.0L);
    const auto longer = polynomial_c11(s, 0.25L, 100.0L, 100);
    CHECK(chebyshev.status == Status::ok);
    CHECK(std::abs(chebyshev.c11 / longer.c11 - 1.0L) < 8 * std::numeric_limits<long double>::epsilon());
    CHECK(std::abs(Complex(longer.c11) / reference::plane_c11({0, 1}, 0.25, 100) - 1.0) < 5e-16);
}

}  // namespace
}  // namespace polynomial_tests
