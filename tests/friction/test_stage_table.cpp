// rollbem/rolling/run.hpp: a row of the table of stages is all of a scheme, with friction.
// The row {2, 1/2} is two steps of implicit Euler, each of half the distance.
#include <cmath>

#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/friction/detail/rolling_friction.hpp>
#include <rollbem/line.hpp>

#include "support/catch.hpp"

namespace stage_table_tests {
namespace {

using namespace rollbem;
using Motion = FrictionModel::Motion;

constexpr detail::StageTable halves(2, 0.5);
constexpr double a = 5e-3, G = 8e10, dq = 0.3 * a, p_0 = 5e8;

const Contact contact({.half_length = a, .half_width = 5e-2, .shear_modulus = G, .poisson_ratio = 0.28});
const Mesh<double> mesh = cosine_mesh(8);
ElementSystem<double> line(const PlaneKernel<double>& kernel) { return rolling_system(mesh, Collocation{}, kernel); }
const ElementSystem<double> along = line(PlaneKernel<double>::longitudinal(contact)),
                            across = line(PlaneKernel<double>::lateral(contact));

/// A step of the row against two of implicit Euler, from steady rolling, while the load grows: all that it returns.
template <int directions>
void compare(const ElementSystem<double, directions>& system, const Friction::Law& law, const Creepage& start,
             const Creepage& middle, const Creepage& end, double growth) {
    const Friction friction{law, ArrayX<double>(p_0 * mean_hertz_pressure(mesh))};
    const FrictionModel model(contact, system, unchecked, friction, Integrator::implicit_euler);
    const detail::ContactData<directions> data("test", contact, system, friction);
    detail::StepScratch<directions> own(data.size(), false, data.varies());
    auto workspace = model.workspace();
    auto from = model.at_rest(), half = from, to = from, found = from;
    REQUIRE(model.steady(model.at_rest(), {Travel::at_speed(20), start}, from, workspace).status == Status::ok);
    const auto load = [&](double way) {
        const ArrayX<double> rate = mean_hertz_pressure(mesh);
        return NormalLoad{(1 + growth * way) * friction.normal_pressure, (1 + growth / 2 * way) * a, rate, 0};
    };
    const Travel whole{dq, dq / 20}, part{dq / 2, dq / 40};
    const NormalLoad two = load(0.5), three = load(1);
    const auto first = model.advance(from, {part, Motion::linear(start, middle), two}, half, workspace);
    const auto second = model.advance(half, {part, Motion::linear(middle, end), three}, to, workspace);
    const auto axes = [&](const auto& loaded) { return data.units.axes(loaded); };
    const auto components = [](const Creepage& value) {
        if constexpr (directions == 1) {
            return value.longitudinal;
        } else {
            return value;
        }
    };
    const auto motion = RigidMotion<detail::CreepageAlong<directions>>::linear(components(start), components(end));
    detail::TimeStep<directions> rolled{motion, a, axes(from), axes(three), whole.dq / a, halves};
    rolled.duration = whole.duration;
    const detail::LoadAtEnd end_load{three.normal_pressure, three.half_length, from.half_width, &three.pressure_rate};
    const auto step = detail::solve<directions>({data, rolled, from, end_load, own}, found);
    REQUIRE(second.status == Status::ok);
    REQUIRE(step.status == Status::ok);
    if (growth == 0) CHECK(step.complementarity_residual >= first.complementarity_residual);
    CHECK(found.zones == to.zones);
    CHECK((found.traction - to.traction).cwiseAbs().maxCoeff() < 1e-10 * p_0);
    const double work = first.slip_work + second.slip_work;
    CHECK(work > 0);
    CHECK(std::abs(step.slip_work - work) < 1e-9 * work);
    // the energy of elements is symmetric up to their error only
    const double jumps = first.jump_work + second.jump_work;
    CHECK(std::abs(step.jump_work - jumps) <= 1e-2 * jumps);
}

}  // namespace

TEST_CASE("With friction a row of the table is all of a scheme", "[stages][friction]") {
    const ExponentialFall falling{0.3, 0.18, 0.1};
    const ElementSystem<double, 2> both(along, across);
    for (const double growth : {0.0, 0.05}) {
        compare<1>(along, 0.3, {1e-3}, {2e-3}, {3e-3}, growth);
        compare<1>(along, falling, {1e-3}, {2e-3}, {3e-3}, growth);
        compare<2>(both, 0.3, {1e-3, 5e-4, 0}, {2e-3, -5e-4, 0}, {3e-3, -1.5e-3, 0}, growth);
        compare<2>(both, falling, {1e-3, 5e-4, 0}, {2e-3, -5e-4, 0}, {3e-3, -1.5e-3, 0}, growth);
    }
}

}  // namespace stage_table_tests
