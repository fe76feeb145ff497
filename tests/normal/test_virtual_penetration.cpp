// rollbem/normal/virtual_penetration.hpp
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include <rollbem/normal/profile.hpp>
#include <rollbem/normal/virtual_penetration.hpp>
#include <rollbem/normal/wheel_on_rail.hpp>
#include <rollbem/normal/detail/contact_region.hpp>
#include <rollbem/normal/detail/elliptic_integrals.hpp>
#include <rollbem/normal/detail/rail_samples.hpp>

#include "support/catch.hpp"
#include "support/refusal.hpp"

namespace virtual_penetration_tests {
namespace {

using namespace rollbem;
using Catch::Matchers::ContainsSubstring;

constexpr double compliance = 1 / 1.2e11, along = 0.3, approach = 1e-4;

/// Rows over a parabola of radius R about s_0, a little wider than what interpenetrates.
Eigen::ArrayXd parabola(double R, double half, Eigen::Index n, double s_0 = 0, double depth = approach) {
    const Eigen::ArrayXd s = Eigen::ArrayXd::LinSpaced(n, -half, half) - s_0;
    return depth - s * s / (2 * R);
}

/// A cone of this half angle [rad], on an arc at y = 0.75 about a centre R below its top.
WheelOnRail on_crown(double angle, double R) {
    WheelOnRail::Dimensions dimensions{.radius = along};
    dimensions.rail_origin = WheelOnRail::Dimensions::Origin{0.75, 0};
    const Eigen::ArrayXd y = Eigen::ArrayXd::LinSpaced(801, -0.03, 0.03);
    return {Profile(2 * y, -2 * std::tan(angle) * y, Profile::Use::piece),
            Profile(y, R - (R * R - y.square()).sqrt(), Profile::Use::piece), dimensions};
}

TEST_CASE("virtual_penetration: ellipses displace their middle by the approach, circles by the root of 1.1 too wide",
          "[penetration]") {
    for (const auto& [across, share] :
         {std::pair{along, 0.55}, {along, 0.5}, {along, 0.4}, {0.01, 0.55}, {0.1, 0.55}, {2.0, 0.55}, {10.0, 0.55}}) {
        const double half = 1.05 * std::sqrt(2 * across * approach), exact = across == along ? 1e-5 : 2e-5;
        const auto found = virtual_penetration(parabola(across, half, 4001), half / 2000, {along, compliance, share});
        REQUIRE((found.size() == 1 && found[0].status == Status::ok));
        // for a share of 1/2 the semi-axes of a circle are Hertz's, the root of R delta
        const double a = std::sqrt(2 * share * along * approach), b = std::sqrt(2 * share * across * approach),
                     longer = std::max(a, b), shorter = std::min(a, b);
        // p_0 sqrt(1 - x^2/a^2 - s^2/b^2) displaces its middle by p_0 shorter K/E*
        const double p_0 = approach / (compliance * shorter * detail::EllipticIntegrals(shorter / longer).K);
        CAPTURE(across, share);
        CHECK(std::abs(found[0].approach / approach - 1) < 1e-6);
        CHECK(std::abs(found[0].half_length / a - 1) < 1e-5);
        CHECK(std::abs(found[0].half_width / b - 1) < 1e-5);
        CHECK(std::abs(found[0].area / (std::numbers::pi * a * b) - 1) < exact);
        CHECK(std::abs(found[0].load / (2 * std::numbers::pi / 3 * a * b * p_0) - 1) < exact);
        CHECK(std::abs(found[0].peak_pressure / p_0 - 1) < exact);
        CHECK(std::abs(found[0].y - half) < 1e-9);
    }
}

TEST_CASE("virtual_penetration: contacts apart in one plane are as alone, lobes by what is left of them",
          "[penetration]") {
    const double half = 0.03, crown = 0.012, step = half / 2000;
    const VirtualPenetration::Parameters contact{along, compliance};
    for (const double shallower : {0.9, 0.6, 0.3}) {
        const Eigen::ArrayXd one = parabola(along, half, 4001, -crown),
                             two = parabola(along, half, 4001, crown, shallower * approach);
        const auto zones = virtual_penetration(one.max(two), step, contact);
        CAPTURE(shallower);
        REQUIRE(zones.size() == 2);
        for (std::size_t k = 0; k < 2; ++k) {
            const auto alone = virtual_penetration(k == 0 ? one : two, step, contact);
            REQUIRE((alone.size() == 1 && zones[k].status == Status::ok));
            CHECK(std::abs(zones[k].approach / (k == 0 ? approach : shallower * approach) - 1) < 1e-6);
            CHECK(std::abs(zones[k].load / alone[0].load - 1) < 1e-9);
            CHECK(std::abs(zones[k].peak_pressure / alone[0].peak_pressure - 1) < 1e-9);
            CHECK(std::abs(zones[k].area / alone[0].area - 1) < 1e-9);
            CHECK(zones[k].y == alone[0].y);
        }
    }
    // two lobes of one stretch: what remains of the shallower one displaces it
    const double near = 0.006, depth = 0.6 * approach, remains = depth - 0.45 * approach;
    const Eigen::ArrayXd second = parabola(along, half, 4001, near, depth);
    const auto lobes = virtual_penetration(parabola(along, half, 4001, -near).max(second), step, contact);
    REQUIRE((lobes.size() == 2 && lobes[1].status == Status::ok));
    const double a = std::sqrt(2 * along * remains);  // circular
    CHECK(std::abs(lobes[1].approach / depth - 1) < 1e-6);
    CHECK(std::abs(lobes[1].half_length / a - 1) < 1e-4);
    CHECK(std::abs(lobes[1].peak_pressure * a * std::numbers::pi / 2 * compliance * 0.55 / remains - 1) < 1e-4);
}

TEST_CASE("virtual_penetration: ends of profiles and refusals", "[penetration]") {
    const double half = 0.03;
    const auto cut = virtual_penetration(parabola(along, 1e-3, 101), 2e-5, {along, compliance});
    REQUIRE(cut.size() == 1);
    CHECK(cut[0].status == Status::end_of_profile);
    Eigen::ArrayXd unknown = parabola(along, half, 4001);
    for (const double none : {std::nan(""), -std::numeric_limits<double>::infinity()}) {
        unknown[2050] = none;
        const auto broken = virtual_penetration(unknown, half / 2000, {along, compliance});
        CHECK(broken.size() == 2);
        for (const auto& zone : broken) CHECK(zone.status == Status::end_of_profile);
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

TEST_CASE("virtual_penetration: a cone on a crown, inclined and yawed, has the axes of its inclined sections",
          "[penetration]") {
    constexpr double crown = 0.08;
    for (const double angle : {-0.35, 0.0, 0.2, 0.35}) {
        for (const double yaw : {0.0, 0.02}) {
            const WheelOnRail wheel = on_crown(angle, crown);
            WheelsetPosition at{.lateral = 1e-3, .yaw = yaw};
            const WheelOnRail::RigidContact touch = rigid_contact(wheel, at);
            REQUIRE(touch.status == Status::ok);
            const double depth = 0.5 * approach, slope = std::cos(touch.angle);
            at.height = touch.height + depth / slope;
            const auto found = virtual_penetration(wheel, at);
            CAPTURE(angle, yaw);
            REQUIRE((found.size() == 1 && found[0].status == Status::ok));
            const double R = touch.rolling_radius / slope, a = std::sqrt(1.1 * R * depth),
                         b = std::sqrt(1.1 * crown * depth),
                         p_0 = depth / (wheel.compliance() * b * detail::EllipticIntegrals(b / a).K);
            CHECK(std::abs(found[0].angle - touch.angle) < 1e-3);
            CHECK(std::abs(found[0].y - touch.y) < 5e-5);
            CHECK(std::abs(found[0].z - touch.z) < 2e-5);
            CHECK(std::abs(found[0].approach / depth - 1) < 1e-3);
            CHECK(std::abs(found[0].half_length / a - 1) < 2e-3);
            CHECK(std::abs(found[0].half_width / b - 1) < 2e-3);
            CHECK(std::abs(found[0].area / (std::numbers::pi * a * b) - 1) < 4e-3);
            CHECK(std::abs(found[0].peak_pressure / p_0 - 1) < 2e-3);
            CHECK(std::abs(found[0].load / (2 * std::numbers::pi / 3 * a * b * p_0) - 1) < 5e-3);
        }
    }
}

TEST_CASE("virtual_penetration: deepest places aside from the middle lie on the rail", "[penetration]") {
    const WheelOnRail wheel(s1002(), rail_60e1());
    const WheelOnRail::Geometry& geometry = wheel.geometry();
    for (const double lateral : {1e-3, 5e-3, 7e-3}) {
        const double touch = rigid_contact(wheel, {.lateral = lateral}).height;
        for (const VirtualPenetration& found :
             virtual_penetration(wheel, {.lateral = lateral, .height = touch + 1.2e-4})) {
            REQUIRE(found.status == Status::ok);
            const auto samples = detail::rail_samples(geometry, 0);
            const auto nearest =
                std::min_element(samples.begin(), samples.end(), [&](const auto& one, const auto& two) {
                    return std::hypot(one.y - found.y, one.z - found.z) < std::hypot(two.y - found.y, two.z - found.z);
                });
            CAPTURE(lateral, found.y, found.z);
            CHECK(std::abs(detail::closest_on_rail(geometry, nearest->s, 0, found.y, found.z).depth) < 1e-7);
        }
    }
}

TEST_CASE("virtual_penetration: a wheel that cannot be placed says why", "[penetration]") {
    const WheelOnRail wheel(s1002(), rail_60e1());
    WheelOnRail::Workspace workspace;
    for (const WheelsetPosition& at : {WheelsetPosition{.lateral = -3e-3, .height = 2e-3},
                                       {.lateral = -3e-3, .height = 2e-2},
                                       {.yaw = 1},
                                       {.lateral = std::nan("")},
                                       {.height = std::nan("")},
                                       {.lateral = 1}}) {
        const auto found = virtual_penetration(wheel, at);
        CAPTURE(at.lateral, at.height, at.yaw);
        REQUIRE(found.size() == 1);
        CHECK(found[0].status == wheel.solve_at_height(at, workspace, {}).status);
        CHECK((!has_numbers(found[0].status) && found[0].load == 0));
    }
    CHECK(virtual_penetration(wheel, {.height = -1e-6}).empty());
}

}  // namespace
}  // namespace virtual_penetration_tests
