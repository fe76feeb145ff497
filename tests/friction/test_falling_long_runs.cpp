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
