// rollbem/vehicle/contact_table.hpp, make_contact_table.hpp: tangents, mirror images, balance, the way through a change
// of contact points, and the table against the patches that it stands for.
#include <array>
#include <cmath>
#include <random>
#include <sstream>
#include <string>

#include <rollbem/compiled/wheelset.hpp>
#include <rollbem/vehicle/make_contact_table.hpp>
#include <rollbem/vehicle/wheelset_forces.hpp>

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
constexpr Inputs scales{1e-4, 1e-4, 30, 60, 0.03, 0.03, 0.02, 0.02, 1e5, mu};

WheelForces look_up(const Inputs& x, WheelsetSide side = WheelsetSide::right) {
    return s1002().look_up(
        creep(), side, {.lateral = x[0], .yaw = x[1]},
        {.forward = x[2], .pitch_rate = x[3], .lateral = x[4], .vertical = x[5], .roll_rate = x[6], .yaw_rate = x[7]},
        x[8], x[9]);
}

Inputs random_inputs(std::mt19937_64& random, double largest_shift) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto about = [&](double middle, double range) { return middle + range * uniform(random); };
    return {about(0, largest_shift),  about(0, 0.014), 30,
            about(-30 / radius, 0.1), about(0, 0.1),   about(0, 0.05),
            about(0, 0.05),           about(0, 0.05),  about(1e5, 5e4),
            about(0.3, 0.1)};
}

/// The free rolling of a centred wheelset.
Inputs rolling(double lateral) { return {lateral, 0, 30, -30 / radius, 0, 0, 0, 0, 1e5, mu}; }

}  // namespace

TEST_CASE("tangents of a wheel's forces are those of its forces", "[contact_table]") {
    std::mt19937_64 random(7);
    double worst = 0;
    for (int scene = 0; scene < 300; ++scene) {
        const Inputs x = random_inputs(random, 8e-3);
        const WheelsetSide side = scene % 2 == 0 ? WheelsetSide::right : WheelsetSide::left;
        const WheelForces at = look_up(x, side);
        REQUIRE(at.status == StepStatus::ok);
        for (std::size_t j = 0; j < x.size(); ++j) {
            Inputs more = x, less = x;
            const double h = 1e-4 * scales[j];
            more[j] += h;
            less[j] -= h;
            const WheelForces above = look_up(more, side), below = look_up(less, side);
            // the second derivatives of the splines jump at their nodes
            const double across =
                (above.tangent.col(Eigen::Index(j)) - below.tangent.col(Eigen::Index(j))).norm() * scales[j];
            const Eigen::Matrix<double, 6, 1> difference =
                (above.force - below.force) / (2 * h) - at.tangent.col(Eigen::Index(j));
            const double error = difference.norm() * scales[j];
            INFO("scene " << scene << ", input " << j << ", error " << error);
            REQUIRE(error < 0.5 * across + 1e-6 * x[8] + 1e-3 * at.tangent.col(Eigen::Index(j)).norm() * scales[j]);
            worst = std::max(worst, error / x[8]);
        }
    }
    REQUIRE(worst > 0);
}

TEST_CASE("the left wheel is the mirror image of the right one", "[contact_table]") {
    std::mt19937_64 random(8);
    for (int scene = 0; scene < 50; ++scene) {
        Inputs x = random_inputs(random, 8e-3);
        const WheelForces right = look_up(x);
        for (const std::size_t j : {0U, 1U, 4U, 6U, 7U}) x[j] = -x[j];
        const WheelForces left = look_up(x, WheelsetSide::left);
        for (Eigen::Index i = 0; i < 6; ++i) {
            REQUIRE(left.force[i] == (i % 2 == 0 ? 1 : -1) * right.force[i]);
        }
        REQUIRE(left.heat == right.heat);
    }
}

TEST_CASE("rolling backwards is the mirror image of rolling forward; at standstill there is a status",
          "[contact_table]") {
    std::mt19937_64 random(10);
    for (int scene = 0; scene < 50; ++scene) {
        Inputs x = random_inputs(random, 8e-3);
        const WheelsetSide side = scene % 2 == 0 ? WheelsetSide::right : WheelsetSide::left;
        const WheelForces forward = look_up(x, side);
        constexpr std::array<double, 6> signs{-1, 1, 1, 1, -1, -1};
        constexpr Inputs turned{1, -1, -1, -1, 1, 1, 1, -1, 1, 1};
        for (std::size_t j = 0; j < x.size(); ++j) x[j] *= turned[j];
        const WheelForces backward = look_up(x, side);
        REQUIRE(backward.status == StepStatus::ok);
        for (Eigen::Index i = 0; i < 6; ++i) {
            const double sign = signs[std::size_t(i)];
            REQUIRE(backward.force[i] == sign * forward.force[i]);
            for (Eigen::Index j = 0; j < WheelForces::inputs; ++j) {
                REQUIRE(backward.tangent(i, j) == sign * turned[std::size_t(j)] * forward.tangent(i, j));
            }
        }
        REQUIRE(backward.heat == forward.heat);
        for (std::size_t k = 0; k < 2; ++k) {
            REQUIRE(backward.points[k].arm[0] == -forward.points[k].arm[0]);
            REQUIRE(backward.points[k].creepage.spin == -forward.points[k].creepage.spin);
        }
    }
    for (const double speed : {0.0, 1e-310}) {
        Inputs x = rolling(1e-3);
        x[2] = speed;
        x[3] = -speed / radius;
        REQUIRE(look_up(x).status == StepStatus::invalid_step);
        x[4] = 0.01;
        REQUIRE(look_up(x, WheelsetSide::left).status == StepStatus::invalid_step);
    }
}

TEST_CASE("a wheel carries its load, and friction makes heat", "[contact_table]") {
    std::mt19937_64 random(9);
    for (int scene = 0; scene < 200; ++scene) {
        const Inputs x = random_inputs(random, 8e-3);
        const WheelForces at = look_up(x);
        REQUIRE(at.status == StepStatus::ok);
        REQUIRE_THAT(at.force[2], WithinRel(-x[8], 1e-9));
        REQUIRE(at.heat >= 0);
        // power on the wheelset: minus heat, and what normal forces do on the motion into the rail
        const auto& f = at.force;
        const double tilt = s1002().on_rails(x[0], x[1]).roll, spin = x[3];
        const double w_x = x[6] - spin * std::sin(x[1]), w_y = spin * std::cos(tilt) * std::cos(x[1]),
                     w_z = x[7] + spin * std::sin(tilt) * std::cos(x[1]);
        double power = f[0] * x[2] + f[1] * x[4] + f[2] * x[5] + f[3] * w_x + f[4] * w_y + f[5] * w_z, pressed = 0;
        for (const WheelForces::Point& point : at.points) {
            if (point.load_share == 0) continue;
            const auto& r = point.arm;
            const double v_y = x[4] + w_z * r[0] - w_x * r[2], v_z = x[5] + w_x * r[1] - w_y * r[0];
            pressed -= point.normal_load * (v_z * std::cos(point.angle) - v_y * std::sin(point.angle));
        }
        REQUIRE_THAT(power, WithinAbs(pressed - at.heat, 1e-9 * (std::abs(pressed) + at.heat + x[8])));
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
        REQUIRE(at.status == StepStatus::ok);
        const double first = at.points[0].load_share, second = at.points[1].load_share;
        REQUIRE_THAT(first + second, WithinAbs(1, 1e-6));
        both = both || (first > 0.2 && second > 0.2);
        most_angle = std::max({most_angle, -at.points[0].angle * (first > 0.5), -at.points[1].angle * (second > 0.5)});
        const double step = (at.force - last.force).norm();
        const double slope = std::max(at.tangent.col(0).norm(), last.tangent.col(0).norm());
        INFO("at " << 1e-3 * k << " mm: step " << step << " N, slope " << slope << " N/m");
        REQUIRE(step <= 2e-6 * slope + 30);
        last = at;
    }
    REQUIRE(both);
    REQUIRE(most_angle > 1.0);
}

TEST_CASE("a table agrees with the patches at its nodes, and has their forces between them", "[contact_table]") {
    const WheelsetOnTrack track(WheelOnRail(rollbem::s1002(), rail_uic60()));
    const ContactTable::Grid grid{.largest_shift = 1e-3, .shifts = 5, .largest_yaw = 2e-3, .yaws = 3};
    const WheelOnRail::Options coarse{.cells_x = 20, .cells_s = 12};
    double missing = -1;
    const ContactTable table = make_contact_table(track, 1e5, creep(), grid, 2, coarse, &missing);
    REQUIRE(missing == 0);
    WheelsetOnTrack::Workspace workspace;
    const auto contacts = track.solve({.lateral = -0.5e-3, .yaw = -2e-3}, {1e5, 1e5}, workspace, {}, coarse);
    const RailPatch& patch = contacts.wheels[1].patches[0];
    const WheelsetSpeeds speeds{.forward = 30,
                                .pitch_rate = -30 / radius * 1.0005,
                                .lateral = 0.01,
                                .vertical = 1e-3,
                                .roll_rate = 3e-3,
                                .yaw_rate = 0.01};
    const WheelForces at = table.look_up(creep(), WheelsetSide::right, contacts.position, speeds, 1e5, mu);
    REQUIRE(at.status == StepStatus::ok);
    const WheelForces::Point& point = at.points[at.points[0].load_share > 0 ? 0 : 1];
    REQUIRE_THAT(point.angle, WithinAbs(patch.angle, 1e-7));
    REQUIRE_THAT(point.normal_load, WithinRel(patch.load, 2e-2));  // with friction
    REQUIRE_THAT(table.on_rails(-0.5e-3, -2e-3).roll, WithinAbs(contacts.position.roll, 1e-8));
    // at the middle of the ellipse instead of the reference point
    const PatchEllipse ellipse = creep_ellipse(patch, track.wheel().dimensions(), creep());
    const Creepage<double> own = creepage_of(patch, contacts.position, speeds, radius);
    REQUIRE_THAT(point.creepage.longitudinal, WithinAbs(own.longitudinal - own.spin * ellipse.s, 1e-8));
    REQUIRE_THAT(point.creepage.lateral, WithinAbs(own.lateral + own.spin * ellipse.x, 1e-8));
    REQUIRE_THAT(point.creepage.spin, WithinAbs(own.spin, 1e-7));
    // the rule for the ellipse against the patch itself
    const PatchContact<double> outline = contact_of(patch, track.wheel().dimensions());
    const PatchMesh<double> mesh = patch_mesh(outline, cosine_mesh(12), uniform_mesh(13));
    const auto elements = mesh.rectangles(outline.half_length());
    Eigen::ArrayXd pressure = pressure_of(patch)(elements);
    double load = 0;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const auto& [x_1, x_2, y_1, y_2] = elements[i];
        load += pressure[Eigen::Index(i)] * (x_2 - x_1) * (y_2 - y_1);
    }
    const FrictionModel model(
        outline, steady_system(mesh, NodeDifference{Nodes::chebyshev}, HalfSpace<double>(outline.poisson_ratio())),
        {mu, (patch.load / load) * pressure, {}, false});
    auto work = model.workspace();
    auto state = model.at_rest();
    const double bound = mu * patch.load, unit = bound / (outline.shear_modulus() * outline.c() * outline.c());
    for (const Creepage<double> v : {Creepage<double>{0.02 * unit, 0, 0},
                                     {0, 0.02 * unit, 0},
                                     {0, 0, 0.1},
                                     {0.1 * unit, 0.1 * unit, 0.1},
                                     {unit, -unit, -0.1}}) {
        const auto& patch_force = model.steady(model.at_rest(), v, state, work).force;
        const auto force = ellipse.forces(creep(), track.wheel().dimensions(), mu, patch.load, v);
        CHECK_THAT(force.longitudinal / bound, WithinAbs(patch_force.longitudinal / bound, 0.015));
        CHECK_THAT(force.lateral / bound, WithinAbs(patch_force.lateral / bound, 0.015));
        CHECK_THAT(force.moment / (bound * outline.c()), WithinAbs(patch_force.moment / (bound * outline.c()), 0.015));
    }
}

TEST_CASE("a shifted wheelset is turned back as by its patches, less than by ellipses", "[contact_table]") {
    // Both patches cross the joint of two arcs of the rail. Where their longitudinal forces vanish moves less with the
    // shift than where their pressures act, which lengthens Klingel's wave.
    const WheelsetOnTrack track(WheelOnRail(rollbem::s1002(), rail_uic60()));
    WheelsetOnTrack::Workspace workspace;
    WheelsetRolling shifted;
    shifted.position.lateral = 1e-4;
    const WheelsetForces patches = rolling_forces(track, shifted, {.coefficient = mu}, workspace);
    REQUIRE(patches.contacts.status == Status::ok);
    Eigen::ArrayXXd values = s1002().values();
    for (const Eigen::Index point : {Eigen::Index(0), Eigen::Index(ContactRow::point_rows)}) {
        values.middleRows(point + ContactRow::correction, 9).setZero();
    }
    const ContactTable ellipses(s1002().grid(), 1e5, s1002().shear_modulus(), s1002().poisson_ratio(), values);
    const auto turning = [&](const ContactTable& table) {
        double moment = 0;
        for (const WheelsetSide side : WheelsetOnTrack::sides) {
            const WheelForces wheel = table.look_up(creep(), side, shifted.position,
                                                    {.forward = 1, .pitch_rate = patches.pitch_rate}, 1e5, mu);
            REQUIRE(wheel.status == StepStatus::ok);
            moment += wheel.force[5];
        }
        return moment;
    };
    CHECK_THAT(turning(s1002()), WithinRel(patches.on_wheelset.moment[2], 0.02));
    CHECK(turning(ellipses) / patches.on_wheelset.moment[2] > 1.2);
}

TEST_CASE("a table of contact geometry is read as it was written", "[contact_table]") {
    std::stringstream stream;
    s1002().write(stream);
    const ContactTable again = ContactTable::read(stream);
    REQUIRE((again.values() - s1002().values()).abs().maxCoeff() < 1e-7);  // float
    std::string text = stream.str();
    text[text.size() / 2] = static_cast<char>(text[text.size() / 2] ^ 1);
    std::istringstream damaged(text), cut(text.substr(0, 1000)), other("rollbem creep forces"), none;
    CHECK_THAT(refusal([&] { ContactTable::read(damaged); }), ContainsSubstring("checksum"));
    CHECK_THAT(refusal([&] { ContactTable::read(cut); }), ContainsSubstring("must not end within the table"));
    CHECK_THAT(refusal([&] { ContactTable::read(other); }), ContainsSubstring("must not end"));
    CHECK_THAT(
        refusal([&] { ContactTable({.shifts = 4}, 1e5, 8.2e10, 0.28, Eigen::ArrayXXd::Zero(ContactTable::rows, 52)); }),
        ContainsSubstring("shifts = 4 must be odd"));
}

TEST_CASE("look-ups say what is wrong", "[contact_table]") {
    Inputs x = rolling(0);
    x[0] = 9.1e-3;
    CHECK(look_up(x).status == StepStatus::wrong_table);
    x = rolling(0);
    x[8] = -1;
    CHECK(look_up(x).status == StepStatus::invalid_load);
    x[8] = std::nan("");
    CHECK(look_up(x).status == StepStatus::not_finite);
    x[8] = 0;
    const WheelForces lifted = look_up(x);
    CHECK(lifted.status == StepStatus::ok);
    CHECK(lifted.force.isZero(0));
}

}  // namespace contact_table_tests
