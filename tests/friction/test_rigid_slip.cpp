// rollbem/friction/model.hpp: a rigid slip of each element besides the creepage, RigidMotion::with_rows
#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include <rollbem/patch.hpp>

#include "friction/any_model.hpp"
#include "support/catch.hpp"

namespace rigid_slip_tests {

using namespace rollbem;
using Vectors = ElementVectors;
using Motion = RigidMotion<Creepage>;

namespace {

constexpr NodeDifference chebyshev{Nodes::chebyshev};
constexpr double G = 8e10, a = 5e-3, mu = 0.3, V = 20;
constexpr Travel travel{0.2 * a, 0.2 * a / V};
constexpr Creepage some{6e-4, -4e-4, 0.2}, other{-2e-4, 8e-4, 0.3};

/// The rigid slip of a creepage at the points of the equations.
Vectors rows_of(const Elements<double>& elements, const Creepage& creepage) {
    Vectors rows(elements.size(), 2);
    rows.col(0) = creepage.longitudinal - creepage.spin * a * elements.y;
    rows.col(1) = creepage.lateral + creepage.spin * a * elements.x;
    return rows;
}

double difference(const TangentialForce& one, const TangentialForce& two) {
    return std::max({std::abs(one.longitudinal - two.longitudinal), std::abs(one.lateral - two.lateral),
                     std::abs(one.moment - two.moment) / a});
}

TEST_CASE("Slip by rows equals slip by creepages", "[friction]") {
    const Friction::Law law = GENERATE(0, 1) == 0 ? Friction::Law(mu) : Friction::Law(ExponentialFall{mu, 0.2, 0.05});
    const PatchContact contact({.half_length = a, .half_width = 4e-3, .shear_modulus = G, .poisson_ratio = 0.28});
    const PatchMesh<double> mesh = patch_mesh(contact, 6, 5);
    const ElementSystem system = rolling_system(mesh, chebyshev, HalfSpace<double>(0.28));
    const Vectors first = rows_of(system.elements(), some), last = rows_of(system.elements(), other);
    const Vectors shift = first * travel.dq, half_last = last / 2;
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
        const FrictionModel model(contact, system, unchecked, {law, hertz_pressures(contact, mesh, 6e4)}, integrator);
        auto workspace = model.workspace(), by_rows = model.workspace();
        auto now = model.at_rest(), next = now, following = now;
        const auto same = [&](const FrictionStep& expected, const FrictionStep& step) {
            REQUIRE(expected.status == Status::ok);
            CHECK(step.status == Status::ok);
            const double unit = std::abs(expected.force.lateral);
            CAPTURE(rollbem::name(integrator), expected.force.longitudinal, expected.force.lateral);
            CHECK(difference(step.force, expected.force) < 1e-10 * unit);
            CHECK(difference(step.tangent.by_lateral, expected.tangent.by_lateral) < 1e-7 * unit / 1e-3);
            CHECK(difference(step.tangent.by_spin, expected.tangent.by_spin) < 1e-7 * unit * a / 1e-3);
            CHECK(step.slip_work == Approx(expected.slip_work).epsilon(1e-9));
            CHECK((next.traction - following.traction).cwiseAbs().maxCoeff() < 1e-9 * G * 1e-3);
            CHECK((workspace.slip() - by_rows.slip()).norm() <= 1e-9 * workspace.slip().norm());
        };
        same(model.steady(now, {Travel::at_speed(V), some}, next, workspace),
             model.steady(now, {Travel::at_speed(V), Motion({}).with_rows(first)}, following, by_rows));
        now = next;
        same(model.advance(now, {travel, Motion::linear(some, other)}, next, workspace),
             model.advance(now, {travel, Motion::linear({}, {}).with_rows(first, last)}, following, by_rows));
        now = next;
        // half by creepages, half by rows
        const Creepage half{other.longitudinal / 2, other.lateral / 2, other.spin / 2};
        same(model.advance(now, {travel, other}, next, workspace),
             model.advance(now, {travel, Motion(half).with_rows(half_last)}, following, by_rows));
        now = next;
        const Creepage moved{some.longitudinal * travel.dq, some.lateral * travel.dq, some.spin * travel.dq};
        same(model.advance(now, {{0, travel.duration}, Motion::shift(moved)}, next, workspace),
             model.advance(now, {Travel{0, travel.duration}, Motion::shift({}).with_rows(shift)}, following, by_rows));
    }
}

/// A line with equal kernels in both directions, whose slip is not turned; and slip that only rows can vary along it.
const any_model::Setup line{
    .directions = 2, .integrator = Integrator::implicit_euler, .mesh = cosine_mesh<double>(24), .nu = 0};
Vectors bent_rows() {
    const ArrayX<double> x = line.mesh.centres() + line.mesh.widths() / 2;
    Vectors rows(24, 2);
    rows.col(0) = 0.6 * any_model::sliding * (x.square() - 0.3 * x);
    rows.col(1) = 0.4 * any_model::sliding * (x - 0.5 * x.square());
    return rows;
}

TEST_CASE("Any contact with friction takes slip by rows", "[friction]") {
    const Vectors rows = bent_rows(), crossed = rows.rowwise().reverse();
    const auto force = [](int directions, bool across, const Motion& motion) {
        any_model::Setup setup = line;
        setup.directions = directions;
        setup.across = across;
        const FrictionModel model = any_model::make(setup);
        Run run(model);
        REQUIRE(run.steady({Travel::at_speed(1), motion}).status == Status::ok);
        return run.advance({Travel{0.1 * any_model::a, 1}, motion}).force;
    };
    const double creeps = any_model::creepage(0.14).longitudinal;
    const TangentialForce along = force(1, false, Motion(creeps, 0).with_rows(rows)),
                          across = force(1, true, Motion(0, creeps).with_rows(crossed));
    CHECK(along.longitudinal != force(1, false, Motion(creeps, 0)).longitudinal);
    CHECK(along.lateral == 0);
    CHECK(across.lateral == along.longitudinal);
    CHECK(across.longitudinal == 0);
    // the half of both directions without slip across
    Vectors alone = rows;
    alone.col(1).setZero();
    const TangentialForce both = force(2, false, Motion(creeps, 0).with_rows(alone));
    CHECK(both.longitudinal == Approx(along.longitudinal).epsilon(1e-12));
}

TEST_CASE("Slip by rows of another number, or not finite, is refused", "[friction]") {
    const FrictionModel model = any_model::make(line);
    Run run(model);
    const auto refused = [&](const Motion& motion, Status status) {
        CHECK(run.steady({Travel::at_speed(1), motion}).status == status);
        CHECK(run.advance({1e-4, motion}).status == status);
        CHECK(run.next().traction.isZero(0));
    };
    Vectors rows = bent_rows();
    const Vectors fewer = rows.topRows(23);
    refused(Motion({}).with_rows(fewer), Status::invalid_step);
    refused(Motion({}).with_rows(rows, fewer), Status::invalid_step);
    CHECK(run.steady({Travel::at_speed(1), Motion::shift({})}).status == Status::invalid_step);
    rows(3, 1) = std::numeric_limits<double>::quiet_NaN();
    refused(Motion({}).with_rows(rows), Status::not_finite);
    const AdhesionModel<> adhesion(line.contact(), line.system(false), unchecked);
    const Eigen::VectorXd slip = bent_rows().col(0);
    CHECK(Run(adhesion).advance({1e-4, RigidMotion<double>(1e-3).with_rows(slip)}).status == Status::invalid_step);
}

template <class First, class... Last>
constexpr bool are_rows = requires(const Motion& motion, First&& first, Last&&... last) {
    motion.with_rows(std::forward<First>(first), std::forward<Last>(last)...);
};

TEST_CASE("A motion cannot refer to rows that are gone, nor weights to a system", "[friction]") {
    STATIC_REQUIRE(are_rows<const Vectors&>);
    STATIC_REQUIRE(are_rows<Vectors&, const Vectors&>);
    STATIC_REQUIRE(are_rows<Motion::RowsView, Motion::RowsView>);  // whose owner the caller keeps
    STATIC_REQUIRE_FALSE(are_rows<Vectors>);
    STATIC_REQUIRE_FALSE(are_rows<const Vectors>);
    STATIC_REQUIRE_FALSE(are_rows<Vectors, const Vectors&>);
    STATIC_REQUIRE_FALSE(are_rows<const Vectors&, Vectors>);
    STATIC_REQUIRE_FALSE(are_rows<Vectors, Vectors>);
    STATIC_REQUIRE_FALSE(are_rows<decltype(Vectors() / 2)>);
    STATIC_REQUIRE(std::is_same_v<decltype(std::declval<ElementSystem<double>>().weights()), ArrayX<double>>);
}

}  // namespace

}  // namespace rigid_slip_tests
