// rollbem/vehicle/contact_table.hpp, make_contact_table.hpp: balance, power, the way through a change of contact
// points, and the table against the patches that it stands for.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include <rollbem/detail/checked_stream.hpp>
#include <rollbem/normal/profile.hpp>
#include <rollbem/normal/wheel_on_rail.hpp>
#include <rollbem/vehicle/contact_table.hpp>
#include <rollbem/vehicle/creep_force_table.hpp>
#include <rollbem/vehicle/make_contact_table.hpp>
#include <rollbem/vehicle/wheelset_forces.hpp>
#include <rollbem/vehicle/detail/creep_ellipse.hpp>
#include <rollbem/vehicle/detail/wheel_node.hpp>

#include "support/catch.hpp"
#include "support/refusal.hpp"

namespace contact_table_tests {

using namespace rollbem;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

const CreepForceTable& creep() {
    static const auto table = CreepForceTable::read(ROLLBEM_STEEL_CREEP);
    return table;
}
const ContactTable& s1002() {
    static const auto table = ContactTable::read(ROLLBEM_S1002_CONTACT);
    return table;
}

constexpr double radius = 0.46, mu = 0.3;
using Inputs = std::array<double, WheelForces::inputs>;

/// A roll of 0 stands for the roll of equal loads.
WheelForces look_up(const Inputs& x, WheelsetSide side = WheelsetSide::right, ContactTable::Friction friction = {}) {
    friction.coefficient = x[9];
    return s1002().look_up(
        creep(), side, {.lateral = x[0], .yaw = x[1]},
        {.forward = x[2], .pitch_rate = x[3], .lateral = x[4], .vertical = x[5], .roll_rate = x[6], .yaw_rate = x[7]},
        {x[8], x[10] == 0 ? std::nullopt : std::optional(x[10])}, friction);
}

Inputs random_inputs(std::mt19937_64& random, double largest_shift) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto about = [&](double middle, double range) { return middle + range * uniform(random); };
    return {about(0, largest_shift),
            about(0, 0.014),
            30,
            about(-30 / radius, 0.1),
            about(0, 0.1),
            about(0, 0.05),
            about(0, 0.05),
            about(0, 0.05),
            about(1e5, 5e4),
            about(0.3, 0.1),
            0};
}
/// The same with a roll of its own.
Inputs with_roll(Inputs x, std::mt19937_64& random) {
    x[0] *= 0.8;
    x[10] = s1002().on_rails(x[0], x[1]).roll + std::uniform_real_distribution<double>(-1e-4, 1e-4)(random);
    return x;
}

/// The free rolling of a centred wheelset.
Inputs rolling(double lateral) { return {lateral, 0, 30, -30 / radius, 0, 0, 0, 0, 1e5, mu, 0}; }

}  // namespace

TEST_CASE("forces without tangents are the forces with tangents, and so are statuses and points", "[contact_table]") {
    const ReducedFriction wet({.adhesion_factor = 0.5, .slip_factor = 0.3, .friction_ratio = 0.4, .fall = 0.2});
    const int kind = GENERATE(0, 1, 2);  // dry; wet, and slippery by zones; much friction, which may hold a wheel up
    ContactTable::Friction friction;
    if (kind == 1) {
        friction.factor = {0, 1, 0.7, 1};
        friction.reduced = &wet;
    }
    std::mt19937_64 random(11);
    for (int scene = 0; scene < 300; ++scene) {
        Inputs x = random_inputs(random, 9.5e-3);
        if (scene % 3 == 0) x = with_roll(x, random);
        if (scene % 10 == 0) x[8] = 0;
        if (kind == 2) x[9] += 0.3;
        const WheelsetSide side = scene % 2 == 0 ? WheelsetSide::right : WheelsetSide::left;
        const WheelForces at = look_up(x, side, friction);
        friction.coefficient = x[9];
        const WheelForces plain =
            s1002().forces(creep(), side, {.lateral = x[0], .yaw = x[1]}, {x[2], x[3], x[4], x[5], x[6], x[7]},
                           {x[8], x[10] == 0 ? std::nullopt : std::optional(x[10])}, friction);
        CAPTURE(kind, scene, name(at.status));
        CHECK(plain.status == at.status);
        CHECK(plain.load_on_table == at.load_on_table);
        CHECK(plain.tangent.isZero(0));
        if (at.status != Status::ok) continue;
        CHECK(std::abs(at.force[2] + x[8]) <= 1e-11 * x[8]);
        CHECK((plain.force - at.force).norm() <= 1e-8 * at.force.norm());
        CHECK(plain.heat == Approx(at.heat).epsilon(1e-6).margin(1e-9));
        for (std::size_t k = 0; k < at.points.size(); ++k) {
            CHECK(plain.points[k].load_share == Approx(at.points[k].load_share).margin(1e-7));
            if (!(at.points[k].load_share > 0)) continue;
            // a share that begins to carry rises steeply, relative to itself
            CHECK(plain.points[k].normal_load == Approx(at.points[k].normal_load).epsilon(1e-6).margin(1e-14 * x[8]));
            CHECK(plain.points[k].force.lateral == Approx(at.points[k].force.lateral).margin(1e-6 * x[8]));
        }
    }
}

TEST_CASE("wheels without friction, or with next to none, have forces of the rail's normals and finite tangents",
          "[contact_table]") {
    std::mt19937_64 random(12);
    for (const double coefficient : {0.0, 1e-300, 1e-200, 1e-20}) {
        for (int scene = 0; scene < 20; ++scene) {
            Inputs x = random_inputs(random, 8e-3);
            x[9] = coefficient;
            const WheelForces at = look_up(x);
            CAPTURE(coefficient, scene, name(at.status));
            REQUIRE(at.status == Status::ok);
            CHECK(std::abs(at.force[0]) <= 1e-12 * x[8]);
            CHECK(at.force[2] == Approx(-x[8]));
            CHECK(at.tangent.allFinite());
            CHECK(at.derivative(WheelForces::load)[2] == Approx(-1));
        }
    }
}

TEST_CASE("at standstill there is a status", "[contact_table]") {
    for (const double speed : {0.0, 1e-310}) {
        Inputs x = rolling(1e-3);
        x[2] = speed;
        x[3] = -speed / radius;
        const WheelForces stands = look_up(x);
        REQUIRE(stands.status == Status::invalid_step);
        CHECK(stands.force[0] == 0);
        CHECK_THAT(stands.force[2], WithinRel(-x[8], 1e-12));
        x[4] = 0.01;
        REQUIRE(look_up(x, WheelsetSide::left).status == Status::invalid_step);
    }
}

TEST_CASE("power on a wheel is the power on its points: minus heat, and the work of normal forces", "[contact_table]") {
    std::mt19937_64 random(9);
    for (int scene = 0; scene < 200; ++scene) {
        const Inputs x = with_roll(random_inputs(random, 8e-3), random);
        const WheelForces at = look_up(x);
        REQUIRE(at.status == Status::ok);
        const auto& f = at.force;
        const double spin = x[3];
        const double w_x = x[6] - spin * std::sin(x[1]), w_y = spin * std::cos(x[10]) * std::cos(x[1]),
                     w_z = x[7] + spin * std::sin(x[10]) * std::cos(x[1]);
        const double power = f[0] * x[2] + f[1] * x[4] + f[2] * x[5] + f[3] * w_x + f[4] * w_y + f[5] * w_z;
        double pressed = 0;
        for (const WheelForces::Point& point : at.points) {
            if (point.load_share == 0) continue;
            const auto& r = point.arm;
            const double v_y = x[4] + w_z * r[0] - w_x * r[2], v_z = x[5] + w_x * r[1] - w_y * r[0];
            pressed -= point.normal_load * (v_z * std::cos(point.angle) - v_y * std::sin(point.angle));
        }
        REQUIRE(at.heat >= 0);
        REQUIRE_THAT(power, WithinAbs(pressed - at.heat, 1e-9 * (std::abs(pressed) + at.heat + x[8])));
    }
}

TEST_CASE("a wheel carries its load, and what forces take from the motion becomes heat", "[contact_table]") {
    std::mt19937_64 random(9);
    for (int scene = 0; scene < 200; ++scene) {
        Inputs x = random_inputs(random, 8e-3);
        // both wheels in steady rolling: nothing moves into the rails
        x[4] = x[5] = x[6] = 0;
        const double tilt = s1002().on_rails(x[0], x[1], {x[8], x[8]}).roll, spin = x[3];
        const Eigen::Vector3d turn(-spin * std::sin(x[1]), spin * std::cos(tilt) * std::cos(x[1]),
                                   x[7] + spin * std::sin(tilt) * std::cos(x[1]));
        double power = 0, heat = 0, share = 0;
        for (const WheelsetSide side : {WheelsetSide::left, WheelsetSide::right}) {
            const WheelForces at = look_up(x, side);
            REQUIRE(at.status == Status::ok);
            REQUIRE_THAT(at.force[2], WithinRel(-x[8], 1e-9));
            power -= at.force[0] * x[2] + at.force.tail<3>().dot(turn);
            heat += at.heat;
            for (const WheelForces::Point& point : at.points) {
                share += point.load_share;
                CHECK((point.load_share < 0.01 || point.peak_pressure > 1e8));
            }
        }
        REQUIRE_THAT(share, WithinAbs(2, 1e-12));
        INFO("shift " << x[0] << ", yaw " << x[1] << ", load " << x[8] << ", heat " << heat);
        // where the contact passes to the flange, within tenths of a millimetre, a table is coarser
        const double part = std::abs(x[0]) < 6.1e-3 ? 1e-2 : 0.1;
        CHECK_THAT(power, WithinAbs(heat, part * heat + 1e-4 * x[8]));
    }
}

TEST_CASE("forces have no steps where the load goes over to another point of contact", "[contact_table]") {
    // S1002 on 60E1 from the tread to the flange: within a micrometre forces change by at most their steepest slope
    bool both = false;
    double most_angle = 0;
    WheelForces last = look_up(rolling(0));
    for (int k = 1; k <= 7000; ++k) {
        const Inputs x = rolling(1e-6 * k);
        const WheelForces at = look_up(x);
        REQUIRE(at.status == Status::ok);
        int carrying = 0;
        for (const WheelForces::Point& point : at.points) {
            carrying += point.load_share > 0.2;
            if (point.load_share > 0.5) most_angle = std::max(most_angle, -point.angle);
        }
        both = both || carrying > 1;
        const double step = (at.force - last.force).norm();
        const double slope = std::max(at.tangent.col(0).norm(), last.tangent.col(0).norm());
        INFO("at " << 1e-3 * k << " mm: step " << step << " N, slope " << slope << " N/m");
        REQUIRE(step <= 2e-6 * slope + 30);
        last = at;
    }
    REQUIRE(both == (s1002().side(WheelsetSide::right).zones.count() > 1));
    REQUIRE(most_angle > 1.0);
}

TEST_CASE("a table of a rail that changes along the way is refused", "[contact_table]") {
    const Profile rail = rail_60e1();
    const Sections sections({{-1, rail, {}}, {1, rail, {}}}, Sections::Interpolation::through);
    const WheelsetOnTrack track(
        WheelOnRail(rollbem::s1002(), sections, {.rail_origin = WheelOnRail::Dimensions::Origin{0.75, 0}}));
    CHECK_THAT(refusal([&] { make_contact_table(track, creep()); }),
               ContainsSubstring("surface = changes along the way"));
}

TEST_CASE("a table agrees with the patches at its nodes, whichever side and yaw", "[contact_table]") {
    const WheelOnRail right(rollbem::s1002(), rail_60e1()), left(rollbem::s1002(), rail_54e1(), {.radius = 0.45});
    const bool both = GENERATE(true, false);
    const WheelsetOnTrack track = both ? WheelsetOnTrack(right) : WheelsetOnTrack(left, right);
    ContactTableMaker::Options making{.grid = contact_table_grid(1e5, 1e-3, 5, 4e-3, 3),
                                      .contacts = {.cells_x = 20, .cells_s = 12}};
    making.grid.loads = {6e4, 1e5};
    making.zones = {ContactTable::Zones(), ContactTable::Zones()};
    making.fits_friction = false;
    making.jobs = 2;
    const ContactTableMaker::Result made = make_contact_table(track, creep(), making);
    REQUIRE(made.missing_share == 0);
    REQUIRE(made.table.is_mirrored() == both);
    REQUIRE(made.table.grid().shifts.size() == 5);
    WheelsetOnTrack::Workspace workspace;
    const WheelsetSpeeds speeds{.forward = 30,
                                .pitch_rate = -30 / radius * 1.0005,
                                .lateral = 0.01,
                                .vertical = 1e-3,
                                .roll_rate = 3e-3,
                                .yaw_rate = 0.01};
    for (const double yaw : {-4e-3, 2e-3}) {
        const auto contacts = track.solve({.lateral = -0.5e-3, .yaw = yaw}, {6e4, 6e4}, workspace, {}, making.contacts);
        const auto rails = made.table.on_rails(-0.5e-3, yaw, {6e4, 6e4});
        CHECK_THAT(rails.roll, WithinAbs(contacts.position.roll, 1e-9));
        CHECK_THAT(rails.height, WithinAbs(contacts.position.height, 1e-9));
        for (const WheelsetSide side : WheelsetOnTrack::sides) {
            const auto& patches = contacts.wheels[std::size_t(side)].patches;
            REQUIRE(patches.size() == 1);
            const WheelForces at = made.table.look_up(creep(), side, contacts.position, speeds, 6e4, 1e-9);
            REQUIRE(at.status == Status::ok);
            const WheelForces::Point& point = at.points[0];
            const WheelsetPosition seen = contacts.seen(side);
            const WheelOnRail::Dimensions& dimensions = track.wheel(side).dimensions();
            const PatchEllipse ellipse = creep_ellipse(patches[0], dimensions, creep());
            const Creepage own =
                creepage_of(patches[0], seen, WheelsetOnTrack::seen_from(side, speeds), dimensions.radius);
            CAPTURE(both, yaw, int(side));
            CHECK_THAT(point.normal_load, WithinRel(patches[0].load, 1e-4));
            CHECK_THAT(point.peak_pressure, WithinRel(patches[0].peak_pressure, 0.02));
            CHECK_THAT(point.ellipse.half_length(), WithinRel(ellipse.half_length, 1e-5));
            // at the middle of the ellipse, in the patch's plane
            CHECK_THAT(point.friction_angle, WithinAbs(patches[0].angle, 1e-6));
            CHECK(std::abs(point.friction_angle - point.angle) > 1e-5);
            CHECK_THAT(point.arm[0], WithinAbs(patches[0].x + ellipse.x, 1e-8));
            CHECK_THAT(point.creepage.longitudinal, WithinAbs(own.longitudinal - own.spin * ellipse.s, 1e-7));
            CHECK_THAT(point.creepage.lateral, WithinAbs(own.lateral + own.spin * ellipse.x, 1e-6));
            CHECK_THAT(point.creepage.spin, WithinAbs(own.spin, 1e-5));
        }
    }
}

/// Rows of a point with this half-length; c11, ... are 1.
ContactRow::Values rows_of(double length) {
    ContactRow::Values rows = ContactRow::Values::Zero();
    for (const auto row : ContactRow::positive) rows[row] = 1;
    rows[ContactRow::share] = 1;
    rows[ContactRow::length] = length;
    return rows;
}

TEST_CASE("an unknown node is the mean of its neighbours, and odd rows go on to yaw 0", "[contact_table]") {
    const WheelsetOnTrack track(WheelOnRail(rollbem::s1002(), rail_60e1()));
    ContactTableMaker::Options making{.grid = contact_table_grid(1e5, 3e-3, 7, 2e-2, 3)};
    making.grid.loads = {1e5};
    const ContactTable::Grid& grid = making.grid;
    ContactTableMaker::Side side{.zones = {}, .nodes = std::vector<ContactTableMaker::Node>(std::size_t(grid.nodes()))};
    for (std::size_t i = 0; i < side.nodes.size(); ++i) {
        const double yaw = grid.yaws[i / 7];
        side.nodes[i] = {true, 1e-4 * double(i), 1e-5 * double(i), {rows_of(1e-3 * double(1 + i))}};
        // at yaw 0 what is odd and divided by the yaw is not known
        for (const auto row : {ContactRow::arm_x, ContactRow::correction_by_yaw}) {
            side.nodes[i].zones[0][row] = yaw == 0 ? 9 : 3 + 1e4 * yaw * yaw;
        }
    }
    side.nodes[11].known = false;
    making.zones = {ContactTable::Zones(), ContactTable::Zones()};
    const ContactTable table = ContactTableMaker(track, creep(), making).table({side}).table;
    REQUIRE(table.grid().shifts.size() == 7);
    const ContactTable::Side& found = table.side(WheelsetSide::right);
    CHECK_THAT(found.points(ContactRow::length, 11), WithinRel(12e-3, 1e-6));
    CHECK_THAT(found.on_rails(0, 11), WithinRel(11e-4, 1e-12));
    for (const auto row : {ContactRow::arm_x, ContactRow::correction_by_yaw}) {
        CHECK_THAT(found.points(row, 2), WithinRel(3, 1e-6));
    }
}

TEST_CASE("a zone that carries at another load or yaw has the ellipse of the nearer load", "[contact_table]") {
    const ContactTable::Grid grid{{-2e-3, -1e-3, 0, 1e-3, 2e-3}, {0, 1e-2}, {5e4, 1e5}};
    ContactTable::Side side{.radius = radius, .zones = ContactTable::Zones({{0.7, 1e-3}})};
    side.on_rails.setZero(2, grid.nodes());
    side.points.setZero(ContactRow::rows, 2 * grid.nodes());
    for (Eigen::Index i = 0; i < grid.nodes(); ++i) side.points.col(i) = rows_of(1e-3);
    for (std::size_t shift = 0; shift < 5; ++shift) {  // the second zone, not at the first load and yaw
        side.points.col(grid.nodes() + grid.node(0, 1, shift)) = rows_of(2e-3);
        side.points.col(grid.nodes() + grid.node(1, 0, shift)) = rows_of(3e-3);
    }
    const ContactTable table(grid, {8.2e10, 0.28}, {side});
    CHECK_THAT(table.side(WheelsetSide::right).points(ContactRow::length, grid.nodes() + grid.node(0, 0, 2)),
               WithinRel(3e-3, 1e-6));
}

TEST_CASE("the ellipse of a patch has its forces, from rest to sliding", "[contact_table]") {
    const WheelsetOnTrack track(WheelOnRail(rollbem::s1002(), rail_60e1()));
    WheelsetOnTrack::Workspace workspace;
    const auto contacts = track.solve({.lateral = -0.5e-3, .yaw = -2e-3}, {1e5, 1e5}, workspace);
    const RailPatch& patch = contacts.wheels[1].patches[0];
    const WheelOnRail::Dimensions& dimensions = track.wheel().dimensions();
    const PatchEllipse ellipse = creep_ellipse(patch, dimensions, creep());
    const double c = contact_of(patch, dimensions).c(), bound = mu * patch.load,
                 unit = bound / (dimensions.shear_modulus * c * c);
    for (const Creepage v : {Creepage{0.02 * unit, 0, 0},
                             {0, 0.02 * unit, 0},
                             {0, 0, 0.1},
                             {0.1 * unit, 0.1 * unit, 0.1},
                             {unit, -unit, -0.1}}) {
        // a wheel that has just these creepages: by its speeds at the reference point
        const WheelsetPosition at = contacts.position;
        const Creepage zero = creepage_of(patch, at, {.forward = 1, .pitch_rate = -1 / radius}, radius);
        const auto speeds = [&](const std::array<double, 3>& w) {
            return WheelsetSpeeds{.forward = 1, .pitch_rate = -1 / radius + w[0], .lateral = w[1], .yaw_rate = w[2]};
        };
        Eigen::Matrix3d by;
        for (std::size_t k = 0; k < 3; ++k) {
            std::array<double, 3> w{};
            w[k] = 1e-6;
            const Creepage moved = creepage_of(patch, at, speeds(w), radius);
            by.col(Eigen::Index(k)) = Eigen::Vector3d(moved.longitudinal - zero.longitudinal,
                                                      moved.lateral - zero.lateral, moved.spin - zero.spin) /
                                      1e-6;
        }
        const Eigen::Vector3d w = by.inverse() * Eigen::Vector3d(v.longitudinal - zero.longitudinal,
                                                                 v.lateral - zero.lateral, v.spin - zero.spin);
        const PatchForce own = patch_force(patch, at, speeds({w[0], w[1], w[2]}), dimensions, {.coefficient = mu});
        REQUIRE(own.status == Status::ok);
        const auto force = ellipse.forces(creep(), dimensions, mu, patch.load, own.creepage);
        CHECK_THAT(force.longitudinal / bound, WithinAbs(own.force.longitudinal / bound, 0.015));
        CHECK_THAT(force.lateral / bound, WithinAbs(own.force.lateral / bound, 0.015));
        CHECK_THAT(force.moment / (bound * c), WithinAbs(own.force.moment / (bound * c), 0.015));
    }
}

TEST_CASE("a shifted wheelset is turned back as by its patches, less than by ellipses", "[contact_table]") {
    // Both patches cross the joint of two arcs of the rail. Where their longitudinal forces vanish moves less with the
    // shift than where their pressures act, which lengthens Klingel's wave.
    const WheelsetOnTrack track(WheelOnRail(rollbem::s1002(), rail_60e1()));
    WheelsetOnTrack::Workspace workspace;
    WheelsetRolling shifted;
    shifted.position.lateral = 1e-4;
    const WheelsetForces patches = rolling_forces(track, shifted, {.coefficient = mu}, workspace);
    REQUIRE(patches.contacts.status == Status::ok);
    ContactTable::Side plain = s1002().side(WheelsetSide::right);
    plain.points.row(ContactRow::creepage_scale).setOnes();
    for (const auto row : {ContactRow::correction, ContactRow::correction_by_yaw, ContactRow::bend})
        plain.points.middleRows(row, 9).setZero();
    const ContactTable ellipses(s1002().grid(), {s1002().shear_modulus(), s1002().poisson_ratio()}, {plain});
    const auto turning = [&](const ContactTable& table) {
        double moment = 0;
        for (const WheelsetSide side : WheelsetOnTrack::sides) {
            const WheelForces wheel = table.look_up(creep(), side, shifted.position,
                                                    {.forward = 1, .pitch_rate = patches.pitch_rate}, 1e5, mu);
            REQUIRE(wheel.status == Status::ok);
            moment += wheel.force[5];
        }
        return moment;
    };
    CHECK_THAT(turning(s1002()), WithinRel(patches.on_wheelset.moment[2], 0.03));
    CHECK(turning(ellipses) / patches.on_wheelset.moment[2] > 1.2);
}

TEST_CASE("loads follow heights, which follow loads", "[contact_table]") {
    std::mt19937_64 random(12);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int scene = 0; scene < 50; ++scene) {
        const double lateral = 6e-3 * uniform(random), yaw = 0.012 * uniform(random);
        const double load = 1e5 + 3e4 * uniform(random);
        // heights of wheels under equal loads give the loads back
        const auto equal = s1002().on_rails(lateral, yaw, {load, load});
        const auto support = s1002().load_at_height(WheelsetSide::right, lateral, yaw,
                                                    equal.height + ContactTable::half_base * equal.roll);
        CHECK_THAT(support.load, WithinRel(load, 1e-6));
        CHECK(support.by_height > 3e8);
    }
    const auto equal = s1002().on_rails(0, 0);
    const auto lifted = s1002().load_at_height(WheelsetSide::left, 0, 0, equal.height - 1e-3);
    CHECK(lifted.load == 0);
    const auto light = s1002().load_at_height(WheelsetSide::left, 0, 0, equal.height - 6e-5);
    CHECK((light.load > 0 && light.load < s1002().grid().loads[0]));
    const auto more = s1002().load_at_height(WheelsetSide::left, 0, 0, equal.height - 6e-5 + 1e-9);
    CHECK_THAT((more.load - light.load) / 1e-9, WithinRel(light.by_height, 1e-3));
}

TEST_CASE("zones part the rail into shares that sum up to 1", "[contact_table]") {
    const ContactTable::Zones zones({{0.722, 3e-3}, {0.73, 2e-3}});
    for (double y = 0.71; y < 0.74; y += 1e-4) {
        double sum = 0;
        for (Eigen::Index zone = 0; zone < zones.count(); ++zone) {
            CHECK(zones.weight(zone, y) >= 0);
            sum += zones.weight(zone, y);
        }
        CHECK_THAT(sum, WithinAbs(1, 1e-15));
    }
    CHECK(zones.weight(1, 0.7265) == 1);
    CHECK_THAT(refusal([] {
                   ContactTable::Zones({{0.72, 3e-3}, {0.724, 2e-3}});
               }),
               ContainsSubstring("lower end of a cut"));
}

TEST_CASE("a table of contact geometry is read as it was written", "[contact_table]") {
    std::stringstream stream;
    const ContactTable::Errors said{4e4, 1e5, 7, {1, 2}, {3, 4}, {5, 6}};
    s1002().with_errors({said}).write(stream);
    const ContactTable again = ContactTable::read(stream);
    REQUIRE(again.errors().size() == 1);
    CHECK(again.errors()[0].wheels == 7);
    CHECK((again.errors()[0].mean[1] == 2 && again.errors()[0].largest == said.largest));
    const auto &one = again.side(WheelsetSide::right), &two = s1002().side(WheelsetSide::right);
    CHECK((one.on_rails == two.on_rails).all());
    for (Eigen::Index row = 0; row < ContactRow::rows; ++row) {
        const double size = two.points.row(row).abs().maxCoeff();
        CHECK((one.points.row(row) - two.points.row(row)).abs().maxCoeff() <= 1e-6 * size);
    }
    std::string text = stream.str();
    text[text.size() / 2] = static_cast<char>(text[text.size() / 2] ^ 1);
    std::istringstream damaged(text), cut(text.substr(0, 1000)), other("rollbem creep forces"), none;
    CHECK_THAT(refusal([&] { ContactTable::read(damaged); }), ContainsSubstring("checksum"));
    CHECK_THAT(refusal([&] { ContactTable::read(cut); }), ContainsSubstring("must not end within the table"));
    CHECK_THAT(refusal([&] { ContactTable::read(other); }), ContainsSubstring("must not end"));
    CHECK_THAT(refusal([&] {
                   ContactTable({{0, 1}, {0, 1}, {1}}, {8.2e10, 0.28}, {});
               }),
               ContainsSubstring("number of shifts = 2 must be 5 to 10001"));
}

TEST_CASE("a table of version 2 is read, without plane and bend", "[contact_table]") {
    using enum ContactRow::Of;
    const ContactTable::Grid grid{{-2e-3, -1e-3, 0, 1e-3, 2e-3}, {0, 5e-3}, {8e4}};
    std::vector<Eigen::Index> old;  // rows as version 2 has them
    for (const auto& [first, count] : std::vector<std::pair<Eigen::Index, int>>{
             {share, 3}, {arm_z, 2}, {radius, 8}, {correction, 9}, {correction_by_yaw, 9}, {peak, 3}}) {
        for (int k = 0; k < count; ++k) old.push_back(first + k);
    }
    REQUIRE(old.size() == 34);
    std::stringstream stream;
    detail::CheckedWriter writer(stream, "rollbem contact geometry");
    for (const std::uint32_t count : {2, 5, 2, 1, 1}) writer.integer(count);
    for (const auto* nodes : {&grid.shifts, &grid.yaws, &grid.loads}) {
        for (const double node : *nodes) writer.number(node);
    }
    for (const double number : {8.2e10, 0.28}) writer.number(number);
    writer.integer(std::uint32_t(0));
    writer.number(contact_table_tests::radius);
    for (std::size_t k = 0; k < old.size(); ++k) writer.number(1 + double(k));
    for (Eigen::Index node = 0; node < grid.nodes(); ++node) {
        for (const double number : {1e-4, 2e-4}) writer.number(number);
        writer.integer(std::uint32_t(1));
        for (std::size_t k = 0; k < old.size(); ++k) writer.number(float(0.25F));
    }
    writer.finish();
    const ContactTable table = ContactTable::read(stream);
    const ContactTable::Side& side = table.side(WheelsetSide::right);
    for (std::size_t k = 0; k < old.size(); ++k) CHECK(side.points(old[k], 3) == 1.25 + double(k));
    CHECK(side.points(plane, 3) == 0);
    CHECK((side.points.middleRows(bend, 9) == 0).all());
    CHECK(table.errors().empty());
}

TEST_CASE("bends bring ellipses to the patches between rest and full sliding", "[contact_table]") {
    const WheelsetOnTrack track(WheelOnRail(rollbem::s1002(), rail_60e1()));
    const WheelOnRail::Dimensions& dimensions = track.wheel().dimensions();
    WheelsetOnTrack::Workspace workspace;
    const auto contacts = track.solve({.lateral = 1.3e-3, .yaw = 4e-3}, {8e4, 8e4}, workspace);
    detail::WheelNode node;
    node.at = contacts.seen(WheelsetSide::right);
    node.pitch_per_metre = -1 / radius;
    node.patches = detail::patch_creep_matrices(contacts.wheels[1].patches, dimensions, false);
    const ContactTable::Zones zones;
    std::vector<detail::NodeFriction> motions = detail::friction_of(node, dimensions), others;
    REQUIRE(motions.size() > 40);
    for (std::size_t m = 0; m < motions.size(); m += 3) {  // left out of the fit
        others.push_back(std::move(motions[m]));
        motions[m] = motions.back();
        motions.pop_back();
    }
    auto rows = detail::zone_rows(node, zones, dimensions, creep());
    const auto error = [&] {
        double sum = 0;
        for (const auto& motion : others) {
            sum += (detail::forces_of_zones(rows, node, node.vertical(), motion, dimensions, creep()) - motion.sum())
                       .abs()
                       .maxCoeff() /
                   (mu * node.vertical() * double(others.size()));
        }
        return sum;
    };
    const double before = error();
    detail::fit_bends(rows, zones, node, motions, dimensions, creep());
    CAPTURE(before, error());
    CHECK(error() < 0.7 * before);
    CHECK(error() < 7e-3);
}

TEST_CASE("points keep within their friction, and none gains energy", "[contact_table]") {
    std::mt19937_64 random(77);
    for (int scene = 0; scene < 3000; ++scene) {
        Inputs x = random_inputs(random, 8e-3);
        x[1] /= 2;
        const WheelForces at = look_up(x);
        REQUIRE(at.status == Status::ok);
        for (const WheelForces::Point& point : at.points) {
            if (!(point.load_share > 0)) continue;
            CAPTURE(scene, point.load_share);
            CHECK(std::hypot(point.force.longitudinal, point.force.lateral) <= x[9] * point.normal_load * (1 + 1e-9));
            CHECK(point.heat >= 0);
        }
    }
}

TEST_CASE("look-ups say what is wrong", "[contact_table]") {
    Inputs x = rolling(0);
    x[8] = 0;
    const WheelForces lifted = look_up(x);
    CHECK(lifted.status == Status::ok);
    CHECK(lifted.force.isZero(0));
    const ContactTable soft(s1002().grid(), {8.2e10, 0.3}, {s1002().side(WheelsetSide::right)});
    const WheelsetSpeeds speeds{.forward = 30, .pitch_rate = -30 / 0.46};
    CHECK(soft.look_up(creep(), WheelsetSide::right, {}, speeds, 1e5, 0.3).status == Status::wrong_table);
    CHECK(soft.forces(creep(), WheelsetSide::right, {}, speeds, 1e5, 0.3).status == Status::wrong_table);
    const double last = s1002().largest_shift();
    const ContactTable::Load as_equal(1e5, s1002().on_rails(last, 0, {1e5, 1e5}).roll);
    CHECK(s1002().look_up(creep(), WheelsetSide::right, {.lateral = last}, speeds, as_equal, mu).status == Status::ok);
}

TEST_CASE("an ellipse keeps its size where a zone begins to carry", "[contact_table]") {
    // from one node to the next the half-width of the second zone changes tenfold
    const Inputs begins{-5.51e-3, 8e-3, 20, -20 / radius, 0, 0, 0, 20.0 / 400, 55e3, mu, 0};
    const WheelForces wheel = look_up(begins, WheelsetSide::left);
    REQUIRE(wheel.status == Status::ok);
    CHECK(wheel.force[1] / (mu * 55e3) == Approx(2.0273).margin(8e-3));  // by patches
    const ContactTable::Side& side = s1002().side(WheelsetSide::right);
    const auto least = [&](ContactRow::Of row) {
        return (side.points.row(ContactRow::share) > 0).select(side.points.row(row), 1e100).minCoeff();
    };
    const double least_length = least(ContactRow::length), least_width = least(ContactRow::width),
                 least_peak = least(ContactRow::peak);
    std::mt19937_64 random(69);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < 20000; ++i) {
        const WheelsetPosition at{.lateral = 4.5e-3 + 2e-3 * uniform(random), .yaw = 1e-2 * uniform(random)};
        const double load = 4e4 + 6e4 * uniform(random);
        const WheelForces sliding = s1002().forces(
            creep(), WheelsetSide::right, at, {.forward = 20, .pitch_rate = -20 / radius, .yaw_rate = 0.05}, load, mu);
        CAPTURE(at.lateral, at.yaw, load);
        REQUIRE(sliding.status == Status::ok);
        for (const WheelForces::Point& point : sliding.points) {
            if (!(point.load_share > 0)) continue;
            const double size = std::cbrt(point.normal_load);
            REQUIRE(point.ellipse.half_length() / size > 0.7 * least_length);
            REQUIRE(point.ellipse.half_width() / size > 0.7 * least_width);
            REQUIRE(point.peak_pressure / size > 0.7 * least_peak);
        }
    }
}

TEST_CASE("a table whose ellipses have no size is refused", "[contact_table]") {
    ContactTable::Side side = s1002().side(WheelsetSide::right);
    Eigen::Index carries = 0;
    side.points.row(ContactRow::share).maxCoeff(&carries);
    side.points(ContactRow::width, carries) = GENERATE(0.0, -1e-5);
    CHECK_THAT(refusal([&] {
                   ContactTable(s1002().grid(), {8.2e10, 0.28}, {side});
               }),
               ContainsSubstring("semi-axis, coefficient, scale or peak of a point = ") &&
                   ContainsSubstring("must be positive, above 1e-6 of its mean"));
}

TEST_CASE("a place where no zone carries has no forces", "[contact_table]") {
    const ContactTable::Grid& grid = s1002().grid();
    ContactTable::Side side = s1002().side(WheelsetSide::right);
    for (Eigen::Index column = 0; column < side.points.cols(); ++column) {
        const double shift = grid.shifts[std::size_t(column) % grid.shifts.size()];
        if (std::abs(shift) > 3e-3) side.points(ContactRow::share, column) = 0;
    }
    const ContactTable holed(grid, {8.2e10, 0.28}, {side});
    const WheelsetSpeeds speeds{.forward = 30, .pitch_rate = -30 / radius};
    const double shift = GENERATE(2e-3, 3e-3 + 5e-5, 3e-3 + 9e-5, 5e-3);
    const Status expected = shift < 3e-3 ? Status::ok : Status::wrong_table;
    CHECK(holed.look_up(creep(), WheelsetSide::right, {.lateral = shift}, speeds, 1e5, mu).status == expected);
    CHECK(holed.forces(creep(), WheelsetSide::right, {.lateral = shift}, speeds, 1e5, mu).status == expected);
    CHECK(holed.look_up(creep(), WheelsetSide::right, {.lateral = shift}, speeds, 0, mu).status == Status::ok);
}

}  // namespace contact_table_tests
