// rollbem/reference/fitted_polynomial.hpp
#include <cmath>
#include <complex>

#include <gsl/gsl_errno.h>

#include <rollbem/compiled/monomial.hpp>
#include <rollbem/reference/bessel.hpp>
#include <rollbem/reference/fitted_polynomial.hpp>

#include "support/catch.hpp"

namespace fitted_polynomial_tests {
namespace {

using namespace rollbem;

TEST_CASE("Quadrature of Eq. (20) agrees with the diagonal kernel of Chebyshev polynomials", "[fitted_polynomial]") {
    gsl_set_error_handler_off();
    const double nu = 0.25;
    const double aspect = 30;
    for (const double x : {-0.95, -0.2, 0.0, 0.6, 0.99}) {
        const double t2 =
            2 * reference::monomial_displacement(2, x, nu, aspect) - reference::monomial_displacement(0, x, nu, aspect);
        CAPTURE(x);
        CHECK(std::abs(reference::monomial_displacement(0, x, nu, aspect) - 1.5 * plane_lambda(nu, aspect)) < 1e-11);
        CHECK(std::abs(reference::monomial_displacement(1, x, nu, aspect) - 1.5 * x) < 1e-11);
        CHECK(std::abs(t2 - 1.5 / 2 * (2 * x * x - 1)) < 1e-11);
    }
}

TEST_CASE("The fitted B agrees with the exact one", "[fitted_polynomial]") {
    gsl_set_error_handler_off();
    for (const double nu : {0.0, 0.5}) {
        const Eigen::MatrixXd fitted = reference::fitted_displacement_matrix(8, nu, 100.0);
        const Eigen::MatrixXd exact = displacement_matrix(8, nu, 100.0);
        const double difference = (fitted - exact).cwiseAbs().maxCoeff();
        CAPTURE(nu, difference);
        CHECK(difference < 1e-9);
    }
}

TEST_CASE("The paper's order 20 with a fitted B agrees with the Bessel functions", "[fitted_polynomial]") {
    gsl_set_error_handler_off();
    const Eigen::MatrixXd fitted = reference::fitted_displacement_matrix(20, 0.25, 100.0);
    for (const double z : {0.1, 1.0, 2.0}) {
        const PolynomialSolution<double> solution = solve_monomial<double>({0, z}, 0.25, 100.0, fitted);
        const double error = std::abs(solution.c11 / reference::plane_c11({0, z}, 0.25, 100.0) - 1.0);
        CAPTURE(z, error, solution.error_estimate, solution.condition);
        CHECK(error < 1e-8);
        CHECK(solution.status == Status::ok);
    }
}

TEST_CASE("The fit rejects invalid input", "[fitted_polynomial]") {
    CHECK_THROWS_AS(reference::fitted_displacement_matrix(-1, 0.25, 100.0), std::invalid_argument);
    CHECK_THROWS_AS(reference::monomial_displacement(2, 1.0, 0.25, 100.0), std::invalid_argument);
    CHECK_THROWS_AS(reference::monomial_displacement(2, 0.0, 0.7, 100.0), std::invalid_argument);
}

}  // namespace
}  // namespace fitted_polynomial_tests
