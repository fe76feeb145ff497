// rollbem/vehicle/virtual_penetration.hpp
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <rollbem/compiled/wheelset.hpp>
#include <rollbem/normal/hertz_ellipse.hpp>
#include <rollbem/vehicle/virtual_penetration.hpp>

#include "support/catch.hpp"
#include "support/refusal.hpp"

namespace {

using namespace rollbem;
using Catch::Matchers::ContainsSubstring;

constexpr double compliance = 1 / 1.2e11, along = 0.3, approach = 1e-4;

/// Rows over a parabola of radius R about s_0, a little wider than what interpenetrates.
Eigen::ArrayXd parabola(double R, double half, Eigen::Index n, double s_0 = 0) {
    const Eigen::ArrayXd s = Eigen::ArrayXd::LinSpaced(n, -half, half) - s_0;
    return approach - s * s / (2 * R);
}

TEST_CASE("virtual_penetration: a circular contact is by the root of 1.1 too wide and too strong", "[penetration]") {
    const double half = 1.05 * std::sqrt(2 * along * approach);
    for (const double share : {0.55, 0.5, 0.4}) {
        const auto found = virtual_penetration(parabola(along, half, 4001), half / 2000, {along, compliance, share});
        REQUIRE((found.size() == 1 && found[0].status == Status::ok));
        // Hertz: a = sqrt(R delta), N = 4/3 E* a delta, p_0 = 2 E* a/(pi R)
        const double a = std::sqrt(along * approach), N = 4 / (3 * compliance) * a * approach,
                     p_0 = 2 * a / (std::numbers::pi * along * compliance), ratio = std::sqrt(2 * share);
        CAPTURE(share);
        CHECK(std::abs(found[0].approach / approach - 1) < 1e-6);
        CHECK(std::abs(found[0].half_length / (ratio * a) - 1) < 1e-5);
        CHECK(std::abs(found[0].half_width / (ratio * a) - 1) < 1e-5);
        CHECK(std::abs(found[0].area / (std::numbers::pi * ratio * ratio * a * a) - 1) < 1e-5);
        CHECK(std::abs(found[0].load / (ratio * N) - 1) < 1e-5);
        CHECK(std::abs(found[0].peak_pressure * ratio / p_0 - 1) < 1e-5);
        CHECK(std::abs(found[0].y - half) < 1e-9);
    }
}

TEST_CASE("virtual_penetration: elliptic contacts displace their middle by the approach", "[penetration]") {
    for (const double across : {0.01, 0.1, 2.0, 10.0}) {
        const double half = 1.05 * std::sqrt(2 * across * approach);
        const auto found = virtual_penetration(parabola(across, half, 4001), half / 2000, {along, compliance});
        REQUIRE(found.size() == 1);
        const double a = std::sqrt(1.1 * along * approach), b = std::sqrt(1.1 * across * approach),
                     longer = std::max(a, b), shorter = std::min(a, b);
        // p_0 sqrt(1 - x^2/a^2 - s^2/b^2) displaces its middle by p_0 shorter K/E*
        const double p_0 = approach / (compliance * shorter * detail::EllipticIntegrals<double>(shorter / longer).K);
        CAPTURE(across);
        CHECK(std::abs(found[0].peak_pressure / p_0 - 1) < 2e-5);
        CHECK(std::abs(found[0].load / (2 * std::numbers::pi / 3 * a * b * p_0) - 1) < 2e-5);
        CHECK(std::abs(found[0].area / (std::numbers::pi * a * b) - 1) < 2e-5);
    }
}

TEST_CASE("virtual_penetration: zones, ends of profiles and refusals", "[penetration]") {
    const double half = 0.03, crown = 0.012;
    const Eigen::ArrayXd two = parabola(along, half, 4001, crown).max(parabola(along, half, 4001, -crown));
    const auto zones = virtual_penetration(two, half / 2000, {along, compliance});
    const auto alone = virtual_penetration(parabola(along, half, 4001, crown), half / 2000, {along, compliance});
    REQUIRE((zones.size() == 2 && alone.size() == 1));
    for (const VirtualPenetration& zone : zones) CHECK(std::abs(zone.load / alone[0].load - 1) < 1e-9);
    CHECK(zones[0].y < zones[1].y);

    const auto cut = virtual_penetration(parabola(along, 1e-3, 101), 2e-5, {along, compliance});
    REQUIRE(cut.size() == 1);
    CHECK(cut[0].status == Status::end_of_profile);
    Eigen::ArrayXd unknown = parabola(along, half, 4001);
    unknown[2050] = std::nan("");
    for (const auto& zone : virtual_penetration(unknown, half / 2000, {along, compliance})) {
        CHECK(zone.status == Status::end_of_profile);
    }
    CHECK(virtual_penetration(parabola(along, half, 101) - 1, 1e-3, {along, compliance}).empty());

    const Eigen::ArrayXd rows = parabola(along, half, 101);
    CHECK_THAT(refusal([&] {
                   virtual_penetration(rows, 1e-3, {along, compliance, 0});
               }),
               ContainsSubstring("share = 0 must lie in (0, 1]"));
    CHECK_THAT(refusal([&] {
                   virtual_penetration(rows.head(2), 1e-3, {along, compliance});
               }),
               ContainsSubstring("number of rows = 2 must be at least 3"));
}

TEST_CASE("virtual_penetration: a wheel on a crown has Hertz's contact but for the root of 1.1", "[penetration]") {
    const auto arc = [](double R) {
        const Eigen::ArrayXd y = Eigen::ArrayXd::LinSpaced(401, -0.03, 0.03);
        return Profile(y, R - (R * R - y.square()).sqrt(), Profile::Use::piece);
    };
    const auto plane = [] {
        const Eigen::ArrayXd y = Eigen::ArrayXd::LinSpaced(401, -0.06, 0.06);
        return Profile(y, Eigen::ArrayXd::Zero(401), Profile::Use::piece);
    };
    TrackDimensions dimensions{.radius = along};
    dimensions.rail_origin = TrackDimensions::Origin{0.75, 0};
    const WheelOnRail wheel(plane(), arc(along), dimensions);
    WheelOnRail::Workspace workspace;
    const WheelsetPosition at{.lateral = 2e-3, .height = approach};
    const auto found = virtual_penetration(wheel, at);
    const WheelOnRail::Contact exact = wheel.solve_at_height(at, workspace, {.cells_x = 80, .cells_s = 60});
    REQUIRE((found.size() == 1 && found[0].status == Status::ok && exact.status == Status::ok));
    const RailPatch& patch = exact.patches[0];
    CHECK(std::abs(found[0].load / patch.load / std::sqrt(1.1) - 1) < 3e-3);
    CHECK(std::abs(found[0].peak_pressure / patch.peak_pressure * std::sqrt(1.1) - 1) < 3e-3);
    CHECK(std::abs(found[0].area / patch.area / 1.1 - 1) < 1e-2);
    CHECK(std::abs(found[0].y - patch.y) < 6e-5);  // a row
    CHECK(std::abs(found[0].approach / patch.approach - 1) < 1e-3);
    CHECK(virtual_penetration(wheel, {.height = -1e-6}).empty());
    CHECK(virtual_penetration(wheel, {.lateral = std::nan("")}).empty());
}

}  // namespace
