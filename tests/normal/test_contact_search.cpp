// rollbem/normal/wheel_on_rail.hpp, normal/surface.hpp, normal/detail/: contacts of real surfaces
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <rollbem/normal/hertz.hpp>
#include <rollbem/normal/profile.hpp>
#include <rollbem/normal/wheel_on_rail.hpp>
#include <rollbem/normal/detail/patch_shape.hpp>
#include <rollbem/normal/detail/region_solver.hpp>
#include <rollbem/normal/detail/sufficient_cells.hpp>

#include "extremes/deformed_gap.hpp"
#include "support/catch.hpp"
#include "support/refusal.hpp"

using namespace rollbem;
using Catch::Matchers::ContainsSubstring;
using extremes::least_gap, extremes::RailPoints;

namespace {

constexpr double pi = std::numbers::pi;

/// z(y) at `count` equidistant y.
Profile piece(double from, double to, Eigen::Index count, const std::function<double(double)>& z) {
    const Eigen::ArrayXd y = Eigen::ArrayXd::LinSpaced(count, from, to);
    return {y, y.unaryExpr(z), Profile::Use::piece};
}
/// Through points y, z [mm].
Profile polygon(const std::vector<std::array<double, 2>>& points) {
    Eigen::ArrayXd y(Eigen::Index(points.size())), z(y.size());
    for (Eigen::Index i = 0; i < y.size(); ++i) {
        y[i] = 1e-3 * points[std::size_t(i)][0];
        z[i] = 1e-3 * points[std::size_t(i)][1];
    }
    return {y, z, Profile::Use::piece};
}
const Profile& cylinder() {
    static const Profile of = piece(-0.06, 0.06, 241, [](double) { return 0; });
    return of;
}
/// z of a crown of radius R [m].
double crown(double y, double R) { return R - std::sqrt(R * R - y * y); }
Profile arc(double R = 0.3, double half = 0.03) {
    return piece(-half, half, 401, [R](double y) { return crown(y, R); });
}
/// Two planes that lean by this angle, and what rolls on both.
Profile groove(double angle) {
    const double slope = std::tan(angle);
    return polygon({{-20, -20 * slope}, {-10, -10 * slope}, {0, 0}, {10, -10 * slope}, {20, -20 * slope}});
}
Profile ball(double R) {
    return piece(-0.98 * R, 0.98 * R, 801, [R](double y) { return std::sqrt(R * R - y * y) - R; });
}
/// A side at 1:3 beside a tread, and what lies on the side's part of the rail.
Profile side_and_tread() {
    return piece(-0.05, 0.05, 2001, [](double y) { return y < 0 ? -3 * y : 0; });
}
double beside_tread(double y) { return -3 * y + 6 * std::pow(y + 0.02, 2); }
Sections alike(const Profile& profile, Sections::Interpolation how = Sections::Interpolation::through, double to = 1) {
    return Sections({{-to, profile}, {0, profile}, {to, profile}}, how);
}

const WheelOnRail& s1002_on_uic60() {
    static const WheelOnRail of(s1002(), rail_uic60());
    return of;
}
/// The same rail as a roller of 100 km.
const WheelOnRail& s1002_on_uic60_in_slices() {
    static const WheelOnRail of = [] {
        WheelOnRail::Dimensions dimensions;
        dimensions.rail_origin = s1002_on_uic60().geometry().rail_origin();
        return WheelOnRail(s1002(), RailSurface::roller(rail_uic60(), 1e5), dimensions);
    }();
    return of;
}

/// The wheel's tape circle above the rail's origin.
constexpr WheelOnRail::Dimensions above{.radius = 0.46, .rail_origin = WheelOnRail::Dimensions::Origin{0.75, 0}};

constexpr detail::ContactSettings coarse_cells{
    .cells_x = 24, .cells_s = 16, .tolerance = 1e-6, .cell_size = 0, .interaction = true, .halves_cells = false};

WheelOnRail::Contact under(double load, const WheelOnRail& wheel, const WheelsetPosition& at = {},
                           const WheelOnRail::Options& options = {}) {
    WheelOnRail::Workspace workspace;
    return wheel.solve_for_load(at, load, workspace, options);
}
/// The contact of a wheel above a rail.
WheelOnRail::Contact under(double load, const WheelSurface& wheel, const RailSurface& rail,
                           const WheelsetPosition& at = {}, const WheelOnRail::Options& options = {}) {
    return under(load, WheelOnRail(wheel, rail, above), at, options);
}
WheelOnRail::Contact at_height(double height, const WheelSurface& wheel, const RailSurface& rail,
                               const WheelOnRail::Options& options = {}) {
    WheelOnRail::Workspace workspace;
    return WheelOnRail(wheel, rail, above).solve_at_height({.height = height}, workspace, options);
}
/// Two patches that share the load, this far from the middle of the rail.
void carry_halves(const WheelOnRail::Contact& contact, double load, double tolerance, double apart = 0,
                  double margin = 0) {
    REQUIRE(contact.status == Status::ok);
    REQUIRE(contact.patches.size() == 2);
    for (const RailPatch& patch : contact.patches) {
        CHECK(patch.load == Approx(load / 2).epsilon(tolerance));
        if (apart > 0) CHECK(std::abs(patch.y - 0.75) == Approx(apart).margin(margin));
    }
}

}  // namespace

TEST_CASE("contact_search: contacts part where the depth falls below three quarters of both maxima", "[profiles]") {
    struct Sample {
        double depth, angle;
    };
    // the number of the sample at which they part, all of them if they do not
    const auto parts_at = [](const std::vector<Sample>& of) {
        std::vector<detail::PenetrationSample> samples;
        for (const auto& [depth, angle] : of) {
            samples.push_back(
                {.wheel_s = 0,
                 .x = 0,
                 .y = 0,
                 .z = 0,
                 .closest = {.s = 0, .y = 0, .z = 0, .depth = depth, .slope = {1, -std::tan(angle)}, .inside = true},
                 .width = 1});
        }
        return detail::find_split(samples.begin(), samples.end()) - samples.begin();
    };
    const auto two = [&](double second, double angle) {
        return parts_at({{0, 0}, {1, 0}, {0.5, angle}, {second, angle}, {0, angle}});
    };
    CHECK(two(0.7, 0.45) == 2);
    CHECK(two(0.6, 0.45) == 5);  // 0.5 is more than three quarters of the lesser maximum
    CHECK(two(0.7, 0.3) == 5);   // normals less than 20 degrees apart
    // of several such minima at the lowest
    CHECK(parts_at({{0, 0}, {1, 0}, {0.3, 0.5}, {1, 0.5}, {0.5, 1}, {1, 1}, {0, 1}}) == 2);
    CHECK(parts_at({{0, 0}, {1, 0}, {0.5, 0.5}, {1, 0.5}, {0.3, 1}, {1, 1}, {0, 1}}) == 4);
}

TEST_CASE("contact_search: a region whose samples all lie above each other has a plane", "[profiles]") {
    detail::Region wall;
    for (const double z : {2e-3, 3e-3, 4e-3}) {
        wall.samples.push_back(
            {.wheel_s = 0,
             .x = 1e-3,
             .y = 0.75,
             .z = z,
             .closest = {.s = 0.02, .y = 0.75, .z = z, .depth = 1e-5, .slope = {0, 1}, .inside = true},
             .width = 0});
    }
    const WheelOnRail wheel(cylinder(), polygon({{-20, 0}, {0, 0}, {0, 20}, {10, 20}}), above);
    const detail::ContactPlane plane = detail::plane_of(wheel.geometry(), wall, 0);
    CHECK(plane.x == Approx(1e-3));
    CHECK(plane.angle == Approx(pi / 2));
}

TEST_CASE("contact_search: two crowns carry half of the load each, and displace each other", "[profiles]") {
    const Profile crowns = piece(-0.05, 0.05, 401, [](double y) { return std::pow(std::abs(y) - 0.03, 2) / 0.6; });
    const RailSurface plain = crowns, of_sections = alike(crowns, Sections::Interpolation::spline);
    for (const auto& [rail, interaction, height] :
         {std::tuple(&plain, true, 0.068489e-3), {&plain, false, 0.066161e-3}, {&of_sections, true, 0.068489e-3}}) {
        CAPTURE(rail->has_sections(), interaction);
        const auto contact = under(1e5, cylinder(), *rail, {}, {.interaction = interaction});
        carry_halves(contact, 1e5, 1e-4, 0.03, 1e-5);
        CHECK(contact.height == Approx(height).epsilon(1e-3));
    }
}

TEST_CASE("contact_search: a stretch of rail beyond a dent, and on both sides of a groove", "[profiles]") {
    // y falls by 0.1 um on the way from one crown to the other
    std::vector<std::array<double, 2>> dented, grooved;
    for (int k = -500; k <= 500; ++k) {
        const double y = 0.1 * k, z = std::pow(std::abs(y) - 30, 2) / 600;
        dented.push_back({y, z});
        if (k == -100) dented.push_back({y - 1e-4, z - 0.03});
        if (std::abs(y) < 10) continue;
        grooved.push_back({y, z});
        if (k != -100) continue;
        for (const auto& [wall, depth] :
             {std::pair{-9.9, 8.0}, {-9.5, 30.0}, {-8.0, 36.0}, {8.0, 36.0}, {9.5, 30.0}, {9.9, 8.0}})
            grooved.push_back({wall, depth});
    }
    for (const auto& points : {dented, grooved}) carry_halves(under(1e5, cylinder(), polygon(points)), 1e5, 1e-3);
}

TEST_CASE("contact_search: the back of a flange at a guard rail with a vertical face", "[profiles]") {
    // the running rail's crown, and beside the flange's back a guard rail with a rounded edge of 5 mm
    std::vector<std::array<double, 2>> points{{-130, -20}};
    for (int k = 0; k <= 45; ++k) {
        const double angle = pi / 2 * k / 45;
        points.push_back({-84.6 + 5 * std::sin(angle), -15 - 5 * std::cos(angle)});
    }
    for (const auto& [y, z] : {std::pair{-79.6, 0.0}, {-79.6, 40.0}, {-40.0, 41.0}, {-38.0, 20.0}, {-36.0, 5.0}})
        points.push_back({y, z});
    for (int k = -60; k <= 60; ++k) points.push_back({0.5 * k, k * k * 0.25 / 600});
    // S1002 with the back of its flange
    const Profile front = s1002();
    std::vector<std::array<double, 2>> whole;
    for (int k = 0; k < 20; ++k) whole.push_back({1e3 * front.y()[0] - 0.05, -20 + 1.4 * k});
    for (Eigen::Index i = 0; i < front.size(); ++i) whole.push_back({1e3 * front.y()[i], 1e3 * front.z()[i]});
    const WheelOnRail wheel(polygon(whole), polygon(points), above);
    WheelOnRail::Workspace workspace;
    // turned, so that the back touches on its rim
    const WheelsetPosition at{.lateral = -8.2e-3, .height = 1e-4, .yaw = 0.01};
    const auto contact = wheel.solve_at_height(at, workspace, {.cells_x = 60});
    CAPTURE(name(contact.status), contact.patches.size());
    REQUIRE(has_numbers(contact.status));
    REQUIRE(contact.patches.size() >= 2);
    const auto guard = std::max_element(contact.patches.begin(), contact.patches.end(),
                                        [](const auto& one, const auto& two) { return one.angle < two.angle; });
    CHECK(guard->angle > 1.3);
    CHECK(guard->y < 0.69);
    CHECK(least_gap(wheel, RailPoints(wheel), at, contact) > -1e-6);
}

TEST_CASE("contact_search: a cylinder on a crowned roller: Hertz with both curvatures along x", "[profiles]") {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const ElasticBody steel{2 * above.shear_modulus * 1.28, 0.28};
    for (const double radius : {0.3, 1.0}) {
        const auto contact = under(1e5, cylinder(), RailSurface::roller(arc(), radius));
        CAPTURE(radius);
        REQUIRE(contact.status == Status::ok);
        REQUIRE(contact.patches.size() == 1);
        const RailPatch& patch = contact.patches[0];
        const HertzEllipse hertz(
            {.load = 1e5, .radii_1 = {0.46, infinite}, .radii_2 = {radius, 0.3}, .body_1 = steel, .body_2 = steel});
        CHECK(patch.approach == Approx(hertz.approach()).epsilon(2e-3));
        CHECK(patch.peak_pressure == Approx(hertz.peak_pressure()).epsilon(2e-3));
        CHECK(patch.half_length == Approx(hertz.half_length()).epsilon(4e-3));
        CHECK(patch.half_width == Approx(hertz.half_width()).epsilon(4e-3));
    }
}

TEST_CASE("contact_search: surfaces that do not change along the way are plain ones, far ahead of the axle, too",
          "[profiles]") {
    const Profile tread = piece(-0.06, 0.06, 241, [](double y) { return -y / 20; });
    const RailSurface rails[] = {arc(), RailSurface::roller(arc(), 1e6), alike(arc())};
    const WheelSurface wheels[] = {tread, alike(tread, Sections::Interpolation::through, pi)};
    for (const double yaw : {0.0, -0.3}) {
        const WheelsetPosition at{.lateral = 2e-3, .yaw = yaw, .along = 0.1, .pitch = 1};
        const auto same = under(5e4, tread, arc(), at);
        REQUIRE(same.status == Status::ok);
        for (const RailSurface& rail : rails) {
            for (const WheelSurface& wheel : wheels) {
                const auto contact = under(5e4, wheel, rail, at);
                CAPTURE(yaw, rail.has_sections(), rail.roller_radius(), wheel.is_round(), name(contact.status));
                REQUIRE(contact.patches.size() == 1);
                const RailPatch &one = contact.patches[0], &other = same.patches[0];
                CHECK(contact.height == Approx(same.height).margin(1e-3 * other.approach));
                CHECK(one.x == Approx(other.x).margin(1e-4));
                CHECK(one.y == Approx(other.y).margin(1e-5));
                CHECK(one.load == Approx(other.load).epsilon(1e-4));
                CHECK(one.peak_pressure == Approx(other.peak_pressure).epsilon(3e-3));
            }
        }
    }
}

TEST_CASE("contact_search: a steep side of a wheel that yaws touches far from the axle, of sections, too",
          "[profiles]") {
    const Profile sharp = arc(0.02, 0.0196), side = piece(0.04, 0.16, 241, [](double y) { return 2.5 * y; });
    const WheelOnRail::Dimensions large{.radius = 0.8, .rail_origin = WheelOnRail::Dimensions::Origin{0.75, 0}};
    const WheelsetPosition at{.yaw = 0.18};
    const auto same = under(2e3, {side, sharp, large}, at), contact = under(2e3, {side, alike(sharp), large}, at);
    REQUIRE(same.status == Status::ok);
    REQUIRE(contact.status == Status::ok);
    CHECK(same.patches[0].x < -0.48);
    CHECK(contact.patches[0].x == Approx(same.patches[0].x).margin(1e-4));
    CHECK(contact.height == Approx(same.height).margin(1e-3 * same.patches[0].approach));
}

TEST_CASE("contact_search: curves of a placed wheel lie on its turned surface, with their slopes", "[profiles]") {
    std::vector<Sections::Section> list;
    for (int k = -8; k <= 8; ++k) {
        const double u = 0.1 * k;
        list.push_back(
            {u, piece(-0.06 + 0.02 * u, 0.06, 121, [u](double y) { return 0.01 * std::sin(3 * u) - y / 3; })});
    }
    const WheelsetPosition at{.lateral = 3e-3, .roll = 0.02, .yaw = 0.2, .pitch = 0.15};
    for (const WheelSurface& surface :
         {WheelSurface(list[0].profile), WheelSurface(Sections(list, Sections::Interpolation::through))}) {
        const WheelSurface::Placed placed(surface, 0.75, 0.46, at);
        for (const double ahead : {-0.08, 0.01, 0.12}) {
            const double x = placed.middle_x() + ahead, s = 0.05, h = 1e-6;
            const RailSurface::Point p = placed.section(s, x), before = placed.section(s - h, x),
                                     after = placed.section(s + h, x);
            CAPTURE(surface.is_round(), ahead);
            CHECK(p.slope[0] == Approx((after.y - before.y) / (2 * h)).margin(1e-8));
            CHECK(p.slope[1] == Approx((after.z - before.z) / (2 * h)).margin(1e-8));
            // turned back by roll and yaw
            const double y = p.y - at.lateral, z = p.z + 0.46, across = std::cos(at.roll) * y + std::sin(at.roll) * z,
                         down = std::cos(at.roll) * z - std::sin(at.roll) * y,
                         forward = std::cos(at.yaw) * x + std::sin(at.yaw) * across;
            const WheelSurface::Point same = surface.at(s, std::atan2(forward, down) - at.pitch);
            CHECK(std::hypot(forward, down) == Approx(0.46 + same.z).epsilon(1e-12));
            CHECK(std::cos(at.yaw) * across - std::sin(at.yaw) * x == Approx(0.75 + same.y).epsilon(1e-12));
        }
    }
}

TEST_CASE("contact_search: curves of a roller lie on its turned surface, with their slopes", "[profiles]") {
    const Profile narrow = arc(0.05);
    const RailSurface rail = RailSurface::roller(narrow, 0.4);
    for (const double x : {-0.15, 0.02, 0.1}) {
        const double s = 0.01, h = 1e-6;
        const RailSurface::Point p = rail.at(s, x), before = rail.at(s - h, x), after = rail.at(s + h, x);
        CAPTURE(x);
        CHECK(p.y == narrow.at(s).y);
        CHECK(std::hypot(x, 0.4 - p.z) == Approx(0.4 - narrow.at(s).z).epsilon(1e-14));
        CHECK(p.slope[0] == Approx((after.y - before.y) / (2 * h)).margin(1e-8));
        CHECK(p.slope[1] == Approx((after.z - before.z) / (2 * h)).margin(1e-8));
    }
}

TEST_CASE("contact_search: the gauge is measured where the rail is narrowest, the height from its top", "[profiles]") {
    // an inner side of 13 mm radius by chords of 15 degrees, narrowest between two points, 13 mm below the top
    std::vector<std::array<double, 2>> points;
    for (double angle = 127.5; angle > 0; angle -= 15) {
        points.push_back({-23 - 13 * std::sin(angle * pi / 180), 16 - 13 * std::cos(angle * pi / 180)});
    }
    for (double y = -23; y < 30; y += 5) points.push_back({y, 3});
    const WheelOnRail wheel(cylinder(), polygon(points), {.gauge = 1.435});
    CHECK(wheel.geometry().rail_origin().y == Approx(1.435 / 2 + 0.036).margin(1e-5));
    CHECK(wheel.geometry().rail_origin().z == Approx(-3e-3).margin(5e-5));
}

TEST_CASE("contact_search: a rail without an inner side is refused, with a remedy where its outer side is one",
          "[profiles]") {
    const Profile whole = rail_60e1();
    const auto refused = [&](double from, double to, double sign) {
        std::vector<std::array<double, 2>> points;
        for (Eigen::Index i = 0; i < whole.size(); ++i) {
            if (whole.y()[i] < from || whole.y()[i] > to) continue;
            points.push_back({sign * 1e3 * whole.y()[i], 1e3 * whole.z()[i]});
        }
        return refusal([&] { WheelOnRail(cylinder(), polygon(points)); });
    };
    CHECK(refused(-1, 0.02, 1) == "");
    CHECK_THAT(refused(-1, 0.02, -1), ContainsSubstring("depth of the rail's inner side = ") &&
                                          ContainsSubstring("--rail-mirror y for a left rail, or give rail_origin"));
    CHECK_THAT(refused(-0.02, 0.02, 1), ContainsSubstring("without an inner side give rail_origin"));
}

TEST_CASE("contact_search: a rail of sections is not known beyond its end", "[profiles]") {
    const Sections ended({{-1, arc()}, {0, arc()}}, Sections::Interpolation::through);
    for (const auto& [along, status] : {std::pair{-0.02, Status::ok},
                                        {-0.001, Status::end_of_profile},
                                        {0.001, Status::end_of_profile},
                                        {0.5, Status::no_contact}}) {
        CAPTURE(along);
        CHECK(under(1e4, cylinder(), ended, {.along = along}).status == status);
    }
}

TEST_CASE("contact_search: a contact goes on from one part of a rail to the next, and beside an interruption",
          "[profiles]") {
    // features below the contact, and one beside it that a section lacks; a wing that no wheel is above
    const Profile arc = piece(-0.03, 0.1, 1301, [](double y) { return y < 0.065 ? crown(y, 0.3) : -0.002; });
    const auto same = under(1e4, cylinder(), RailSurface::roller(arc, 1e5));
    REQUIRE(same.status == Status::ok);
    const auto solved = [&](double middle, double beside, double along) {
        const double missing = beside > 0 ? beside : -1;
        std::vector<Sections::Section> list;
        for (const double u : {-0.3, -0.2, 0.1, 0.2, 0.3}) {
            list.push_back({u, arc, {0, u == 0.2 ? missing : 0.01, middle, 0.07, 1}});
        }
        return under(1e4, cylinder(), Sections(list, Sections::Interpolation::through), {.along = along});
    };
    for (const double middle : {0.0295, 0.03, 0.0306}) {
        for (const double beside : {0.01, -1.0}) {
            const auto contact = solved(middle, beside, 0);
            CAPTURE(middle, beside, name(contact.status));
            REQUIRE(contact.status == Status::ok);
            REQUIRE(contact.patches.size() == 1);
            CHECK(contact.height == Approx(same.height).epsilon(1e-4));
            CHECK(contact.patches[0].peak_pressure == Approx(same.patches[0].peak_pressure).epsilon(1e-3));
            CHECK(contact.patches[0].rail_s == Approx(same.patches[0].rail_s).margin(1e-5));
        }
    }
    // where the parts on both sides of the missing feature end, so does what is known of the rail below the wheel
    CHECK(solved(0.02, -1, 0.0985).status == Status::ok);
    CHECK(solved(0.04, -1, 0.0985).status == Status::end_of_profile);
}

TEST_CASE("contact_search: a wheel stands on the chord of its flat", "[profiles]") {
    constexpr double half = 0.05, r = 0.46;  // of the flat's angle
    std::vector<Sections::Section> sections;
    for (int k = -40; k <= 40; ++k) {
        const double angle = 2 * half * k / 40,
                     z = std::abs(angle) < half ? r * (std::cos(half) / std::cos(angle) - 1) : 0;
        sections.push_back({angle, piece(-0.06, 0.06, 61, [z](double) { return z; })});
    }
    const WheelSurface flat{Sections(sections, Sections::Interpolation::through)};
    const auto on_chord = under(1e4, flat, arc());
    REQUIRE(has_numbers(on_chord.status));
    // the cubics between sections round the ends of the chord over about the distance of two sections
    CHECK(on_chord.patches[0].half_length == Approx(r * std::sin(half)).margin(1.3 * r * half / 20));
    CHECK(on_chord.height - on_chord.patches[0].approach == Approx(r * (1 - std::cos(half))).margin(3e-6));
    // the same after a turn, and half a turn of pitch away it is round
    const auto turned = under(1e4, flat, arc(), {.pitch = 2 * pi});
    CHECK(turned.height == Approx(on_chord.height).margin(2e-7));
    const auto beside = under(1e4, flat, arc(), {.pitch = 3}), same = under(1e4, cylinder(), arc());
    REQUIRE(beside.status == Status::ok);
    CHECK(beside.height == Approx(same.height).epsilon(1e-3));
    CHECK(beside.patches[0].area == Approx(same.patches[0].area).epsilon(1e-2));
    // pitched about its middle, on the end of the chord, where the radius is r again
    const auto on_end = under(1e4, flat, arc(), {.pitch = 0.02});
    REQUIRE(on_end.patches.size() == 1);
    CHECK(on_end.patches[0].x == Approx(r * std::sin(0.02 - half)).margin(3e-4));
    CHECK(on_end.patches[0].rolling_radius == Approx(r).margin(3e-5));
}

TEST_CASE("contact_search: a wheel touches a ramp of 1:10 where its slope equals the ramp's", "[profiles]") {
    std::vector<Sections::Section> sections;
    for (const double u : {-0.3, -0.1, 0.0, 0.2, 0.3}) {
        sections.push_back({u, piece(-0.03, 0.03, 201, [u](double y) { return crown(y, 0.3) - 0.1 * u; })});
    }
    const Sections ramp(sections, Sections::Interpolation::through);
    for (const double along : {0.0, 0.03}) {
        const auto contact = under(1e3, cylinder(), ramp, {.along = along});
        CAPTURE(along, name(contact.status));
        REQUIRE(contact.status == Status::ok);
        REQUIRE(contact.patches.size() == 1);
        CHECK(contact.patches[0].x == Approx(0.46 * std::sin(std::atan(0.1))).margin(3e-5));
        CHECK(contact.patches[0].z == Approx(-0.1 * (along + contact.patches[0].x)).margin(1e-8));
        const double touch = 0.46 * (1 - std::sqrt(1.01)) - 0.1 * along;
        CHECK(contact.height - touch == Approx(contact.patches[0].approach).epsilon(0.01));
    }
}

TEST_CASE("contact_search: near contacts whose normals differ by more than 20 degrees have a plane each",
          "[profiles]") {
    // of both sides of a groove, and the radius of a ball in it
    for (const auto& [angle, radius] : {std::pair{pi / 6, 3e-3}, {pi / 11, 3e-3}, {pi / 11, 2.2e-3}}) {
        for (const RailSurface& rail : {RailSurface(groove(angle)), RailSurface(alike(groove(angle)))}) {
            const auto contact = under(10, ball(radius), rail);
            CAPTURE(angle, radius, rail.has_sections(), name(contact.status));
            REQUIRE(contact.patches.size() == 2);
            for (const RailPatch& patch : contact.patches) {
                CHECK(std::abs(patch.angle) == Approx(angle).epsilon(1e-6));
                CHECK(patch.load * std::cos(patch.angle) == Approx(5).epsilon(1e-3));
            }
        }
    }
}

TEST_CASE("contact_search: a wheel that yaws touches with the flange and the gauge corner far apart along x",
          "[profiles]") {
    const WheelsetPosition at{.lateral = 5.2e-3, .roll = -2.8e-3, .yaw = -24e-3};
    const RailPoints points(s1002_on_uic60());
    for (const WheelOnRail* wheel : {&s1002_on_uic60(), &s1002_on_uic60_in_slices()}) {
        const auto contact = under(5e4, *wheel, at);
        CAPTURE(name(contact.status));
        REQUIRE(contact.patches.size() == 2);
        const RailPatch &flange = contact.patches[0], &corner = contact.patches[1];
        CHECK(corner.angle - flange.angle > pi / 9);
        CHECK(corner.x - flange.x > 0.02);
        CHECK(least_gap(s1002_on_uic60(), points, at, contact) > -1e-6);
    }
}

TEST_CASE("contact_search: a tread that lies more than two millimetres above the rail when the flange touches",
          "[profiles]") {
    // the side on one crown, the tread 2.3 mm above the other
    const Profile crowns =
        piece(-0.05, 0.05, 2001, [](double y) { return y < 0 ? beside_tread(y) : std::pow(y - 0.03, 2) / 5 + 2.3e-3; });
    const auto same = at_height(2.35e-3, side_and_tread(), crowns),
               contact = at_height(2.35e-3, side_and_tread(), RailSurface::roller(crowns, 1e6));
    // along its normal the side lies less than a millimetre within the rail
    CHECK(same.status == Status::ok);
    CHECK(contact.status == Status::ok);
    REQUIRE(same.patches.size() == 2);
    REQUIRE(contact.patches.size() == 2);
    for (const std::size_t k : {0, 1}) {
        // both are found from samples, on slices and on the silhouette: to a thirtieth of a cell
        CHECK(contact.patches[k].y == Approx(same.patches[k].y).margin(same.patches[k].grid.dy / 30));
        CHECK(contact.patches[k].load == Approx(same.patches[k].load).epsilon(1e-2));
    }
}

TEST_CASE("contact_search: regions found in another order go on with their cells", "[profiles]") {
    // the side is deeper at first, and the tread half a millimetre below
    const Profile crowns = piece(
        -0.05, 0.05, 2001, [](double y) { return y < 0 ? beside_tread(y) : std::pow(y - 0.03, 2) * 2.644 + 2e-5; });
    const WheelOnRail wheel(side_and_tread(), RailSurface::roller(crowns, 1e6), above);
    detail::RegionSolver solver;
    REQUIRE(solver.locate(wheel.geometry(), {}, coarse_cells) == Status::ok);
    solver.divide(4.9e-4);
    for (const double height : {4.9e-4, 5.2e-4}) {
        solver.refine(height, height > 5e-4 ? 1 : 0, false, true);
        solver.settle(0, 1e-6, false);
        const std::vector<RailPatch> patches = solver.patches(0);
        REQUIRE(patches.size() == 2);
        CHECK(patches[0].y == Approx(0.78).margin(1e-4));
        CHECK(patches[1].y == Approx(0.73).margin(1e-4));
    }
}

TEST_CASE("contact_search: contacts that part a run of depths do not overlap, and their planes are doubtful",
          "[profiles]") {
    const auto contact = under(4e5, s1002_on_uic60(), {.lateral = 6.5e-3, .roll = -0.1e-3, .yaw = 28e-3});
    REQUIRE(contact.patches.size() == 2);
    double flange_end = 0, corner_end = 1;
    for (const RailPatch& patch : contact.patches) {
        CHECK(patch.status == Status::doubtful_plane);
        for (Eigen::Index j = 0; j < patch.grid.ny; ++j) {
            if (!(patch.pressure.col(j) > 0).any()) continue;
            const double y = patch.place(0, patch.grid.y(j), patch.rail_n[j])[1];
            if (patch.angle < -pi / 4) flange_end = std::max(flange_end, y);
            if (patch.angle > -pi / 4) corner_end = std::min(corner_end, y);
        }
    }
    CHECK(flange_end < corner_end);
    // one round the gauge corner stays one
    CHECK(under(3.6e5, s1002_on_uic60(), {.lateral = 6.17e-3, .roll = -0.9e-3, .yaw = -22e-3}).patches.size() == 1);
}

TEST_CASE("contact_search: parts of one run of depths displace each other with interaction off, as one region",
          "[profiles]") {
    // a wheel that turns by 25 degrees over a rail that follows it but for two hollows; a crown near them, which
    // belongs to the same region, and one far beside them
    const auto wheel_z = [](double y) { return 0.466 * (0.004 * std::log(std::cosh(y / 0.004)) - y) / 2; };
    const auto rail_z = [&](double y) {
        const double t = y / 0.008, humps = 36e-6 * std::pow(t * t - 1, 2),
                     near = std::pow(y + 0.0175, 2) / 0.05 + 2e-5, far = std::pow(y - 0.04, 2) / 0.4;
        return wheel_z(y) + std::min({humps, near, far, 5e-3});
    };
    const Profile wheel = piece(-0.05, 0.05, 1001, wheel_z), with_crown = piece(-0.05, 0.05, 4001, rail_z),
                  without = piece(-0.05, 0.03, 3201, rail_z);
    // all of it in one plane
    const double angle = std::atan(-0.466 / 2), dx = 4e-4, ds = 2e-4;
    const NormalContact::Cells grid{
        .nx = 60, .ny = 200, .x_0 = -30 * dx + dx / 2, .y_0 = -120 * ds + ds / 2, .dx = dx, .dy = ds};
    const auto n_at = [&](const auto& z, double s) {
        double low = -0.03, high = 0.03;
        for (int k = 0; k < 50; ++k) {
            const double y = (low + high) / 2;
            (y * std::cos(angle) + z(y) * std::sin(angle) < s ? low : high) = y;
        }
        return z(low) * std::cos(angle) - low * std::sin(angle);
    };
    Eigen::ArrayXXd gap(grid.nx, grid.ny);
    for (Eigen::Index j = 0; j < grid.ny; ++j) {
        const double along = n_at(rail_z, grid.y(j)) - n_at(wheel_z, grid.y(j)) - 1e-4 * std::cos(angle);
        for (Eigen::Index i = 0; i < grid.nx; ++i) {
            gap(i, j) = along + grid.x(i) * grid.x(i) / (2 * 0.46) * std::cos(angle);
        }
    }
    NormalContact one((1 - above.poisson_ratio) / above.shear_modulus);
    const double expected = one.approach(grid, gap, 0).load;
    std::vector<WheelOnRail::Contact> found;
    for (const RailSurface& rail : {RailSurface(with_crown), RailSurface(without),
                                    RailSurface(alike(without, Sections::Interpolation::spline))}) {
        const auto contact = at_height(1e-4, wheel, rail, {.interaction = false});
        const bool crown = rail.has_sections() ? false : rail.profile().length() > 0.09;
        CAPTURE(rail.has_sections(), crown, name(contact.status), contact.patches.size());
        REQUIRE(contact.patches.size() == (crown ? 4 : 3));
        double load = 0;
        for (const RailPatch& patch : contact.patches) load += patch.y < 0.75 + 0.02 ? patch.load : 0;
        CHECK(load == Approx(expected).epsilon(0.01));
        found.push_back(contact);
    }
    for (const std::size_t k : {0, 1, 2}) CHECK(found[2].patches[k].y == Approx(found[1].patches[k].y).margin(1e-4));
}

TEST_CASE("contact_search: a contact that another one lifts is none", "[profiles]") {
    // two crowns, one of which lies 60 um lower
    for (const double side : {-1, 1}) {
        const Profile crowns = piece(-0.05, 0.05, 401, [side](double y) {
            return std::pow(std::abs(y) - 0.03, 2) / 0.6 + (side * y > 0 ? 6e-5 : 0);
        });
        const WheelOnRail wheel(cylinder(), crowns, above);
        detail::RegionSolver solver;
        REQUIRE(solver.locate(wheel.geometry(), {}, coarse_cells) == Status::ok);
        const double touching = solver.touch() + 9e-5, lifted = solver.touch() + 6.05e-5;
        solver.divide(touching);
        for (const int round : {0, 1, 2}) {
            solver.refine(lifted, round, false, true);
            solver.settle(0, 1e-6, false);
            CHECK(solver.patches(0).size() == 1);
        }
        // where there are more regions than touch, those that do sink with the wheel
        solver.divide(lifted);
        solver.refine(lifted, 0, false, true);
        solver.refine(lifted + 1e-6, 1, false, true);
        solver.settle(1e-6, 1e-6, false);
        CHECK(solver.deepest() == Approx(6.15e-5).epsilon(1e-4));
        REQUIRE(solver.patches(1e-6).size() == 1);
        CHECK(solver.patches(1e-6)[0].approach == Approx(6.25e-5).epsilon(1e-4));
        CHECK(solver.patches(1e-6)[0].half_length > 0.003);
    }
}

TEST_CASE("contact_search: regions that appear or vanish have the cells of the finest, and whether these suffice",
          "[profiles]") {
    detail::ContactSettings settings = coarse_cells;
    settings.cells_x = 6;
    settings.halves_cells = true;
    // two crowns with flat tops, one of which lies 60 um lower; of rough ones cells are given up early
    for (const auto& [noise, first] : {std::pair{0.0, 5e-5}, {0.0, 7e-5}, {1e-5, 5e-5}}) {
        std::mt19937 random(1);
        const auto rough = [&, size = noise](double z) {
            return z + size * (double(random()) / double(std::mt19937::max()) - 0.5);
        };
        const Profile tread = piece(-0.06, 0.06, 481, [&](double) { return rough(0); });
        const Profile crowns = piece(-0.05, 0.05, noise > 0 ? 401 : 1001, [&](double y) {
            return rough(20 * std::pow(std::max(std::abs(std::abs(y) - 0.03) - 0.004, 0.0), 2) + (y > 0 ? 6e-5 : 0));
        });
        const WheelOnRail wheel(tread, crowns, above);
        detail::RegionSolver solver;
        REQUIRE(solver.locate(wheel.geometry(), {}, settings) == Status::ok);
        const double height = solver.touch() + first;
        solver.divide(height);
        for (int round = 0; round == 0 || solver.double_cells(); round = 1) {
            solver.refine(height, round, false, true);
            solver.settle(0, 1e-4, round > 0);
        }
        const auto finest = [&] {
            std::pair<Eigen::Index, Eigen::Index> most;
            for (const RailPatch& patch : solver.patches(0))
                most = {std::max(most.first, patch.grid.nx), std::max(most.second, patch.grid.ny)};
            return most;
        };
        const auto before = finest();
        CHECK(before.first > 6);
        CHECK(before.second > 60);
        solver.refine(solver.touch() + 12e-5 - first, 1, true, true);
        solver.settle(0, 1e-4, false);
        CAPTURE(noise, first);
        CHECK(finest() == before);
        for (const RailPatch& patch : solver.patches(0)) CHECK((patch.status == Status::few_cells) == (noise > 0));
        if (noise > 0) continue;
        // pressures that do not settle on more cells need still more
        solver.settle(0, 0, false);
        CHECK(solver.patches(0).at(0).status == Status::few_cells);
    }
}

TEST_CASE("contact_search: cells become smaller where too few touch, for a load and at a height", "[profiles]") {
    const Profile crowned = piece(-0.05, 0.05, 401, [](double y) { return y * y / 0.6; });
    const WheelOnRail::Options options{.cell_size = 5e-3};
    for (const auto& contact :
         {under(4e4, cylinder(), crowned, {}, options), at_height(6e-5, cylinder(), crowned, options)}) {
        CHECK(contact.status == Status::ok);
        REQUIRE(contact.patches.size() == 1);
        CHECK(contact.patches[0].grid.dx == 2.5e-3);
    }
}

TEST_CASE("contact_search: cells become smaller where halves of them would change pressures", "[profiles]") {
    // a crown with ends, where pressures rise, and shoulders that 20 cells do not see
    const Profile plateau = piece(
        -0.03, 0.03, 6001, [](double y) { return std::abs(y) < 0.008 ? 0 : 20 * std::pow(std::abs(y) - 0.008, 2); });
    const Profile shoulders =
        piece(-0.03, 0.03, 6001, [](double y) { return 0.4 * y * y + 8e-6 * std::cos(2 * pi * y / 0.004); });
    const WheelOnRail::Options given{.cells_x = 40, .cells_s = 20, .halves_cells = false},
        fine{.cells_x = 40, .cells_s = 320, .halves_cells = false};
    for (const Profile* rail : {&plateau, &shoulders}) {
        const auto found = under(4e4, cylinder(), *rail), coarse = under(4e4, cylinder(), *rail, {}, given),
                   expected = under(4e4, cylinder(), *rail, {}, fine),
                   pressed = at_height(expected.height, cylinder(), *rail);
        CAPTURE(rail == &plateau, name(found.status), name(expected.status), name(pressed.status));
        for (const auto* contact : {&found, &expected, &pressed}) REQUIRE(has_numbers(contact->status));
        const auto peak = [](const WheelOnRail::Contact& of) { return of.patches.at(0).peak_pressure; };
        if (rail == &plateau) CHECK(std::abs(peak(coarse) / peak(expected) - 1) > 0.05);
        CHECK(peak(found) == Approx(peak(expected)).epsilon(0.05));
        CHECK(peak(pressed) == Approx(peak(expected)).epsilon(0.05));
        CHECK(found.patches[0].approach == Approx(expected.patches[0].approach).epsilon(0.005));
        CHECK(pressed.patches[0].load == Approx(expected.patches[0].load).epsilon(0.005));
        CHECK(found.patches[0].grid.ny > 20);
        CHECK(found.patches[0].grid.nx == 40);
        CHECK(coarse.patches[0].grid.nx == 40);
    }
    // pressures over a sharp edge grow with every halving
    const Profile edge = polygon({{-30, 20}, {-20, 12}, {-5, 0}, {5, 0}, {20, 12}, {30, 20}});
    CHECK(under(4e4, cylinder(), edge).status == Status::few_cells);
    CHECK(has_numbers(under(4e4, cylinder(), edge, {}, given).status));
}

TEST_CASE("contact_search: several lobes, and lines across the rail, have at least 60 cells along s", "[profiles]") {
    const Profile crown = piece(-0.02, 0.02, 801, [](double y) { return y * y / 0.6; }),
                  line = piece(-0.02, 0.02, 801, [](double y) { return y * y / 40; }),
                  lobes = piece(-0.02, 0.02, 801,
                                [](double y) { return 2e-5 * std::pow(y * y / 3.6e-5 - 1, 2) + 2e-3 * y; });
    for (const auto& [rail, load, cells] :
         {std::tuple(&crown, 1e4, 20), {&line, 1e4, 60}, {&lobes, 3e4, 60}, {&lobes, 1e4, 20}}) {
        CHECK(under(load, cylinder(), *rail, {}, {.halves_cells = false}).patches.at(0).grid.ny == cells);
    }
}

TEST_CASE("contact_search: what is too small for an outline and carries next to nothing is dropped", "[profiles]") {
    // three lobes, two of which begin to touch
    const Profile lobes =
        piece(-0.03, 0.03, 6001, [](double y) { return 0.4 * y * y + 8e-6 * std::cos(2 * pi * y / 0.004); });
    const auto contact = at_height(9.5e-6, cylinder(), lobes, {.halves_cells = false});
    CHECK(contact.status == Status::ok);
    REQUIRE(contact.patches.size() == 2);
    CHECK(contact.dropped > 0);
    CHECK(contact.dropped < 2e-3 * (contact.patches[0].load + contact.patches[1].load));
}

TEST_CASE("contact_search: cells become smaller along x for waves between their centres", "[profiles]") {
    std::vector<Sections::Section> sections;
    for (int k = -32; k <= 32; ++k) {
        const double z = 3e-7 * std::cos(pi * k / 2 + 0.7);
        sections.push_back({k * 3.75e-4, piece(-0.03, 0.03, 61, [z](double y) { return crown(y, 0.3) + z; })});
    }
    const Sections waves(sections, Sections::Interpolation::through);
    const auto contact = under(3e3, cylinder(), waves, {}, {.cells_x = 10}),
               expected = under(3e3, cylinder(), waves, {}, {.cells_x = 120, .halves_cells = false});
    CHECK(contact.status == Status::ok);
    CHECK(contact.patches.at(0).peak_pressure == Approx(expected.patches.at(0).peak_pressure).epsilon(0.05));
}

TEST_CASE("contact_search: the last steps to a load: a contact that outgrows its cells, an approach beside points",
          "[profiles]") {
    const WheelsetPosition at{.lateral = 1.99281e-3, .roll = 1.57114e-3, .yaw = 2.44304e-3};
    CHECK(under(11507.16, s1002_on_uic60(), at).status == Status::ok);
    const Profile skew = piece(-0.02, 0.02, 1601, [](double y) { return y * y / 0.6 + 5 * y * y * y; });
    for (const double load : {1e4, 3e4}) {
        const auto contact = under(load, cylinder(), skew);
        CHECK(contact.patches.at(0).approach == Approx(contact.height).epsilon(1e-6));
    }
}

TEST_CASE("contact_search: loads between those before and after contacts get a plane each", "[profiles]") {
    // both sides of a groove in a bowl, whose normals part as the contacts grow
    const auto bowl = [](double y) { return -26.5 * y * y; };
    const Profile wheel = piece(-0.012, 0.012, 2401, bowl),
                  rail = piece(-0.012, 0.012, 2401, [&](double y) {
                      const double edge = std::abs(y) - 1.5e-3;
                      return bowl(y) + (edge > 0 ? 5e-3 * edge : std::min(-0.6 * edge, 3e-4));
                  });
    for (const double load : {7012.76, 27137.2, 31069.3}) {
        const auto contact = under(load, wheel, rail, {}, {.interaction = false, .halves_cells = false});
        REQUIRE(has_numbers(contact.status));
        REQUIRE(contact.patches.size() == 2);
        CHECK(contact.patches[0].vertical_load() + contact.patches[1].vertical_load() == Approx(load).epsilon(1e-4));
    }
}

TEST_CASE("contact_search: cells for waves of a rough wheel on a rough rail are given up early, of one of both not",
          "[profiles]") {
    std::mt19937 random(1);
    const auto rough = [&](double curvature, double noise) {
        return piece(-0.03, 0.03, 241, [&](double y) {
            return curvature * y * y + noise * (double(random()) / double(std::mt19937::max()) - 0.5);
        });
    };
    for (const auto& [on_wheel, on_rail] : {std::pair(8e-6, 8e-6), std::pair(0.0, 8e-6), std::pair(8e-6, 0.0)}) {
        const Profile on_axle = rough(0, on_wheel);
        const WheelOnRail wheel(on_axle, rough(1, on_rail), above);
        const bool both = on_wheel > 0 && on_rail > 0;
        const auto contact = under(4e4, wheel);
        CHECK(contact.status == (both ? Status::few_cells : Status::ok));
        CHECK((contact.patches.at(0).grid.ny < 240) == both);
        CHECK(wheel.geometry().is_rough() == both);
    }
}

TEST_CASE("contact_search: a narrow bump far from the deepest contact is a contact of its own", "[profiles]") {
    for (const auto& [height, at] : {std::pair(2e-5, 7e-3), std::pair(4e-5, 7.6e-3), std::pair(6e-5, 8.4e-3)}) {
        const Profile rail = piece(-0.03, 0.03, 1201, [height = height, at = at](double y) {
            return y * y / 0.8 - height * std::exp(-std::pow((y - at) / 2e-4, 2));
        });
        CHECK(under(1e5, cylinder(), rail).patches.size() == 2);
    }
}

TEST_CASE("contact_search: approaches are depths of the surfaces, also where gaps beside a patch are not known",
          "[profiles]") {
    const WheelsetPosition at{.lateral = 5.895e-3, .roll = -2.044e-3, .yaw = -0.02644};
    for (const double cant : {0.0, 1.0 / 40, 1.0 / 20}) {
        const auto contact = under(9.2e5, {s1002(), rail_uic60(cant)}, at);
        REQUIRE_FALSE(contact.patches.empty());
        for (const RailPatch& patch : contact.patches) {
            CHECK(patch.approach > 0);
            CHECK(patch.approach < 1e-3);
        }
    }
}

TEST_CASE("contact_search: a contact does not depend on what its workspace has solved before", "[profiles]") {
    const Profile edge = polygon({{-30, 20}, {-20, 12}, {-5, 0}, {5, 0}, {20, 12}, {30, 20}});
    WheelOnRail::Dimensions soft = above;
    soft.shear_modulus /= 2;
    const Profile crowned = piece(-0.05, 0.05, 401, [](double y) { return y * y / 0.6; });
    const WheelOnRail at_edge(cylinder(), edge, above), wheel(cylinder(), crowned, above),
        softer(cylinder(), crowned, soft);
    WheelOnRail::Workspace used;
    CHECK(at_edge.solve_for_load({}, 4e4, used).status == Status::few_cells);
    for (const WheelOnRail* of : {&wheel, &softer, &wheel}) {
        WheelOnRail::Workspace fresh;
        const auto expected = of->solve_at_height({.height = 6e-5}, fresh, {}),
                   found = of->solve_at_height({.height = 6e-5}, used, {});
        REQUIRE(found.status == Status::ok);
        CHECK((found.patches.at(0).pressure == expected.patches.at(0).pressure).all());
    }
}

TEST_CASE("contact_search: waves between the centres of cells count by the pressures that they can raise",
          "[profiles]") {
    constexpr double distance = 1e-4, compliance = 1e-11;
    constexpr Eigen::Index count = 20, parts = 32;
    const Eigen::ArrayXd place = Eigen::ArrayXd::LinSpaced(parts * (count - 1) + 1, 0, count - 1),
                         pressure = Eigen::ArrayXd::Constant(count, 1e9);
    const auto times = [&](const Eigen::ArrayXd& h) {
        return detail::WavesMissed{h, pressure, parts, distance, compliance}.times();
    };
    // full contact of waves whose length is twice the distance of centres: pi E* A/L
    const Eigen::ArrayXd wave = (pi * place).sin() * 0.05e9 * compliance * 2 * distance / pi;
    CHECK(times(1.01 * wave) == 2);
    CHECK(times(0.99 * wave) == 1);
    CHECK(times((place / 10 - 1).cube()) == 1);
    CHECK(times(1.01 * (2 * pi * place).sin() * 0.05e9 * compliance * 2 * distance / pi) == 4);
    for (const double sign : {-1.01, 1.01}) CHECK(times(sign * (place > 9 && place < 10).select(wave, 0)) == 2);
    // none are enough for a kink
    CHECK(times(1e-4 * (place - 9.7).abs()) == parts / 2);
    // waves beside pressures do not count
    Eigen::ArrayXd beside = wave;
    beside.head(parts * (count - 3)).setZero();
    Eigen::ArrayXd with_end = pressure;
    with_end.tail(4).setZero();
    CHECK(detail::WavesMissed{30 * beside, with_end, parts, distance, compliance}.times() == 1);
    // finer cells miss shorter waves, which are stiffer; those beyond the edge of the last cell that is pressed do not
    // count
    Eigen::ArrayXd both = 1.01 * wave + 0.6 * (2 * pi * place).sin() * wave.maxCoeff();
    CHECK(times(both) == 4);
    both += (place > 15.25 && place < 16).select(30 * (8 * pi * place).sin() * wave.maxCoeff(), 0);
    CHECK(detail::WavesMissed{both, with_end, parts, distance, compliance}.times() == 4);
}

TEST_CASE("contact_search: changes by larger cells count over 1.5 % of loads, and over 6 % of pressures",
          "[profiles]") {
    constexpr double compliance = 1e-11, cell = 2e-4, infinite = std::numeric_limits<double>::infinity();
    constexpr Eigen::Index count = 25, half = (count + 1) / 2;
    const NormalContact::Cells grid{count, count, -cell * 12, -cell * 12, cell, cell},
        twice{half, half, grid.x_0, grid.y_0, 2 * cell, 2 * cell};
    NormalContact fine(compliance), coarse(compliance), used(1);
    // a sphere, and one with a bump between the centres of larger cells
    for (const bool bump : {false, true}) {
        const auto gaps = [&](const NormalContact::Cells& of) {
            NormalContact::Grid h(of.nx, of.ny);
            for (Eigen::Index j = 0; j < of.ny; ++j) {
                for (Eigen::Index i = 0; i < of.nx; ++i) {
                    const double x = of.x(i), y = of.y(j), off = std::hypot(x - cell, y - cell) / cell;
                    h(i, j) = x * x + y * y - (bump ? 5e-7 * std::exp(-4 * off * off) : 0);
                }
            }
            return h;
        };
        const NormalContact::Grid h = gaps(grid);
        const NormalContact::Solution solution = fine.approach(grid, h, 4e-6, 1e-6);
        const auto change = [&](double counted) {
            return detail::change_by_larger_cells(used, grid, h, solution, fine.pressure(), compliance, counted, 2, 2);
        };
        const double by_load = std::abs(coarse.approach(twice, gaps(twice), 4e-6, 1e-6).load / solution.load - 1),
                     by_pressure = std::abs(
                         detail::peak_pressure(coarse.pressure()) / detail::peak_pressure(fine.pressure()) - 1);
        CHECK(change(infinite) == Approx(by_load / 0.015).epsilon(0.02));
        CHECK(change(0) == Approx((std::max)(by_load / 0.015, by_pressure / 0.06)).epsilon(0.02));
        CHECK((by_pressure / 0.06 > by_load / 0.015) == bump);
    }
}

TEST_CASE("contact_search: a patch without an outline asks for cells in the direction with fewer", "[profiles]") {
    const NormalContact::Cells grid{.nx = 20, .ny = 20, .x_0 = 0, .y_0 = 0, .dx = 1, .dy = 1};
    const auto wanted = [&](Eigen::Index in_x, Eigen::Index in_s, double negligible) {
        Eigen::ArrayXXd p = Eigen::ArrayXXd::Zero(20, 20);
        p.block(3, 4, in_x, in_s).setOnes();
        const detail::MoreCells of = detail::cells_for_outlines(grid, p, negligible);
        return std::pair(of.x, of.s);
    };
    using Times = std::pair<Eigen::Index, Eigen::Index>;
    CHECK(wanted(12, 2, 0) == Times(1, 2));
    CHECK(wanted(2, 2, 0) == Times(2, 2));
    CHECK(wanted(2, 2, 5) == Times(1, 1));
    CHECK(wanted(12, 12, 0) == Times(1, 1));
}

TEST_CASE("contact_search: what contacts displace each other falls with their distance in space", "[profiles]") {
    // both sides of a groove touch a ball that yaws ahead of and behind its middle
    const WheelsetPosition at{.lateral = 0.75 * (1 - std::cos(0.05)), .yaw = 0.05};
    const auto alone = under(2e3, ball(0.02), groove(pi / 6), at, {.interaction = false}),
               both = under(2e3, ball(0.02), groove(pi / 6), at);
    REQUIRE(both.patches.size() == 2);
    const RailPatch &one = both.patches[0], &other = both.patches[1];
    CHECK(std::abs(one.x - other.x) > 0.02);
    const double apart = std::hypot(one.x - other.x, one.y - other.y, one.z - other.z);
    CHECK(one.approach - alone.patches[0].approach ==
          Approx(0.3 * other.load * (1 - above.poisson_ratio) / above.shear_modulus / (pi * apart)).epsilon(0.02));
}

TEST_CASE("contact_search: interaction is within 0.1 of finite elements, and never negative", "[profiles]") {
    for (const auto& [degrees, f] :
         {std::pair{0, 1.0}, {11, 1.0}, {21, 0.94}, {31, 0.84}, {41, 0.69}, {51, 0.49}, {61, 0.26}, {90, 0.0}}) {
        CAPTURE(degrees);
        CHECK(detail::interaction(degrees * pi / 180) == Approx(f).margin(0.1));
        CHECK(detail::interaction(-degrees * pi / 180) >= 0);
    }
}

TEST_CASE("contact_search: patches are chains of rows that touch, at corners, too, by the heavier branch",
          "[profiles]") {
    Eigen::ArrayXXd p = Eigen::ArrayXXd::Zero(8, 4);  // columns are rows y = const
    p.col(0).segment(3, 2) = 4;                       // two branches, both beside corners of the next row
    p.col(0).segment(7, 1) = 10;
    p.col(1).segment(5, 2) = 3;
    p.col(2).segment(3, 2) = 2;  // two branches again
    p.col(2).segment(7, 1) = 9;
    p.col(3).segment(0, 2) = 1;  // a cell away
    const std::vector<Eigen::ArrayXXd> found = detail::split_into_patches(p);
    REQUIRE(found.size() == 4);
    for (const auto& [k, sum] : {std::pair{0, 10 + 6 + 9}, {1, 8}, {2, 4}, {3, 2}})
        CHECK(found[std::size_t(k)].sum() == sum);
    CHECK((found[0] + found[1] + found[2] + found[3] - p).abs().maxCoeff() == 0);
}

TEST_CASE("contact_search: a deep groove of the rail or of the wheel parts contacts 3 mm apart", "[profiles]") {
    // two crowns of 10 mm radius
    std::vector<std::array<double, 2>> points;
    for (double y = -20; y < -0.45; y += 0.1) points.push_back({y, std::pow(y + 1.5, 2) / 20});
    for (const auto& [y, z] : {std::pair{-0.4, 4.0}, {-0.2, 5.0}}) points.push_back({y, z});
    for (std::size_t k = points.size(); k-- > 0;) points.push_back({-points[k][0], points[k][1]});
    const Profile grooved = polygon(points);
    for (auto& [y, z] : points) z = -z;
    for (const auto& contact : {under(1e3, cylinder(), grooved), under(1e3, polygon(points), cylinder())})
        carry_halves(contact, 1e3, 1e-3, 1.5e-3, 1.5e-6);
}

TEST_CASE("contact_search: both sides of a slit narrower than the distance of samples touch", "[profiles]") {
    std::vector<std::array<double, 2>> points;
    for (double y = -20; y < -0.02; y += y < -1 ? 0.25 : 0.02) {
        const double edge = std::max(0.0, 1 - (-0.02 - y) / 0.5);
        points.push_back({y, y * y / 600 + 0.01 * edge * edge});
    }
    for (const auto& [y, z] : {std::pair{-0.019, 5.0}, {-0.017, 20.0}}) points.push_back({y, z});
    for (std::size_t k = points.size(); k-- > 0;) points.push_back({-points[k][0], points[k][1]});
    carry_halves(under(3e3, cylinder(), polygon(points), {.lateral = 4e-5}), 3e3, 1e-3);
}

TEST_CASE("contact_search: pressures beside a wall steeper than 84 degrees are not known", "[profiles]") {
    for (const auto& [degrees, defined] : {std::pair{80, true}, {87, false}}) {
        std::vector<std::array<double, 2>> points;
        for (double y = -20; y <= 3; y += 0.25) points.push_back({y, y * y / 200});
        points.push_back({3 + 20 / std::tan(degrees * pi / 180), 20.045});
        for (const auto& [y, z] : {std::pair{19.0, 23.5}, {23.0, 24.0}}) points.push_back({y, z});
        const auto contact = under(1e5, cylinder(), polygon(points), {}, {.halves_cells = false});
        CAPTURE(degrees, name(contact.status));
        CHECK(has_numbers(contact.status) == defined);
        CHECK((contact.status == Status::undefined_section) != defined);
    }
}

TEST_CASE("contact_search: a wheel that yaws so much that its lowest points lie where sections are not known",
          "[profiles]") {
    const WheelOnRail::Dimensions small{.radius = 0.4, .rail_origin = WheelOnRail::Dimensions::Origin{0.75, 0}};
    const WheelOnRail wheel(piece(-0.02, 0.15, 401, [](double y) { return 0.5 * y + 10 * y * y; }), arc(0.3, 0.06),
                            small);
    const WheelsetPosition at{.lateral = -0.04, .yaw = 0.2};
    CHECK(under(2e3, wheel, at).status == Status::undefined_section);
    CHECK(rigid_contact(wheel, at).status == Status::undefined_section);
}

TEST_CASE("contact_search: at the end of a rail a contact's plane lies on the rail, of sections, too", "[profiles]") {
    const Profile ended = piece(-0.03, 5e-4, 401, [](double y) { return y * y / 0.6; });
    double y = 0;
    for (const RailSurface& rail : {RailSurface(ended), RailSurface::roller(ended, 1e6)}) {
        const auto contact = at_height(5e-5, cylinder(), rail);
        CHECK(contact.status == Status::end_of_profile);
        if (y > 0) CHECK(contact.patches.at(0).y == Approx(y).margin(2e-5));
        y = contact.patches.at(0).y;
    }
}

TEST_CASE("contact_search: what is not finite or too deep has its status", "[profiles]") {
    const Profile sharp = arc(0.02, 0.0196);
    WheelOnRail::Workspace workspace;
    for (const RailSurface& rail : {RailSurface(sharp), RailSurface(alike(sharp))}) {
        const WheelOnRail wheel(cylinder(), rail, above);
        CAPTURE(rail.has_sections());
        for (double WheelsetPosition::*member :
             {&WheelsetPosition::lateral, &WheelsetPosition::height, &WheelsetPosition::roll, &WheelsetPosition::yaw,
              &WheelsetPosition::along, &WheelsetPosition::pitch}) {
            WheelsetPosition at;
            at.*member = NAN;
            CHECK(wheel.solve_for_load(at, 1e4, workspace).status == Status::not_finite);
            CHECK(wheel.solve_at_height(at, workspace, {}).status == Status::not_finite);
        }
        for (const double height : {1.1e-3, 1e-2, 0.1})
            CHECK(wheel.solve_at_height({.height = height}, workspace, {}).status == Status::too_deep);
    }
}

TEST_CASE("contact_search: along a rail whose crown becomes sharp, a plane becomes doubtful", "[profiles]") {
    std::vector<Sections::Section> sections;
    for (const double u : {-0.6, -0.5, -0.4, -0.3, 0.3, 0.4, 0.5, 0.6}) {
        sections.push_back({u, arc(u < 0 ? 0.1 : 0.004, 0.0038)});
    }
    const Sections sharpened(sections, Sections::Interpolation::through);
    CHECK(under(3e4, cylinder(), sharpened, {.along = -0.45}).status == Status::ok);
    CHECK(under(3e4, cylinder(), sharpened, {.along = 0.45}).status == Status::doubtful_plane);
}
