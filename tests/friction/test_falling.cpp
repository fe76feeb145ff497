// rollbem/friction/law.hpp, and friction that falls with slip: against reference forces and limits.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "friction/any_model.hpp"
#include "support/catch.hpp"

namespace any_model {
namespace {

TEST_CASE("The law falls from mu_0 at rest to mu_k, halfway at its half velocity; memories fade", "[friction]") {
    const ExponentialFall falling{0.3, 0.1, 0.2};
    CHECK(falling(0.0) == Approx(0.3).epsilon(1e-15));
    CHECK(falling(0.2) == Approx(0.2).epsilon(1e-15));
    CHECK(falling(0.6) == Approx(0.1 + 0.2 / 8).epsilon(1e-14));
    using Memory = Friction::Memory;
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
        const FrictionModel steady =
            make({.falls = true, .distance = distances[k], .mesh = uniform_mesh<double>(160), .strip = true}, true);
        const State rest = steady.at_rest();
        Run run(steady);
        for (int j = 0; j < 5; ++j) {
            run.now() = rest;
            const Step step = run.steady({Travel::at_speed(speed), Creepage{creepages[j]}});
            CAPTURE(distances[k], creepages[j]);
            CHECK(step.status == Status::ok);
            CHECK(std::abs(ratios(step)[0] - steady_forces[k][j]) < 6e-6);
            CHECK(step.rounds > 1);  // of all searches for stick and slip: the last takes one
        }
    }
}

TEST_CASE("In steady sliding, a memory fades over the intervals of the equations", "[friction]") {
    const Setup setup{.falls = true, .distance = 3e-4, .mesh = cosine_mesh<double>(12)};
    const ElementSystem<double> system =
        rolling_system(setup.mesh, NodeDifference{Nodes::chebyshev}, setup.kernel(false));
    const FrictionModel model(setup.contact(), system, unchecked,
                              {law, setup.pressure(), {setup.distance, least_velocity}});
    Run run(model);
    constexpr double creepage = 0.5;  // 200 times that of full sliding: slip is that of rigid bodies
    REQUIRE(run.steady({Travel::at_speed(speed), Creepage{creepage}}).stick_count == 0);
    double mu = law.mu_0;
    for (Eigen::Index i = 11; i >= 0; --i) {
        mu = law.mu_k + (mu - law.mu_k) / (1 + a * system.elements().intervals[i] * creepage / setup.distance);
        CAPTURE(i, mu, run.now().friction_coefficient[i], system.elements().intervals[i], system.elements().areas[i]);
        CHECK(run.now().friction_coefficient[i] == Approx(mu).epsilon(1e-3));
    }
}

TEST_CASE("With little memory, the force oscillates at the peak of the creep curve", "[friction]") {
    // a steady solution exists, but a run from rest does not reach it: the force drops within one step, however short,
    // and rises slowly again, with a period that tends to 4.1 or 4.2 from above
    Ride ride({.falls = true,
               .distance = 2e-6,
               .integrator = Integrator::implicit_euler,
               .mesh = cosine_mesh<double>(80),
               .strip = true});
    const double dq = 0.0125;
    double last = 0, highest = 0, lowest = 1;
    std::vector<double> falls;
    for (int k = 1; k * dq < 24; ++k) {
        const Step step = ride.step(dq, Creepage{2e-3});
        REQUIRE(step.status == Status::ok);
        const double force = ratios(step)[0];
        if (last - force > 0.1) {
            falls.push_back(k * dq);
            highest = std::max(highest, last);
            lowest = std::min(lowest, force);
        }
        last = force;
    }
    REQUIRE(falls.size() >= 3);
    const double period = (falls.back() - falls.front()) / static_cast<double>(falls.size() - 1);
    CAPTURE(falls, highest, lowest, period);
    CHECK(std::abs(highest - 0.828) < 0.01);
    CHECK(std::abs(lowest - 0.656) < 0.01);
    CHECK(std::abs(period - 4.25) < 0.1);
}

TEST_CASE("Tractions that jump within a step and return release the energy of both jumps", "[friction]") {
    Ride ride({.falls = true, .strip = true});
    const double fast = 10;  // all elements slide at mu_k, in the first stage of the last step backwards
    for (int k = 0; k < 3; ++k) REQUIRE(ride.step(0.1, Creepage{fast}).status == Status::ok);
    State jump = ride.now;
    const Step step = ride.step(0.1, Motion::linear({-10 * fast}, {fast}));
    REQUIRE(step.status == Status::ok);
    CHECK((ride.now.traction - jump.traction).norm() < 1e-12 * jump.traction.norm());
    jump.traction *= -2;
    const double ratio = 1 + std::numbers::sqrt2;  // weight of the first of two stages
    CHECK(step.jump_work == Approx(2 * ratio * ride.model.elastic_energy(jump)).epsilon(1e-10));
}

TEST_CASE("A memory needs the points of the equations", "[friction]") {
    const Setup setup;
    const ElementSystem<double> system = setup.system(false);
    const ElementSystem<double> pointless(system.G(), system.G_prime(), system.weights());
    const auto with_memory = [&](const auto& of, double distance) {
        FrictionModel(setup.contact(), of, unchecked, {law, setup.pressure(), {distance, least_velocity}});
    };
    const std::string why =
        "FrictionModel: distance of the memory = 1e-06 must be 0 for a system that does not know the points of its "
        "equations";
    CHECK_THROWS_WITH(with_memory(pointless, 1e-6), why);
    CHECK_THROWS_WITH(with_memory(ElementSystem<double, 2>(pointless, setup.system(true)), 1e-6), why);
    CHECK_NOTHROW(with_memory(pointless, 0));
}

TEST_CASE("A law may rise from nothing; it is called as const", "[friction]") {
    const struct {
        double operator()(double v) const { return std::min(0.3, v); }
        double operator()(double) { return NAN; }
    } rising{};
    const Setup setup{.mesh = cosine_mesh<double>(40), .strip = true};
    const FrictionModel model(setup.contact(), setup.system(false), unchecked, Friction{rising, setup.pressure()},
                              Integrator::implicit_euler);
    Run run(model);
    REQUIRE(run.steady({Travel::at_speed(speed), Creepage{5e-3}}).status == Status::ok);
    for (Eigen::Index i = 0; i < model.size(); ++i) {
        const double v = speed * std::abs(run.workspace().slip()(i, 0));
        CHECK(run.now().friction_coefficient[i] == Approx(rising(v)).margin(1e-12));
    }
    CHECK(Run(model).advance({{0.05 * a, 0.05 * a / speed}, Creepage{5e-3}}).status == Status::ok);
}

}  // namespace
}  // namespace any_model
