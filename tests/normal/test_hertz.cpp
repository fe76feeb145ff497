// rollbem/normal/hertz.hpp
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <rollbem/detail/gauss_legendre.hpp>
#include <rollbem/normal/hertz.hpp>

#include "support/catch.hpp"

namespace hertz_tests {
namespace {

using namespace rollbem;

// The integral of sin^2 theta between two angles, by quadrature: means of sqrt(1 - x^2), x = -cos theta.
template <class Real>
Real integral_of_square_sine(Real from, Real to) {
    static const detail::QuadratureRule<Real> rule = detail::gauss_legendre<Real>(30);
    const Real half = (to - from) / 2, middle = (to + from) / 2;
    Real sum = 0;
    for (Eigen::Index k = 0; k < rule.nodes.size(); ++k) {
        const Real sine = std::sin(middle + half * rule.nodes[k]);
        sum += rule.weights[k] * sine * sine;
    }
    return sum * half;
}

long double exact_mean(const Mesh<long double>& mesh, Eigen::Index i) {
    const auto angle = [&](Eigen::Index j) {
        return 2 * std::atan2(std::sqrt(mesh.edges_from_trailing()[j]), std::sqrt(mesh.edges_from_leading()[j]));
    };
    return integral_of_square_sine(angle(i), angle(i + 1)) / mesh.widths()[i];
}

// The mean pressure on an element of a fixed mesh.
double exact_mean(const HertzLine& hertz, double low, double high) {
    const double a = hertz.half_length();
    const auto angle = [&](double x) { return std::acos(std::clamp(-x / a, -1.0, 1.0)); };
    return hertz.peak_pressure() * a * integral_of_square_sine(angle(low), angle(high)) / (high - low);
}

HertzLine line_under(double load_per_width) {
    const ElasticBody body{2.1e11, 0.28};
    return HertzLine({.load_per_width = load_per_width, .combined_radius = 0.46, .body_1 = body, .body_2 = body});
}
const HertzLine line = line_under(1e6);

TEST_CASE("Hertz's line contact has the exact half-length, pressures and elastic constants", "[hertz]") {
    CHECK_THROWS_AS(HertzLine({.load_per_width = 0, .combined_radius = 1, .body_1 = {1, 0}, .body_2 = {1, 0}}),
                    std::invalid_argument);
    CHECK_THROWS_WITH(HertzLine({.load_per_width = 1, .combined_radius = 1, .body_1 = {1, 0}, .body_2 = {1, 0.7}}),
                      "HertzLine: poisson_ratio = 0.7 must lie in [0, 0.5]");
    CHECK_THROWS_WITH(
        HertzLine({.load_per_width = 1e308, .combined_radius = 1e-290, .body_1 = {1e30, 0}, .body_2 = {1e30, 0}}),
        "HertzLine: peak pressure = inf must be positive and finite");
    // equal bodies: E* = G/(1-nu), and p0 = E* a/(2R) from the curvature of the surfaces
    const Contact contact = line.contact(0.01);
    CHECK(contact.shear_modulus() == Approx(2.1e11 / 2.56).epsilon(1e-14));
    CHECK(contact.poisson_ratio() == Approx(0.28).epsilon(1e-14));
    CHECK(contact.half_length() == line.half_length());
    // a = 1 whatever the peak pressure, of equal bodies
    for (const double peak : {0.1, 1.0, 30.0}) {
        const auto unit = HertzLine::dimensionless(peak);
        CHECK(unit.half_length() == Approx(1).epsilon(1e-15));
        CHECK(unit.peak_pressure() == Approx(peak).epsilon(1e-15));
    }
    CHECK_THROWS_AS(HertzLine::dimensionless(0), std::invalid_argument);
    CHECK(line.peak_pressure() ==
          Approx(contact.shear_modulus() / 0.72 * line.half_length() / 2 / 0.46).epsilon(1e-13));
    for (const Mesh<double>& mesh : {cosine_mesh<double>(2000), geometric_mesh<double>(30, 1e6)})
        CHECK(line.half_length() * (mesh.widths() * line.mean_pressure(mesh)).sum() == Approx(1e6).epsilon(1e-13));
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
    const HertzLine::Pressure pressure = line.pressure();
    CHECK(pressure(0.0) == line.peak_pressure());
    CHECK(pressure(-0.6) == Approx(0.8 * line.peak_pressure()).epsilon(1e-15));
    CHECK(pressure(1.0) == 0);
    const Mesh<double> mesh = cosine_mesh<double>(7);
    const detail::QuadratureRule<double> rule = detail::gauss_legendre<double>(20);
    double mean = 0;  // of the element in the middle, where the pressure is analytic
    for (Eigen::Index k = 0; k < 20; ++k) mean += rule.weights[k] / 2 * pressure(mesh.widths()[3] / 2 * rule.nodes[k]);
    CHECK(pressure(mesh)[3] == Approx(mean).epsilon(1e-14));
}

TEST_CASE("Hertz's load on a breathing mesh has exact pressures", "[hertz][load]") {
    const Mesh<double> mesh = cosine_mesh<double>(17);
    const HertzLine::Load hertz = HertzLine::Load::breathing(line, mesh);
    CHECK(hertz.breathes());
    NormalLoad load = hertz.at(1e6);
    // bit for bit the contact of the line itself
    CHECK(load.half_length == line.half_length());
    CHECK((load.normal_pressure == line.mean_pressure(mesh)).all());
    for (const double P : {1e-3, 3e5, 1.5e6, 1e12}) {
        REQUIRE(hertz.set(P, load) == Status::ok);
        const HertzLine there = line_under(P);
        CHECK(load.half_length == Approx(there.half_length()).epsilon(1e-14));
        CHECK((load.normal_pressure / there.mean_pressure(mesh) - 1).abs().maxCoeff() < 1e-14);
        CHECK((load.normal_pressure * mesh.widths()).sum() * load.half_length == Approx(P).epsilon(1e-13));
    }
}

TEST_CASE("Hertz's load on a fixed mesh has exact pressures", "[hertz][load]") {
    for (const bool uniform : {true, false}) {
        for (const Eigen::Index n : {1, 2, 12, 13, 200}) {
            const Mesh<double> mesh = uniform ? uniform_mesh<double>(n) : cosine_mesh<double>(n);
            const double length = 1.25 * line.half_length();
            const HertzLine::Load hertz = HertzLine::Load::fixed(line, mesh, length);
            CHECK(!hertz.breathes());
            NormalLoad load = hertz.at(1e6);
            for (const double P : {1e-6, 1.0, 2e4, 3.7e5, 1e6, 1.5e6}) {
                REQUIRE(hertz.set(P, load) == Status::ok);
                const HertzLine there = line_under(P);
                CAPTURE(uniform, n, P);
                CHECK(load.half_length == length);
                CHECK((load.normal_pressure * mesh.widths()).sum() * length ==
                      Approx(P).epsilon(1e-12 + 1e-15 * length / there.half_length()));
                CHECK((load.pressure_rate * mesh.widths()).sum() * length == Approx(1).epsilon(1e-12));
                const ArrayX<double> edges = mesh.edges() * length;
                double worst = 0, free = 0;
                for (Eigen::Index i = 0; i < n; ++i) {
                    const double exact = exact_mean(there, edges[i], edges[i + 1]);
                    worst = std::max(worst, std::abs(load.normal_pressure[i] - exact) / there.peak_pressure());
                    if (std::abs(edges[i]) >= there.half_length() && std::abs(edges[i + 1]) >= there.half_length() &&
                        edges[i] * edges[i + 1] > 0) {
                        free = std::max(free, load.normal_pressure[i] / there.peak_pressure());
                    }
                }
                CHECK(worst < 1e-13 * there.half_length() / (length * mesh.widths().minCoeff()) + 1e-13);
                CHECK(free < 1e-20);  // round-off where an edge of the contact coincides with one of an element
            }
            // no load: contact is about to begin in the middle
            REQUIRE(hertz.set(0, load) == Status::ok);
            CHECK((load.normal_pressure == 0).all());
            CHECK((load.pressure_rate * mesh.widths()).sum() * length == Approx(1).epsilon(1e-13));
            CHECK((load.pressure_rate > 0).count() <= (n % 2 == 0 ? 2 : 1));
            if (uniform) CHECK((load.pressure_rate > 0).count() == (n % 2 == 0 ? 2 : 1));
        }
    }
    // a mesh as long as the contact
    const Mesh<double> mesh = cosine_mesh<double>(17);
    const NormalLoad whole = HertzLine::Load::fixed(line, mesh, line.half_length()).at(1e6);
    CHECK((whole.normal_pressure / line.mean_pressure(mesh) - 1).abs().maxCoeff() < 1e-14);
}

TEST_CASE("Loads that Hertz's contact cannot carry are rejected", "[hertz][load]") {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    const Mesh<double> mesh = uniform_mesh<double>(10);
    const HertzLine::Load fixed = HertzLine::Load::fixed(line, mesh, 1.25 * line.half_length());
    NormalLoad load = fixed.at(1e6), other = HertzLine::Load::fixed(line, uniform_mesh<double>(9), 1).at(1);
    CHECK(fixed.set(1e6 * 1.25 * 1.25, load) == Status::ok);
    CHECK(fixed.set(1e6 * 1.25 * 1.25 * 1.0001, load) == Status::invalid_load);
    CHECK(fixed.set(1e6, other) == Status::invalid_load);
    CHECK(other.check(9) == Status::invalid_load);
    for (const double length : {0.0, -1.0, nan, infinity}) {
        CHECK_THROWS_AS(HertzLine::Load::fixed(line, mesh, length), std::invalid_argument);
    }
    CHECK_THROWS_WITH(HertzLine::Load::breathing(line, mesh).at(0),
                      "HertzLine::Load: load_per_width = 0 must be positive and finite");
}

}  // namespace
}  // namespace hertz_tests
