// rollbem/vehicle/wheelset_on_track.hpp, normal/wheel_on_rail.hpp
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <rollbem/normal/profile.hpp>
#include <rollbem/vehicle/wheelset_on_track.hpp>

#include "support/catch.hpp"
#include "support/observed_order.hpp"
#include "support/refusal.hpp"

namespace equivalent_conicity_tests {
namespace {

using namespace rollbem;
using Catch::Matchers::ContainsSubstring;
using Difference = WheelsetOnTrack::RadiusDifference;

constexpr double rail_y = 0.75, radius = 0.46;

/// A piece z(y) over |y| <= half.
template <class Height>
Profile piece(double half, const Height& height) {
    const Eigen::ArrayXd y = Eigen::ArrayXd::LinSpaced(401, -half, half);
    return {y, y.unaryExpr(height), Profile::Use::piece};
}

/// An arc about a centre below it; its lowest point in z, which is down, at (apex, 0).
Profile arc(double half, double R, double apex = 0) {
    return piece(half, [=](double y) { return R - std::sqrt(R * R - (y - apex) * (y - apex)); });
}
Profile cone(double gamma) {
    return piece(0.06, [=](double y) { return -gamma * y; });
}

WheelOnRail on_track(const Profile& wheel, const RailSurface& rail, double r0 = radius) {
    return {wheel, rail, {.radius = r0, .rail_origin = WheelOnRail::Dimensions::Origin{rail_y, 0}}};
}

/// Delta r by a formula over |y| <= 10 mm.
template <class Function>
Difference formula(const Function& function) {
    const Eigen::ArrayXd y = Eigen::ArrayXd::LinSpaced(20001, -0.01, 0.01);
    return {y, y.unaryExpr(function), 1.5, radius};
}

TEST_CASE("equivalent_conicity: cones on round rails have their own conicity and Klingel's wave", "[conicity]") {
    const double gamma = 0.05, R = 0.3;
    const WheelsetOnTrack wheelset(on_track(cone(gamma), arc(0.03, R)));
    const WheelsetOnTrack::RollingRadii centred = rolling_radii(wheelset, 0);
    REQUIRE(centred.status == Status::ok);
    const double place = -R * std::sin(std::atan(gamma));  // where the rail has the cone's slope
    for (const WheelOnRail::RigidContact& contact : centred.wheels) {
        CHECK(std::abs(contact.rail_y - place) < 1e-8);
        CHECK(std::abs(contact.angle + std::atan(gamma)) < 1e-8);
        CHECK(std::abs(contact.rolling_radius - (radius - gamma * place)) < 1e-9);
    }
    const auto radii = radius_difference(wheelset);
    REQUIRE(radii);
    for (const double amplitude : {1e-4, 1e-3, 3e-3, 8e-3}) {
        const Difference::Conicity wave = equivalent_conicity(*radii, amplitude);
        CAPTURE(amplitude, name(wave.status));
        REQUIRE(wave.status == Status::ok);
        CHECK(std::abs(wave.tan_gamma / gamma - 1) < 1e-4);
        CHECK(std::abs(wave.tan_gamma_linear / gamma - 1) < 1e-4);
        const double apart = 2 * (rail_y + place), r0 = radius - gamma * place,
                     klingel = 2 * std::numbers::pi * std::sqrt(apart / 2 * r0 / gamma);
        CHECK(std::abs(wave.wavelength / klingel - 1) < 1e-4);
        CHECK(std::abs(wave.y_max + wave.y_min) < 1e-6);
        CHECK(std::abs(wave.y_max - wave.y_min - 2 * amplitude) < 1e-12);
    }
    CHECK(std::abs(*conicity_nonlinearity(*radii)) < 1e-3);
}

TEST_CASE("equivalent_conicity: hollow round wheels on round rails turn as their radii say", "[conicity]") {
    // Centres lie apart by R_w - R_r: sin delta is their lateral distance over that, Delta r = R_w (cos - cos).
    const double R_w = 0.45, R_r = 0.3, lateral = 4e-3;
    const WheelsetOnTrack wheelset(on_track(arc(0.03, R_w, lateral), arc(0.03, R_r)));
    const auto tilt = [&](double y) { return -std::asin((lateral + y) / (R_w - R_r)); };
    for (const double y : {-4e-3, -1e-3, 0.0, 5e-4, 2e-3}) {
        const WheelsetOnTrack::RollingRadii radii = rolling_radii(wheelset, y);
        CAPTURE(y, name(radii.status));
        REQUIRE(radii.status == Status::ok);
        CHECK(std::abs(radii.wheels[1].angle - tilt(y)) < 1e-8);
        CHECK(std::abs(radii.wheels[0].angle - tilt(-y)) < 1e-8);
        CHECK(std::abs(radii.difference() - R_w * (std::cos(tilt(-y)) - std::cos(tilt(y)))) < 1e-10);
        CHECK(std::abs(radii.difference() + rolling_radii(wheelset, -y).difference()) < 1e-15);
    }
    const auto radii = radius_difference(wheelset);
    REQUIRE(radii);
    const Difference::Conicity wave = equivalent_conicity(*radii, 1e-4);
    REQUIRE(wave.status == Status::ok);
    const double expected = R_w / (R_w - R_r) * std::tan(-tilt(0));
    CHECK(std::abs(wave.tan_gamma / expected - 1) < 1e-5);
    CHECK(std::abs(wave.tan_gamma_linear / expected - 1) < 1e-5);
}

TEST_CASE("equivalent_conicity: a smaller wheel shifts the wave, not the conicity of cones", "[conicity]") {
    const double gamma = 0.05, less = 5e-4;
    const Profile rail = arc(0.03, 0.3);
    const WheelsetOnTrack wheelset(on_track(cone(gamma), rail, radius - less), on_track(cone(gamma), rail));
    const auto radii = radius_difference(wheelset);
    REQUIRE(radii);
    const Difference::Conicity wave = equivalent_conicity(*radii, 3e-3);
    REQUIRE(wave.status == Status::ok);
    // the right one is larger: rolling straight, the wheelset stands to the left
    CHECK(std::abs((wave.y_min + wave.y_max) / 2 + less / (2 * gamma)) < 1e-7);
    CHECK(std::abs(wave.tan_gamma / gamma - 1) < 1e-6);
}

TEST_CASE("equivalent_conicity: a mirrored wheelset has the same wave, also where the contact jumps", "[conicity]") {
    const auto wave = [](double left, double right) {
        const WheelOnRail one(s1002(), rail_60e1(), {.radius = left}), two(s1002(), rail_60e1(), {.radius = right});
        return equivalent_conicity(radius_difference(WheelsetOnTrack(one, two)).value(), 3e-3);
    };
    // Delta r passes 0 where the contact goes over to another place of the rail
    const Difference::Conicity smaller = wave(radius - 1e-4, radius), larger = wave(radius, radius - 1e-4);
    REQUIRE(smaller.status == Status::ok);
    CHECK(std::abs(smaller.wavelength / larger.wavelength - 1) < 1e-7);
    CHECK(std::abs(smaller.y_min + larger.y_max) < 1e-9);
}

TEST_CASE("equivalent_conicity: closed forms of waves with a cubic, a step and nothing", "[conicity]") {
    const double gamma = 0.1, A = 3e-3;
    std::vector<double> inverse, apart;
    for (const double cubic : {2e3, -5e2, 5e3}) {
        const Difference radii = formula([=](double y) { return 2 * (gamma + cubic * y * y) * y; });
        for (const double amplitude : {A, A / 2, A / 4}) {
            // of a Duffing oscillator, by the arithmetic-geometric mean of both terms of the elliptic integral
            double a = std::sqrt(gamma + cubic * amplitude * amplitude / 2),
                   b = std::sqrt(gamma + cubic * amplitude * amplitude);
            for (int k = 0; k < 6; ++k) {
                const double mean = (a + b) / 2;
                b = std::sqrt(a * b);
                a = mean;
            }
            const Difference::Conicity wave = equivalent_conicity(radii, amplitude);
            CAPTURE(cubic, amplitude, wave.tan_gamma, a * a);
            REQUIRE(wave.status == Status::ok);
            CHECK(std::abs(wave.tan_gamma / (a * a) - 1) < 1e-6);
            const double harmonic = gamma + 0.75 * cubic * amplitude * amplitude;
            CHECK(std::abs(wave.tan_gamma_linear / harmonic - 1) < 1e-6);
            if (cubic != 5e3) continue;
            inverse.push_back(1 / amplitude);
            apart.push_back(wave.tan_gamma - wave.tan_gamma_linear);
        }
    }
    // both ways agree to the second order in the amplitude
    const double order = support::observed_order(inverse, apart);
    CAPTURE(order);
    CHECK((order > 3.5 && order < 4.5));

    // the harmonic wave of k y + c y^2 is balanced about m, k m + c m^2 + c A^2/2 = 0
    const double k = 0.2, c = 10, m = (std::sqrt(k * k - 2 * c * c * A * A) - k) / (2 * c);
    const Difference::Conicity bent =
        equivalent_conicity(formula([=](double y) { return 2 * (k * y + c * y * y); }), A);
    CHECK(std::abs(bent.tan_gamma_linear / (k + 2 * c * m) - 1) < 1e-6);

    const double step = 1e-3;
    const Difference::Conicity of_step =
        equivalent_conicity(formula([=](double y) { return y == 0 ? 0 : std::copysign(step, y); }), A);
    CHECK(std::abs(of_step.tan_gamma * 16 * A / (std::numbers::pi * std::numbers::pi * step) - 1) < 1e-3);
    CHECK(std::abs(of_step.tan_gamma_linear * std::numbers::pi * A / (2 * step) - 1) < 1e-3);

    const Difference::Conicity cylinder = equivalent_conicity(formula([](double) { return 0.0; }), A);
    CHECK((cylinder.status == Status::ok && cylinder.tan_gamma == 0 && std::isinf(cylinder.wavelength)));
}

TEST_CASE("equivalent_conicity: what has no wave says why", "[conicity]") {
    const Difference cone_like = formula([](double y) { return 0.1 * y; });
    CHECK(equivalent_conicity(cone_like, 9.9e-3).status == Status::ok);
    CHECK(equivalent_conicity(cone_like, 10.1e-3).status == Status::beyond_clearance);
    // small waves do not pass an equilibrium that repels them, wide ones do
    const Difference falling = formula([](double y) { return 0.2 * y * (y * y / 9e-6 - 1); });
    CHECK(equivalent_conicity(falling, 2e-3).status == Status::unstable);
    CHECK(equivalent_conicity(falling, 6e-3).status == Status::ok);
    CHECK(!conicity_nonlinearity(falling));
    CHECK(equivalent_conicity(formula([](double y) { return -0.1 * y; }), 3e-3).status == Status::unstable);
    // aside, the wave has no room for the amplitude that it has in the middle
    const Difference aside = formula([](double y) { return 0.1 * (y - 4e-3); });
    CHECK(equivalent_conicity(aside, 5e-3).status == Status::ok);
    CHECK(equivalent_conicity(aside, 7e-3).status == Status::beyond_clearance);

    const WheelsetOnTrack real(WheelOnRail(s1002(), rail_60e1()));
    const auto radii = radius_difference(real);
    REQUIRE(radii);
    CHECK(equivalent_conicity(*radii, 8e-3).status == Status::ok);
    for (const double amplitude : {9e-3, 0.012, 0.05}) {
        CHECK(equivalent_conicity(*radii, amplitude).status == Status::beyond_clearance);
    }
    CHECK(rolling_radii(real, 9e-3).status == Status::beyond_clearance);
    CHECK(rolling_radii(real, std::nan("")).status == Status::not_finite);
    // an outer end face is no flank
    const Profile smooth = s1002();
    const Eigen::Index n = smooth.size();
    Eigen::ArrayXd y(n + 3), z(n + 3);
    y << smooth.y(), 0.062, 0.0622, 0.0624;
    z << smooth.z(), smooth.z()[n - 1] - 3e-3, smooth.z()[n - 1] - 1e-2, smooth.z()[n - 1] - 3e-2;
    CHECK(rolling_radii(WheelsetOnTrack(WheelOnRail(Profile(y, z), rail_60e1())), 8e-3).status == Status::ok);
    const WheelsetOnTrack narrow(on_track(cone(0.05), arc(0.03, 0.3)));
    CHECK(rolling_radii(narrow, 0.09).status == Status::end_of_profile);
    CHECK(!radius_difference(WheelsetOnTrack(WheelOnRail(s1002(), rail_60e1(), {.gauge = 1.41}))));

    for (const double amplitude : {0.0, 1e-8, 9.9e-7, std::nan(""), std::numeric_limits<double>::infinity()}) {
        CHECK_THAT(refusal([&] { equivalent_conicity(cone_like, amplitude); }),
                   ContainsSubstring("must be positive and finite, and at least 1e-6 m"));
    }
    CHECK(std::abs(equivalent_conicity(cone_like, 1e-6).tan_gamma / 0.05 - 1) < 1e-5);
    // an outer chamfer of a tread without a flange is no flank
    const Profile chamfered =
        piece(0.06, [](double across) { return -0.05 * across - 2 * std::max(across - 0.04, 0.0); });
    CHECK(rolling_radii(WheelsetOnTrack(on_track(chamfered, arc(0.03, 0.3))), 0).status == Status::ok);
    CHECK_THAT(refusal([&] { radius_difference(real, 1); }), ContainsSubstring("step = 1 must lie in [1e-6, 1e-3]"));
    CHECK_THAT(refusal([&] { Difference(Eigen::ArrayXd::Zero(2), Eigen::ArrayXd::Zero(2), 1.5, radius); }),
               ContainsSubstring("lateral = 0 must exceed the one before it"));
    const WheelOnRail on_roller = on_track(cone(0.05), RailSurface::roller(arc(0.03, 0.3), 0.5));
    CHECK_THAT(refusal([&] { rigid_contact(on_roller, {}); }), ContainsSubstring("a round wheel on a straight rail"));
}

TEST_CASE("rigid_contact: what it does not use may be no number", "[conicity]") {
    const WheelOnRail wheel(s1002(), rail_60e1());
    const double none = std::nan("");
    const WheelOnRail::RigidContact contact = rigid_contact(wheel, {.lateral = 2e-3, .yaw = 5e-3}),
                                    same = rigid_contact(
                                        wheel,
                                        {.lateral = 2e-3, .height = none, .yaw = 5e-3, .along = none, .pitch = none});
    REQUIRE((contact.status == Status::ok && same.status == Status::ok));
    CHECK((same.height == contact.height && same.y == contact.y && same.rolling_radius == contact.rolling_radius));
    for (const WheelsetPosition& at : {WheelsetPosition{.lateral = none}, {.roll = none}, {.yaw = none}}) {
        CHECK(rigid_contact(wheel, at).status == Status::not_finite);
    }
}

TEST_CASE("rigid_contact: where a vanishing load is carried, also rolled and yawed", "[conicity]") {
    const WheelOnRail wheel(s1002(), rail_60e1());
    WheelOnRail::Workspace workspace;
    for (const WheelsetPosition& at : {WheelsetPosition{.lateral = -3e-3},
                                       {.lateral = 4e-3},
                                       {.lateral = 2e-3, .roll = 2e-3, .yaw = 5e-3},
                                       {.lateral = 7.2e-3}}) {
        const WheelOnRail::RigidContact rigid = rigid_contact(wheel, at);
        const WheelOnRail::Contact loaded = wheel.solve_for_load(at, 1, workspace);
        CAPTURE(at.lateral, name(rigid.status), name(loaded.status));
        REQUIRE((rigid.status == Status::ok && has_numbers(loaded.status)));
        const RailPatch& patch = loaded.patches[0];
        CHECK(std::abs(rigid.height + patch.approach / std::cos(patch.angle) - loaded.height) < 5e-9);
        CHECK(std::abs(rigid.x - patch.x) < 2e-5);
        CHECK(std::abs(rigid.y - patch.y) < 2e-5);
        CHECK(std::abs(rigid.z - patch.z) < 2e-5);
        CHECK(std::abs(rigid.rail_y - patch.rail_y) < 2e-5);
        CHECK(std::abs(rigid.wheel_y - patch.wheel_y) < 2e-5);
        CHECK(std::abs(rigid.angle - patch.angle) < 1e-3);
        CHECK(std::abs(rigid.rolling_radius - patch.rolling_radius) < 1e-5);
    }
}

}  // namespace
}  // namespace equivalent_conicity_tests
