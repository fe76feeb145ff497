// rollbem/vehicle/wheelset_forces.hpp, rail_friction.hpp, and friction of a patch with both
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <rollbem/normal/profile.hpp>
#include <rollbem/normal/wheel_on_rail.hpp>
#include <rollbem/vehicle/wheelset_forces.hpp>
#include <rollbem/vehicle/wheelset_on_track.hpp>

#include "support/catch.hpp"
#include "support/refusal.hpp"
#include "vehicle/hertz_patch.hpp"

namespace flash_temperature_tests {

using namespace rollbem;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double a = 5.88e-3, b = 10.54e-3, load = 1e5, radius = 0.46, mu = 0.3;

RailPatch ellipse() { return testing::hertz_patch(a, b, load); }

constexpr double slide = 1;  // [m/s]
PatchForce sliding(const RollingFriction& friction, double speed = 30) {
    const WheelsetSpeeds speeds{.forward = speed - slide / 2, .pitch_rate = -(speed + slide / 2) / radius};
    return patch_force(ellipse(), {}, speeds, WheelOnRail::Dimensions{}, friction);
}

}  // namespace

TEST_CASE("A band of uniform heat is as hot as Carslaw and Jaeger say, however it is parted", "[profiles]") {
    const RollingFriction::Heating heating;
    const double heat = 1e8, speed = 20;
    const Eigen::ArrayXd places{{-a, -a / 2, a / 3, a, 2 * a}};
    const auto of = [&](const Eigen::ArrayXd& edges) {
        return flash_temperature(edges, Eigen::ArrayXd::Constant(edges.size() - 1, heat), places, speed, heating);
    };
    const Eigen::ArrayXd whole = of(Eigen::ArrayXd{{-a, a}}), parts = of(Eigen::ArrayXd{{-a, -a / 2, 0.1 * a, a}});
    for (Eigen::Index k = 0; k < places.size(); ++k) {
        const double ahead = std::max(a - places[k], 0.0);
        const double expected = heat * std::sqrt(heating.diffusivity() * ahead / (std::numbers::pi * speed)) / 50;
        CHECK_THAT(whole[k], WithinRel(expected, 1e-12));
        CHECK_THAT(parts[k], WithinRel(expected, 1e-12));
    }
}

TEST_CASE("A sliding ellipse is as hot as the integral over its middle strip", "[profiles]") {
    const RollingFriction::Heating heating;
    const PatchForce found = sliding({.coefficient = mu, .elements = 30, .strips = 9, .heating = heating});
    REQUIRE(found.status == Status::ok);
    CHECK_THAT(found.slip_work * 30, WithinRel(mu * load * slide, 3e-3));
    // heat of rigid slip; the heat of elastic surfaces differs by the strain, which is small beside the creepage
    constexpr double shape = 2.1884;  // the largest integral of sqrt(1 - u^2)/sqrt(u - x) over u from x to 1
    const double heat = mu * slide * ellipse().peak_pressure;
    CHECK_THAT(found.peak_temperature,
               WithinRel(heat / 2 * shape * std::sqrt(heating.diffusivity() * a / (std::numbers::pi * 30)) / 50, 0.03));
    CHECK(std::isnan(sliding({.coefficient = mu}).peak_temperature));
}

TEST_CASE("A band of uniform pressure is hottest at its trailing edge", "[profiles]") {
    RailPatch band = ellipse();
    const Eigen::ArrayXd ends = Eigen::ArrayXd::Constant(2, a);
    band.outline.emplace(Eigen::ArrayXd{{-b, b}}, -ends, ends);
    band.pressure.setConstant(band.peak_pressure);
    band.load = 4 * a * b * band.peak_pressure;
    const RollingFriction::Heating heating;
    const PatchForce found =
        patch_force(band, {}, {.forward = 29.5, .pitch_rate = -30.5 / radius}, WheelOnRail::Dimensions{},
                    {.coefficient = mu, .elements = 2, .strips = 5, .heating = heating});
    REQUIRE(found.status == Status::ok);
    const double heat = mu * slide * band.peak_pressure;
    CHECK_THAT(found.peak_temperature,
               WithinRel(heat * std::sqrt(heating.diffusivity() * 2 * a / (std::numbers::pi * 30)) / 50, 0.04));
}

TEST_CASE("Friction that depends on the temperature agrees with it", "[profiles]") {
    RollingFriction friction{.coefficient = mu, .elements = 10, .strips = 7, .heating = RollingFriction::Heating{}};
    const PatchForce cold = sliding(friction);
    const auto with = [&](RollingFriction::Heating::Friction hot) {
        friction.heating->friction = hot;
        return sliding(friction);
    };
    // never reached, and reached at once
    const PatchForce same = with({0.1, 2000, 3000}), low = with({0.1, 0, 1e-6});
    CHECK(same.force.longitudinal == cold.force.longitudinal);
    CHECK_THAT(low.force.longitudinal, WithinRel(0.1 * load, 1e-6));
    CHECK_THAT(low.peak_temperature, WithinRel(cold.peak_temperature / 3, 0.03));
    // heat, and so the temperature, is in proportion to friction: T = mu(T)/mu T_cold where all is as warm as the peak
    const PatchForce falling = with({0.1, 0, 300});
    REQUIRE(falling.status == Status::ok);
    CHECK(falling.force.longitudinal < cold.force.longitudinal);
    CHECK(falling.force.longitudinal > low.force.longitudinal);
    const double steep = 200.0 / 300 / mu * 1e-3 * cold.peak_temperature;
    CHECK(falling.peak_temperature > cold.peak_temperature / (1 + steep));
    CHECK(falling.peak_temperature < cold.peak_temperature);
}

TEST_CASE("Heat that flows along the contact has no temperature", "[profiles]") {
    RollingFriction friction{.coefficient = mu, .elements = 8, .strips = 7, .heating = RollingFriction::Heating{}};
    const double slow = 9 * friction.heating->diffusivity() / a;
    const WheelsetSpeeds speeds{.forward = slow * 0.99, .pitch_rate = -slow * 1.01 / radius};
    const auto of = [&] { return patch_force(ellipse(), {}, speeds, WheelOnRail::Dimensions{}, friction); };
    CHECK(of().status == Status::ok);
    CHECK(std::isnan(of().peak_temperature));
    friction.heating->friction = {0.1, 0, 100};
    CHECK(of().status == Status::not_converged);
    CHECK(std::isnan(of().force.longitudinal));
    CHECK(of().strip_work.size() == 0);
    // nor has a wheel that slides on one place of its own
    friction.heating->friction.reset();
    for (const double creepage : {0.15, 0.3}) {
        const WheelsetSpeeds slips{.forward = 30 * (1 - creepage / 2), .pitch_rate = -30 * (1 + creepage / 2) / radius};
        const PatchForce found = patch_force(ellipse(), {}, slips, WheelOnRail::Dimensions{}, friction);
        CHECK(std::isnan(found.peak_temperature) == (creepage > 0.2));
    }
}

TEST_CASE("Friction and heating that cannot be meant are refused", "[profiles]") {
    const auto why = [](const RollingFriction& friction) { return refusal([&] { sliding(friction); }); };
    const auto heated = [&](const RollingFriction::Heating& heating) { return why({.heating = heating}); };
    const auto hot = [&](const RollingFriction::Heating::Friction& of) { return heated({.friction = of}); };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THAT(why({.coefficient = -1}), ContainsSubstring("coefficient = -1 must be finite and not negative"));
    CHECK_THAT(why({.layer = nan}), ContainsSubstring("layer = nan"));
    CHECK_THAT(why({.layer = -1}), ContainsSubstring("layer = -1"));
    CHECK_THAT(heated({.conductivity = 0}), ContainsSubstring("conductivity = 0"));
    CHECK_THAT(heated({.heat_capacity = -3.5e6}), ContainsSubstring("heat_capacity = -3500000"));
    CHECK_THAT(hot({-0.1, 0, 30}), ContainsSubstring("hot coefficient = -0.1"));
    CHECK_THAT(hot({0.1, 300, 20}), ContainsSubstring("end of hot friction = 20 must lie above its begin"));
}

TEST_CASE("Places on a rail below a patch lie on its profile", "[profiles]") {
    const WheelOnRail wheel(s1002(), rail_uic60());
    WheelsetOnTrack::Workspace workspace;
    for (const double lateral : {5e-3, 6.8e-3}) {
        const auto contacts = WheelsetOnTrack(wheel).solve({.lateral = lateral}, {1e5, 1e5}, workspace);
        const RailPatch& patch = contacts.wheels[1].patches.at(0);
        REQUIRE(patch.has_numbers());
        for (Eigen::Index row = 0; row < patch.grid.ny; ++row) {
            const double s = patch.grid.y(row);
            if (s < patch.outline->low() || s > patch.outline->high()) continue;
            // from the place in the plane down to the profile along its normal
            double along = patch.rail_s + s;
            for (int k = 0; k < 20; ++k) {
                const RailSurface::Point rail = wheel.geometry().rail_at(along, 0);
                const double apart =
                    (rail.y - patch.y) * std::cos(patch.angle) + (rail.z - patch.z) * std::sin(patch.angle);
                along += (s - apart) / (rail.slope[0] * std::cos(patch.angle) + rail.slope[1] * std::sin(patch.angle));
            }
            const RailSurface::Point rail = wheel.geometry().rail_at(along, 0);
            CHECK_THAT(patch.surface_y(s) - patch.rail_y, WithinAbs(rail.y - patch.y, 2e-5));
            const double angle = std::atan2(rail.slope[1], rail.slope[0]);
            CHECK_THAT(patch.surface_angle(s), WithinAbs(angle, 0.02));
            CHECK_THAT(patch.angle + std::atan(patch.rail_slope[row]), WithinAbs(angle, 1e-6));
        }
    }
}

TEST_CASE("Each strip of a patch has the rail's friction", "[profiles]") {
    using enum RollingFriction::OnRail::Over;
    const auto with = [](const RollingFriction::OnRail& rail) {
        return sliding({.coefficient = 9, .elements = 10, .strips = 15, .rail = rail});
    };
    const PatchForce constant = sliding({.coefficient = mu, .elements = 10, .strips = 15}),
                     same = with({angle, {0}, {mu}}), linear = with({y, {-b, b}, {0, 2 * mu}});
    CHECK(same.force.longitudinal == constant.force.longitudinal);
    // a level patch: all has one angle, and mu over y as its mean and a moment, b^2/5 of Hertz's pressures
    CHECK(with({angle, {-0.1, 0.1}, {0, 2 * mu}}).force.longitudinal == constant.force.longitudinal);
    CHECK_THAT(linear.force.longitudinal, WithinRel(mu * load, 1e-4));
    CHECK_THAT(linear.force.moment, WithinRel(-mu * load * b / 5, 0.02));
    CHECK(with({y, {-1, 1}, {0, 0}}).force.longitudinal == 0.0);
}

TEST_CASE("Friction over a rail is linear between its nodes", "[profiles]") {
    using enum RollingFriction::OnRail::Over;
    const RollingFriction::OnRail rail(angle, {0.1, 0.3}, {0.4, 0.1});
    CHECK(rail.at(0, 9) == 0.4);
    CHECK_THAT(rail.at(0.2, 9), WithinAbs(0.25, 1e-15));
    CHECK(rail.at(0.5, 9) == 0.1);
    CHECK_THAT(refusal([] { RollingFriction::OnRail(y, {}, {}); }), ContainsSubstring("number of nodes = 0"));
    CHECK_THAT(refusal([] { RollingFriction::OnRail(y, {1, 1}, {0, 0}); }), ContainsSubstring("node = 1"));
    CHECK_THAT(refusal([] { RollingFriction::OnRail(y, {1}, {-1}); }), ContainsSubstring("coefficient = -1"));
}

}  // namespace flash_temperature_tests
