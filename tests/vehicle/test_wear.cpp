// rollbem/vehicle/wear.hpp: work, fatigue and Y/Q by table, beside patches at the same places.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <rollbem/compiled/wheelset.hpp>
#include <rollbem/vehicle/wear.hpp>

#include "support/catch.hpp"

namespace wear_tests {
namespace {

using namespace rollbem;

constexpr double load = 1e5, mu = 0.3, speed = 15, radius = 0.46;

const CreepForceTable& creep() {
    static const auto table = CreepForceTable::read(ROLLBEM_STEEL_CREEP);
    return table;
}
const ContactTable& contacts() {
    static const auto table = ContactTable::read(ROLLBEM_S1002_CONTACT);
    return table;
}
const WheelsetOnTrack& track() {
    static const WheelsetOnTrack wheelset(WheelOnRail(s1002(), rail_60e1()));
    return wheelset;
}

/// A place in a curve to the left.
struct Place {
    double shift, yaw, curvature;

    WheelsetPosition position() const { return {.lateral = shift, .yaw = yaw}; }
    WheelsetSpeeds speeds() const {
        return {.forward = speed, .pitch_rate = -speed / radius, .yaw_rate = -speed * curvature};
    }
    WheelForces by_table(WheelsetSide side) const {
        const WheelForces found = contacts().look_up(creep(), side, position(), speeds(), load, mu);
        REQUIRE(found.status == Status::ok);
        return found;
    }
};
constexpr Place places[] = {{1e-3, 0, 4e-4}, {3.2e-3, -2e-4, 1e-3}, {5.2e-3, 5e-4, 2.5e-3}, {6.2e-3, 4e-3, 3e-3}};

Eigen::ArrayXd work_by_table(const WheelForces& wheel, Eigen::Index cells) {
    const Profile& rail = track().wheel().rail();
    ProfileWear wear(rail, cells);
    for (const WheelForces::Point& point : wheel.points) {
        if (point.load_share > 0) wear.add(arc_length(rail, point), strip_work_of(point, creep(), mu));
    }
    return wear.work() * wear.width();
}

TEST_CASE("Work by table over a profile adds up to the wheel's creep work", "[wear]") {
    for (const Place& place : places) {
        for (const WheelsetSide side : {WheelsetSide::left, WheelsetSide::right}) {
            const WheelForces wheel = place.by_table(side);
            double gamma = 0;
            for (const WheelForces::Point& point : wheel.points) {
                if (point.load_share > 0) gamma += t_gamma(point);
            }
            CAPTURE(place.shift, int(side), gamma);
            CHECK(gamma > 0);
            CHECK(work_by_table(wheel, 300).sum() == Approx(gamma).epsilon(1e-12));
            CHECK(gamma * speed == Approx(wheel.heat).epsilon(2e-2));  // V of each point is not the vehicle's
        }
    }
}

TEST_CASE("Work and fatigue by table are those of patches at the same places", "[wear]") {
    WheelsetOnTrack::Workspace workspace;
    const Profile& rail = track().wheel().rail();
    constexpr Eigen::Index cells = 300;
    double by_patches = 0, by_table = 0, misplaced = 0;
    for (const Place& place : places) {
        WheelsetRolling rolling{.position = place.position(), .loads = {load, load}, .speeds = place.speeds()};
        rolling.free_pitch = false;
        const WheelsetForces forces = rolling_forces(track(), rolling, {.coefficient = mu}, workspace);
        REQUIRE(has_numbers(forces.contacts.status));
        for (const WheelsetSide side : {WheelsetSide::left, WheelsetSide::right}) {
            const auto k = std::size_t(side);
            ProfileWear wear(rail, cells);
            double index = -1, gamma = 0;
            for (std::size_t i = 0; i < forces.patches[k].size(); ++i) {
                const RailPatch& patch = forces.contacts.wheels[k].patches[i];
                wear.add(patch.rail_s, forces.patches[k][i]);
                index = std::max(index, surface_fatigue_index(patch, forces.patches[k][i], 3e8));
                gamma += t_gamma(forces.patches[k][i]);
            }
            const Eigen::ArrayXd exact = wear.work() * wear.width();
            const WheelForces wheel = place.by_table(side);
            const Eigen::ArrayXd found = work_by_table(wheel, cells);
            double table_index = -1;
            for (const WheelForces::Point& point : wheel.points) {
                if (point.load_share > 0) table_index = std::max(table_index, surface_fatigue_index(point, 3e8));
            }
            CAPTURE(place.shift, k, exact.sum(), found.sum(), index, table_index,
                    (found - exact).abs().sum() / 2 / exact.sum());
            CHECK(std::abs(found.sum() - gamma) < 0.1 * gamma + 0.3);
            CHECK(std::abs(table_index - index) < 0.03);
            by_patches += exact.sum();
            by_table += found.sum();
            misplaced += (found - exact).abs().sum() / 2;
            const double q = y_over_q(wheel, side), outwards = side == WheelsetSide::right ? -1 : 1;
            CHECK(q == Approx(outwards * forces.on_wheel[k].force[1] / -forces.on_wheel[k].force[2]).margin(0.02));
        }
    }
    CAPTURE(by_patches, by_table, misplaced / by_patches);
    CHECK(by_table == Approx(by_patches).epsilon(0.03));
    CHECK(misplaced < 0.15 * by_patches);
}

TEST_CASE("A flange that presses outwards has Y/Q above 0 on either side", "[wear]") {
    const Place right{6.5e-3, 5e-3, 0}, left{-6.5e-3, -5e-3, 0};
    const double q = y_over_q(right.by_table(WheelsetSide::right), WheelsetSide::right);
    CHECK(q > 0.2);
    CHECK(y_over_q(left.by_table(WheelsetSide::left), WheelsetSide::left) == Approx(q));
}

TEST_CASE("Work is done where a point slips, at its place on the rail", "[wear]") {
    const Profile& rail = track().wheel().rail();
    for (const Place& place : places) {
        for (WheelForces::Point point : place.by_table(WheelsetSide::right).points) {
            if (!(point.load_share > 0)) continue;
            const Profile::Point found = rail.at(arc_length(rail, point));
            CHECK(found.y == Approx(point.rail_y).margin(2e-6));
            CHECK(std::atan2(found.slope[1], found.slope[0]) == Approx(point.angle).margin(0.1));
            // rigid slip vanishes at y = b and is largest at y = -b
            point.creepage = {5e-3, 0, 5e-3 / point.ellipse.half_width()};
            point.force = {-1e3, 0, 0};
            const PatchForce turned = strip_work_of(point, creep(), mu);
            CHECK(turned.strip_work.head(5).sum() > turned.strip_work.tail(5).sum());
            CHECK(turned.edges[0] == Approx(-point.ellipse.half_width()));
        }
    }
}

TEST_CASE("Work of a point without load or without slip", "[wear]") {
    CHECK(strip_work_of({}, creep(), mu).status == Status::no_contact);
    WheelForces::Point point = places[0].by_table(WheelsetSide::right).points[0];
    for (const WheelForces::Point& other : places[0].by_table(WheelsetSide::right).points) {
        if (other.load_share > point.load_share) point = other;
    }
    point.creepage = {1e-9, 0, 0};
    point.force = {-1, 0, 0};
    const PatchForce still = strip_work_of(point, creep(), mu, {.strips = 8, .elements = 8});
    CHECK(still.strip_work.sum() == Approx(1e-9));
    CHECK(still.strip_work.minCoeff() > 0);
    CHECK((still.strip_work - still.strip_work.reverse()).abs().maxCoeff() < 1e-22);
    CHECK(std::isnan(arc_length(track().wheel().rail(), [&] {
        WheelForces::Point beside = point;
        beside.rail_y = 1;
        return beside;
    }())));
    const auto kalker = creep_coefficients(creep(), PatchContact<double>({6e-3, 6e-3, 8e10, 0.28}));
    CHECK(kalker.c11 == Approx(4.2262).epsilon(5e-3));  // on a circle
    CHECK(kalker.c22 == Approx(3.7049).epsilon(5e-3));
    CHECK(kalker.c23 == Approx(1.4881).epsilon(2e-2));
}

}  // namespace
}  // namespace wear_tests
