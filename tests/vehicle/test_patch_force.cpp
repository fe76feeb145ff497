// rollbem/scene/wheelset.hpp, vehicle/detail/patch_elements.hpp, vehicle/wheelset_forces.hpp
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <rollbem/normal/profile.hpp>
#include <rollbem/normal/wheel_on_rail.hpp>
#include <rollbem/scene/detail/mirror.hpp>
#include <rollbem/scene/wheelset.hpp>
#include <rollbem/vehicle/wheelset_forces.hpp>
#include <rollbem/normal/detail/mirrored_patch.hpp>
#include <rollbem/vehicle/detail/mirrored_forces.hpp>
#include <rollbem/vehicle/detail/patch_elements.hpp>

#include "support/catch.hpp"
#include "vehicle/creep_force_scene.hpp"

namespace {

using namespace rollbem;
using creep_forces::array;

const WheelsetOnTrack& wheelset() {
    static const WheelsetOnTrack standard(WheelOnRail(s1002(), rail_uic60()));
    return standard;
}
const WheelOnRail& wheel() { return wheelset().wheel(); }
/// The right wheel at the gauge corner: the outline and the pressures have two lobes.
struct Scene {
    WheelsetPosition at;
    WheelsetSpeeds speeds{2, -4.35, 1e-3, 2e-3, 3e-3, 4e-3};
    RailPatch patch;

    explicit Scene(double lateral = 5e-3) {
        WheelsetOnTrack::Workspace workspace;
        const auto contacts = wheelset().solve({.lateral = lateral, .yaw = -3e-3}, {1e5, 1e5}, workspace);
        REQUIRE(has_numbers(contacts.status));
        at = contacts.seen(WheelsetSide::right);
        patch = contacts.wheels[1].patches.at(0);
    }
};

TEST_CASE("Creepages of a mirror image are mirror images of creepages, and forces on them", "[profiles]") {
    const Scene scene;
    const detail::Mirror mirror = GENERATE(detail::Mirror::reversing_x(), detail::Mirror::across_track());
    const RailPatch patch = mirrored(scene.patch, mirror);
    const WheelsetPosition at = mirrored(scene.at, mirror);
    const WheelsetSpeeds speeds = mirrored(scene.speeds, mirror);
    const Creepage own = mirrored(creepage_of(patch, at, speeds, 0.46), mirror),
                   expected = creepage_of(scene.patch, scene.at, scene.speeds, 0.46);
    CHECK(own.longitudinal == Approx(expected.longitudinal));
    CHECK(own.lateral == Approx(expected.lateral));
    CHECK(own.spin == Approx(expected.spin));
    const RollingFriction friction{.elements = 6, .strips = 7};
    const PatchForce force = patch_force(scene.patch, scene.at, scene.speeds, wheel().dimensions(), friction),
                     image = mirrored(patch_force(patch, at, speeds, wheel().dimensions(), friction), mirror);
    CHECK(((array(image.force) - array(force.force)).abs() <= 1e-9 * array(force.force).abs()).all());
    CHECK((image.edges - force.edges).abs().maxCoeff() < 1e-12);
    CHECK((image.strip_work - force.strip_work).abs().maxCoeff() < 1e-9 * force.slip_work);
}

TEST_CASE("The strips of a patch with two lobes are less than a third of the narrower one", "[profiles]") {
    struct Lobes {
        double second, width;  // height over the first one's, which is 0.1 wide, and width
        Eigen::Index strips;
    };
    const Lobes lobes = GENERATE(Lobes{1, 0.9, 25}, Lobes{0.2, 0.9, 25}, Lobes{0.02, 0.9, 13}, Lobes{0, 0.9, 13});
    const bool outlined = GENERATE(true, false);  // lobes of the outline, or of the pressures
    RailPatch patch;
    patch.status = Status::ok;
    patch.grid = {1, 200, 0, 0.0025, 1, 0.005};
    const Eigen::ArrayXd y = Eigen::ArrayXd::LinSpaced(200, patch.grid.y(0), patch.grid.y(199));
    const auto parabola = [&](double low, double width) -> Eigen::ArrayXd {
        return (4 * (y - low) / width * (1 - (y - low) / width)).max(0);
    };
    const Eigen::ArrayXd height = parabola(0, 0.1) + lobes.second * parabola(0.1, lobes.width),
                         even = Eigen::ArrayXd::Ones(200), half_length = outlined ? height.max(0.01) : even;
    patch.outline.emplace(y, -half_length, half_length);
    patch.pressure = (outlined ? even : height).transpose();
    CHECK(elements_for(patch).strips == lobes.strips);
    CHECK(elements_for(patch).along == 12);
}

TEST_CASE("Elements that are not given are those that the lobes of the patch need", "[profiles]") {
    const Scene scene(4.95e-3);
    const PatchElements needed = elements_for(scene.patch);
    REQUIRE(needed.strips > 13);  // those of one lobe
    const auto force = [&](const RollingFriction& friction) {
        return patch_force(scene.patch, scene.at, scene.speeds, wheel().dimensions(), friction).force.lateral;
    };
    CHECK(force({}) == force({.elements = needed.along, .strips = needed.strips}));
    CHECK(force({}) != force({.strips = 13}));
}

TEST_CASE("At the gauge corner each strip has the friction of the rail's surface below it", "[profiles]") {
    const Scene scene;
    const RollingFriction friction{
        .elements = 4,
        .strips = 9,
        .rail = RollingFriction::OnRail(RollingFriction::OnRail::Over::y, {-0.05, 0.05}, {0, 1})};
    const PatchForce slides =
        patch_force(scene.patch, scene.at, {.forward = 2, .pitch_rate = -2}, wheel().dimensions(), friction);
    REQUIRE(slides.status == Status::ok);
    double apart = 0;
    for (const Yield::LoadedRectangle& element : slides.surface) {
        const double y = scene.patch.surface_y((element.y_1 + element.y_2) / 2);
        const double traction = std::hypot(element.traction_x, element.traction_y);
        CHECK(traction == Approx(10 * (y + 0.05) * element.pressure).epsilon(1e-6));
        apart = std::max(apart, std::abs(y - scene.patch.rail_y - (element.y_1 + element.y_2) / 2));
    }
    CHECK(apart > 1e-4);
}

TEST_CASE("The load of a lobe grows from nothing as the wheelset shifts", "[profiles]") {
    double before = 0;
    for (double lateral = 4.36e-3; lateral < 4.6e-3; lateral += 2e-5) {
        CAPTURE(lateral);
        WheelsetOnTrack::Workspace workspace;
        const auto contacts = wheelset().solve({.lateral = lateral}, {1e5, 1e5}, workspace);
        CHECK(contacts.status == Status::ok);
        const auto& patches = contacts.wheels[1].patches;
        const double load = patches.size() > 1 ? patches[1].load : 0;
        CHECK(load >= before);
        CHECK(load - before < 1500);
        before = load;
    }
    CHECK(before > 1e4);
}

TEST_CASE("Pieces of one plane rub as the outline into which they grow together", "[profiles]") {
    const auto sum = [](double lateral, bool together, std::size_t count) {
        WheelsetOnTrack::Workspace workspace;
        const auto contacts = wheelset().solve({.lateral = lateral, .yaw = -3e-3}, {1e5, 1e5}, workspace);
        const auto& patches = contacts.wheels[1].patches;
        REQUIRE(patches.size() == count);
        REQUIRE(patches_by_plane(patches).size() == 1);
        WheelsetSpeeds speeds{.forward = 20};
        speeds.pitch_rate = -20 / patches[0].rolling_radius;
        const auto at = contacts.seen(WheelsetSide::right);
        const auto all = patch_forces(patches, at, speeds, wheel().dimensions(), {});
        double lateral_force = 0;
        for (std::size_t k = 0; k < count; ++k) {
            const PatchForce own = together ? all[k] : patch_force(patches[k], at, speeds, wheel().dimensions(), {});
            REQUIRE(own.status == Status::ok);
            lateral_force += own.force.lateral / (0.3 * 1e5);
        }
        return lateral_force;
    };
    const double before = sum(4.82e-3, true, 2), after = sum(4.84e-3, true, 1), alone = sum(4.82e-3, false, 2);
    CHECK(std::abs(after - before) < 0.01);
    CHECK(std::abs(after - alone) > 0.02);
}

TEST_CASE("Strips are taken away until friction is solved, down to 5, or once where there are fewer", "[profiles]") {
    std::vector<Eigen::Index> tried;
    const auto until = [&](Eigen::Index strips, Eigen::Index solved) {
        tried.clear();
        return with_fewer_strips({{4, strips}}, [&](const std::vector<PatchElements>& elements) {
            tried.push_back(elements[0].strips);
            return elements[0].strips == solved;
        });
    };
    CHECK(until(9, 7));
    CHECK(tried == std::vector<Eigen::Index>{9, 7});
    CHECK_FALSE(until(8, 1));
    CHECK(tried == std::vector<Eigen::Index>{8, 6});
    CHECK_FALSE(until(3, 1));
    CHECK(tried == std::vector<Eigen::Index>{3});
}

TEST_CASE("A compliant layer between wheel and rail makes a bristle model", "[profiles]") {
    // far softer than the half-spaces: traction = layer's stiffness times the slip that bristles have gathered
    const Scene scene(-2e-3);
    const double layer = 1e-8;
    RollingFriction friction{.coefficient = 1e6, .elements = 10, .strips = 15};
    friction.layer = layer;
    const PatchForce found = patch_force(scene.patch, scene.at, scene.speeds, wheel().dimensions(), friction);
    REQUIRE(found.status == Status::ok);
    double square = 0;  // integral of half the squared length
    const PatchContact::Outline& outline = *scene.patch.outline;
    constexpr int lines = 2000;
    for (int k = 0; k < lines; ++k) {
        const double s = outline.low() + (k + 0.5) / lines * (outline.high() - outline.low()),
                     length = outline.leading(s) - outline.trailing(s),
                     slip = found.creepage.longitudinal - found.creepage.spin * s;
        square += slip * length * length / 2 * (outline.high() - outline.low()) / lines;
    }
    CHECK(found.force.longitudinal == Approx(-square / layer).epsilon(2e-2));
    friction.layer = 0;
    const PatchForce stiff = patch_force(scene.patch, scene.at, scene.speeds, wheel().dimensions(), friction);
    CHECK(std::abs(found.force.longitudinal) < 0.05 * std::abs(stiff.force.longitudinal));
}

TEST_CASE("A longitudinal force is had by a pitch rate, or by none", "[profiles]") {
    WheelsetOnTrack::Workspace workspace;
    const RollingFriction friction{.coefficient = 0.3, .elements = 6, .strips = 7};
    const WheelsetPosition at = wheelset().solve({.lateral = -1e-3}, {1e5, 1e5}, workspace).position;
    for (const double forward : {20.0, -20.0}) {
        WheelsetRolling rolling{
            .position = at, .free = WheelsetOnTrack::Free::nothing, .speeds = {.forward = forward}, .force = 2e4};
        const WheelsetForces driven = rolling_forces(wheelset(), rolling, friction, workspace);
        CAPTURE(forward, driven.pitch_rate);
        REQUIRE(driven.contacts.status == Status::ok);
        CHECK(std::abs(driven.on_wheelset.force[0] - 2e4) < 1);
        CHECK((driven.pitch_rate < 0) == (forward > 0));
        rolling.force.reset();
        rolling.free_pitch = false;
        rolling.speeds.pitch_rate = driven.pitch_rate;
        const WheelsetForces given = rolling_forces(wheelset(), rolling, friction, workspace);
        CHECK(std::abs(given.on_wheelset.force[0] - 2e4) < 2);
    }
    const WheelsetForces carried = rolling_forces(
        wheelset(), {.position = {.lateral = -1e-3}, .speeds = {.forward = 20}, .force = 2e4}, friction, workspace);
    REQUIRE(carried.contacts.status == Status::ok);
    CHECK(std::abs(carried.on_wheelset.force[0] - 2e4) < 1);
    for (const WheelsetForces::Wrench& wheel : carried.on_wheel) CHECK(wheel.force[2] == Approx(-1e5).epsilon(1.01e-6));
    const WheelsetForces beyond = rolling_forces(
        wheelset(), {.position = at, .free = WheelsetOnTrack::Free::nothing, .speeds = {.forward = 20}, .force = 7e4},
        friction, workspace);
    for (const auto& patches : beyond.patches) {
        CHECK(patches.at(0).status == Status::no_solution);
        CHECK(patches.at(0).strip_work.size() == 0);
        CHECK(std::isnan(patches.at(0).force.longitudinal));
        CHECK(std::isnan(patches.at(0).creepage.longitudinal));
    }
    CHECK(std::isnan(beyond.on_wheelset.force[0]));
    CHECK(std::isnan(beyond.pitch_rate));
}

TEST_CASE("A longitudinal force of one wheel is had while the other one is lifted", "[profiles]") {
    WheelsetOnTrack::Workspace workspace;
    const WheelsetRolling rolling{.position = {.height = 3e-4, .roll = 4e-4},
                                  .free = WheelsetOnTrack::Free::nothing,
                                  .speeds = {.forward = 20},
                                  .force = 1e3};
    const WheelsetForces driven = rolling_forces(wheelset(), rolling, {.elements = 6, .strips = 7}, workspace);
    REQUIRE(driven.contacts.wheels[0].status == Status::no_contact);
    CHECK(driven.patches[1].at(0).status == Status::ok);
    CHECK(std::abs(driven.on_wheelset.force[0] - 1e3) < 0.5);
    double work = 0, peak = 0;
    for (const PatchForce& patch : driven.patches[1]) work += patch.slip_work;
    for (const RailPatch& patch : driven.contacts.wheels[1].patches) peak = std::max(peak, patch.peak_pressure);
    CHECK(driven.slip_work() == work);
    CHECK(driven.peak_pressure() == peak);
}

TEST_CASE("A longitudinal force within a jump of the contacts' grids is unbalanced", "[profiles]") {
    WheelsetOnTrack::Workspace workspace;
    const RollingFriction friction{.coefficient = 0.6, .elements = 3, .strips = 5};
    const WheelOnRail::Options few_cells{.cells_x = 8, .cells_s = 6, .halves_cells = false};
    WheelsetRolling rolling{.position = {.lateral = 7.5e-3, .yaw = 9e-4},
                            .free = WheelsetOnTrack::Free::height,
                            .speeds = {.forward = 20},
                            .force = 0};
    const WheelsetForces found = rolling_forces(wheelset(), rolling, friction, workspace, few_cells);
    REQUIRE(found.contacts.status == Status::unbalanced);
    CHECK(found.status() == Status::unbalanced);
    CHECK(std::abs(found.on_wheelset.force[0]) < 1e-2 * 2e5);
    // the forces are those at this rate, on one side of the jump
    rolling.force.reset();
    rolling.free_pitch = false;
    rolling.speeds.pitch_rate = found.pitch_rate;
    const double again = rolling_forces(wheelset(), rolling, friction, workspace, few_cells).on_wheelset.force[0];
    CHECK(again == Approx(found.on_wheelset.force[0]).epsilon(1e-6));
}

TEST_CASE("Loads are carried by normal forces alone where friction's vertical share is left out", "[profiles]") {
    WheelsetOnTrack::Workspace workspace;
    const RollingFriction friction{.coefficient = 0.3, .elements = 6, .strips = 7};
    const WheelsetRolling rolling{.position = {.lateral = 6.1e-3, .roll = 0, .yaw = 5e-3},
                                  .free = WheelsetOnTrack::Free::height,
                                  .loads_include_friction = false};
    const WheelsetForces normal = rolling_forces(wheelset(), rolling, friction, workspace);
    WheelsetOnTrack::Workspace other;
    const auto alone = wheelset().solve(rolling.position, rolling.loads, other, rolling.free);
    REQUIRE((has_numbers(normal.contacts.status) && has_numbers(alone.status)));
    CHECK(std::abs(normal.contacts.wheels[1].height - alone.wheels[1].height) < 1e-9);
    double share = 0;
    for (const RailPatch& patch : normal.contacts.wheels[1].patches) share += patch.vertical_load() / 1e5;
    CHECK(share == Approx(1).epsilon(2e-3));
    CHECK(std::abs(normal.on_wheel[1].force[2] / 1e5 + 1) > 0.02);
}

}  // namespace
