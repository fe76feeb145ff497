// rollbem/friction/transient.hpp, state.hpp, normal/load.hpp: properties of a step under a varying load, independent of
// its accuracy.
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/compiled/friction.hpp>

#include "load_scene.hpp"
#include "support/catch.hpp"

namespace {

using namespace friction_tests;
using State = FrictionState<>;
using Step = FrictionStep<>;
using Workspace = FrictionWorkspace<>;
using Motion = RigidMotion<double>;
using Load = NormalLoad<double>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// Bitwise equality, including NaN and the sign of zero.
bool same(double x, double y) { return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y); }
template <class Derived>
bool same(const Eigen::DenseBase<Derived>& x, const Eigen::DenseBase<Derived>& y) {
    bool equal = x.size() == y.size();
    for (Eigen::Index i = 0; equal && i < x.size(); ++i) equal = same(x(i), y(i));
    return equal;
}
bool same(const State& x, const State& y) {
    return same(x.traction, y.traction) && x.zones == y.zones && same(x.normal_pressure, y.normal_pressure) &&
           same(x.half_length, y.half_length) && x.system == y.system;
}
bool same(const FrictionStep<>& x, const FrictionStep<>& y) {
    return same(x.force, y.force) && same(x.force_per_width, y.force_per_width) && same(x.tangent, y.tangent) &&
           same(x.slip_work_per_width, y.slip_work_per_width) && x.rounds == y.rounds && x.status == y.status;
}

TEST_CASE("The statuses of a load have names", "[friction][load]") {
    CHECK(name(StepStatus::invalid_load) == std::string("invalid_load"));
    CHECK(name(StepStatus::needs_fixed_mesh) == std::string("needs_fixed_mesh"));
    CHECK(name(StepStatus::wrong_state) == std::string("wrong_state"));
    CHECK(name(StepStatus::not_finite) == std::string("not_finite"));
}

TEST_CASE("A constant load gives bit for bit the same steps as no load", "[friction][load]") {
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
        for (const bool strip : {false, true}) {
            const LoadScene scene = LoadScene::breathing(cosine_mesh<double>(21));
            const FrictionModel<> model = strip ? scene.strip_model(integrator) : scene.model(integrator);
            const Load load = scene.hertz.at(full_force);
            State plain = model.at_rest(), plain_next = plain, loaded = plain, loaded_next = plain;
            Workspace plain_workspace = model.workspace(), loaded_workspace = plain_workspace;
            for (int k = 0; k < 60; ++k) {
                const double dq = k % 7 == 0 ? 0.4 : k % 7 == 3 ? 0 : 0.1;
                const double xi = load_creepage(1.2 * std::sin(0.3 * k));
                const Motion motion = dq == 0      ? Motion::shift(0.3 * xi)
                                      : k % 2 == 0 ? Motion(xi)
                                                   : Motion::linear(xi, 0.5 * xi);
                const FrictionStep<> one = model.advance(plain, dq, motion, plain_next, plain_workspace);
                const Step other = model.advance(loaded, dq, motion, load, loaded_next, loaded_workspace);
                CAPTURE(k, strip, name(integrator));
                REQUIRE(one.status == StepStatus::ok);
                REQUIRE(same(one, other));
                REQUIRE(same(plain_next, loaded_next));
                REQUIRE(same(plain_workspace.slip(), loaded_workspace.slip()));
                std::swap(plain, plain_next);
                std::swap(loaded, loaded_next);
            }
        }
    }
}

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
                forces.insert(forces.end(), {step.force, step.tangent, step.slip_work_per_width, rolling.force(to)});
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
            CHECK(one.force_per_width == Approx(two.force_per_width).epsilon(1e-10).margin(1e-10 * full_force));
            CHECK(one.tangent == Approx(two.tangent).epsilon(1e-10));
            CHECK(one.slip_work_per_width ==
                  Approx(two.slip_work_per_width).epsilon(1e-9).margin(1e-12 * full_force * peak));
            CHECK(next.half_length == end.half_length);
            CHECK(same(next.normal_pressure, end.normal_pressure));
            std::swap(now, next);
            std::swap(elsewhere, elsewhere_next);
        }
    }
}

TEST_CASE("Contact may be lost and regained", "[friction][load]") {
    for (const bool strip : {false, true}) {
        for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
            for (const Eigen::Index n : {1, 3, 30}) {
                const LoadScene scene = LoadScene::fixed(uniform_mesh<double>(n));
                const FrictionModel<> model = strip ? scene.strip_model(integrator) : scene.model(integrator);
                State now = model.at_rest(), next = now;
                Workspace workspace = model.workspace();
                Load load = scene.hertz.at(full_force);
                CAPTURE(strip, name(integrator), n);
                for (int k = 0; k < 68; ++k) {
                    const double P = std::max(0.0, 0.4 + std::sin(0.3 * k)) * full_force;  // lifts off at each trough
                    REQUIRE(scene.hertz.set(P, load) == StepStatus::ok);
                    const double dq = k % 6 == 5 ? 0 : 0.15;
                    const Step step = model.advance(now, dq, Motion::shift(load_creepage(0.1 * std::cos(0.2 * k))),
                                                    load, next, workspace);
                    CAPTURE(k, P);
                    REQUIRE(step.status == StepStatus::ok);
                    CHECK(step.complementarity_residual < 1e-11);
                    CHECK(step.slip_work_per_width >= 0);
                    CHECK((next.traction.array().abs() <= load.normal_pressure * (1 + 1e-12)).all());
                    CHECK(((load.normal_pressure > 0) || (next.traction.array() == 0)).all());
                    CHECK(std::isfinite(step.tangent));
                    CHECK(std::isfinite(step.tangent_by_load));
                    if (P == 0) {
                        CHECK(step.force == 0);
                        CHECK(step.stick_count == 0);
                        CHECK(step.tangent == 0);
                    }
                    std::swap(now, next);
                }
                CHECK(now.traction.cwiseAbs().maxCoeff() > 0.01 * peak);
            }
        }
    }
    // a breathing mesh of three elements
    const LoadScene scene = LoadScene::breathing(cosine_mesh<double>(3));
    const FrictionModel<> model = scene.model();
    State now = model.at_rest(), next = now;
    Workspace workspace = model.workspace();
    Load load = scene.hertz.at(full_force);
    for (int k = 0; k < 80; ++k) {
        REQUIRE(scene.hertz.set(SineLoad{.A = 0.9}(0.2 * k), load) == StepStatus::ok);
        REQUIRE(model.advance(now, 0.2, load_creepage(0.5), load, next, workspace).status == StepStatus::ok);
        std::swap(now, next);
    }
}

TEST_CASE("A half-length that the mesh cannot follow is reported as needs_fixed_mesh", "[friction][load]") {
    const LoadScene scene = LoadScene::breathing(cosine_mesh<double>(12));
    const FrictionModel<> model = scene.model(), strip = scene.strip_model();
    Workspace workspace = model.workspace();
    State now = model.at_rest(), next = now;
    Load load = scene.hertz.at(full_force);
    const auto status = [&](const FrictionModel<>& of, const State& from, double dq, double half_length) {
        load.half_length = half_length;
        State start = from;
        start.system = of.fingerprint();
        const State kept = next;
        const Step step = of.advance(start, dq, Motion::shift(1e-4), load, next, workspace);
        if (step.status != StepStatus::ok) {
            CHECK(same(next, kept));
            CHECK(std::isnan(step.force));
            CHECK(std::isnan(step.tangent_by_half_length));
        }
        return step.status;
    };
    for (const double way : {1.0, -1.0}) {
        CHECK(status(model, now, 0.1, 1 + way * 0.099) == StepStatus::ok);
        CHECK(status(model, now, 0.125, 1 + way * 0.125) == StepStatus::needs_fixed_mesh);
        CHECK(status(model, now, 0.1, 1 + way * 0.11) == StepStatus::needs_fixed_mesh);
        CHECK(status(model, now, 0, 1 + way * 1e-9) == StepStatus::needs_fixed_mesh);
        CHECK(status(strip, now, 0.1, 1 + way * 1e-9) == StepStatus::needs_fixed_mesh);
    }
    CHECK(status(model, now, 0, 1) == StepStatus::ok);
    CHECK(status(strip, now, 0.1, 1) == StepStatus::ok);

    // a state at another half-length, and steps that keep it
    State longer = now;
    longer.half_length = 1.1;
    CHECK(status(model, longer, 0.1, 1.1) == StepStatus::ok);
    CHECK(status(model, longer, 0, 1.1) == StepStatus::ok);
    CHECK(status(strip, longer, 0.1, 1.1) == StepStatus::needs_fixed_mesh);
    CHECK(status(strip, longer, 0.2, 1) == StepStatus::needs_fixed_mesh);
    CHECK(model.advance(longer, 0.1, 1e-4, next, workspace).status == StepStatus::ok);
    CHECK(model.steady(longer, 1e-4, next, workspace).status == StepStatus::ok);
    longer.system = strip.fingerprint();
    CHECK(strip.advance(longer, 0.1, 1e-4, next, workspace).status == StepStatus::needs_fixed_mesh);
    CHECK(strip.shift(longer, 1e-4, next, workspace).status == StepStatus::needs_fixed_mesh);
    CHECK(strip.steady(longer, 1e-4, next, workspace).status == StepStatus::needs_fixed_mesh);
    const SteadyFrictionModel<> steady(scene.contact, scene.mesh, scene.scheme, scene.kernel, scene.law());
    longer.system = steady.fingerprint();
    State point = steady.at_rest();
    CHECK(steady.steady(longer, 1e-4, point, workspace).status == StepStatus::needs_fixed_mesh);

    // systems with a single half-length: user-supplied matrices, and Galerkin's method
    const ElementSystem<double> system = scene.system();
    const FrictionModel<> ready(scene.contact, ElementSystem<double>(system.G(), system.G_prime(), system.weights()),
                                unchecked, scene.law());
    CHECK(status(ready, now, 0.1, 1.01) == StepStatus::needs_fixed_mesh);
    CHECK(status(ready, now, 0.1, 1) == StepStatus::ok);
    const FrictionModel<> galerkin(scene.contact,
                                   rolling_system(scene.mesh, Galerkin{.alpha_L = 0.5, .alpha_T = 0.5}, scene.kernel),
                                   unchecked, scene.law());
    CHECK(status(galerkin, now, 0.1, 1.01) == StepStatus::needs_fixed_mesh);
    CHECK(status(galerkin, now, 0.1, 1) == StepStatus::ok);
}

TEST_CASE("Invalid loads are rejected", "[friction][load]") {
    const LoadScene scene = LoadScene::breathing(cosine_mesh<double>(10));
    const FrictionModel<> model = scene.model();
    Workspace workspace = model.workspace();
    const State now = model.at_rest();
    State next = now;
    next.traction.setConstant(7);
    const State kept = next;
    const Load good = scene.hertz.at(full_force);
    const auto refused = [&](const Load& load) {
        CHECK(load.check(10) == StepStatus::invalid_load);
        CHECK(model.advance(now, 0.1, 1e-4, load, next, workspace).status == StepStatus::invalid_load);
        CHECK(model.steady(now, 1e-4, load, next, workspace).status == StepStatus::invalid_load);
        CHECK(same(next, kept));
    };
    for (const double value : {-1e-300, -1.0, nan, infinity, -infinity}) {
        for (const Eigen::Index i : {0, 4, 9}) {
            Load load = good;
            load.normal_pressure[i] = value;
            refused(load);
            State from = now;
            from.normal_pressure[i] = value;
            CHECK(model.advance(from, 0.1, 1e-4, good, next, workspace).status == StepStatus::invalid_load);
            CHECK(model.advance(from, 0.1, 1e-4, next, workspace).status == StepStatus::invalid_load);
            CHECK(same(next, kept));
        }
        Load load = good;
        load.half_length = value;
        refused(load);
        State from = now;
        from.half_length = value;
        CHECK(model.advance(from, 0.1, 1e-4, good, next, workspace).status == StepStatus::invalid_load);
        CHECK(model.shift(from, 1e-4, next, workspace).status == StepStatus::invalid_load);
        CHECK(same(next, kept));
    }
    Load load = good;
    load.half_length = 0;
    refused(load);
    load = good;
    load.normal_pressure.conservativeResize(9);
    refused(load);
    load = good;
    load.pressure_rate.conservativeResize(9);
    refused(load);
    load = good;
    load.pressure_rate[3] = nan;
    refused(load);
    refused(Load{});
    load = good;
    load.pressure_rate.resize(0);  // no tangent by the load is requested
    const Step step = model.advance(now, 0.1, 1e-4, load, next, workspace);
    CHECK(step.status == StepStatus::ok);
    CHECK(std::isnan(step.tangent_by_load));
    CHECK(std::isfinite(step.tangent_by_half_length));
    // zero pressure is a valid load, also with a negative zero
    load.normal_pressure.setConstant(-0.0);
    CHECK(model.advance(now, 0.1, 1e-4, load, next, workspace).status == StepStatus::ok);
    CHECK(next.traction.isZero(0));
}

TEST_CASE("A state belongs to the model with the pressure of its first load", "[friction][load]") {
    // a model of another pressure would continue under that of the state: the status reports it
    LoadScene scene = LoadScene::breathing(cosine_mesh<double>(10));
    const FrictionModel<> model = scene.model();
    Friction<> law = scene.law();
    law.normal_pressure *= 1.1;
    const FrictionModel<> pressed(scene.contact, scene.system(), unchecked, law);
    State next = model.at_rest();
    Workspace workspace = model.workspace();
    CHECK(pressed.advance(model.at_rest(), 0.1, 1e-4, next, workspace).status == StepStatus::wrong_state);
    CHECK(pressed.shift(model.at_rest(), 1e-4, next, workspace).status == StepStatus::wrong_state);
    // likewise a model of the contact under a larger load
    const LoadScene larger = LoadScene::breathing(scene.mesh, 1100, 1.1);
    CHECK(larger.model().advance(model.at_rest(), 0.1, 1e-4, next, workspace).status == StepStatus::wrong_state);
    CHECK(larger.model().steady(model.at_rest(), 1e-4, next, workspace).status == StepStatus::wrong_state);
    // the force of a state refers to its own half-length
    REQUIRE(model.steady(model.at_rest(), 1e-4, scene.hertz.at(1.21 * full_force), next, workspace).status ==
            StepStatus::ok);
    CHECK(next.half_length == Approx(1.1).epsilon(1e-14));
    CHECK(model.force(next) == Approx(2000 * 1.1 * scene.mesh.widths().matrix().dot(next.traction)).epsilon(1e-14));
    // the coefficient of friction may change
    scene.mu = 0.5;
    CHECK(scene.model().advance(model.at_rest(), 0.1, 1e-4, next, workspace).status == StepStatus::ok);
}

TEST_CASE("A step under a varying load depends only on the state and the arguments", "[friction][load]") {
    std::mt19937 random(7);
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
    };
    for (const bool breathing : {true, false}) {
        for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
            const LoadScene scene = breathing ? LoadScene::breathing(cosine_mesh<double>(20))
                                              : LoadScene::fixed(uniform_mesh<double>(20), 1.5);
            const FrictionModel<> model = scene.model(integrator);
            const Workspace fresh = model.workspace();
            Workspace used = fresh;
            State now = model.at_rest(), next = now, again = now;
            Load load = scene.hertz.at(full_force);
            for (int k = 0; k < 150; ++k) {
                const double P = full_force * (breathing ? uniform(0.9, 1.1) : uniform(0, 2));
                REQUIRE(scene.hertz.set(P, load) == StepStatus::ok);
                const double dq = random() % 2 == 0 ? 0.25 : uniform(0.21, 0.5);
                const Motion motion = Motion::linear(load_creepage(uniform(-1, 1)), load_creepage(uniform(-1, 1)));
                const bool plain = random() % 4 == 0;
                Workspace other = fresh;
                CAPTURE(k, breathing, name(integrator), dq, P);
                if (plain) {
                    REQUIRE(
                        same(model.advance(now, dq, motion, next, used), model.advance(now, dq, motion, again, other)));
                } else {
                    const Step one = model.advance(now, dq, motion, load, next, used);
                    const Step two = model.advance(now, dq, motion, load, again, other);
                    REQUIRE(one.status == StepStatus::ok);
                    REQUIRE(same(one, two));
                    REQUIRE(same(one.tangent_by_load, two.tangent_by_load));
                    REQUIRE(same(one.tangent_by_half_length, two.tangent_by_half_length));
                    REQUIRE(same(next.normal_pressure, load.normal_pressure));
                }
                REQUIRE(same(next, again));
                REQUIRE(same(used.slip(), other.slip()));
                std::swap(now, next);
            }
        }
    }
}

}  // namespace
