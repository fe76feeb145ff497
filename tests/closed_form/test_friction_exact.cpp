// rollbem/closed_form/carter.hpp
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include <rollbem/closed_form/carter.hpp>

#include "support/catch.hpp"

namespace friction_exact_tests {
namespace {

using namespace rollbem;

using Workspace = std::unique_ptr<gsl_integration_workspace, decltype(&gsl_integration_workspace_free)>;

Workspace make_workspace() {
    gsl_set_error_handler_off();
    return Workspace(gsl_integration_workspace_alloc(1000), &gsl_integration_workspace_free);
}

template <typename Function>
gsl_function wrap(Function& f) {
    gsl_function result;
    result.function = [](double x, void* data) { return (*static_cast<Function*>(data))(x); };
    result.params = &f;
    return result;
}

/// Integral between ascending break points that include every singularity of f (GSL's QAGP).
template <typename Function>
double integrate(Function f, std::vector<double> points) {
    const Workspace workspace = make_workspace();
    gsl_function integrand = wrap(f);
    double result = 0;
    double error = 0;
    gsl_integration_qagp(&integrand, points.data(), points.size(), 1e-13, 1e-13, 1000, workspace.get(), &result,
                         &error);
    return result;
}

/// Principal value of the integral of f(alpha)/(alpha - pole) over [lower, upper] (GSL's QAWC).
template <typename Function>
double principal_value(Function f, double lower, double upper, double pole) {
    const Workspace workspace = make_workspace();
    gsl_function integrand = wrap(f);
    double result = 0;
    double error = 0;
    gsl_integration_qawc(&integrand, lower, upper, pole, 1e-12, 1e-12, 1000, workspace.get(), &result, &error);
    return result;
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

TEMPLATE_TEST_CASE("Closed forms of friction hold in every scalar type", "[friction]", float, double, long double) {
    using Scalar = TestType;
    const Scalar eps = std::numeric_limits<Scalar>::epsilon();
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
}  // namespace friction_exact_tests
