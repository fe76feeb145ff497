// rollbem/normal/hertz.hpp
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <gsl/gsl_sf_ellint.h>

#include <rollbem/normal/hertz.hpp>
#include <rollbem/normal/detail/ellipse_pressures.hpp>
#include <rollbem/normal/detail/elliptic_integrals.hpp>

#include "support/catch.hpp"
#include "support/refusal.hpp"

namespace hertz_ellipse_tests {
namespace {

using namespace rollbem;
using Catch::Matchers::ContainsSubstring;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double pi = std::numbers::pi;
constexpr double flat = std::numeric_limits<double>::infinity();
const ElasticBody steel{2.1e11, 0.28}, rubber{1e7, 0.49};

HertzEllipse::Parameters wheel_on_rail() {
    return {.load = 1e5, .radii_1 = {0.46, flat}, .radii_2 = {flat, 0.3}, .body_1 = steel, .body_2 = steel};
}

HertzEllipse crossed(double rolling, double lateral, double load = 1e5) {
    return HertzEllipse(
        {.load = load, .radii_1 = {rolling, lateral}, .radii_2 = {flat, flat}, .body_1 = steel, .body_2 = rubber});
}

double relative(double value, double exact) { return std::abs(value / exact - 1); }

TEST_CASE("Elliptic integrals are GSL's, and keep their digits for circles", "[hertz]") {
    for (const double kappa : {0.9, 0.5, 0.2, 0.03}) {
        const double e = std::sqrt((1 - kappa) * (1 + kappa));
        const double K = gsl_sf_ellint_Kcomp(e, GSL_PREC_DOUBLE), E = gsl_sf_ellint_Ecomp(e, GSL_PREC_DOUBLE);
        const detail::EllipticIntegrals at(kappa);
        CAPTURE(kappa);
        CHECK(relative(at.K, K) < 1e-13);
        CHECK(relative(at.D, (K - E) / (e * e)) < 1e-13);
        CHECK(relative(at.B, (E - kappa * kappa * K) / (e * e)) < 1e-13);
        CHECK(relative(at.C, (at.D - at.B) / (e * e)) < 1e-12);
    }
    const detail::EllipticIntegrals circle(1);
    CHECK(relative(circle.K, pi / 2) < 2 * eps);
    CHECK(relative(circle.D, pi / 4) < 2 * eps);
    CHECK(relative(circle.C, pi / 16) < 2 * eps);
    // K -> ln(4/kappa), E -> 1
    const detail::EllipticIntegrals needle(1e-150);
    CHECK(relative(needle.K, std::log(4e150)) < 1e-14);
    CHECK(relative(needle.D, needle.K - 1) < 1e-14);
    CHECK(relative(needle.B, 1) < 1e-12);
}

TEST_CASE("The surfaces touch within the ellipse: both curvatures of the gap are met", "[hertz]") {
    // under Hertz's pressure the displacement at the centre and at the ends of both axes, by quadrature of another
    // kind: the potential of the ellipsoid, (3 N/(4 pi E*)) int (1 - x^2/(a^2+w) - y^2/(b^2+w)) dw/sqrt((a^2+w)(b^2+w)
    // w)
    const HertzEllipse ellipse(wheel_on_rail());
    const double a = ellipse.half_length(), b = ellipse.half_width(), compliance = 2 * (1 - 0.28 * 0.28) / 2.1e11;
    const auto displaced = [&](double x, double y) {
        // w = a b t^2, t = exp(pi/2 sinh u)
        double sum = 0;
        const double h = 1.0 / 32;
        for (int k = -160; k <= 160; ++k) {
            const double u = k * h, t = std::exp(std::sinh(u) * pi / 2), w = a * b * t * t;
            const double root = std::sqrt((a * a + w) * (b * b + w));
            if (!(t < 1e100 && t > 1e-100)) continue;
            sum += h * std::cosh(u) * pi / 2 * t * 2 * std::sqrt(a * b) / root *
                   (1 - x * x / (a * a + w) - y * y / (b * b + w));
        }
        return 3 * ellipse.load() * compliance / (4 * pi) * sum;
    };
    CHECK(relative(displaced(0, 0), ellipse.approach()) < 1e-12);
    CHECK(relative(displaced(0, 0) - displaced(a, 0), a * a / 2 / 0.46) < 1e-11);
    CHECK(relative(displaced(0, 0) - displaced(0, b), b * b / 2 / 0.3) < 1e-11);
}

TEST_CASE("Equal radii give the circle, and long ellipses the line contact", "[hertz]") {
    const double compliance = (1 - 0.28 * 0.28) / steel.young_modulus + (1 - 0.49 * 0.49) / rubber.young_modulus;
    const HertzEllipse circle = crossed(0.4, 0.4);
    CHECK(circle.half_length() == circle.half_width());
    CHECK(circle.turn() == 0);
    CHECK(relative(circle.half_length(), std::cbrt(3 * 1e5 * 0.4 * compliance / 4)) < 4 * eps);
    CHECK(relative(circle.approach(), circle.half_length() * circle.half_length() / 0.4) < 4 * eps);
    // in its middle a long ellipse is a line contact under the load per width 3 N/(4 b)
    const HertzEllipse needle = crossed(0.4, 0.4e9);
    const HertzLine limit({.load_per_width = 3 * 1e5 / (4 * needle.half_width()),
                           .combined_radius = 0.4,
                           .body_1 = steel,
                           .body_2 = rubber});
    CHECK(needle.half_width() > 1e4 * needle.half_length());
    CHECK(relative(limit.half_length(), needle.half_length()) < 1e-7);
    CHECK(relative(limit.peak_pressure(), needle.peak_pressure()) < 1e-7);
    for (const double ratio : {1e-200, 1e-30, 1e-8, 1e8, 1e30, 1e200}) {
        const HertzEllipse ellipse = crossed(1, ratio);
        CAPTURE(ratio);
        CHECK((ellipse.half_length() < ellipse.half_width()) == (ratio > 1));
        CHECK(std::isfinite(ellipse.half_width()));
        CHECK(std::isfinite(ellipse.approach()));
        CHECK(ellipse.approach() > 0);
        const double kappa = detail::ellipse_of_curvatures(std::min(ratio, 1 / ratio));
        const detail::EllipticIntegrals at(kappa);
        CHECK(relative(kappa * kappa * at.D / at.B, std::min(ratio, 1 / ratio)) < 1e-11);
    }
}

TEST_CASE("An ellipse under another load is the one made with it", "[hertz]") {
    HertzEllipse::Parameters parameters = wheel_on_rail();
    parameters.load = 3e4;
    const HertzEllipse direct(parameters), scaled = HertzEllipse(wheel_on_rail()).under(3e4);
    CHECK(relative(direct.half_length(), scaled.half_length()) < 1e-14);
    CHECK(relative(direct.approach(), scaled.approach()) < 1e-14);
    CHECK(relative(direct.peak_pressure(), scaled.peak_pressure()) < 1e-14);
    CHECK(relative(direct.peak_pressure() * 2 * pi / 3 * direct.half_length() * direct.half_width(), 3e4) < 1e-14);
}

TEST_CASE("Bodies may be turned, exchanged and flattened", "[hertz]") {
    HertzEllipse::Parameters parameters{
        .load = 1e5, .radii_1 = {0.5, 0.8}, .radii_2 = {0.3, 2}, .body_1 = steel, .body_2 = rubber};
    const HertzEllipse along(parameters);
    parameters.angle = pi / 2;
    const HertzEllipse across(parameters);
    parameters.radii_2 = {2, 0.3};
    parameters.angle = 0;
    const HertzEllipse swapped(parameters);
    CHECK(relative(across.half_length(), swapped.half_length()) < 1e-14);
    CHECK(relative(across.half_width(), swapped.half_width()) < 1e-14);
    CHECK(std::abs(across.turn()) < 1e-14);
    CHECK(across.half_width() / across.half_length() != along.half_width() / along.half_length());
    // one curved body alone, turned: the ellipse turns with it
    for (const double angle : {0.3, -0.3, 0.7}) {
        HertzEllipse::Parameters alone{.load = 1e5,
                                       .radii_1 = {flat, flat},
                                       .radii_2 = {0.3, 2},
                                       .angle = angle,
                                       .body_1 = steel,
                                       .body_2 = rubber};
        CAPTURE(angle);
        const HertzEllipse turned(alone);
        CHECK(relative(turned.turn(), angle) < 1e-14);
        CHECK(relative(turned.half_length(), crossed(0.3, 2).half_length()) < 1e-13);
        CHECK(relative(turned.half_width(), crossed(0.3, 2).half_width()) < 1e-13);
        std::swap(alone.radii_2.rolling, alone.radii_2.lateral);
        const HertzEllipse wide(alone);
        CHECK(relative(wide.turn(), angle) < 1e-14);
        CHECK(relative(wide.half_length(), crossed(2, 0.3).half_length()) < 1e-13);
    }
    // a concave rail
    parameters.radii_1 = {0.5, 0.25};
    parameters.radii_2 = {flat, -0.5};
    CHECK(relative(HertzEllipse(parameters).half_length(), crossed(0.5, 0.5).half_length()) < 1e-14);
}

// n x m equal rectangles over the box of half-sides a and b
std::vector<PatchMesh<double>::Rectangle> grid(double a, double b, int n, int m) {
    std::vector<PatchMesh<double>::Rectangle> elements;
    for (int j = 0; j < m; ++j) {
        for (int i = 0; i < n; ++i) {
            elements.push_back({a * (2.0 * i / n - 1), a * (2.0 * (i + 1) / n - 1), b * (2.0 * j / m - 1),
                                b * (2.0 * (j + 1) / m - 1)});
        }
    }
    return elements;
}

TEST_CASE("Pressures of elements are exact means, however the ellipse cuts them", "[hertz]") {
    // one rectangle around the whole, quarters, and pieces add up to the same volume and slope
    for (const auto& [n, m] : {std::pair{1, 1}, {2, 2}, {5, 7}, {13, 4}}) {
        for (const double side : {1.0, 1.3}) {
            double volume = 0, inverse = 0;
            for (const PatchMesh<double>::Rectangle& element : grid(side, side, n, m)) {
                const auto [height, root] = detail::integrate_hemisphere(element);
                volume += height;
                inverse += root;
                // as seen after exchange of both axes, for which closed form and quadrature change their places
                const auto [other, other_root] =
                    detail::integrate_hemisphere({element.y_1, element.y_2, element.x_1, element.x_2});
                CHECK(std::abs(height - other) < 1e-8);
                CHECK(std::abs(root - other_root) < 1e-5);
            }
            CAPTURE(n, m, side);
            CHECK(relative(volume, 2 * pi / 3) < 1e-8);
            CHECK(relative(inverse, 2 * pi) < 1e-5);
        }
    }
    // inside, for small elements, the value at the centre
    const auto [height, root] = detail::integrate_hemisphere({0.3, 0.302, -0.401, -0.4});
    CHECK(relative(height / 2e-6, std::sqrt(1 - 0.301 * 0.301 - 0.4005 * 0.4005)) < 1e-6);
    CHECK(relative(root / 2e-6, 1 / std::sqrt(1 - 0.301 * 0.301 - 0.4005 * 0.4005)) < 1e-5);
    CHECK(detail::integrate_hemisphere({0.8, 0.9, 0.8, 0.9})[0] == 0);
}

TEST_CASE("Elements carry the load exactly", "[hertz]") {
    const HertzEllipse ellipse(wheel_on_rail());
    const double a = ellipse.half_length(), b = ellipse.half_width();
    for (const double load : {1e5, 4e4, 1e3}) {
        for (const double side : {1.0, 0.97}) {  // the second loses some of the rim
            const std::vector<PatchMesh<double>::Rectangle> elements = grid(side * a, side * b, 9, 8);
            const auto at = ellipse.under(load).pressures(elements);
            double carried = 0, rate = 0;
            for (std::size_t i = 0; i < elements.size(); ++i) {
                const double area = (elements[i].x_2 - elements[i].x_1) * (elements[i].y_2 - elements[i].y_1);
                const Eigen::Index k = static_cast<Eigen::Index>(i);
                carried += area * at.mean[k];
                rate += area * at.rate[k];
            }
            CAPTURE(load, side);
            CHECK(relative(carried, load) < 20 * eps);
            CHECK(relative(rate, 1) < 20 * eps);
            CHECK(at.mean.minCoeff() >= 0);
        }
    }
    CHECK_THAT(refusal([&] { ellipse.pressures(grid(a / 2, b, 4, 4)); }),
               ContainsSubstring("share of the load on the elements = ") && ContainsSubstring("must be at least 0.9"));
    CHECK_THAT(refusal([&] { ellipse.pressures({{a, -a, -b, b}}); }), ContainsSubstring("area of an element"));
}

TEST_CASE("The contact of an ellipse has its axes and the combined constants of both bodies", "[hertz]") {
    HertzEllipse::Parameters parameters = wheel_on_rail();
    parameters.body_1 = {.young_modulus = 2e11, .poisson_ratio = 0.25};  // 1/G = 1.25e-11
    parameters.body_2 = {.young_modulus = 1e11, .poisson_ratio = 0};     // 1/G = 2e-11
    const HertzEllipse ellipse(parameters);
    const PatchContact contact = ellipse.contact();
    CHECK(contact.half_length() == ellipse.half_length());
    CHECK(contact.half_width() == ellipse.half_width());
    CHECK(relative(contact.shear_modulus(), 1 / 1.625e-11) < 4 * eps);
    CHECK(relative(contact.poisson_ratio(), 0.25 * 1.25 / 3.25) < 4 * eps);
    parameters.angle = 0.1;
    CHECK_THAT(refusal([&] { HertzEllipse(parameters).contact(); }),
               ContainsSubstring("HertzEllipse: turn = ") && ContainsSubstring("must be 0"));
}

TEST_CASE("Bodies that make no ellipse are refused by name", "[hertz]") {
    const auto told = [](const auto& change) {
        HertzEllipse::Parameters parameters = wheel_on_rail();
        change(parameters);
        return refusal([&] { HertzEllipse{parameters}; });
    };
    CHECK_THAT(told([](auto& p) { p.load = 0; }), ContainsSubstring("HertzEllipse: load = 0 must be positive"));
    CHECK_THAT(told([](auto& p) { p.radii_1.rolling = 0; }), ContainsSubstring("radii_1.rolling = 0 must be"));
    CHECK_THAT(told([](auto& p) { p.radii_2.lateral = std::nan(""); }), ContainsSubstring("radii_2.lateral = nan"));
    CHECK_THAT(told([](auto& p) { p.radii_2.lateral = flat; }), ContainsSubstring("smaller principal curvature"));
    CHECK_THAT(told([](auto& p) { p.radii_2.lateral = -0.3; }), ContainsSubstring("smaller principal curvature"));
    CHECK_THAT(told([](auto& p) { p.angle = flat; }), ContainsSubstring("angle = inf must be finite"));
    CHECK_THAT(told([](auto& p) { p.body_1.poisson_ratio = 0.6; }), ContainsSubstring("poisson_ratio = 0.6"));
    CHECK_THAT(told([](auto& p) { p.body_2.young_modulus = -1; }), ContainsSubstring("young_modulus = -1"));
    CHECK_THAT(refusal([] { HertzEllipse(wheel_on_rail()).under(-1); }), ContainsSubstring("load = -1"));
    // sizes and pressures beyond double precision
    CHECK_THAT(told([](auto& p) { p.load = p.radii_1.rolling = 1e-290; }),
               ContainsSubstring("peak pressure = inf must"));
    CHECK_THAT(refusal([] { HertzEllipse(wheel_on_rail()).under(5e-324); }),
               ContainsSubstring("load = 4.94065645841e-324 must"));
    const PatchContact contact({1e-3, 1e-3, 1, 0});
    const auto pressures = [&](double load) { return hertz_pressures(contact, patch_mesh(contact, 4, 4), load); };
    CHECK_THAT(refusal([&] { pressures(1e305); }), ContainsSubstring("largest pressure = inf must be finite"));
    CHECK_THAT(refusal([&] { pressures(0); }), ContainsSubstring("hertz_pressures: load = 0"));
}

}  // namespace
}  // namespace hertz_ellipse_tests
