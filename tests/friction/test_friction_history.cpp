// rollbem/friction/state.hpp: what a state may hold, and to which systems it belongs.
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "friction/same_bits.hpp"
#include "scene.hpp"
#include "support/catch.hpp"

namespace friction_tests {
namespace {

using State = FrictionState<>;
using Step = FrictionStep<>;
using Workspace = FrictionWorkspace<>;
using same_bits::same;

TEST_CASE("Invalid counts in a state do not change the solution", "[friction]") {
    const Scene scene(cosine_mesh<double>(20), half, 1, 10);
    constexpr int high = std::numeric_limits<int>::max(), low = std::numeric_limits<int>::min();
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
        const FrictionModel<> model = scene.transient(integrator);
        Workspace workspace = model.workspace();
        State now = model.at_rest(), next = now, expected = now;
        for (int k = 0; k < 60; ++k) {
            REQUIRE(model.advance(now, 0.1, creepage(0.5), next, workspace).status == StepStatus::ok);
            std::swap(now, next);
        }
        const State rolled = now;
        REQUIRE(rolled.solver.unchanged_steps > 10);
        now.solver.unchanged_steps = 0;
        const Step step = model.advance(now, 0.1, creepage(0.5), expected, workspace);
        REQUIRE(step.status == StepStatus::ok);
        CHECK(expected.solver.unchanged_steps == 1);
        for (const int steps : {high, low, -1, 75}) {
            now.solver.unchanged_steps = steps;
            CAPTURE(name(integrator), steps);
            CHECK(same(model.advance(now, 0.1, creepage(0.5), next, workspace), step));
            CHECK(same(next, expected));
        }
        for (const double distance :
             {nan, 0.0, -rolled.solver.unchanged_distance, 2 * rolled.solver.unchanged_distance}) {
            now = rolled;
            now.solver.unchanged_distance = distance;
            CAPTURE(name(integrator), distance);
            CHECK(same(model.advance(now, 0.1, creepage(0.5), next, workspace), step));
            CHECK(same(next, expected));
        }
        // possible, but untrue counts
        for (const int steps : {1, 11, 12, 74}) {
            for (const double xi : {0.5, 1.2, -0.4}) {
                now = rolled;
                now.solver.unchanged_steps = 0;
                const Step found = model.advance(now, 0.1, creepage(xi), expected, workspace);
                now.solver.unchanged_steps = steps;
                const Step claimed = model.advance(now, 0.1, creepage(xi), next, workspace);
                CAPTURE(name(integrator), steps, xi);
                CHECK(claimed.status == StepStatus::ok);
                CHECK(claimed.force == Approx(found.force).epsilon(1e-12));
                CHECK(next.zones == expected.zones);
            }
        }
        // a step of the other integrator has another matrix
        const FrictionModel<> other =
            scene.transient(integrator == Integrator::sdirk2 ? Integrator::implicit_euler : Integrator::sdirk2);
        CHECK(other.advance(rolled, 0.1, creepage(0.5), next, workspace).status == StepStatus::ok);
        CHECK(next.solver.unchanged_steps <= 1);
    }
}

TEST_CASE("Invalid zones in a state do not change the solution", "[friction]") {
    const Scene scene(cosine_mesh<double>(30), half, 1, 100);
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
        const FrictionModel<> model = scene.transient(integrator);
        FrictionWorkspace<> workspace = model.workspace();
        FrictionState<> now = model.at_rest(), next = now;
        for (int k = 0; k < 40; ++k) {
            model.advance(now, 0.1, creepage(1.5), next, workspace);
            std::swap(now, next);
        }
        const FrictionStep<> expected = model.advance(now, 0.1, creepage(1.5), next, workspace);
        REQUIRE(expected.status == StepStatus::ok);
        const std::vector<Zone> zones = next.zones;
        for (std::size_t i = 0; i < now.zones.size(); ++i) {
            for (const int other : {-127, -2, 2, 127}) {
                FrictionState<> spoilt = now;
                spoilt.zones[i] = static_cast<Zone>(other);
                const FrictionStep<> step = model.advance(spoilt, 0.1, creepage(1.5), next, workspace);
                CAPTURE(i, other);
                CHECK(step.status == StepStatus::ok);
                CHECK(step.force == Approx(expected.force).epsilon(1e-9));
                CHECK(next.zones == zones);
            }
        }
    }
}

TEST_CASE("Fingerprints distinguish systems but not friction laws", "[friction]") {
    const Scene scene(cosine_mesh<double>(8), half, 1, 10);
    const ElementSystem<double> system = scene.system();
    CHECK(system.fingerprint() == scene.system().fingerprint());
    const auto changed = [&](int what) {
        MatrixX<double> G = system.G(), G_prime = system.G_prime();
        ArrayX<double> widths = system.weights();
        double& entry = what == 0 ? G(3, 5) : what == 1 ? G_prime(7, 0) : widths[7];
        entry = std::nextafter(entry, 1e9);
        return ElementSystem<double>(G, G_prime, widths).fingerprint();
    };
    for (const int what : {0, 1, 2}) CHECK(changed(what) != system.fingerprint());
    CHECK(scene.transient().fingerprint() == scene.transient(Integrator::implicit_euler).fingerprint());
    CHECK(scene.transient().fingerprint() == Scene(scene.mesh, half, 0.1, 10).transient().fingerprint());
    CHECK(scene.transient().fingerprint() != Scene(scene.mesh, half, 1, 11).transient().fingerprint());
}

}  // namespace
}  // namespace friction_tests
