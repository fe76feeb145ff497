// rollbem/scene/patch_contact.hpp, HertzEllipse::along_rolling: what takes the place of a turned ellipse in patches.
#include <cmath>
#include <numbers>

#include <rollbem/normal/hertz.hpp>
#include <rollbem/scene/patch_contact.hpp>

#include "support/catch.hpp"
#include "support/refusal.hpp"

namespace turned_axes_tests {

using namespace rollbem;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double load = 8e4, nu = 0.28, c = 5e-3, pi = std::numbers::pi;

SemiAxes axes_of(double a_over_b) { return {c * std::sqrt(a_over_b), c / std::sqrt(a_over_b)}; }

/// A wheel and a rail whose planes are turned by a yaw.
HertzEllipse with_yaw(double yaw, double rail = 0.3) {
    const ElasticBody steel{2.1e11, nu};
    return HertzEllipse(
        {.load = load, .radii_1 = {0.46, -1}, .radii_2 = {1e9, rail}, .angle = yaw, .body_1 = steel, .body_2 = steel});
}

}  // namespace

TEST_CASE("turned_axes: extents of the turned ellipse along the new axes, and its area") {
    for (const double a_over_b : {0.1, 0.5, 1.0, 3.0, 10.0}) {
        const SemiAxes axes = axes_of(a_over_b);
        CHECK(rolling_ellipse(axes, 0.0).axes == axes);
        for (const double turn : {-0.7, 0.01, 0.4, 1.3, pi / 2}) {
            CAPTURE(a_over_b, turn);
            const auto [a, b] = rolling_ellipse(axes, turn).axes;
            CHECK_THAT(a * b, WithinRel(c * c, 1e-14));
            const auto extent = [&](double by_a, double by_b) {
                return std::hypot(by_a * axes.half_length, by_b * axes.half_width);
            };
            CHECK_THAT(a / b, WithinRel(extent(std::cos(turn), std::sin(turn)) / extent(std::sin(turn), std::cos(turn)),
                                        1e-13));
        }
    }
}

TEST_CASE("turned_axes: contacts and loads of patches take a turned ellipse by along_rolling") {
    const HertzEllipse turned = with_yaw(0.02), along = turned.along_rolling();
    REQUIRE(std::abs(turned.turn()) > 0.01);
    CHECK_THAT(refusal([&] { (void)turned.contact(); }), ContainsSubstring("along_rolling"));
    CHECK(along.turn() == 0);
    CHECK_THAT(along.peak_pressure(), WithinRel(turned.peak_pressure(), 1e-14));
    CHECK(along.approach() == turned.approach());
    const SemiAxes expected = rolling_ellipse({turned.half_length(), turned.half_width()}, turned.turn()).axes;
    const PatchContact contact = along.contact();
    CHECK(contact.half_length() == expected.half_length);
    CHECK(contact.half_width() == expected.half_width);
    const HertzEllipse straight = with_yaw(0);
    CHECK(straight.along_rolling().half_length() == straight.half_length());
    CHECK(straight.along_rolling().half_width() == straight.half_width());

    const PatchMesh<double> mesh = patch_mesh(contact, 6, 6);
    CHECK_THAT(refusal([&] { HertzEllipse::Load::breathing(turned, contact, mesh); }),
               ContainsSubstring("along_rolling"));
    const auto hertz = HertzEllipse::Load::breathing(along, contact, mesh);
    NormalLoad now = hertz.at(load);
    CHECK(hertz.set(with_yaw(0.03), now) == Status::invalid_load);
    CHECK(hertz.set(with_yaw(0.03).along_rolling(), now) == Status::ok);
    CHECK(now.half_length == with_yaw(0.03).along_rolling().half_length());

    // a nearly round ellipse may be turned far, but remains nearly round, to the second order
    const HertzEllipse round = with_yaw(1e-3, 1 / (1 + 1 / 0.46));
    REQUIRE(std::abs(round.turn()) > 0.7);
    CHECK(std::abs(round.half_length() / round.half_width() - 1) > 5e-4);
    CHECK_THAT(round.along_rolling().contact().a_over_b(), WithinAbs(1, 1e-5));
}

}  // namespace turned_axes_tests
