// Rolling in time where friction falls with slip and nothing is remembered: which runs come to steady rolling, and
// which do not.
#include <algorithm>
#include <cmath>
#include <utility>

#include <rollbem/compiled/friction.hpp>

#include "falling_scene.hpp"
#include "support/catch.hpp"

namespace {

using namespace falling_tests;

constexpr double creepage = 1e-3;

TEST_CASE("A run without memory that stands still solves the equations of steady rolling", "[friction]") {
    // G (p - p_before) = 0, and mu = mu_s(v) at the same v: steps of any length have the steady solutions
    for (const bool cosine : {false, true}) {
        for (const Eigen::Index n : {20, 40}) {
            for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
                const Scene scene(cosine ? cosine_mesh<double>(n) : uniform_mesh<double>(n));
                const FrictionModel<Law> model = scene.transient(integrator);
                auto workspace = model.workspace();
                const State rest = model.at_rest();
                State now = rest, next = rest, steady = rest;
                double change = 1;
                Step step;
                for (int k = 0; k < 100; ++k) {
                    step = model.advance(now, {4 * a, 4 * a / speed}, creepage, next, workspace);
                    REQUIRE(step.status == StepStatus::ok);
                    change = (next.traction - now.traction).cwiseAbs().maxCoeff() / peak_pressure;
                    std::swap(now, next);
                }
                CAPTURE(cosine, n, name(integrator), force_ratio(step));
                CHECK(change < 1e-12);
                const Step from_rest = model.steady(rest, creepage, speed, steady, workspace);
                CHECK(from_rest.status == StepStatus::ok);
                CHECK(from_rest.force == Approx(step.force).epsilon(1e-10));
                const Step from_run = model.steady(now, creepage, speed, steady, workspace);
                CHECK(from_run.status == StepStatus::ok);
                CHECK((steady.traction - now.traction).cwiseAbs().maxCoeff() < 1e-10 * peak_pressure);
                CHECK((steady.friction_coefficient - now.friction_coefficient).abs().maxCoeff() < 1e-10);
                CHECK(steady.zones == now.zones);
            }
        }
    }
}

// Least and largest force over the last 10 a of a run over 20 a in steps of 0.02 a from steady rolling, disturbed in
// its first step by a part of the creepage.
std::pair<double, double> swing(const FrictionModel<Law>& model, double disturbance) {
    auto workspace = model.workspace();
    State now = model.at_rest(), next = now;
    model.steady(now, creepage, speed, next, workspace);
    std::swap(now, next);
    double least = 1, largest = 0;
    for (int k = 0; k < 1000; ++k) {
        const double imposed = creepage * (k == 0 ? 1 + disturbance : 1);
        const Step step = model.advance(now, {0.02 * a, 0.02 * a / speed}, imposed, next, workspace);
        REQUIRE(step.status == StepStatus::ok);
        std::swap(now, next);
        if (k < 500) continue;
        least = std::min(least, force_ratio(step));
        largest = std::max(largest, force_ratio(step));
    }
    return {least, largest};
}

TEST_CASE("Without memory steady rolling is unstable in short steps; with memory it is stable", "[friction]") {
    for (const bool cosine : {false, true}) {
        Scene scene(cosine ? cosine_mesh<double>(40) : uniform_mesh<double>(40));
        CAPTURE(cosine);
        for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
            CAPTURE(name(integrator));
            scene.distance = 0;
            const FrictionModel<Law> forgetful = scene.transient(integrator);
            const auto [least, largest] = swing(forgetful, 1e-6);
            CAPTURE(least, largest);
            CHECK(least > 0.5);
            CHECK(largest < 0.585);  // of 0.595 and 0.591 in steady rolling
            CHECK(largest - least > 0.01);
            scene.distance = 10e-6;
            const auto [low, high] = swing(scene.transient(integrator), 1e-2);
            CAPTURE(low, high);
            CHECK(high - low < 1e-4);
        }
    }
}

}  // namespace
