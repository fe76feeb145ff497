// rollbem/vehicle/wear.hpp: work, fatigue and Y/Q by table, beside patches at the same places.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>

#include <rollbem/normal/profile.hpp>
#include <rollbem/normal/profile_wear.hpp>
#include <rollbem/scene/detail/mirror.hpp>
#include <rollbem/vehicle/wear.hpp>
#include <rollbem/vehicle/wheelset_forces.hpp>

#include "support/catch.hpp"
#include "support/refusal.hpp"
#include "vehicle/made_tables.hpp"

namespace wear_tests {
namespace {

using namespace rollbem;
using testing::s1002_60e1, testing::s1002_on_60e1, testing::steel;

constexpr double load = 1e5, mu = 0.3, speed = 15, radius = 0.46;

/// A place in a curve to the left.
struct Place {
    double shift, yaw, curvature;

    WheelsetPosition position() const { return {.lateral = shift, .yaw = yaw}; }
    WheelsetSpeeds speeds() const {
        return {.forward = speed, .pitch_rate = -speed / radius, .yaw_rate = -speed * curvature};
    }
    WheelForces by_table(WheelsetSide side) const {
        const WheelForces found = s1002_60e1().look_up(steel(), side, position(), speeds(), load, mu);
        REQUIRE(found.status == Status::ok);
        return found;
    }
};
constexpr Place places[] = {{1e-3, 0, 4e-4}, {3.2e-3, -2e-4, 1e-3}, {5.2e-3, 5e-4, 2.5e-3}, {6.2e-3, 4e-3, 3e-3}};

TEST_CASE("Work and fatigue by table agree with patches at the same places", "[wear]") {
    WheelsetOnTrack::Workspace workspace;
    const Profile& rail = s1002_on_60e1().wheel().rail();
    constexpr Eigen::Index cells = 300;
    double by_patches = 0, by_table = 0, misplaced = 0;
    for (const Place& place : places) {
        WheelsetRolling rolling{.position = place.position(), .loads = {load, load}, .speeds = place.speeds()};
        rolling.free_pitch = false;
        const WheelsetForces forces = rolling_forces(s1002_on_60e1(), rolling, {.coefficient = mu}, workspace);
        REQUIRE(has_numbers(forces.contacts.status));
        for (const WheelsetSide side : {WheelsetSide::left, WheelsetSide::right}) {
            const auto k = std::size_t(side);
            ProfileWear wear(rail, cells);
            double index = -1, gamma = 0, peak = 0;
            for (std::size_t i = 0; i < forces.patches[k].size(); ++i) {
                const RailPatch& patch = forces.contacts.wheels[k].patches[i];
                wear.add(patch.rail_s, forces.patches[k][i]);
                index = std::max(index, surface_fatigue_index(patch, forces.patches[k][i], 3e8));
                gamma += t_gamma(forces.patches[k][i]);
                peak = std::max(peak, patch.peak_pressure);
            }
            const Eigen::ArrayXd exact = wear.work() * wear.width();
            const WheelForces wheel = place.by_table(side);
            ProfileWear table(rail, cells);
            double table_index = -1, table_gamma = 0, table_peak = 0;
            for (const WheelForces::Point& point : wheel.points) {
                if (!(point.load_share > 0)) continue;
                table.add(arc_length(rail, point), strip_work_of(point, steel(), mu));
                table_gamma += t_gamma(point);
                table_index = std::max(table_index, surface_fatigue_index(point, 3e8));
                table_peak = std::max(table_peak, point.peak_pressure);
            }
            const Eigen::ArrayXd found = table.work() * table.width();
            CAPTURE(place.shift, k, table_peak / peak, exact.sum(), found.sum(), index, table_index,
                    (found - exact).abs().sum() / 2 / exact.sum());
            CHECK(table_gamma > 0);
            CHECK(found.sum() == Approx(table_gamma).epsilon(1e-12));
            CHECK(table_gamma * speed == Approx(wheel.heat).epsilon(2e-2));  // V of each point is not the vehicle's
            CHECK(std::abs(table_gamma - gamma) < 0.1 * gamma + 0.3);
            CHECK(std::abs(table_index - index) < 0.03);
            CHECK(table_peak == Approx(peak).epsilon(0.04));
            by_patches += exact.sum();
            by_table += found.sum();
            misplaced += (found - exact).abs().sum() / 2;
            const double q = y_over_q(wheel, side), outwards = side == WheelsetSide::right ? -1 : 1;
            CHECK(q == Approx(outwards * forces.on_wheel[k].force[1] / -forces.on_wheel[k].force[2]).margin(0.02));
            if (place.shift > 6e-3 && side == WheelsetSide::right) CHECK(q > 0.2);  // the flange presses outwards
        }
    }
    CAPTURE(by_patches, by_table, misplaced / by_patches);
    CHECK(y_over_q(Place{-6.2e-3, -4e-3, -3e-3}.by_table(WheelsetSide::left), WheelsetSide::left) > 0.2);
    CHECK(by_table == Approx(by_patches).epsilon(0.03));
    CHECK(misplaced < 0.15 * by_patches);
}

TEST_CASE("Work is done where a point slips, at its place on the rail", "[wear]") {
    const Profile& rail = s1002_on_60e1().wheel().rail();
    for (const Place& place : places) {
        for (WheelForces::Point point : place.by_table(WheelsetSide::right).points) {
            if (!(point.load_share > 0)) continue;
            const Profile::Point found = rail.at(arc_length(rail, point));
            CHECK(found.y == Approx(point.rail_y).margin(2e-6));
            CHECK(std::atan2(found.slope[1], found.slope[0]) == Approx(point.angle).margin(0.1));
            // rigid slip vanishes at y = b and is largest at y = -b
            point.creepage = {5e-3, 0, 5e-3 / point.ellipse.half_width()};
            point.force = {-1e3, 0, 0};
            const PatchForce turned = strip_work_of(point, steel(), mu);
            CHECK(turned.strip_work.head(5).sum() > turned.strip_work.tail(5).sum());
            CHECK(turned.edges[0] == Approx(-point.ellipse.half_width()));
        }
    }
}

TEST_CASE("Backwards, work lies where it lies in the mirror image that rolls forward", "[wear]") {
    for (const Place& place : places) {
        for (const WheelsetSide side : {WheelsetSide::left, WheelsetSide::right}) {
            const WheelForces forward = place.by_table(side);
            const WheelForces backwards =
                s1002_60e1().look_up(steel(), side, detail::mirrored(place.position(), detail::Mirror::reversing_x()),
                                     detail::mirrored(place.speeds(), detail::Mirror::reversing_x()), load, mu);
            REQUIRE(backwards.status == Status::ok);
            for (std::size_t k = 0; k < forward.points.size(); ++k) {
                const WheelForces::Point &one = forward.points[k], &image = backwards.points[k];
                if (!(one.load_share > 0)) continue;
                CHECK(one.rolling_velocity == Approx(speed).epsilon(0.05));
                CHECK(image.rolling_velocity == -one.rolling_velocity);
                CHECK(one.heat == Approx(t_gamma(one) * one.rolling_velocity));
                const Eigen::ArrayXd work = strip_work_of(one, steel(), mu).strip_work;
                CHECK((strip_work_of(image, steel(), mu).strip_work - work).abs().maxCoeff() < 1e-12 * work.sum());
            }
        }
    }
}

WheelForces::Point loaded_point() {
    const WheelForces wheel = places[0].by_table(WheelsetSide::right);
    return *std::ranges::max_element(wheel.points, {}, &WheelForces::Point::load_share);
}

TEST_CASE("Work of a point is refused where it is unknown", "[wear]") {
    const WheelForces::Point point = loaded_point();
    const auto refused = [&](double coefficient, const SimplifiedTheory::Mesh& mesh) {
        return refusal([&] { strip_work_of(point, steel(), coefficient, mesh); });
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(refused(-0.1, {}) == "strip_work_of: friction_coefficient = -0.1 must be finite and not negative");
    CHECK(refused(nan, {}) == "strip_work_of: friction_coefficient = nan must be finite and not negative");
    for (const double coefficient : {0.0, mu}) {
        for (const int strips : {2, 0, -5}) {
            CHECK(refused(coefficient, {.strips = strips}) ==
                  "strip_work_of: number of strips = " + std::to_string(strips) + " must be at least 3");
        }
        CHECK(refused(coefficient, {.elements = 0}) == "strip_work_of: number of elements = 0 must be at least 1");
    }
    WheelForces::Point other = point;
    other.ellipse = PatchContact({point.ellipse.half_length(), point.ellipse.half_width(), 8e10, 0.35});
    CHECK(refusal([&] { strip_work_of(other, steel(), mu); }) ==
          "creep_coefficients: poisson_ratio = 0.35 must be within 0.01 of the table's, 0.28");

    // nothing slips under a bound that is never reached: as the load
    CHECK(strip_work_of(point, steel(), 1e300).strip_work.sum() == Approx(t_gamma(point)).epsilon(1e-12));
    CHECK(strip_work_of(point, steel(), 0, {.strips = 3}).strip_work.size() == 3);
    for (const double coefficient : {0.0, mu}) {
        for (const Creepage& creepage : {Creepage{nan, 0, 0}, {0, 1e308, 0}}) {
            other = point;
            other.creepage = creepage;
            const PatchForce found = strip_work_of(other, steel(), coefficient);
            CHECK(found.status == Status::not_finite);
            CHECK(found.strip_work.size() == 0);
        }
    }
}

TEST_CASE("Wear over a profile takes work at any place, and none without result", "[wear]") {
    const Profile& rail = s1002_on_60e1().wheel().rail();
    ProfileWear wear(rail, 50);
    PatchForce friction = strip_work_of(loaded_point(), steel(), mu);
    const double work = friction.strip_work.sum();
    REQUIRE(work > 0);
    for (const double s : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        CHECK(refusal([&] { wear.add(s, friction); }).starts_with("ProfileWear: s = "));
    }
    CHECK((wear.work() == 0).all());
    wear.add(-1e300, friction);
    wear.add(1e300, friction, 2);
    CHECK(wear.work()[0] * wear.width() == Approx(work).epsilon(1e-12));
    CHECK(wear.work().tail(1)[0] * wear.width() == Approx(2 * work).epsilon(1e-12));
    const Eigen::ArrayXd before = wear.work();
    friction.status = Status::not_converged;
    wear.add(rail.length() / 2, friction);
    wear.add(std::numeric_limits<double>::quiet_NaN(), {});
    CHECK((wear.work() == before).all());
}

TEST_CASE("Laws of wear", "[wear]") {
    // kg per metre and m^2, of x in N/mm^2
    const auto rate = [](const ProfileWear::Law& law, double x) {
        return law.depth({.work = 1e6 * x, .pressure = 1e9, .slip = 1e-3, .sliding_velocity = 0.1}) * 7850 / 1e-3;
    };
    const ProfileWear::Law law = ProfileWear::Law::t_gamma(), table({2, 4}, {10, 30});
    for (const auto& [x, k] : {std::array{0.0, 0.0},
                               {5.0, 26.5},
                               {10.4, 55.12},
                               {50.0, 55.12},
                               {77.2, 55.12},
                               {100.0, 55.12 + 61.9 * 22.8}}) {
        CHECK(rate(law, x) == Approx(k).epsilon(1e-12).margin(1e-12));
    }
    for (const auto& [x, k] : {std::array{1.0, 10.0}, {2.5, 15.0}, {9.0, 30.0}, {0.0, 0.0}}) {
        CHECK(rate(table, x) == Approx(k).epsilon(1e-12).margin(1e-12));
    }
    // Archard: seizure, mild, severe and again mild wear
    const ProfileWear::Law archard = ProfileWear::Law::archard_kth();
    for (const auto& [pressure, velocity, k] :
         {std::array{2.5e9, 0.1, 350e-4}, {1e9, 0.1, 5e-4}, {1e9, 0.2, 35e-4}, {1e9, 0.7, 35e-4}, {1e9, 0.8, 5e-4}}) {
        CHECK(archard_coefficient(pressure, velocity) == k);
        CHECK(archard.depth({0, pressure, 1e-3, velocity}) == Approx(k * pressure * 1e-3 / 3e9));
    }
    CHECK(refusal([] { ProfileWear::Law({}, {}); }) == "ProfileWear::Law: number of places = 0 must be at least 1");
    CHECK(refusal([] {
              ProfileWear::Law({1, 1}, {1, 1});
          }) == "ProfileWear::Law: t_gamma_per_area = 1 must lie above the one before");
    CHECK(refusal([] { ProfileWear::Law({1}, {-1}); }) ==
          "ProfileWear::Law: rate = -1 must be finite and not negative");
    CHECK(refusal([] {
              ProfileWear::Law({1}, {1, 2});
          }) == "ProfileWear::Law: number of rates = 2 must be the number of places");
    CHECK(refusal([] { ProfileWear::Law::archard_kth(0); }) ==
          "ProfileWear::Law: hardness = 0 must be positive and finite");
}

TEST_CASE("Wear of patches is the law's sum over their elements", "[wear]") {
    WheelsetOnTrack::Workspace workspace;
    const Place& place = places[3];
    WheelsetRolling rolling{.position = place.position(), .loads = {load, load}, .speeds = place.speeds()};
    rolling.free_pitch = false;
    const WheelsetForces forces = rolling_forces(s1002_on_60e1(), rolling, {.coefficient = mu}, workspace);
    const Profile& rail = s1002_on_60e1().wheel().rail();
    for (const ProfileWear::Law& law : {ProfileWear::Law::t_gamma(), ProfileWear::Law::archard_kth()}) {
        ProfileWear wear(rail, 700);
        double sum = 0;
        for (std::size_t i = 0; i < forces.patches[1].size(); ++i) {
            const PatchForce& friction = forces.patches[1][i];
            REQUIRE(friction.status == Status::ok);
            CHECK(friction.work.sum() == Approx(friction.slip_work).epsilon(1e-12));
            const PatchForce worn = wear_of(friction, law, speed);
            double own = 0;
            for (Eigen::Index k = 0; k < friction.slip.size(); ++k) {
                const Yield::LoadedRectangle& e = friction.surface[friction.first_element + std::size_t(k)];
                const double area = (e.x_2 - e.x_1) * (e.y_2 - e.y_1), slip = friction.slip[k];
                own += area * law.depth({friction.work[k] / area, e.pressure, slip, slip * speed});
                // work is traction times slip where both are taken at one place
                CHECK(friction.work[k] <= 1.3 * area * std::hypot(e.traction_x, e.traction_y) * slip + 1e-9);
            }
            CHECK(worn.strip_work.sum() == Approx(own).epsilon(1e-12));
            CHECK(worn.strip_work.minCoeff() >= 0);
            wear.add(forces.contacts.wheels[1].patches[i].rail_s, worn);
            sum += own;
            // wear in proportion to work lies where the work does
            const auto middle = [](const PatchForce& of) {
                const Eigen::Index n = of.strip_work.size();
                return ((of.edges.head(n) + of.edges.tail(n)) / 2 * of.strip_work).sum() / of.strip_work.sum();
            };
            const PatchForce even = wear_of(friction, ProfileWear::Law({0, 1e6}, {0, 1e6}), speed);
            CHECK(even.strip_work.sum() == Approx(friction.slip_work * 1e-9 / 7850).epsilon(1e-12));
            CHECK(middle(even) == Approx(middle(friction)).margin(0.05 * friction.edges.maxCoeff()));
        }
        CHECK(sum > 0);
        const Eigen::ArrayXd means = wear.at_points(rail);
        CHECK((means * lengths_at_points(rail)).sum() == Approx(sum).epsilon(1e-9));
        // worn area = the law's sum, however it is spread
        const Eigen::ArrayXd area = spread(rail, 1e4 * means, 1e-3);
        CHECK((area * lengths_at_points(rail)).sum() == Approx(1e4 * sum).epsilon(1e-9));
        CHECK(area.minCoeff() >= 0);
    }
    CHECK(wear_of({}, ProfileWear::Law::t_gamma(), speed).strip_work.size() == 0);
}

TEST_CASE("Work of a point without load or without slip", "[wear]") {
    CHECK(strip_work_of({}, steel(), mu).status == Status::no_contact);
    WheelForces::Point point = loaded_point();
    point.creepage = {1e-9, 0, 0};
    point.force = {-1, 0, 0};
    const PatchForce still = strip_work_of(point, steel(), mu, {.strips = 8, .elements = 8});
    CHECK(still.strip_work.sum() == Approx(1e-9));
    CHECK(still.strip_work.minCoeff() > 0);
    CHECK((still.strip_work - still.strip_work.reverse()).abs().maxCoeff() < 1e-22);
    point.rail_y = 1;
    CHECK(std::isnan(arc_length(s1002_on_60e1().wheel().rail(), point)));
    const auto kalker = creep_coefficients(steel(), PatchContact({6e-3, 6e-3, 8e10, 0.28}));
    CHECK(kalker.c11 == Approx(4.2262).epsilon(5e-3));  // on a circle
    CHECK(kalker.c22 == Approx(3.7049).epsilon(5e-3));
    CHECK(kalker.c23 == Approx(1.4881).epsilon(2e-2));
}

TEST_CASE("Of two places of a profile below one another a point lies on the one with its angle", "[wear]") {
    // more than half a circle, whose ends hang over
    constexpr double R = 0.03;
    const Eigen::ArrayXd turn = Eigen::ArrayXd::LinSpaced(1001, -2, 2);
    const Profile head(R * turn.sin(), R * (1 - turn.cos()), Profile::Use::piece);
    for (const double at : {1.2, std::numbers::pi - 1.2}) {
        WheelForces::Point point;
        point.rail_y = R * std::sin(1.2);
        point.angle = at;
        CHECK(arc_length(head, point) == Approx(R * (2 + at)).epsilon(1e-4));
    }
}

}  // namespace
}  // namespace wear_tests
