// rollbem/vehicle/creep_force_table.hpp, ReducedFriction: limits, what it refuses, and its distance from patches whose
// friction falls with the slip of each element.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <rollbem/line.hpp>
#include <rollbem/patch.hpp>
#include <rollbem/vehicle/creep_force_table.hpp>

#include "extremes/drawn.hpp"
#include "support/catch.hpp"
#include "support/refusal.hpp"
#include "vehicle/creep_force_scene.hpp"
#include "vehicle/made_tables.hpp"

namespace reduced_friction_tests {

using namespace rollbem;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using creep_forces::array, creep_forces::contact, creep_forces::numbers;
using testing::steel;

namespace {

constexpr double mu_0 = 0.5, load = 8e4, modulus = 8e10;
constexpr ReducedFriction::Parameters wet{
    .adhesion_factor = 0.6, .slip_factor = 0.25, .friction_ratio = 0.4, .fall = 0.6};

/// Creepages near saturation times `level`, in a random direction.
Creepage creepage(const PatchContact& patch, double level, drawn::Draw& draw) {
    const double unit = level * mu_0 * load / (4 * modulus * patch.c() * patch.c());
    return {unit * draw.normal(), unit * draw.normal(), unit / patch.c() * draw.normal()};
}

}  // namespace

TEST_CASE("reduced_friction: without reduction and fall, the numbers of the table") {
    drawn::Draw draw(1);
    for (const ReducedFriction& none : {ReducedFriction({}), ReducedFriction({.fall = 0.7})}) {
        for (int i = 0; i < 50; ++i) {
            const PatchContact patch = contact(draw.decades(-0.9, 1.1));
            const Creepage v = creepage(patch, i == 0 ? 0 : draw.decades(-2, 2), draw);
            const ReducedFriction::Force now = none.look_up(steel(), patch, mu_0, load, 30, v);
            const CreepForceTable::Force table = steel().look_up(patch, mu_0, load, v);
            REQUIRE(now.status == Status::ok);
            CHECK(now.a_over_b_on_table == table.a_over_b_on_table);
            CHECK(now.friction_coefficient == mu_0);
            CHECK((numbers(now) == numbers(table)).all());
            CHECK((array(now.tangent_by_speed) == 0).all());
        }
    }
}

TEST_CASE("reduced_friction: the initial slope, full sliding, and Polach's share between them") {
    const ReducedFriction friction(wet);
    const PatchContact patch = contact(1.7);
    const double slope = (wet.adhesion_factor + wet.slip_factor) / 2, stiffness = modulus * patch.c() * patch.c();
    const CreepForceTable::Force rest = steel().look_up(patch, mu_0, load, {});
    for (const double size : {0.0, 1e-9}) {  // beside rest as at it
        const ReducedFriction::Force now = friction.look_up(steel(), patch, mu_0, load, 20, {size, size, size});
        const Eigen::Array33d by_creepage = numbers(now).middleCols<3>(1),
                              expected = slope * numbers(rest).middleCols<3>(1);
        const auto largest = [](const Eigen::Array33d& of) { return of.abs().colwise().maxCoeff().eval(); };
        CHECK((largest(by_creepage - expected) <= 1e-4 * largest(expected)).all());
        CHECK_THAT(now.force.longitudinal, WithinAbs(slope * size * rest.tangent.by_longitudinal.longitudinal, 1e-6));
    }
    // full sliding at a slip velocity of 1.5 m/s, to the error of the table there
    const double mu = mu_0 * (0.6 * std::exp(-0.6 * 1.5) + 0.4);
    for (const double xi : {1e4, 1e6}) {
        const ReducedFriction::Force now =
            friction.look_up(steel(), patch, mu_0, load, 1.5 / xi, {0.6 * xi, -0.8 * xi, 0});
        CHECK_THAT(now.friction_coefficient, WithinRel(mu, 1e-12));
        CHECK_THAT(now.force.longitudinal, WithinRel(-0.6 * mu * load, 1e-4));
        CHECK_THAT(now.force.lateral, WithinRel(0.8 * mu * load, 1e-4));
    }
    // by spin alone: the slip velocity is V |phi| r, where x^2 and y^2 have the means a^2/5 and b^2/5
    const ReducedFriction::Force turning = friction.look_up(steel(), patch, mu_0, load, 30, {0, 0, 4});
    const double w = 30 * 4 * std::hypot(patch.half_length(), patch.half_width()) / std::sqrt(5);
    CHECK_THAT(turning.friction_coefficient, WithinRel(mu_0 * (0.6 * std::exp(-0.6 * w) + 0.4), 1e-12));
    // the ratio to the table's forces at the same mu
    for (const double level : {0.2, 1.0, 5.0}) {
        const double c11 = -rest.tangent.by_longitudinal.longitudinal / stiffness, xi = level * mu_0 * load / stiffness;
        const ReducedFriction::Force now = friction.look_up(steel(), patch, mu_0, load, 10, {xi, 0, 0});
        const double clean = steel().look_up(patch, now.friction_coefficient, load, {xi, 0, 0}).force.longitudinal,
                     eps = std::numbers::pi / 4 * c11 * stiffness * xi / (now.friction_coefficient * load);
        const auto polach = [eps](double k_A, double k_S) {
            return k_A * eps / (1 + std::pow(k_A * eps, 2)) + std::atan(k_S * eps);
        };
        CHECK_THAT(
            now.force.longitudinal / clean,
            WithinRel(polach(wet.adhesion_factor, wet.slip_factor) / polach(1, 1), 2e-3));  // c11 between ellipses
    }
}

TEST_CASE("reduced_friction: what it refuses, and contacts without creepage, load or friction") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    using Parameters = ReducedFriction::Parameters;
    for (const auto& row : {std::pair(Parameters{.adhesion_factor = 1.5}, "adhesion_factor = 1.5 must lie in (0, 1]"),
                            {{.adhesion_factor = 0.0, .slip_factor = 0.0}, "adhesion_factor = 0 must lie in (0, 1]"},
                            {{.adhesion_factor = 0.3, .slip_factor = 0.4},
                             "slip_factor = 0.4 must be positive and at most adhesion_factor"},
                            {{.slip_factor = 0}, "slip_factor = 0 must be positive and at most adhesion_factor"},
                            {{.friction_ratio = -0.1}, "friction_ratio = -0.1 must lie in [0, 1]"},
                            {{.friction_ratio = nan}, "friction_ratio = nan must lie in [0, 1]"},
                            {{.fall = -1}, "fall = -1 must be finite and not negative"}}) {
        CHECK(refusal([&] { ReducedFriction{row.first}; }) == std::string("ReducedFriction: ") + row.second);
    }

    const ReducedFriction friction(wet);
    const PatchContact patch = contact(1);
    const CreepForceTable& table = steel();
    static_assert(noexcept(friction.look_up(table, patch, mu_0, load, 1.0, Creepage{})));
    const auto at = [&](double mu, double N, double V, const Creepage& v) {
        return friction.look_up(table, patch, mu, N, V, v);
    };
    CHECK(friction.look_up(table, PatchContact({5e-3, 5e-3, modulus, 0.4}), mu_0, load, 1, {}).status ==
          Status::wrong_table);
    for (const ReducedFriction::Force& nothing :
         {at(0, load, 1, {1e-3, 0, 0}), at(mu_0, 0, 1, {1e-3, 0, 0}), at(mu_0, load, 1, {}), at(mu_0, load, 0, {})}) {
        CHECK(nothing.status == Status::ok);
        CHECK((array(nothing.force) == 0).all());
        CHECK((numbers(nothing).allFinite() && array(nothing.tangent_by_speed).allFinite()));
    }
}

TEST_CASE("reduced_friction: beside patches whose friction falls with the slip of each element") {
    constexpr ReducedFriction::Parameters dry{.friction_ratio = 0.4, .fall = 0.6};
    const ReducedFriction friction(dry);
    const PatchContact patch = contact(1.3);
    const PatchMesh<double> mesh = patch_mesh(patch, cosine_mesh(16), uniform_mesh(16));
    const auto system = steady_system(mesh, NodeDifference{Nodes::chebyshev}, HalfSpace<double>(0.28));
    const Eigen::ArrayXd pressure = hertz_pressures(patch, mesh, load);
    const ExponentialFall law{mu_0, dry.friction_ratio * mu_0, std::numbers::ln2 / dry.fall};
    const FrictionModel model(patch, system, Friction{law, pressure});
    const FrictionModel constant(patch, system, {mu_0, pressure});
    auto workspace = model.workspace();
    auto constant_workspace = constant.workspace();
    auto state = model.at_rest();
    auto constant_state = constant.at_rest();
    const Eigen::Array3d scale = Eigen::Array3d(1, 1, patch.c()) * mu_0 * load;
    drawn::Draw draw(11);
    Eigen::Array3d sum = Eigen::Array3d::Zero(), largest = sum, table_sum = sum;
    double ignored = 0;
    constexpr int count = 8;
    for (int i = 0; i < count; ++i) {
        const double level = draw.decades(-1, 1.3), speed = draw.uniform(1, 40);
        const Creepage v = creepage(patch, level, draw);
        const auto solved = model.steady(model.at_rest(), {Travel::at_speed(speed), v}, state, workspace);
        const auto clean = constant.steady(constant.at_rest(), {.motion = v}, constant_state, constant_workspace);
        REQUIRE(solved.status == Status::ok);
        REQUIRE(clean.status == Status::ok);
        const ReducedFriction::Force now = friction.look_up(steel(), patch, mu_0, load, speed, v);
        const CreepForceTable::Force table = steel().look_up(patch, mu_0, load, v);
        const Eigen::Array3d error = ((array(now.force) - array(solved.force)) / scale).abs();
        const Eigen::Array3d of_table = ((array(table.force) - array(clean.force)) / scale).abs();
        ignored = std::max(ignored, ((array(table.force) - array(solved.force)) / scale).abs().maxCoeff());
        sum += error / count;
        table_sum += of_table / count;
        largest = largest.max(error);
    }
    CAPTURE(sum.transpose(), largest.transpose(), table_sum.transpose(), ignored);  // ignored: without the fall
    CHECK((table_sum < 5e-4).all());
    CHECK((sum < Eigen::Array3d(0.003, 0.0045, 0.006)).all());
    CHECK((largest < Eigen::Array3d(0.026, 0.051, 0.034)).all());
    CHECK(ignored > 0.4);
}

}  // namespace reduced_friction_tests
