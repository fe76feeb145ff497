// rollbem/normal/hertz.hpp
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <rollbem/detail/gauss_legendre.hpp>
#include <rollbem/normal/hertz.hpp>

#include "support/catch.hpp"

namespace {

using namespace rollbem;

// Mean of sqrt(1 - x^2) between two edges: the integral of sin^2 theta, x = -cos theta, by quadrature in long double.
long double exact_mean(const Mesh<long double>& mesh, Eigen::Index i) {
    static const detail::QuadratureRule<long double> rule = detail::gauss_legendre<long double>(20);
    const auto angle = [&](Eigen::Index j) {
        return 2 * std::atan2(std::sqrt(mesh.edges_from_trailing()[j]), std::sqrt(mesh.edges_from_leading()[j]));
    };
    const long double half = (angle(i + 1) - angle(i)) / 2, middle = (angle(i + 1) + angle(i)) / 2;
    long double sum = 0;
    for (Eigen::Index k = 0; k < rule.nodes.size(); ++k) {
        const long double sine = std::sin(middle + half * rule.nodes[k]);
        sum += rule.weights[k] * sine * sine;
    }
    return sum * half / mesh.widths()[i];
}

TEST_CASE("Hertz's line contact has the exact half-length, pressures and elastic constants", "[hertz]") {
    const HertzLine hertz({.load_per_width = 1e6,
                           .combined_radius = 0.46,
                           .body_1 = {.young_modulus = 2.1e11, .poisson_ratio = 0.28},
                           .body_2 = {.young_modulus = 2.1e11, .poisson_ratio = 0.28}});
    CHECK_THROWS_AS(HertzLine({.load_per_width = 0, .combined_radius = 1, .body_1 = {1, 0}, .body_2 = {1, 0}}),
                    std::invalid_argument);
    CHECK_THROWS_WITH(HertzLine({.load_per_width = 1, .combined_radius = 1, .body_1 = {1, 0}, .body_2 = {1, 0.7}}),
                      "HertzLine: poisson_ratio = 0.7 must lie in [0, 0.5]");
    CHECK_THROWS_WITH(
        HertzLine({.load_per_width = 1e308, .combined_radius = 1e-290, .body_1 = {1e30, 0}, .body_2 = {1e30, 0}}),
        "HertzLine: peak pressure = inf must be positive and finite");
    // equal bodies: E* = G/(1-nu), and p0 = E* a/(2R) from the curvature of the surfaces
    const Contact contact = hertz.contact(0.01);
    CHECK(contact.shear_modulus() == Approx(2.1e11 / 2.56).epsilon(1e-14));
    CHECK(contact.poisson_ratio() == Approx(0.28).epsilon(1e-14));
    CHECK(contact.half_length() == hertz.half_length());
    // a = 1 whatever the peak pressure, of equal bodies
    for (const double peak : {0.1, 1.0, 30.0}) {
        const auto unit = HertzLine::dimensionless(peak);
        CHECK(unit.half_length() == Approx(1).epsilon(1e-15));
        CHECK(unit.peak_pressure() == Approx(peak).epsilon(1e-15));
    }
    CHECK_THROWS_AS(HertzLine::dimensionless(0), std::invalid_argument);
    CHECK(hertz.peak_pressure() ==
          Approx(contact.shear_modulus() / 0.72 * hertz.half_length() / 2 / 0.46).epsilon(1e-13));
    for (const Mesh<double>& mesh : {cosine_mesh<double>(2000), geometric_mesh<double>(30, 1e6)})
        CHECK(hertz.half_length() * (mesh.widths() * hertz.mean_pressure(mesh)).sum() == Approx(1e6).epsilon(1e-13));
    // the first element of a fine mesh: the mean of sqrt(2 t) (1 - t/4 ...) over its width w
    const Mesh<double> fine = cosine_mesh<double>(100000);
    const double w = fine.widths()[0];
    CHECK(mean_hertz_pressure(fine)[0] == Approx(2.0 / 3 * std::sqrt(2 * w) * (1 - 0.15 * w)).epsilon(1e-14));
}

TEST_CASE("Hertz's mean pressures over elements are accurate to round-off", "[hertz]") {
    // the angle that an element spans ranges from the whole half-circle to little: with and without the series
    double largest = 0;
    for (Eigen::Index n = 1; n < 200; ++n) {
        const ArrayX<double> cosine = mean_hertz_pressure(cosine_mesh<double>(n));
        const ArrayX<double> uniform = mean_hertz_pressure(uniform_mesh<double>(n));
        const Mesh<long double> exact_cosine = cosine_mesh<long double>(n),
                                exact_uniform = uniform_mesh<long double>(n);
        for (Eigen::Index i = 0; i < n; ++i) {
            const long double error = std::max(std::abs(cosine[i] / exact_mean(exact_cosine, i) - 1),
                                               std::abs(uniform[i] / exact_mean(exact_uniform, i) - 1));
            if (!(error <= static_cast<long double>(largest))) largest = static_cast<double>(error);
        }
    }
    CAPTURE(largest);
    CHECK(largest < 3e-15);
}

TEST_CASE("Hertz's contact combines bodies with extreme Poisson's ratios", "[hertz]") {
    const ElasticBody rubber{1e6, 0.5}, cork{1e6, 0};
    const HertzLine hertz({.load_per_width = 1e3, .combined_radius = 0.1, .body_1 = rubber, .body_2 = cork});
    // 1/E* = (0.75 + 1)/E
    CHECK(hertz.half_length() == Approx(std::sqrt(4e2 / std::numbers::pi * 1.75e-6)).epsilon(1e-14));
    CHECK(hertz.contact(1).shear_modulus() == Approx(1e6 / 2.5).epsilon(1e-14));
    CHECK(hertz.contact(1).poisson_ratio() == Approx(0.5 * 1.5 / 2.5).epsilon(1e-14));
}

TEST_CASE("Hertz's pressure at a point follows the semi-ellipse", "[hertz]") {
    const ElasticBody steel{2e11, 0.28};
    const HertzLine hertz({.load_per_width = 1e6, .combined_radius = 0.5, .body_1 = steel, .body_2 = steel});
    const HertzLine::Pressure pressure = hertz.pressure();
    CHECK(pressure(0.0) == hertz.peak_pressure());
    CHECK(pressure(-0.6) == Approx(0.8 * hertz.peak_pressure()).epsilon(1e-15));
    CHECK(pressure(1.0) == 0);
    const Mesh<double> mesh = cosine_mesh<double>(7);
    const detail::QuadratureRule<double> rule = detail::gauss_legendre<double>(20);
    double mean = 0;  // of the element in the middle, where the pressure is analytic
    for (Eigen::Index k = 0; k < 20; ++k) mean += rule.weights[k] / 2 * pressure(mesh.widths()[3] / 2 * rule.nodes[k]);
    CHECK(pressure(mesh)[3] == Approx(mean).epsilon(1e-14));
}

}  // namespace
