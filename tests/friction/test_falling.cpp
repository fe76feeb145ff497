// rollbem/friction/law.hpp, falling_steady.hpp, falling_transient.hpp: against reference forces, limits, and the
// definition of the law.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include <rollbem/compiled/friction.hpp>

#include "any_law.hpp"
#include "falling_scene.hpp"
#include "support/catch.hpp"

namespace {

using namespace falling_tests;
using Catch::Matchers::ContainsSubstring;

constexpr double infinite = std::numeric_limits<double>::infinity();

TEST_CASE("Laws fall from mu_0 at rest to mu_k, halfway at their half velocity", "[friction]") {
    const auto check = [](const auto& falling, double late, double rest) {
        CHECK(falling(0.0) == Approx(0.3).epsilon(1e-15));
        CHECK(falling(0.2) == Approx(0.2).epsilon(1e-15));
        CHECK(falling(late) == Approx(rest).epsilon(1e-14));
    };
    check(ExponentialFall<double>{0.3, 0.1, 0.2}, 0.6, 0.1 + 0.2 / 8);
    check(RationalFall<double>{0.3, 0.1, 0.2}, 0.6, 0.1 + 0.2 / 4);
    check(LinearFall<double>{0.3, 0.1, 0.2}, 0.3, 0.15);
    check(LinearFall<double>{0.3, 0.1, 0.2}, 0.6, 0.1);
    const Memory memory{.distance = 2e-6, .least_velocity = 1e-3};
    CHECK(memory.kept(0.1, 1e-5) == Approx(2.0 / 3).epsilon(1e-14));
    CHECK(memory.kept(0, 2e-3) == Approx(0.5).epsilon(1e-14));
    CHECK(Memory{}.kept(0, 1) == 0);
}

// -F/(mu_0 N) at five creepages for three distances of memory; another program differs by less than 1.2e-4.
constexpr double creepages[5] = {5e-4, 1e-3, 2e-3, 5e-3, 1e-2};
constexpr double distances[3] = {0, 2e-6, 10e-6};
constexpr double steady_forces[3][5] = {{0.34140, 0.59053, 0.80649, 0.68687, 0.61827},
                                        {0.34564, 0.60431, 0.84052, 0.70243, 0.62303},
                                        {0.34694, 0.61612, 0.90047, 0.78016, 0.65994}};

TEST_CASE("The steady forces of a wheel at 45 m/s are the reference values", "[friction]") {
    for (int k = 0; k < 3; ++k) {
        const Scene scene(uniform_mesh<double>(160), distances[k]);
        const SteadyFrictionModel<Law> steady = scene.steady();
        const FrictionModel<Law> transient = scene.transient();
        auto workspace = steady.workspace();
        const State rest = steady.at_rest(), other_rest = transient.at_rest();
        State state = rest;
        for (int j = 0; j < 5; ++j) {
            const Step step = steady.steady(rest, creepages[j], speed, state, workspace);
            CAPTURE(distances[k], creepages[j]);
            CHECK(step.status == StepStatus::ok);
            CHECK(std::abs(force_ratio(step) - steady_forces[k][j]) < 6e-6);
            CHECK(step.rounds > 1);  // of all searches for stick and slip: the last takes one
            const Step other = transient.steady(other_rest, creepages[j], speed, state, workspace);
            CHECK(other.force_per_width == Approx(step.force_per_width).epsilon(1e-11));
            constexpr double h = 1e-7;
            const auto force = [&](double part) {
                return steady.steady(rest, creepages[j] * (1 + part), speed, state, workspace).force_per_width;
            };
            const double difference = (force(h) - force(-h)) / (2 * h * creepages[j]);
            CHECK(step.tangent_per_width == Approx(difference).epsilon(1e-6));
        }
    }
}

TEST_CASE("A constant law is Coulomb's", "[friction]") {
    const AnyLaw constant = [](double) { return 0.25; };
    const Scene scene(cosine_mesh<double>(24));
    for (const double distance : {0.0, 3e-6}) {
        for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
            const FrictionModel<> expected(scene.contact, scene.system(), unchecked, {0.25, scene.pressure()},
                                           integrator);
            const FrictionModel<AnyLaw> model(scene.contact, scene.system(), unchecked,
                                              {constant, scene.pressure(), {distance, 1e-3}}, integrator);
            auto workspace = model.workspace();
            auto expected_workspace = expected.workspace();
            State now = model.at_rest(), next = now;
            FrictionState<> expected_now = expected.at_rest(), expected_next = expected_now;
            NormalLoad<double> load{now.normal_pressure, a, {}};
            for (int k = 1; k <= 40; ++k) {
                const double dq = k % 5 == 0 ? 0 : 0.1 * a, duration = 0.1 * a / speed;
                const Motion motion = k % 5 == 0 ? Motion::shift(1e-6) : Motion::linear(1e-3, 1e-3 + 1e-4 * k);
                Step step;
                Step reference;
                if (k % 3 == 0) {
                    load.normal_pressure = scene.pressure() * (1 + 0.01 * k);
                    step = model.advance(now, {dq, duration}, motion, load, next, workspace);
                    reference = expected.advance(expected_now, dq, motion, load, expected_next, expected_workspace);
                } else {
                    step = model.advance(now, {dq, duration}, motion, next, workspace);
                    reference = expected.advance(expected_now, dq, motion, expected_next, expected_workspace);
                }
                std::swap(now, next);
                std::swap(expected_now, expected_next);
                CAPTURE(distance, name(integrator), k);
                REQUIRE(step.status == StepStatus::ok);
                CHECK(now.zones == expected_now.zones);
                CHECK((now.friction_coefficient - 0.25).abs().maxCoeff() < 1e-15);
                CHECK(step.force == Approx(reference.force).epsilon(1e-11));
                CHECK(step.tangent == Approx(reference.tangent).epsilon(1e-10).margin(1e-12));
                CHECK(step.slip_work_per_width == Approx(reference.slip_work_per_width).epsilon(1e-9));
                CHECK((workspace.slip() - expected_workspace.slip()).cwiseAbs().maxCoeff() < 1e-11 * dq + 1e-16);
            }
        }
    }
}

// mu of the particle that arrives at x, by an independent search from the other end
double remembered(const ArrayX<double>& points, const ArrayX<double>& mu, double x, double ahead) {
    if (x >= 1) return ahead;
    for (Eigen::Index i = points.size() - 1; i >= 0; --i) {
        if (points[i] > x) continue;
        const bool last = i == points.size() - 1;
        const double right = last ? 1 : points[i + 1], value = last ? ahead : mu[i + 1];
        return mu[i] + (x - points[i]) / (right - points[i]) * (value - mu[i]);
    }
    return mu[0];
}

TEST_CASE("Each implicit step of random motions obeys law and memory", "[friction]") {
    std::mt19937 generator(7);
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(generator()) / 4294967296.0;
    };
    int slipping = 0, steps = 0, remembering = 0;
    for (int scene_number = 0; scene_number < 60; ++scene_number) {
        const int n = static_cast<int>(uniform(3, 40));
        Scene scene(scene_number % 2 == 0 ? cosine_mesh<double>(n) : uniform_mesh<double>(n),
                    scene_number % 3 == 0 ? 0 : std::pow(10, uniform(-6.5, -4.5)));
        if (scene_number % 4 == 0) scene.scheme = {.alpha_L = 0.3, .alpha_T = 0.5};
        const Friction<Law> friction{
            {0.3, uniform(0.05, 0.3), uniform(0.05, 1)}, scene.pressure(), {scene.distance, uniform(0, 2e-3)}};
        const ElementSystem<double> system = scene.system();
        const FrictionModel<Law> model(scene.contact, system, unchecked, friction, Integrator::implicit_euler);
        auto workspace = model.workspace();
        State now = model.at_rest(), next = now;
        const ArrayX<double>& points = *system.points();
        double creepage = 0;
        for (int k = 0; k < 30; ++k) {
            const double dq = k % 7 == 6 ? 0 : uniform(0.02, 0.5), V = std::pow(10, uniform(0, 1.7));
            const double duration = std::max(dq, 0.1) * a / V;
            creepage = uniform(0, 1) < 0.3 ? uniform(-6e-3, 6e-3) : creepage;
            const Motion motion = dq == 0 ? Motion::shift(a * creepage / 10) : Motion(creepage);
            const Step step = model.advance(now, {dq * a, duration}, motion, next, workspace);
            CAPTURE(scene_number, n, k, step.complementarity_residual);
            REQUIRE(step.status == StepStatus::ok);
            ++steps;
            const double moved = std::abs(creepage) * (dq == 0 ? 0.1 : dq) * a;
            for (Eigen::Index i = 0; i < n; ++i) {
                const double mu = next.friction_coefficient[i], slip = workspace.slip()[i], p = next.traction[i];
                const double bound = mu * next.normal_pressure[i];
                CHECK(std::abs(p) <= bound * (1 + 1e-9) + 1e-9 * peak_pressure);
                if (next.zones[static_cast<std::size_t>(i)] == Zone::stick) {
                    CHECK(std::abs(slip) <= 1e-9 * moved + 1e-16);
                } else {
                    ++slipping;
                    CHECK(slip * p <= 0);
                    CHECK(std::abs(p) == Approx(bound).epsilon(1e-9));
                }
                const double v = std::abs(slip) / duration;
                double expected = friction.law(v);
                if (scene.distance > 0) {
                    const double before = remembered(points, now.friction_coefficient, points[i] + dq, 0.3);
                    const double forgets = duration * std::max(v, friction.memory.least_velocity) / scene.distance;
                    expected = (before + forgets * expected) / (1 + forgets);
                    remembering += forgets > 0.05 && forgets < 5 ? 1 : 0;
                }
                CHECK(std::abs(mu - expected) < 1e-9);
            }
            std::swap(now, next);
        }
    }
    CHECK(slipping > steps);
    CHECK(remembering > steps);
}

TEST_CASE("The tangent of a step in time agrees with central differences", "[friction]") {
    for (const double distance : {0.0, 10e-6}) {
        for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
            for (const bool linear : {false, true}) {
                const Scene scene(cosine_mesh<double>(30), distance);
                const FrictionModel<Law> model = scene.transient(integrator);
                auto workspace = model.workspace();
                State now = model.at_rest(), next = now, probe = now;
                double worst = 0;
                int compared = 0;
                for (int k = 1; k <= 60; ++k) {
                    const double creepage = 1.2e-3 + 8e-4 * std::sin(0.3 * k), before = 1e-3;
                    const bool shift = k % 4 == 0;
                    const auto advance = [&](double size, State& to) {
                        const Motion motion = shift    ? Motion::shift(1e-3 * size * a)
                                              : linear ? Motion::linear(before, size)
                                                       : Motion(size);
                        return model.advance(now, {shift ? 0 : 0.1 * a, 0.1 * a / speed}, motion, to, workspace);
                    };
                    const Step step = advance(creepage, next);
                    REQUIRE(step.status == StepStatus::ok);
                    constexpr double h = 1e-6;
                    const double high = advance(creepage * (1 + h), probe).force_per_width;
                    bool unchanged = probe.zones == next.zones;
                    const double low = advance(creepage * (1 - h), probe).force_per_width;
                    unchanged = unchanged && probe.zones == next.zones;
                    const double difference = (high - low) / (2 * h * creepage * (shift ? 1e-3 * a : 1));
                    if (unchanged && step.stick_count > 3 && step.stick_count < 29) {
                        worst = std::max(worst, std::abs(step.tangent_per_width / difference - 1));
                        ++compared;
                    }
                    std::swap(now, next);
                }
                CAPTURE(distance, name(integrator), linear);
                CHECK(worst < 1e-5);
                CHECK(compared > 30);
            }
        }
    }
}

TEST_CASE("With memory, rolling in time tends to steady rolling as mesh and steps are refined", "[friction]") {
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
        std::vector<double> differences;
        for (const Eigen::Index n : {40, 80, 160}) {
            const Scene scene(uniform_mesh<double>(n), 10e-6);
            const FrictionModel<Law> model = scene.transient(integrator);
            auto workspace = model.workspace();
            State now = model.at_rest(), next = now;
            Step step = model.steady(now, 2e-3, speed, next, workspace);
            const double steady = force_ratio(step), dq = 4.0 / static_cast<double>(n);
            for (double q = 0; q < 20; q += dq) {
                std::swap(now, next);
                step = model.advance(now, {dq * a, dq * a / speed}, 2e-3, next, workspace);
                REQUIRE(step.status == StepStatus::ok);
            }
            differences.push_back(std::abs(force_ratio(step) - steady));
        }
        CAPTURE(name(integrator), differences);
        CHECK(std::abs(differences[0] / differences[1] - 2) < 0.1);  // of first order, both
        CHECK(std::abs(differences[1] / differences[2] - 2) < 0.1);
        CHECK(differences[2] < 4e-4);
    }
}

TEST_CASE("With a memory, sdirk2 is of second order", "[friction]") {
    // against steps an eighth as long, over a way in which the creepage rises and falls once
    const Scene scene(uniform_mesh<double>(20), 20e-6);
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
        const FrictionModel<Law> model = scene.transient(integrator);
        auto workspace = model.workspace();
        const auto run = [&](int steps) {
            State now = model.at_rest(), next = now;
            const double dq = 4.0 / steps;
            const auto creepage = [](double q) { return 4e-3 * std::pow(std::sin(0.7 * q), 2); };
            VectorX<double> forces(8);
            for (int k = 0; k < steps; ++k) {
                const Motion motion = Motion::linear(creepage(k * dq), creepage((k + 1) * dq));
                const Step step = model.advance(now, {dq * a, dq * a / speed}, motion, next, workspace);
                REQUIRE(step.status == StepStatus::ok);
                if ((k + 1) % (steps / 8) == 0) forces[(k + 1) / (steps / 8) - 1] = force_ratio(step);
                std::swap(now, next);
            }
            return forces;
        };
        const VectorX<double> limit = run(2560);
        const double coarse = (run(40) - limit).norm(), fine = (run(320) - limit).norm();
        const double order = std::log2(coarse / fine) / 3;
        CAPTURE(name(integrator), coarse, fine, order);
        if (integrator == Integrator::sdirk2) {
            CHECK(std::abs(order - 1.75) < 0.25);  // 2, less where elements begin to slip
            CHECK(fine < 2e-4);
        } else {
            CHECK(std::abs(order - 1) < 0.3);
        }
    }
}

TEST_CASE("With little memory, the force oscillates at the peak of the creep curve", "[friction]") {
    // a steady solution exists, but a run from rest does not reach it: the force drops within one step, however short,
    // and rises slowly again
    struct Case {
        bool cosine;
        double dq, period, margin;
    };
    // the period tends to 4.1 or 4.2 from above; mesh and steps of the same length beat on uniform ones
    for (const Case& c :
         {Case{false, 0.025, 5.05, 0.1}, Case{false, 0.00625, 4.2, 0.25}, Case{true, 0.0125, 4.25, 0.1}}) {
        const Scene scene(c.cosine ? cosine_mesh<double>(80) : uniform_mesh<double>(80), 2e-6);
        const FrictionModel<Law> model = scene.transient(Integrator::implicit_euler);
        auto workspace = model.workspace();
        State now = model.at_rest(), next = now;
        double last = 0, highest = 0, lowest = 1;
        std::vector<double> falls;
        for (int k = 1; k * c.dq < 24; ++k) {
            const Step step = model.advance(now, {c.dq * a, c.dq * a / speed}, 2e-3, next, workspace);
            REQUIRE(step.status == StepStatus::ok);
            std::swap(now, next);
            const double force = force_ratio(step);
            if (last - force > 0.1) {
                falls.push_back(k * c.dq);
                highest = std::max(highest, last);
                lowest = std::min(lowest, force);
            }
            last = force;
        }
        CAPTURE(c.cosine, c.dq, falls.size(), highest, lowest);
        REQUIRE(falls.size() >= 3);
        const double period = (falls.back() - falls.front()) / static_cast<double>(falls.size() - 1);
        CAPTURE(period);
        CHECK(std::abs(highest - 0.828) < 0.01);
        CHECK(std::abs(lowest - 0.656) < 0.01);
        CHECK(std::abs(period - c.period) < c.margin);
    }
}

TEST_CASE("A point of the creep curve follows the branch of its neighbour", "[friction]") {
    const Law steep{.mu_0 = 0.3, .mu_k = 0, .half_velocity = 0.002};
    const Scene scene(cosine_mesh<double>(40));
    const SteadyFrictionModel<Law> model(scene.contact, scene.mesh, scene.scheme, scene.kernel,
                                         {steep, scene.pressure()});
    auto workspace = model.workspace();
    constexpr int count = 31;
    const auto curve = [&](bool down) {
        std::vector<double> forces(count);
        State now = model.at_rest(), next = now;
        for (int k = 0; k < count; ++k) {
            const int at = down ? count - 1 - k : k;
            const Step step = model.steady(now, 5e-5 * (at + 1), speed, next, workspace);
            REQUIRE(step.status == StepStatus::ok);
            forces[static_cast<std::size_t>(at)] = force_ratio(step);
            std::swap(now, next);
        }
        return forces;
    };
    const std::vector<double> up = curve(false), down = curve(true);
    double apart = 0;
    for (std::size_t k = 0; k < count; ++k) {
        CHECK(up[k] >= down[k] - 1e-9);
        apart = std::max(apart, up[k] - down[k]);
    }
    CHECK(apart > 0.1);
    CHECK(up.back() == Approx(down.back()).epsilon(1e-9));
}

TEST_CASE("Memory is transported on a breathing mesh", "[friction]") {
    // full sliding with v = |creepage| V approximately, so that mu of a particle is known
    Scene scene(uniform_mesh<double>(40), 10e-6);
    const PlaneKernel<double> kernel = PlaneKernel<double>::longitudinal(scene.contact);
    const Law weak{.mu_0 = 0.3, .mu_k = 0.18, .half_velocity = 0.1};
    const FrictionModel<Law> model(scene.contact, rolling_system(scene.mesh, scene.scheme, kernel), unchecked,
                                   {weak, scene.pressure() / 1000, {10e-6, 0}}, Integrator::sdirk2);
    auto workspace = model.workspace();
    State now = model.at_rest(), next = now;
    const double dq = 0.02 * a, creepage = 2e-3;
    NormalLoad<double> load{now.normal_pressure, a, {}};
    double half_length = a;
    for (int k = 1; k <= 150; ++k) {
        half_length = a * (1 + 0.2 * std::sin(0.04 * k));
        load.half_length = half_length;
        const Step step = model.advance(now, {dq, dq / speed}, creepage, load, next, workspace);
        REQUIRE(step.status == StepStatus::ok);
        std::swap(now, next);
        CHECK(now.half_length == half_length);
    }
    // d mu/dx = -(creepage/d) (mu - mu_s) from the leading edge, where a particle has entered; the edge moves back and
    // forth relative to the centre
    const ElementSystem<double> system = rolling_system(scene.mesh, scene.scheme, kernel);
    const ArrayX<double>& points = *system.points();
    const double end = weak(creepage * speed);
    for (Eigen::Index i = 0; i < 40; i += 3) {
        // entered where the edge was when it met the particle: q_in + a(q_in) = q + a(q) zeta
        const double place = half_length / a * points[i];
        double way = 1 - points[i];
        for (int iteration = 0; iteration < 200; ++iteration) {
            way = (1 + 0.2 * std::sin(0.04 * 150 - 2 * way)) - place;
        }
        const double expected = end + (0.3 - end) * std::exp(-creepage * way * a / 10e-6);
        CAPTURE(i, way);
        CHECK(now.friction_coefficient[i] == Approx(expected).margin(2e-3));
    }
}

TEST_CASE("Elements without pressure lose their memory", "[friction]") {
    const Scene scene(uniform_mesh<double>(20), 10e-6);
    const FrictionModel<Law> model = scene.transient();
    auto workspace = model.workspace();
    State now = model.at_rest(), next = now;
    for (int k = 0; k < 40; ++k) {
        REQUIRE(model.advance(now, {0.1 * a, 0.1 * a / speed}, 5e-3, next, workspace).status == StepStatus::ok);
        std::swap(now, next);
    }
    CHECK(now.friction_coefficient.minCoeff() < 0.27);
    NormalLoad<double> load{scene.pressure(), a, {}};
    load.normal_pressure.head(10).setZero();
    REQUIRE(model.advance(now, {0.1 * a, 0.1 * a / speed}, 5e-3, load, next, workspace).status == StepStatus::ok);
    CHECK((next.friction_coefficient.head(10) == 0.3).all());
    CHECK(next.friction_coefficient.tail(10).minCoeff() < 0.29);
}

TEST_CASE("Results depend on state and arguments alone, to the last bit", "[friction]") {
    const auto same = [](double x, double y) { return std::memcmp(&x, &y, sizeof x) == 0; };
    std::mt19937 generator(11);
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(generator()) / 4294967296.0;
    };
    for (const double distance : {0.0, 5e-6}) {
        for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
            const Scene scene(cosine_mesh<double>(20), distance);
            const FrictionModel<Law> model = scene.transient(integrator);
            auto used = model.workspace();
            State now = model.at_rest(), next = now, other = now;
            for (int k = 0; k < 150; ++k) {
                const double dq = std::vector<double>{0.05, 0.1, 0}[generator() % 3] * a,
                             creepage = uniform(-4e-3, 4e-3);
                const bool steady = k % 10 == 9;
                const Motion motion = dq == 0 ? Motion::shift(creepage * a / 10) : Motion(creepage);
                const auto solve = [&](State& to, FrictionWorkspace<>& workspace) {
                    return steady ? model.steady(now, creepage, speed, to, workspace)
                                  : model.advance(now, {dq, 0.05 * a / speed}, motion, to, workspace);
                };
                auto fresh = model.workspace();
                const Step step = solve(next, used), again = solve(other, fresh);
                CAPTURE(distance, name(integrator), k);
                REQUIRE(step.status == again.status);
                CHECK((same(step.force, again.force) && same(step.tangent, again.tangent) &&
                       same(step.slip_work_per_width, again.slip_work_per_width)));
                CHECK((step.rounds == again.rounds && next.zones == other.zones));
                CHECK((next.traction.array() == other.traction.array()).all());
                CHECK((next.friction_coefficient == other.friction_coefficient).all());
                CHECK((next.solver.stage_coefficient == other.solver.stage_coefficient).all());
                if (generator() % 4 != 0) std::swap(now, next);
            }
        }
    }
}

TEST_CASE("Without tangents a step is the same", "[friction]") {
    const Scene scene(cosine_mesh<double>(20), 5e-6);
    Friction<Law> friction = scene.friction();
    friction.with_tangents = false;
    const FrictionModel<Law> with = scene.transient(), without(scene.contact, scene.system(), unchecked, friction);
    auto workspace = with.workspace(), other_workspace = workspace;
    State now = with.at_rest(), next = now, other = now;
    for (int k = 1; k <= 30; ++k) {
        const double creepage = 3e-3 * std::sin(0.2 * k);
        const Step step = with.advance(now, {0.1 * a, 0.1 * a / speed}, creepage, next, workspace),
                   same = without.advance(now, {0.1 * a, 0.1 * a / speed}, creepage, other, other_workspace);
        CHECK(step.force == same.force);
        CHECK((next.friction_coefficient == other.friction_coefficient).all());
        CHECK(std::isfinite(step.tangent));
        CHECK(std::isnan(same.tangent));
        std::swap(now, next);
    }
}

TEST_CASE("A falling law out of range is refused", "[friction]") {
    Scene scene(cosine_mesh<double>(10), 1e-6);
    const auto refused = [&](const Law& bad, const Memory& memory, const char* words) {
        const Friction<Law> friction{bad, scene.pressure(), memory};
        CHECK_THROWS_WITH(SteadyFrictionModel<Law>(scene.contact, scene.mesh, scene.scheme, scene.kernel, friction),
                          ContainsSubstring(words));
        CHECK_THROWS_AS(FrictionModel<Law>(scene.contact, scene.system(), unchecked, friction), std::invalid_argument);
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    refused({-0.1, 0.2, 1}, {}, "friction coefficient at rest = -0.1 must be finite and not negative");
    refused({nan, 0.2, 1}, {}, "friction coefficient at rest = nan");
    refused(law, {-1e-6, 0}, "distance of the memory = -1e-06 must be");
    refused(law, {nan, 0}, "distance of the memory = nan");
    refused(law, {infinite, 0}, "distance of the memory = inf");
    refused(law, {1e-6, -1}, "least_velocity of the memory = -1 must be");
    refused(law, {1e-6, infinite}, "least_velocity of the memory = inf");
    refused({infinite, 0.2, 1}, {}, "friction coefficient at rest = inf");
    const ElementSystem<double> system = scene.system();
    const ElementSystem<double> pointless(system.G(), system.G_prime(), system.weights());
    CHECK_THROWS_WITH(FrictionModel<Law>(scene.contact, pointless, unchecked, scene.friction()),
                      ContainsSubstring("distance of the memory = 1e-06 must be 0"));
    scene.distance = 0;
    CHECK_NOTHROW(FrictionModel<Law>(scene.contact, pointless, unchecked, scene.friction()));

    const FrictionModel<Law> model = scene.transient();
    auto workspace = model.workspace();
    const State rest = model.at_rest();
    State to = rest, wrong = rest;
    const double dq = 0.1 * a, duration = dq / speed;
    for (const double bad : {0.0, -1.0, nan, infinite}) {
        CHECK(model.advance(rest, {dq, bad}, 1e-3, to, workspace).status == StepStatus::invalid_step);
        CHECK(model.steady(rest, 1e-3, bad, to, workspace).status == StepStatus::invalid_step);
        CHECK(scene.steady().steady(scene.steady().at_rest(), 1e-3, bad, to, workspace).status ==
              StepStatus::invalid_step);
    }
    const SteadyFrictionModel<Law> steady = scene.steady();
    State steady_wrong = steady.at_rest(), steady_to = steady_wrong;
    for (const double bad : {nan, infinite}) {
        CHECK(model.steady(rest, bad, speed, to, workspace).status == StepStatus::not_finite);
        CHECK(steady.steady(steady.at_rest(), bad, speed, steady_to, workspace).status == StepStatus::not_finite);
    }
    for (const double bad : {-0.1, nan, infinite}) {
        wrong.friction_coefficient[3] = bad;
        steady_wrong.friction_coefficient[3] = bad;
        CHECK(steady.steady(steady_wrong, 1e-3, speed, steady_to, workspace).status == StepStatus::wrong_state);
        CHECK(model.advance(wrong, {dq, duration}, 1e-3, to, workspace).status == StepStatus::wrong_state);
        CHECK(model.steady(wrong, 1e-3, speed, to, workspace).status == StepStatus::wrong_state);
    }
    wrong = rest;
    for (const double bad : {-0.1, nan, infinite}) {
        wrong.solver.stage_coefficient[3] = bad;
        CHECK(model.advance(wrong, {dq, duration}, 1e-3, to, workspace).status == StepStatus::wrong_state);
    }
    wrong = rest;
    wrong.solver.stage_coefficient.resize(9);
    CHECK(model.advance(wrong, {dq, duration}, 1e-3, to, workspace).status == StepStatus::wrong_state);
    wrong = rest;
    wrong.friction_coefficient.resize(9);
    CHECK(model.advance(wrong, {dq, duration}, 1e-3, to, workspace).status == StepStatus::wrong_state);
    CHECK(model.advance(rest, {dq, duration}, 1e-3, wrong, workspace).status == StepStatus::wrong_state);
    CHECK(model.advance(rest, {dq, duration}, nan, to, workspace).status == StepStatus::not_finite);
    CHECK((to.traction.array() == 0).all());
}

TEST_CASE("A law that returns NaN leads to a status", "[friction]") {
    const AnyLaw broken = [](double v) { return v > 0.05 ? std::numeric_limits<double>::quiet_NaN() : 0.3; };
    const Scene scene(cosine_mesh<double>(20));
    const FrictionModel<AnyLaw> model(scene.contact, scene.system(), unchecked, {broken, scene.pressure()});
    auto workspace = model.workspace();
    State now = model.at_rest(), next = now;
    now.friction_coefficient.setConstant(0.2);
    CHECK(model.advance(now, {0.1 * a, 0.1 * a / speed}, 0.0, next, workspace).status == StepStatus::ok);
    CHECK(model.advance(now, {0.1 * a, 0.1 * a / speed}, 2e-2, next, workspace).status == StepStatus::not_finite);
    CHECK((next.traction.array() == now.traction.array()).all());
    CHECK((next.friction_coefficient == 0.2).all());
}

TEST_CASE("If no coefficient fits its slip, status and residual say so", "[friction]") {
    // it sticks at the coefficient of slip, and slips at that of rest
    const AnyLaw torn = [](double v) { return v > 0 ? 0.3 : 0.1; };
    const Scene scene(uniform_mesh<double>(1));
    const FrictionModel<AnyLaw> model(scene.contact, scene.system(), unchecked, {torn, scene.pressure()},
                                      Integrator::implicit_euler);
    auto workspace = model.workspace();
    State rest = model.at_rest(), next = rest;
    int failed = 0;
    for (int k = 1; k <= 60; ++k) {
        const Step step = model.advance(rest, {0.1 * a, 0.1 * a / speed}, 1e-3 * k, next, workspace);
        if (step.status == StepStatus::ok) continue;
        REQUIRE(step.status == StepStatus::no_solution);
        CHECK(step.complementarity_residual > 0.05);
        CHECK(step.complementarity_residual < 0.21);
        CHECK(std::isfinite(step.force));
        CHECK(std::isnan(step.tangent));
        ++failed;
    }
    CHECK(failed >= 5);
    CHECK(failed <= 55);
}

TEST_CASE("A law that is no number in between is not overlooked", "[friction]") {
    const AnyLaw gap = [](double v) { return v > 0.02 && v < 0.04 ? std::numeric_limits<double>::quiet_NaN() : 0.3; };
    const Scene scene(cosine_mesh<double>(40));
    const FrictionModel<AnyLaw> model(scene.contact, scene.system(), unchecked, {gap, scene.pressure()},
                                      Integrator::implicit_euler);
    auto workspace = model.workspace();
    State now = model.at_rest(), next = now;
    const double dq = 0.05 * a, duration = dq / speed;
    int solved = 0, failed = 0;
    for (int point = 1; point <= 10; ++point) {
        now = model.at_rest();
        for (int k = 0; k < 15; ++k) {
            if (model.advance(now, {dq, duration}, 5e-3 * point, next, workspace).status != StepStatus::ok) {
                ++failed;
                break;
            }
            const ArrayX<double> velocity = workspace.slip().array().abs() / duration;
            CHECK_FALSE((velocity > 0.02 && velocity < 0.04).any());
            ++solved;
            std::swap(now, next);
        }
    }
    CHECK(solved > 0);
    CHECK(failed > 0);
}

TEST_CASE("A law may rise from nothing", "[friction]") {
    const AnyLaw rising = [](double v) { return std::min(0.3, v); };
    const Scene scene(cosine_mesh<double>(40));
    const FrictionModel<AnyLaw> model(scene.contact, scene.system(), unchecked, {rising, scene.pressure()},
                                      Integrator::implicit_euler);
    auto workspace = model.workspace();
    State now = model.at_rest(), next = now;
    REQUIRE(model.steady(now, 5e-3, speed, next, workspace).status == StepStatus::ok);
    for (Eigen::Index i = 0; i < model.size(); ++i) {
        const double v = speed * std::abs(workspace.slip()[i]);
        CHECK(next.friction_coefficient[i] == Approx(rising(v)).margin(1e-12));
    }
    CHECK(model.advance(now, {0.05 * a, 0.05 * a / speed}, 5e-3, next, workspace).status == StepStatus::ok);
}

}  // namespace
