// rollbem/friction/model.hpp: steps in which nothing changes, which are cheaper.
#include <cmath>
#include <utility>

#include <rollbem/compiled/friction.hpp>

#include "falling_scene.hpp"
#include "friction/same_bits.hpp"
#include "support/catch.hpp"

namespace falling_tests {
namespace {

using same_bits::same;

TEST_CASE("Long runs do not depend on the workspace, even if two laws share it", "[friction]") {
    constexpr Eigen::Index n = 16;
    constexpr double dq = 0.2 * a;
    struct Case {
        double distance;
        Integrator integrator;
        int most_rounds;  // of a step in which nothing changes
    };
    for (const Case& c : {Case{0, Integrator::implicit_euler, 1}, Case{10e-6, Integrator::implicit_euler, 1},
                          Case{10e-6, Integrator::sdirk2, 2}}) {
        const Scene scene(cosine_mesh<double>(n), c.distance);
        Friction<Law> steep = scene.friction();
        steep.law.half_velocity *= 0.9;
        const FrictionModel<Law> models[] = {scene.transient(c.integrator),
                                             {scene.contact, scene.system(), unchecked, steep, c.integrator}};
        State now[] = {models[0].at_rest(), models[1].at_rest()}, next = now[0], alone = next;
        auto used = models[0].workspace();
        for (int k = 0; k < 1600; ++k) {
            models[k % 2].advance(now[k % 2], {dq, dq / speed}, 1e-3, next, used);
            std::swap(now[k % 2], next);
        }
        int cheap = 0, settled = 0;
        for (int k = 0; k < 500; ++k) {
            const int who = k < 200 ? 0 : k % 2;  // one for long, then in turns
            const double creepage = k == 150 ? 4e-4 : 1e-3;
            auto fresh = models[who].workspace();
            const Step found = models[who].advance(now[who], {dq, dq / speed}, creepage, next, used);
            const Step expected = models[who].advance(now[who], {dq, dq / speed}, creepage, alone, fresh);
            CAPTURE(c.distance, name(c.integrator), k, who, now[who].solver.unchanged_steps);
            REQUIRE(found.status == StepStatus::ok);
            REQUIRE(std::isfinite(found.tangent));
            REQUIRE(same(found, expected));
            REQUIRE(same(next, alone));
            cheap += now[who].solver.unchanged_steps > n / 2 ? 1 : 0;
            settled += found.rounds <= c.most_rounds ? 1 : 0;
            std::swap(now[who], next);
        }
        CAPTURE(c.distance, name(c.integrator), cheap, settled);
        CHECK(cheap > 300);
        CHECK(settled > 250);
    }
}

TEST_CASE("The tangent of a step that changes nothing agrees with central differences", "[friction]") {
    constexpr double dq = 0.2 * a;
    for (const double distance : {0.0, 10e-6}) {
        const Scene scene(cosine_mesh<double>(30), distance);
        const FrictionModel<Law> model = scene.transient(Integrator::implicit_euler);
        auto workspace = model.workspace();
        State now = model.at_rest(), next = now;
        Step step;
        for (int k = 0; k < 1000; ++k) {
            step = model.advance(now, {dq, dq / speed}, 1e-3, next, workspace);
            std::swap(now, next);
        }
        REQUIRE(now.solver.unchanged_steps > 15);
        REQUIRE(step.rounds == 1);
        REQUIRE(step.stick_count < 25);
        const auto difference = [&](double h) {
            const double high = model.advance(now, {dq, dq / speed}, 1e-3 * (1 + h), next, workspace).force;
            const double low = model.advance(now, {dq, dq / speed}, 1e-3 * (1 - h), next, workspace).force;
            return (high - low) / (2e-3 * h);
        };
        // of second order in h
        const double coarse = std::abs(difference(1e-2) / step.tangent - 1);
        const double fine = std::abs(difference(5e-3) / step.tangent - 1);
        const double finest = std::abs(difference(1e-5) / step.tangent - 1);
        CAPTURE(distance, coarse, fine, finest);
        CHECK(coarse < 1e-3);
        CHECK(coarse > 1e-9);
        CHECK(fine < 0.4 * coarse);
        CHECK(finest < 3e-9);
    }
}

}  // namespace
}  // namespace falling_tests
