// rollbem/friction/transient.hpp: tangents of a step under a varying load, and a Newton iteration that relies on them.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include <rollbem/compiled/friction.hpp>

#include "load_scene.hpp"
#include "support/catch.hpp"

namespace {

using namespace friction_tests;
using State = FrictionState<>;
using Step = FrictionStep<>;
using Motion = RigidMotion<double>;

TEST_CASE("The tangents of a step under a varying load agree with central differences", "[friction][load]") {
    struct Case {
        bool breathing, strip;
    };
    for (const Case& c : {Case{true, false}, Case{false, false}, Case{false, true}}) {
        for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
            for (const bool linear : {false, true}) {
                const LoadScene scene = c.breathing ? LoadScene::breathing(cosine_mesh<double>(24), 100)
                                                    : LoadScene::fixed(uniform_mesh<double>(24), 1.25, 100);
                const FrictionModel<> model = c.strip ? scene.strip_model(integrator) : scene.model(integrator);
                FrictionWorkspace<> workspace = model.workspace();
                State now = model.at_rest(), next = now, probe = now;
                NormalLoad<double> load = scene.hertz.at(full_force), other = load;
                REQUIRE(model.steady(now, load_creepage(0.5), load, next, workspace).status == StepStatus::ok);
                double worst[4] = {0, 0, 0, 0};
                int mixed[4] = {0, 0, 0, 0};
                for (int k = 1; k <= 40; ++k) {
                    std::swap(now, next);
                    const double q = 0.2 * k, P = SineLoad{.L = 4}(q),
                                 xi = load_creepage(0.5 + 0.4 * std::sin(1.3 * q));
                    const auto motion = [&](double end) {
                        return linear ? Motion::linear(load_creepage(0.4), end) : Motion(end);
                    };
                    REQUIRE(scene.hertz.set(P, load) == StepStatus::ok);
                    const Step step = model.advance(now, 0.2, motion(xi), load, next, workspace);
                    REQUIRE(step.status == StepStatus::ok);
                    const double by_whole =
                        step.tangent_by_load_per_width +
                        (c.breathing ? step.tangent_by_half_length_per_width * scene.hertz.half_length_rate(P) : 0);
                    const Eigen::Index loaded = (load.normal_pressure > 0).count();
                    const double tangents[4] = {step.tangent_per_width, step.tangent_by_load_per_width,
                                                step.tangent_by_half_length_per_width, by_whole};
                    const double sizes[4] = {load_creepage(1), full_force, 1, full_force};
                    for (int what = 0; what < 4; ++what) {
                        if (what == 2 && !c.breathing) continue;
                        bool unchanged = true;
                        const auto force = [&](double part) {
                            const double change = part * sizes[what];
                            other = load;
                            if (what == 1) other.normal_pressure += change * load.pressure_rate;
                            if (what == 2) other.half_length += change;
                            if (what == 3) REQUIRE(scene.hertz.set(P + change, other) == StepStatus::ok);
                            const Step moved =
                                model.advance(now, 0.2, motion(what == 0 ? xi + change : xi), other, probe, workspace);
                            unchanged = unchanged && probe.zones == next.zones;
                            return moved.force_per_width;
                        };
                        constexpr double h = 1e-6;
                        const double difference = (force(h) - force(-h)) / (2 * h);
                        if (!unchanged) continue;  // there is a kink in between
                        worst[what] = std::max(worst[what], std::abs(tangents[what] * sizes[what] - difference));
                        if (step.stick_count > 0 && step.stick_count < loaded) ++mixed[what];
                    }
                    CHECK(step.tangent_by_load == Approx(200 * step.tangent_by_load_per_width).epsilon(1e-14));
                    if (c.strip) CHECK(std::isnan(step.tangent_by_half_length));
                }
                for (int what = 0; what < 4; ++what) {
                    CAPTURE(c.breathing, c.strip, name(integrator), linear, what);
                    CHECK(worst[what] < 3e-8 * full_force);
                    CHECK((mixed[what] >= 20 || (what == 2 && !c.breathing)));
                }
            }
        }
    }
}

// A wheel is pulled along and pressed on by a lever, so that the load depends on the friction force, and the speed on
// both: m (v - v_0)/dt = pull + F(v/V, N), N = N_0(t) - c F. Each step solves for v and N.
TEST_CASE("An implicit integrator with the load as an unknown converges quadratically", "[friction][load]") {
    constexpr double lever = 0.3, inertia = 4;  // m V/dt in units of full_force / creepage of full sliding
    for (const bool breathing : {true, false}) {
        for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
            const LoadScene scene = breathing ? LoadScene::breathing(cosine_mesh<double>(30))
                                              : LoadScene::fixed(uniform_mesh<double>(30), 1.5);
            const FrictionModel<> model = scene.model(integrator);
            FrictionWorkspace<> workspace = model.workspace();
            State now = model.at_rest(), next = now;
            NormalLoad<double> load = scene.hertz.at(full_force);
            double xi = load_creepage(0.3), N = full_force;
            REQUIRE(model.steady(now, xi, load, next, workspace).status == StepStatus::ok);
            int quadratic = 0;
            for (int k = 1; k <= 40; ++k) {
                std::swap(now, next);
                const double before = xi;
                const double pull = full_force * (0.5 + 0.2 * std::sin(0.4 * k));
                const double pressed = full_force * (0.9 + 0.1 * std::sin(0.35 * k));
                N = 1.2 * pressed;  // a poor initial guess
                std::vector<double> residuals;
                for (int iteration = 0; iteration < 12; ++iteration) {
                    REQUIRE(scene.hertz.set(N, load) == StepStatus::ok);
                    const Step step = model.advance(now, 0.3, Motion::linear(before, xi), load, next, workspace);
                    REQUIRE(step.status == StepStatus::ok);
                    const double unit = inertia * full_force / load_creepage(1);
                    const Eigen::Vector2d residual(unit * (xi - before) - pull - step.force_per_width,
                                                   N - pressed + lever * step.force_per_width);
                    residuals.push_back(residual.norm() / full_force);
                    if (residuals.back() < 1e-13) break;
                    const double by_load = step.tangent_by_load_per_width +
                                           step.tangent_by_half_length_per_width * scene.hertz.half_length_rate(N);
                    Eigen::Matrix2d slope;
                    slope << unit - step.tangent_per_width, -by_load, lever * step.tangent_per_width,
                        1 + lever * by_load;
                    const Eigen::Vector2d change = slope.partialPivLu().solve(residual);
                    xi -= change[0];
                    N -= change[1];
                }
                CAPTURE(k, breathing, name(integrator), residuals);
                CHECK(residuals.size() <= 6);
                CHECK(residuals.back() < 1e-13);
                // every residual above round-off is of the order of the square of the one before
                for (std::size_t i = 1; i < residuals.size(); ++i) {
                    if (residuals[i - 1] < 0.3 && residuals[i - 1] > 1e-6) {
                        CHECK(residuals[i] < 5 * residuals[i - 1] * residuals[i - 1]);
                        ++quadratic;
                    }
                }
            }
            CHECK(quadratic >= 40);
        }
    }
}

}  // namespace
