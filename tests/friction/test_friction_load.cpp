// rollbem/friction/model.hpp, state.hpp, normal/load.hpp: properties of a step under a varying load, independent of
// its accuracy.
#include <cmath>
#include <utility>
#include <vector>

#include <rollbem/compiled/friction.hpp>

#include "load_scene.hpp"
#include "support/catch.hpp"

namespace friction_tests {
namespace {

using State = FrictionState<>;
using Step = FrictionStep<>;
using Workspace = FrictionWorkspace<>;
using Motion = RigidMotion<double>;
using Load = NormalLoad<double>;

TEST_CASE("The half-length that a mesh is made for does not change the physics", "[friction][load]") {
    // the same history on meshes made for other half-lengths of the same contact; then steps without a load against a
    // model made for the last half-length
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
        const LoadScene scene = LoadScene::breathing(cosine_mesh<double>(24), 100);
        const FrictionModel<> model = scene.model(integrator);
        const SineLoad sine{.L = 4};
        State now = model.at_rest(), next = now;
        Workspace workspace = model.workspace();
        std::vector<double> expected;
        const auto ride = [&](const LoadScene& of, std::vector<double>& forces) {
            const FrictionModel<> rolling = of.model(integrator);
            Workspace own = rolling.workspace();
            State from = rolling.at_rest(), to = from;
            Load load = of.hertz.at(sine(0));
            FrictionStep<> step = rolling.steady(from, load_creepage(0.4), load, to, own);
            for (int k = 1; k <= 43; ++k) {
                forces.insert(forces.end(), {step.force, step.tangent, step.slip_work, rolling.force(to)});
                std::swap(from, to);
                REQUIRE(of.hertz.set(sine(0.1 * k), load) == StepStatus::ok);
                const Motion motion = Motion::linear(load_creepage(0.4 + 0.01 * k), load_creepage(0.41 + 0.01 * k));
                const Step loaded = rolling.advance(from, 0.1, motion, load, to, own);
                REQUIRE(loaded.status == StepStatus::ok);
                forces.insert(forces.end(), {loaded.tangent_by_load, loaded.tangent_by_half_length});
                step = loaded;
            }
            return to;
        };
        const State end = ride(scene, expected);
        for (const double made_for : {0.6, 1.7}) {
            std::vector<double> found;
            const State other_end = ride(LoadScene::breathing(scene.mesh, 100, made_for), found);
            CAPTURE(made_for, name(integrator));
            double worst = 0;
            for (std::size_t k = 0; k < expected.size(); ++k) {
                worst = std::max(worst, std::abs(found[k] / expected[k] - 1));
            }
            CHECK(worst < 1e-10);
            CHECK((other_end.traction - end.traction).cwiseAbs().maxCoeff() < 1e-12 * peak);
        }
        const FrictionModel<> there = LoadScene::breathing(scene.mesh, 100, end.half_length).model(integrator);
        State elsewhere = end, elsewhere_next = end;
        elsewhere.system = there.fingerprint();
        now = end;
        Workspace other = there.workspace();
        for (int k = 0; k < 20; ++k) {
            const double xi = load_creepage(0.7 * std::sin(0.5 * k));
            const FrictionStep<> one = model.advance(now, k % 5 == 4 ? 0 : 0.2, Motion::shift(xi), next, workspace);
            const FrictionStep<> two =
                there.advance(elsewhere, k % 5 == 4 ? 0 : 0.2, Motion::shift(xi), elsewhere_next, other);
            REQUIRE(one.status == StepStatus::ok);
            CHECK(one.force == Approx(two.force).epsilon(1e-10).margin(1e-10 * full_force * scene.contact.width()));
            CHECK(one.tangent == Approx(two.tangent).epsilon(1e-10));
            CHECK(one.slip_work ==
                  Approx(two.slip_work).epsilon(1e-9).margin(1e-12 * full_force * peak * scene.contact.width()));
            CHECK(next.half_length == end.half_length);
            CHECK((next.normal_pressure == end.normal_pressure).all());
            std::swap(now, next);
            std::swap(elsewhere, elsewhere_next);
        }
    }
}

TEST_CASE("A contact does not grow to where the plane kernel is unstable", "[friction][load]") {
    const double b = 0.4, along = 4 * b * std::exp(load_nu / (1 - load_nu)), across = 4 * b * std::exp(-load_nu);
    const LoadScene scene = LoadScene::breathing(cosine_mesh<double>(12), b);
    const ElementSystem<double> lateral =
        rolling_system(scene.mesh, scene.scheme, PlaneKernel<double>::lateral(scene.contact));
    const auto check = [&](const auto& model, double limit, const auto& creepage) {
        auto workspace = model.workspace();
        auto now = model.at_rest(), next = now;
        Load load = scene.hertz.at(full_force);
        const auto advance = [&](double half_length) {
            load.half_length = half_length;
            return model.advance(now, 0.1, creepage, load, next, workspace).status;
        };
        while (now.half_length < limit - 0.1) {
            REQUIRE(advance(now.half_length + 0.05) == StepStatus::ok);
            std::swap(now, next);
        }
        CHECK(advance(limit * (1 - 1e-12)) == StepStatus::ok);
        CHECK(advance(limit * (1 + 1e-12)) == StepStatus::needs_fixed_mesh);
    };
    check(FrictionModel<>(scene.contact, scene.system(), unchecked, scene.law()), along, 1e-4);
    check(FrictionModel(scene.contact, ElementSystem<double, 2>(scene.system(), lateral), unchecked, scene.law()),
          across, Creepage<double>{1e-4, 1e-4});
}

}  // namespace
}  // namespace friction_tests
