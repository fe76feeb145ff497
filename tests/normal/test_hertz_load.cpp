// rollbem/normal/hertz.hpp
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <rollbem/detail/gauss_legendre.hpp>
#include <rollbem/normal/hertz.hpp>

#include "support/catch.hpp"

namespace {

using namespace rollbem;

HertzLine line_under(double load_per_width) {
    const ElasticBody body{2.1e11, 0.28};
    return HertzLine({.load_per_width = load_per_width, .combined_radius = 0.46, .body_1 = body, .body_2 = body});
}
const HertzLine line = line_under(1e6);

// The mean over an element of a fixed mesh, by quadrature in the angle theta, x = -a cos(theta).
double exact_mean(const HertzLine& hertz, double low, double high) {
    static const detail::QuadratureRule<double> rule = detail::gauss_legendre<double>(30);
    const double a = hertz.half_length();
    const auto angle = [&](double x) { return std::acos(std::clamp(-x / a, -1.0, 1.0)); };
    const double half = (angle(high) - angle(low)) / 2, middle = (angle(high) + angle(low)) / 2;
    double sum = 0;
    for (Eigen::Index k = 0; k < rule.nodes.size(); ++k) {
        const double sine = std::sin(middle + half * rule.nodes[k]);
        sum += rule.weights[k] * sine * sine;
    }
    return hertz.peak_pressure() * a * sum * half / (high - low);
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
