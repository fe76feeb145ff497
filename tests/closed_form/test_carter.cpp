// rollbem/closed_form/carter.hpp
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/discretisation/mesh.hpp>

#include "support/catch.hpp"

namespace carter_tests {
namespace {

using namespace rollbem;

/// Integral of weight * f over [lower, upper] with weight (x - lower)^alpha (upper - x)^beta, by GSL's QAWS.
template <typename Function>
double integrate_with_ends(Function f, double lower, double upper, double alpha, double beta) {
    gsl_set_error_handler_off();
    const std::unique_ptr<gsl_integration_workspace, decltype(&gsl_integration_workspace_free)> workspace(
        gsl_integration_workspace_alloc(200), &gsl_integration_workspace_free);
    const std::unique_ptr<gsl_integration_qaws_table, decltype(&gsl_integration_qaws_table_free)> table(
        gsl_integration_qaws_table_alloc(alpha, beta, 0, 0), &gsl_integration_qaws_table_free);
    gsl_function integrand;
    integrand.function = [](double x, void* data) { return (*static_cast<Function*>(data))(x); };
    integrand.params = &f;
    double result = 0;
    double error = 0;
    gsl_integration_qaws(&integrand, lower, upper, table.get(), 0, 2e-14, 200, workspace.get(), &result, &error);
    return result;
}

template <class Scalar>
Scalar mean_between(Scalar x1, Scalar x2, Scalar nu) {
    using At = EdgeDistances<Scalar>;
    return carter_mean_traction(At::at(x1), x2 - x1, At::at(x2), nu);
}

TEST_CASE("The exact c11 is minus the integral of Carter's traction", "[carter]") {
    for (const double nu : {0.0, 0.25, 0.28, 0.5}) {
        // with x = -cos(theta) the integrand is a trigonometric polynomial, so the midpoint rule is exact
        const int count = 8;
        double force = 0;
        for (int k = 0; k < count; ++k) {
            const double theta = std::numbers::pi * (k + 0.5) / count;
            force += carter_traction(-std::cos(theta), nu) * std::sin(theta) * std::numbers::pi / count;
        }
        CAPTURE(nu, force);
        CHECK(std::abs(-force / steady_c11(nu) - 1) < 1e-13);
        CHECK(std::abs(-2 * mean_between(-1.0, 1.0, nu) / steady_c11(nu) - 1) < 1e-15);
        CHECK(std::abs(ellipse_limit_c11(nu) / steady_c11(nu) - std::numbers::pi / 2) < 1e-15);
    }
}

TEST_CASE("Carter's mean traction agrees with adaptive quadrature", "[carter]") {
    const double nu = 0.28;
    const double edges[] = {-1, -0.999, -0.9, -0.3, 0, 0.2, 0.21, 0.95, 0.9999, 1};
    for (const double x1 : edges) {
        for (const double x2 : edges) {
            if (!(x1 < x2)) {
                continue;
            }
            const double alpha = x1 == -1 ? -0.5 : 0;
            const double beta = x2 == 1 ? 0.5 : 0;
            const auto smooth = [&](double x) {
                const double numerator = beta > 0 ? 1 : std::sqrt(1 - x);
                const double denominator = alpha < 0 ? 1 : std::sqrt(1 + x);
                return -numerator / (denominator * 2 * (1 - nu));
            };
            const double mean = integrate_with_ends(smooth, x1, x2, alpha, beta) / (x2 - x1);
            CAPTURE(x1, x2, mean);
            CHECK(std::abs(mean_between(x1, x2, nu) / mean - 1) < 3e-14 + 1e-16 / (x2 - x1));
        }
    }
}

TEST_CASE("Carter's mean traction is accurate on the smallest elements of a cosine mesh", "[carter]") {
    const long double pi = std::numbers::pi_v<long double>;
    for (const int n : {10, 1000, 10000}) {
        double largest = 0;
        long double sum = 0;
        for (int j = 0; j < n; ++j) {
            const long double lower = pi * j / n;
            const long double upper = pi * (j + 1) / n;
            const auto distance = [](long double angle) { return 2 * std::pow(std::sin(angle / 2), 2.0L); };
            const auto edge = [&](int k) {
                return EdgeDistances<double>{static_cast<double>(distance(pi * k / n)),
                                             static_cast<double>(distance(pi * (n - k) / n))};
            };
            const double width = static_cast<double>(2 * std::sin((lower + upper) / 2) * std::sin((upper - lower) / 2));
            const double mean = carter_mean_traction(edge(j), width, edge(j + 1), 0.25);
            sum += static_cast<long double>(mean) * static_cast<long double>(width);
            // the integral is theta + sin(theta); near pi, where it is of third order, it is expanded about pi
            const long double phi = pi * (n - j - 1) / n;
            const long double step = pi / n;
            const long double integral = phi + step > 1.5L ? step + std::sin(upper) - std::sin(lower) : [&] {
                const auto cubic = [](long double angle) {
                    long double term = angle * angle * angle / 6;
                    long double value = term;
                    for (int k = 4; k < 30; k += 2) {
                        term *= -angle * angle / static_cast<long double>(k * (k + 1));
                        value += term;
                    }
                    return value;
                };
                return cubic(phi + step) - cubic(phi);
            }();
            const long double exact = -integral / (static_cast<long double>(width) * 1.5L);
            largest = std::max(largest, static_cast<double>(std::abs(static_cast<long double>(mean) / exact - 1)));
        }
        CAPTURE(n, largest * 1e15);
        CHECK(largest < 4e-15);
        CHECK(std::abs(static_cast<double>(-sum) / steady_c11(0.25) - 1) < 1e-14);
    }
}

TEMPLATE_TEST_CASE("Carter's solution holds in every scalar type", "[carter]", float, double, long double) {
    using Scalar = TestType;
    const Scalar eps = std::numeric_limits<Scalar>::epsilon();
    const Scalar nu = Scalar(0.25);
    CHECK(std::abs(carter_traction(Scalar(28) / 100, nu) + Scalar(0.5)) < 4 * eps);  // sqrt(0.72/1.28) = 3/4
    const Scalar halves = mean_between(Scalar(-1), Scalar(0.5), nu) * Scalar(1.5) +
                          mean_between(Scalar(0.5), Scalar(1), nu) * Scalar(0.5);
    CHECK(std::abs(halves / steady_c11(nu) + 1) < 8 * eps);
    CHECK(std::abs(plane_lambda(nu, Scalar(0.25)) - Scalar(1) / 3) < 2 * eps);
}

}  // namespace
}  // namespace carter_tests
