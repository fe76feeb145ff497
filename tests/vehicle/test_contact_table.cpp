// rollbem/vehicle/contact_table.hpp, make_contact_table.hpp: balance, power, the way through a change of contact
// points, and the table against the patches that it stands for.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/detail/checked_stream.hpp>
#include <rollbem/normal/profile.hpp>
#include <rollbem/normal/wheel_on_rail.hpp>
#include <rollbem/vehicle/make_contact_table.hpp>
#include <rollbem/vehicle/wheelset_forces.hpp>
#include <rollbem/vehicle/detail/creep_ellipse.hpp>
#include <rollbem/vehicle/detail/wheel_node.hpp>

#include "laws/wheels.hpp"
#include "support/catch.hpp"
#include "support/refusal.hpp"
#include "vehicle/creep_force_scene.hpp"
#include "vehicle/made_tables.hpp"

namespace contact_table_tests {

using namespace rollbem;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using creep_forces::array;
using laws::Numbers, laws::wheel_forces;
using testing::s1002_60e1, testing::s1002_on_60e1, testing::steel;

namespace {

constexpr double radius = 0.46, mu = 0.3;

/// A right wheel that rolls freely.
Numbers rolling(double lateral) { return Numbers{{lateral, 0, 30, -30 / radius, 0, 0, 0, 0, 1e5, mu, 0, 1}}; }

}  // namespace

TEST_CASE("forces without tangents are the forces with tangents, and so are statuses and points", "[contact_table]") {
    const ReducedFriction wet({.adhesion_factor = 0.5, .slip_factor = 0.3, .friction_ratio = 0.4, .fall = 0.2});
    const int kind = GENERATE(0, 1, 2);  // dry; wet, and slippery by zones; much friction, which may hold a wheel up
    ContactTable::Friction friction;
    if (kind == 1) {
        friction.factor = {0, 1, 0.7, 1};
        friction.reduced = &wet;
    }
    laws::Draw draw(11);
    for (int scene = 0; scene < 300; ++scene) {
        Numbers x = laws::draw_wheel(draw, scene % 3 == 0, 9.5e-3);
        if (scene % 10 == 0) x[8] = 0;
        if (kind == 2) x[9] += 0.3;
        const WheelForces at = wheel_forces(x, friction), plain = wheel_forces(x, friction, false);
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

/// Velocities of the middle of the axle and of turning, in the order of forces and moments.
Eigen::Vector<double, 6> motion_of(const Numbers& x, double roll) {
    const double level = x[3] * std::cos(x[1]);
    return {x[2], x[4], x[5], x[6] - x[3] * std::sin(x[1]), level * std::cos(roll), x[7] + level * std::sin(roll)};
}

TEST_CASE("power on a wheel is that on its points: minus heat, never gained by one, and the work of normal forces",
          "[contact_table]") {
    laws::Draw draw(9);
    for (int scene = 0; scene < 3000; ++scene) {
        Numbers x = laws::draw_wheel(draw, true);
        x[11] = 1;  // arms and angles of points are those of a right wheel
        const WheelForces at = wheel_forces(x);
        REQUIRE(at.status == Status::ok);
        const Eigen::Vector<double, 6> v = motion_of(x, x[10]);
        double pressed = 0;
        for (const WheelForces::Point& point : at.points) {
            if (point.load_share == 0) continue;
            CAPTURE(scene, point.load_share);
            CHECK(point.heat >= 0);
            CHECK(std::hypot(point.force.longitudinal, point.force.lateral) <= x[9] * point.normal_load * (1 + 1e-9));
            const auto& r = point.arm;
            const double v_y = v[1] + v[5] * r[0] - v[3] * r[2], v_z = v[2] + v[3] * r[1] - v[4] * r[0];
            pressed -= point.normal_load * (v_z * std::cos(point.angle) - v_y * std::sin(point.angle));
        }
        REQUIRE_THAT(at.force.dot(v), WithinAbs(pressed - at.heat, 1e-9 * (std::abs(pressed) + at.heat + x[8])));
    }
}

TEST_CASE("what forces on both wheels take from the motion becomes heat", "[contact_table]") {
    laws::Draw draw(9);
    for (int scene = 0; scene < 200; ++scene) {
        Numbers x = laws::draw_wheel(draw, false);
        // steady rolling: nothing moves into the rails
        x[4] = x[5] = x[6] = 0;
        const auto v = motion_of(x, s1002_60e1().on_rails(x[0], x[1], {x[8], x[8]}).roll);
        double power = 0, heat = 0, share = 0;
        for (const double side : {-1, 1}) {
            x[11] = side;
            const WheelForces at = wheel_forces(x);
            REQUIRE(at.status == Status::ok);
            power -= at.force.dot(v);
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
    double most_angle = 0;
    bool share = false;
    WheelForces last = wheel_forces(rolling(0));
    for (int k = 1; k <= 7000; ++k) {
        const WheelForces at = wheel_forces(rolling(1e-6 * k));
        REQUIRE(at.status == Status::ok);
        int carrying = 0;
        for (const WheelForces::Point& point : at.points) {
            if (point.load_share > 0.5) most_angle = std::max(most_angle, -point.angle);
            carrying += point.load_share > 0.2 ? 1 : 0;
        }
        share = share || carrying == 2;
        const double step = (at.force - last.force).norm();
        const double slope = std::max(at.tangent.col(0).norm(), last.tangent.col(0).norm());
        INFO("at " << 1e-3 * k << " mm: step " << step << " N, slope " << slope << " N/m");
        REQUIRE(step <= 2e-6 * slope + 30);
        last = at;
    }
    REQUIRE(share);
    REQUIRE(most_angle > 1.0);  // another zone carries
}

TEST_CASE("tables of too few shifts, of ellipses without a size and of a rail that changes are refused",
          "[contact_table]") {
    const auto refused = [](const ContactTable::Grid& grid, const ContactTable::Side& side) {
        return refusal([&] { ContactTable(grid, {8.2e10, 0.28}, {side}); });
    };
    ContactTable::Side side = s1002_60e1().side(WheelsetSide::right);
    CHECK_THAT(refused({{0, 1}, {0, 1}, {1}}, side), ContainsSubstring("number of shifts = 2 must be 5 to 10001"));
    Eigen::Index carries = 0;
    side.points.row(ContactRow::share).maxCoeff(&carries);
    for (const double width : {0.0, -1e-5}) {
        side.points(ContactRow::width, carries) = width;
        CHECK_THAT(refused(s1002_60e1().grid(), side),
                   ContainsSubstring("semi-axis, coefficient, scale or peak of a point = ") &&
                       ContainsSubstring("must be positive, above 1e-6 of its mean"));
    }
    const Profile rail = rail_60e1();
    const Sections sections({{-1, rail, {}}, {1, rail, {}}}, Sections::Interpolation::through);
    const WheelsetOnTrack track(
        WheelOnRail(s1002(), sections, {.rail_origin = WheelOnRail::Dimensions::Origin{0.75, 0}}));
    CHECK_THAT(refusal([&] { make_contact_table(track, steel()); }),
               ContainsSubstring("surface = changes along the way"));
}

TEST_CASE("a table agrees with the patches at its nodes, whichever side and yaw", "[contact_table]") {
    const WheelOnRail right(s1002(), rail_60e1()), left(s1002(), rail_54e1(), {.radius = 0.45});
    const bool both = GENERATE(true, false);
    const WheelsetOnTrack track = both ? WheelsetOnTrack(right) : WheelsetOnTrack(left, right);
    ContactTableMaker::Options making{.grid = contact_table_grid(1e5, 1e-3, 5, 4e-3, 3),
                                      .contacts = {.cells_x = 20, .cells_s = 12}};
    making.grid.loads = {6e4, 1e5};
    making.zones = {ContactTable::Zones(), ContactTable::Zones()};
    making.fits_friction = false;
    making.jobs = 2;
    const ContactTableMaker::Result made = make_contact_table(track, steel(), making);
    REQUIRE(made.missing_share == 0);
    REQUIRE(made.table.is_mirrored() == both);
    REQUIRE(made.table.grid().shifts.size() == 5);
    WheelsetOnTrack::Workspace workspace;
    const WheelsetSpeeds speeds{30, -30 / radius * 1.0005, 0.01, 1e-3, 3e-3, 0.01};
    for (const double yaw : {-4e-3, 2e-3}) {
        const auto contacts = track.solve({.lateral = -0.5e-3, .yaw = yaw}, {6e4, 6e4}, workspace, {}, making.contacts);
        const auto rails = made.table.on_rails(-0.5e-3, yaw, {6e4, 6e4});
        CHECK_THAT(rails.roll, WithinAbs(contacts.position.roll, 1e-9));
        CHECK_THAT(rails.height, WithinAbs(contacts.position.height, 1e-9));
        for (const WheelsetSide side : WheelsetOnTrack::sides) {
            const auto& patches = contacts.wheels[std::size_t(side)].patches;
            REQUIRE(patches.size() == 1);
            const WheelForces at = made.table.look_up(steel(), side, contacts.position, speeds, 6e4, 1e-9);
            REQUIRE(at.status == Status::ok);
            const WheelForces::Point& point = at.points[0];
            const WheelsetPosition seen = contacts.seen(side);
            const WheelOnRail::Dimensions& dimensions = track.wheel(side).dimensions();
            const PatchEllipse ellipse = creep_ellipse(patches[0], dimensions, steel());
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
    const ContactTable table = ContactTableMaker(s1002_on_60e1(), steel(), making).table({side}).table;
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
    WheelsetOnTrack::Workspace workspace;
    const auto contacts = s1002_on_60e1().solve({.lateral = -0.5e-3, .yaw = -2e-3}, {1e5, 1e5}, workspace);
    const RailPatch& patch = contacts.wheels[1].patches[0];
    const WheelOnRail::Dimensions& dimensions = s1002_on_60e1().wheel().dimensions();
    const PatchEllipse ellipse = creep_ellipse(patch, dimensions, steel());
    const double c = contact_of(patch, dimensions).c(), bound = mu * patch.load,
                 unit = bound / (dimensions.shear_modulus * c * c);
    for (const Creepage v : {Creepage{0.02 * unit, 0, 0},
                             {0, 0.02 * unit, 0},
                             {0, 0, 0.1},
                             {0.1 * unit, 0.1 * unit, 0.1},
                             {unit, -unit, -0.1}}) {
        // a wheel that has about these creepages
        const double yaw_rate = v.spin - patch.angle / radius;
        const double pitch_rate = (v.longitudinal + yaw_rate * patch.y - 1) / patch.rolling_radius;
        const WheelsetSpeeds speeds{1, pitch_rate, v.lateral - 2e-3, 0, 0, yaw_rate};
        const PatchForce own = patch_force(patch, contacts.position, speeds, dimensions, {.coefficient = mu});
        REQUIRE(own.status == Status::ok);
        const auto force = ellipse.forces(steel(), dimensions, mu, patch.load, own.creepage);
        const Eigen::Array3d error = (array(force) - array(own.force)) / Eigen::Array3d(1, 1, c);
        CHECK(error.abs().maxCoeff() <= 0.015 * bound);
    }
}

TEST_CASE("a shifted wheelset is turned back as by its patches", "[contact_table]") {
    // Both patches cross the joint of two arcs of the rail. Where their longitudinal forces vanish moves less with the
    // shift than where their pressures act, which lengthens Klingel's wave.
    WheelsetOnTrack::Workspace workspace;
    WheelsetRolling shifted;
    shifted.position.lateral = 1e-4;
    const WheelsetForces patches = rolling_forces(s1002_on_60e1(), shifted, {.coefficient = mu}, workspace);
    REQUIRE(patches.contacts.status == Status::ok);
    double moment = 0;
    for (const WheelsetSide side : WheelsetOnTrack::sides) {
        const WheelForces wheel = s1002_60e1().look_up(steel(), side, shifted.position,
                                                       {.forward = 1, .pitch_rate = patches.pitch_rate}, 1e5, mu);
        REQUIRE(wheel.status == Status::ok);
        moment += wheel.force[5];
    }
    CHECK_THAT(moment, WithinRel(patches.on_wheelset.moment[2], 0.03));  // by plain ellipses a fifth more
}

TEST_CASE("loads follow heights, which follow loads", "[contact_table]") {
    laws::Draw draw(12);
    for (int scene = 0; scene < 50; ++scene) {
        const double lateral = draw.uniform(-6e-3, 6e-3), yaw = draw.uniform(-0.012, 0.012);
        const double load = draw.uniform(7e4, 1.3e5);
        // heights of wheels under equal loads give the loads back
        const auto equal = s1002_60e1().on_rails(lateral, yaw, {load, load});
        const auto support = s1002_60e1().load_at_height(WheelsetSide::right, lateral, yaw,
                                                         equal.height + ContactTable::half_base * equal.roll);
        CHECK_THAT(support.load, WithinRel(load, 1e-6));
        CHECK(support.by_height > 3e8);
    }
    const auto lifted_by = [height = s1002_60e1().on_rails(0, 0).height](double lift) {
        return s1002_60e1().load_at_height(WheelsetSide::left, 0, 0, height - lift);
    };
    CHECK(lifted_by(1e-3).load == 0);
    const auto light = lifted_by(6e-5);
    CHECK((light.load > 0 && light.load < s1002_60e1().grid().loads[0]));
    CHECK_THAT((lifted_by(6e-5 - 1e-9).load - light.load) / 1e-9, WithinRel(light.by_height, 1e-3));
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
    s1002_60e1().with_errors({said}).write(stream);
    const ContactTable again = ContactTable::read(stream);
    REQUIRE(again.errors().size() == 1);
    CHECK(again.errors()[0].wheels == 7);
    CHECK((again.errors()[0].mean[1] == 2 && again.errors()[0].largest == said.largest));
    const auto &one = again.side(WheelsetSide::right), &two = s1002_60e1().side(WheelsetSide::right);
    CHECK((one.on_rails == two.on_rails).all());
    for (Eigen::Index row = 0; row < ContactRow::rows; ++row) {
        const double size = two.points.row(row).abs().maxCoeff();
        CHECK((one.points.row(row) - two.points.row(row)).abs().maxCoeff() <= 1e-6 * size);
    }
    std::string text = stream.str();
    text[text.size() / 2] = static_cast<char>(text[text.size() / 2] ^ 1);
    std::istringstream damaged(text), cut(text.substr(0, 1000)), other("rollbem creep forces");
    CHECK_THAT(refusal([&] { ContactTable::read(damaged); }), ContainsSubstring("checksum"));
    CHECK_THAT(refusal([&] { ContactTable::read(cut); }), ContainsSubstring("must not end within the table"));
    CHECK_THAT(refusal([&] { ContactTable::read(other); }), ContainsSubstring("must not end"));
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
    const WheelOnRail::Dimensions& dimensions = s1002_on_60e1().wheel().dimensions();
    WheelsetOnTrack::Workspace workspace;
    const auto contacts = s1002_on_60e1().solve({.lateral = 1.3e-3, .yaw = 4e-3}, {8e4, 8e4}, workspace);
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
    auto rows = detail::zone_rows(node, zones, dimensions, steel());
    const auto error = [&] {
        double sum = 0;
        for (const auto& motion : others) {
            sum += (detail::forces_of_zones(rows, node, node.vertical(), motion, dimensions, steel()) - motion.sum())
                       .abs()
                       .maxCoeff() /
                   (mu * node.vertical() * double(others.size()));
        }
        return sum;
    };
    const double before = error();
    detail::fit_bends(rows, zones, node, motions, dimensions, steel());
    CAPTURE(before, error());
    CHECK(error() < 0.7 * before);
    CHECK(error() < 7e-3);
}

/// Of a right wheel that rolls, with and without tangents.
Status status_of(const ContactTable& table, double lateral, const ContactTable::Load& load) {
    const WheelsetSpeeds speeds{.forward = 30, .pitch_rate = -30 / radius};
    const Status found = table.look_up(steel(), WheelsetSide::right, {.lateral = lateral}, speeds, load, mu).status;
    CHECK(table.forces(steel(), WheelsetSide::right, {.lateral = lateral}, speeds, load, mu).status == found);
    return found;
}

TEST_CASE("wheels without load, friction or motion, and wrong tables", "[contact_table]") {
    Numbers x = rolling(1e-3);
    x[8] = 0;
    const WheelForces lifted = wheel_forces(x);
    CHECK(lifted.status == Status::ok);
    CHECK(lifted.force.isZero(0));
    laws::Draw draw(12);
    for (int scene = 0; scene < 80; ++scene) {
        x = laws::draw_wheel(draw, false);
        x[9] = std::array{0.0, 1e-300, 1e-200, 1e-20}[std::size_t(scene) % 4];
        const WheelForces slides = wheel_forces(x);
        CAPTURE(x.transpose(), name(slides.status));
        REQUIRE(slides.status == Status::ok);
        CHECK(std::abs(slides.force[0]) <= 1e-12 * x[8]);
        CHECK(slides.force[2] == Approx(-x[8]));
        CHECK(slides.tangent.allFinite());
        CHECK(slides.derivative(WheelForces::load)[2] == Approx(-1));
    }
    for (const double speed : {0.0, 1e-310}) {
        x = rolling(1e-3);
        x[2] = speed;
        x[3] = -speed / radius;
        const WheelForces stands = wheel_forces(x);
        REQUIRE(stands.status == Status::invalid_step);
        CHECK(stands.force[0] == 0);
        CHECK_THAT(stands.force[2], WithinRel(-x[8], 1e-12));
        x[4] = 0.01;
        x[11] = -1;
        REQUIRE(wheel_forces(x).status == Status::invalid_step);
    }
    const ContactTable soft(s1002_60e1().grid(), {8.2e10, 0.3}, {s1002_60e1().side(WheelsetSide::right)});
    CHECK(status_of(soft, 0, 1e5) == Status::wrong_table);
    const double last = s1002_60e1().largest_shift();
    const double roll = s1002_60e1().on_rails(last, 0, {1e5, 1e5}).roll;
    CHECK(status_of(s1002_60e1(), last, {1e5, roll}) == Status::ok);
    CHECK(status_of(s1002_60e1(), last, {1e5, roll - 1e-5}) == Status::wrong_table);  // moves the profile farther
}

TEST_CASE("an ellipse keeps its size where a zone begins to carry", "[contact_table]") {
    // from one node to the next the half-width of the second zone changes tenfold
    const WheelForces wheel =
        wheel_forces(Numbers{{-5.51e-3, 8e-3, 20, -20 / radius, 0, 0, 0, 20.0 / 400, 55e3, mu, 0, -1}});
    REQUIRE(wheel.status == Status::ok);
    CHECK(wheel.force[1] / (mu * 55e3) == Approx(2.0273).margin(8e-3));  // by patches
    const ContactTable::Side& side = s1002_60e1().side(WheelsetSide::right);
    const auto least = [&](ContactRow::Of row) {
        return (side.points.row(ContactRow::share) > 0).select(side.points.row(row), 1e100).minCoeff();
    };
    const double least_length = least(ContactRow::length), least_width = least(ContactRow::width),
                 least_peak = least(ContactRow::peak);
    laws::Draw draw(69);
    for (int i = 0; i < 20000; ++i) {
        const double lateral = draw.uniform(4.5e-3, 6.5e-3), yaw = draw.uniform(0, 1e-2), load = draw.uniform(4e4, 1e5);
        const WheelForces sliding =
            wheel_forces(Numbers{{lateral, yaw, 20, -20 / radius, 0, 0, 0, 0.05, load, mu, 0, 1}}, {}, false);
        CAPTURE(lateral, yaw, load);
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

TEST_CASE("a place where no zone carries has no forces", "[contact_table]") {
    const ContactTable::Grid& grid = s1002_60e1().grid();
    ContactTable::Side side = s1002_60e1().side(WheelsetSide::right);
    for (Eigen::Index column = 0; column < side.points.cols(); ++column) {
        const double shift = grid.shifts[std::size_t(column) % grid.shifts.size()];
        if (std::abs(shift) > 3e-3) side.points(ContactRow::share, column) = 0;
    }
    const ContactTable holed(grid, {8.2e10, 0.28}, {side});
    for (const double shift : {2e-3, -2.95e-3, 3e-3 + 5e-5, 3e-3 + 9e-5, 5e-3}) {
        CHECK(status_of(holed, shift, 1e5) == (shift < 3e-3 ? Status::ok : Status::wrong_table));
        CHECK(status_of(holed, shift, 0) == Status::ok);
    }
}

}  // namespace contact_table_tests
