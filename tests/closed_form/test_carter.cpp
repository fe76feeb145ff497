// rollbem/closed_form/carter.hpp
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/discretisation/mesh.hpp>

#include "support/catch.hpp"

namespace carter_tests {
namespace {

using namespace rollbem;

/// What `call` integrates by GSL, given the integrand, memory and where to put the result and its error.
template <class Function, class Call>
double by_gsl(Function f, const Call& call) {
    gsl_set_error_handler_off();
    const std::unique_ptr<gsl_integration_workspace, decltype(&gsl_integration_workspace_free)> memory(
        gsl_integration_workspace_alloc(1000), &gsl_integration_workspace_free);
    gsl_function integrand{[](double x, void* data) { return (*static_cast<Function*>(data))(x); }, &f};
    double result = 0, error = 0;
    call(&integrand, memory.get(), &result, &error);
    return result;
}

/// Integral between ascending break points that include every singularity of f (GSL's QAGP).
template <class Function>
double integrate(const Function& f, std::vector<double> points) {
    return by_gsl(f, [&](auto* integrand, auto* memory, double* result, double* error) {
        gsl_integration_qagp(integrand, points.data(), points.size(), 1e-13, 1e-13, 1000, memory, result, error);
    });
}

/// Principal value of the integral of f(alpha)/(alpha - pole) over [lower, upper] (GSL's QAWC).
template <class Function>
double principal_value(const Function& f, double lower, double upper, double pole) {
    return by_gsl(f, [&](auto* integrand, auto* memory, double* result, double* error) {
        gsl_integration_qawc(integrand, lower, upper, pole, 1e-12, 1e-12, 1000, memory, result, error);
    });
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

TEST_CASE("Carter's mean traction is the difference of its integral", "[carter]") {
    // with x = -cos(theta) the integral of sqrt((1-x)/(1+x)) is theta + sin(theta)
    const auto integral = [](long double x) { return std::acos(-x) + std::sqrt((1 - x) * (1 + x)); };
    const double nu = 0.28;
    const double edges[] = {-1, -0.999, -0.9, -0.3, 0, 0.2, 0.21, 0.95, 0.9999, 1};
    for (const double x1 : edges) {
        for (const double x2 : edges) {
            if (!(x1 < x2)) continue;
            const auto mean = static_cast<double>((integral(x1) - integral(x2)) / ((x2 - x1) * 2 * (1 - nu)));
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

TEST_CASE("Carter's friction solution sticks, slips and carries its force", "[friction]") {
    for (const double delta : {-0.7, 0.1, 0.5, 0.9}) {
        const double border = carter_stick_border(delta);
        const auto traction = [delta](double x) { return carter_friction_traction(x, delta); };
        CAPTURE(delta, border);
        // N = pi p0/2
        CHECK(std::abs(-integrate(traction, {-1, border, 1}) * 2 / std::numbers::pi / carter_force_ratio(delta) - 1) <
              1e-12);
        // in stick du/dx = xi with G = 1, mu p0 = 1, xi = 2 (1-nu) delta and the plane kernel's
        // du/dx = 2 (1-nu)/pi PV int p(alpha)/(alpha - x) dalpha; behind it the slip opposes the traction
        const auto slope_at = [&](double x, double from, double to) {  // the pole x lies between from and to
            const double outside = integrate([&](double alpha) { return traction(alpha) / (alpha - x); },
                                             from == -1 ? std::vector<double>{to, 1} : std::vector<double>{-1, from});
            return (principal_value(traction, from, to, x) + outside) / std::numbers::pi;
        };
        for (const double part : {0.3, 0.6, 0.95}) {
            const double x = border + part * (1 - border);
            CAPTURE(x);
            CHECK(std::abs(slope_at(x, border, 1) / delta - 1) < 1e-8);
            CHECK(std::abs(traction(x)) < std::sqrt(1 - x * x));
            const double y = -1 + part * (border + 1);
            CHECK(std::abs(traction(y)) == Approx(std::sqrt(1 - y * y)).epsilon(1e-15));
            CHECK((delta - slope_at(y, -1, border)) * traction(y) < 0);
        }
    }
}

TEST_CASE("Carter's friction solution has the limits of full sliding and full adhesion", "[friction]") {
    CHECK(carter_force_ratio(1.0) == 1);
    CHECK(carter_force_ratio(3.0) == 1);
    CHECK(carter_force_ratio(-3.0) == -1);
    CHECK(carter_stick_border(2.0) == 1);
    CHECK(carter_friction_traction(0.6, 2.0) == Approx(-0.8).epsilon(1e-15));
    CHECK(carter_friction_traction(0.3, -0.4) == -carter_friction_traction(0.3, 0.4));
    // small creepage: full adhesion, p/(mu p0) = delta 2 (1-nu) p/(G xi)
    const double delta = 1e-12;
    CHECK(carter_friction_traction(0.4, delta) / (delta * 1.5 * carter_traction(0.4, 0.25)) ==
          Approx(1).epsilon(1e-11));
}

TEST_CASE("Cattaneo's shift agrees with adaptive quadrature of the plane kernel", "[friction]") {
    for (const double nu : {0.0, 0.25, 0.5}) {
        for (const double aspect : {1.0, 50.0}) {
            for (const double force_ratio : {-0.3, 0.01, 0.6, 0.99, 1.0}) {
                const double c = cattaneo_stick_half_length(force_ratio);
                const auto traction = [force_ratio](double x) { return cattaneo_traction(x, force_ratio); };
                const double shift = cattaneo_shift(force_ratio, nu, aspect);
                CAPTURE(nu, aspect, force_ratio, c, shift);
                std::vector<double> borders{-1, -c, c, 1};
                if (c == 0) {
                    borders = {-1, 0, 1};
                }
                CHECK(std::abs(-integrate(traction, borders) * 2 / std::numbers::pi / force_ratio - 1) < 1e-11);
                for (const double part : {0.0, 0.5, 0.9}) {
                    const double x = part * c;
                    std::vector<double> points = borders;
                    if (c > 0) {
                        points.insert(points.begin() + 2, x);
                    }
                    const double displacement =
                        integrate(
                            [&](double alpha) {
                                const double d = x - alpha;
                                return traction(alpha) * ((1 - nu) * std::log(4 * aspect * aspect / (d * d)) + 2 * nu);
                            },
                            points) /
                        std::numbers::pi;
                    CHECK(std::abs(displacement + shift) < 1e-10 * (1 + std::abs(shift)));
                }
                CHECK(std::abs(cattaneo_force_ratio(shift, nu, aspect) / force_ratio - 1) < 1e-14);
            }
        }
    }
}

TEST_CASE("The inverse of Cattaneo's shift is accurate over 300 orders of magnitude", "[friction]") {
    for (const double aspect : {0.2, 1.0, 1e6}) {
        for (int k = -300; k <= 0; k += 20) {
            const double force_ratio = std::pow(10.0, k) * 0.999999;
            const double shift = cattaneo_shift(force_ratio, 0.25, aspect);
            CAPTURE(aspect, force_ratio);
            CHECK(std::abs(cattaneo_force_ratio(shift, 0.25, aspect) / force_ratio - 1) < 1e-14);
        }
    }
    CHECK(cattaneo_force_ratio(1e3, 0.25, 10.0) == 1);
    CHECK(cattaneo_force_ratio(0.0, 0.25, 10.0) == 0);
}

TEMPLATE_TEST_CASE("Closed forms hold in every scalar type", "[carter][friction]", float, double, long double) {
    using Scalar = TestType;
    const Scalar eps = std::numeric_limits<Scalar>::epsilon(), nu = Scalar(0.25);
    CHECK(std::abs(carter_traction(Scalar(28) / 100, nu) + Scalar(0.5)) < 4 * eps);  // sqrt(0.72/1.28) = 3/4
    const Scalar halves = mean_between(Scalar(-1), Scalar(0.5), nu) * Scalar(1.5) +
                          mean_between(Scalar(0.5), Scalar(1), nu) * Scalar(0.5);
    CHECK(std::abs(halves / steady_c11(nu) + 1) < 8 * eps);
    CHECK(std::abs(plane_lambda(nu, Scalar(0.25)) - Scalar(1) / 3) < 2 * eps);
    CHECK(std::abs(carter_force_ratio(Scalar(0.5)) - Scalar(0.75)) <= eps);
    CHECK(std::abs(cattaneo_stick_half_length(Scalar(0.75)) - Scalar(0.5)) <= eps);
    CHECK(std::abs(cattaneo_traction(Scalar(0), Scalar(0.75)) + Scalar(0.5)) <= eps);
    CHECK(std::abs(carter_friction_traction(Scalar(28) / 100, Scalar(0.5)) + Scalar(96) / 100 -
                   std::sqrt(Scalar(72 * 28)) / 100) <= 2 * eps);
    const Scalar shift = cattaneo_shift(Scalar(0.75), Scalar(0.25), Scalar(10));
    CHECK(std::abs(cattaneo_force_ratio(shift, Scalar(0.25), Scalar(10)) - Scalar(0.75)) <= 2 * eps);
}

TEST_CASE("Closed forms of friction reject invalid input and name the quantity", "[friction]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(carter_force_ratio(nan), std::invalid_argument);
    CHECK_THROWS_AS(carter_friction_traction(2.0, 0.5), std::invalid_argument);
    CHECK_THROWS_AS(cattaneo_shift(1.1, 0.25, 10.0), std::invalid_argument);
    CHECK_THROWS_AS(cattaneo_force_ratio(nan, 0.25, 10.0), std::invalid_argument);
    CHECK_THROWS_WITH(cattaneo_force_ratio(0.1, 0.25, 0.1), Catch::Matchers::ContainsSubstring("strip kernel"));
}

}  // namespace
}  // namespace carter_tests
