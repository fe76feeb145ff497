// rollbem/friction/state.hpp, workspace.hpp; adhesion/transient.hpp: results depend, bit for bit, only on the state and
// the arguments, not on earlier computations. A state is plain data.
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <rollbem/compiled/transient.hpp>

#include "friction/same_bits.hpp"
#include "scene.hpp"
#include "support/catch.hpp"

namespace friction_tests {
namespace {

using State = FrictionState<>;
using Step = FrictionStep<>;
using Workspace = FrictionWorkspace<>;
using Catch::Matchers::ContainsSubstring;
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

TEST_CASE("States of a system in other units are rejected, and states of another system in full adhesion",
          "[friction]") {
    const Scene scene(cosine_mesh<double>(8), half, 1, 10);
    const FrictionModel<> model = scene.transient();
    Workspace workspace = model.workspace();
    State next = model.at_rest();
    REQUIRE(model.advance(model.at_rest(), 0.1, creepage(0.5), next, workspace).status == StepStatus::ok);
    const State kept = next;
    const VectorX<double> kept_slip = workspace.slip();
    const auto untouched = [&] { return same(next, kept) && same(workspace.slip(), kept_slip); };

    const Scene other_mesh(uniform_mesh<double>(8), half, 1, 10);
    // the same system in other units
    const Contact<double> stiffer(
        {.half_length = 1, .half_width = 10, .shear_modulus = 2, .poisson_ratio = scene.contact.poisson_ratio()});
    const FrictionModel<> in_other_units(stiffer, scene.system(), unchecked, scene.friction);
    CHECK(model.advance(in_other_units.at_rest(), 0.1, 1e-3, next, workspace).status == StepStatus::wrong_state);
    CHECK(untouched());
    // a workspace of another model with as many elements is accepted
    const State rest = model.at_rest();
    Workspace borrowed = Scene(uniform_mesh<double>(8)).transient().workspace();
    CHECK(model.advance(rest, 0.1, 1e-3, next, borrowed).status == StepStatus::ok);
    // another coefficient of friction is the same system
    const FrictionModel<> slippery = Scene(cosine_mesh<double>(8), half, 0.1, 10).transient();
    CHECK(slippery.advance(kept, 0.1, 1e-3, next, workspace).status == StepStatus::ok);

    // the same in full adhesion
    const AdhesionModel<> adhesion(scene.contact, scene.system(), unchecked);
    const AdhesionModel<> other_adhesion(other_mesh.contact, other_mesh.system(), unchecked);
    AdhesionState<> to = adhesion.steady(1e-3);
    const VectorX<double> kept_adhesion = to.traction;
    AdhesionWorkspace<> its_own = adhesion.workspace(), too_small = AdhesionWorkspace<>(7);
    CHECK(adhesion.advance(other_adhesion.at_rest(), 0.1, 1e-3, to, its_own).status == StepStatus::wrong_state);
    CHECK(adhesion.advance(adhesion.at_rest(), 0.1, 1e-3, to, too_small).status == StepStatus::wrong_state);
    CHECK(same(to.traction, kept_adhesion));
    CHECK(to.system == adhesion.fingerprint());
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

TEST_CASE("Friction in time requires of its system what full adhesion requires", "[friction]") {
    // friction bounds the tractions of elements: a system with other unknowns does not compile
    using Law = const Friction<>&;
    static_assert(std::is_constructible_v<FrictionModel<>, Contact<double>, ElementSystem<double>, Unchecked, Law>);
    static_assert(!std::is_constructible_v<FrictionModel<>, Contact<double>, RollingSystem<double>, Unchecked, Law>);
    static_assert(
        !std::is_constructible_v<FrictionModel<>, Contact<double>, RollingSystem<double>, StabilityVerdict, Law>);
    static_assert(std::is_constructible_v<AdhesionModel<>, Contact<double>, RollingSystem<double>, Unchecked>);

    const Scene scene(cosine_mesh<double>(12), half, 1, 10);
    const ElementSystem<double> system = scene.system();
    const StabilityVerdict good{.n = 12, .unstable_count = 0, .uncertain_count = 0, .status = Status::ok};
    const auto refused = [&](const Contact<double>& contact, const ElementSystem<double>& which,
                             const StabilityVerdict& verdict, const std::string& text) {
        CHECK_THROWS_WITH(FrictionModel<>(contact, which, verdict, scene.friction),
                          ContainsSubstring("FrictionModel: " + text));
        CHECK_THROWS_WITH(AdhesionModel<>(contact, which, verdict), ContainsSubstring("AdhesionModel: " + text));
    };
    CHECK_NOTHROW(FrictionModel<>(scene.contact, system, good, scene.friction));
    StabilityVerdict bad = good;
    bad.n = 11;
    refused(scene.contact, system, bad, "n of the verdict = 11 must equal the number of unknowns");
    bad = good;
    bad.unstable_count = 1;
    refused(scene.contact, system, bad, "unstable_count = 1 must be 0");
    bad = good;
    bad.uncertain_count = 2;
    refused(scene.contact, system, bad, "uncertain_count = 2 must be 0");
    bad = good;
    bad.status = Status::ill_conditioned;
    refused(scene.contact, system, bad, "status of the verdict = ill_conditioned must be ok");
    refused(scene.contact, system, StabilityVerdict{}, "n of the verdict = 0");
    // a scheme that does not converge, whatever the verdict on its eigenvalues
    const Scene divergent(cosine_mesh<double>(12), {.alpha_L = -0.2, .alpha_T = -0.2}, 1, 10);
    refused(scene.contact, divergent.system(), good, "share of steady traction that assists the creepage");
    CHECK_NOTHROW(divergent.transient());

    // b/a of the kernel must be that of the contact
    for (const double change : {1e-11, -1e-11, 0.5}) {
        const auto other = Contact<double>::dimensionless(10 * (1 + change), nu);
        refused(other, system, good, "b/a of the kernel over that of the contact");
        CHECK_THROWS_WITH(FrictionModel<>(other, system, unchecked, scene.friction), ContainsSubstring("b/a"));
        CHECK_THROWS_WITH(FrictionModel<>(other, steady_system(scene.mesh, scene.scheme, scene.kernel), scene.friction),
                          ContainsSubstring("b/a"));
    }
    CHECK_NOTHROW(
        FrictionModel<>(Contact<double>::dimensionless(10 * (1 + 5e-13), nu), system, unchecked, scene.friction));
    const auto infinite = Contact<double>::dimensionless(std::numeric_limits<double>::infinity(), nu);
    refused(infinite, system, good, "half_width = inf must be finite");
    // user-supplied matrices have no b/a; interchanged ones are detected
    const ElementSystem<double> ready(system.G(), system.G_prime(), system.weights());
    CHECK_NOTHROW(FrictionModel<>(Contact<double>::dimensionless(20, nu), ready, good, scene.friction));
    CHECK_THROWS_WITH(ElementSystem<double>(system.G_prime(), system.G(), system.weights()),
                      ContainsSubstring("have they changed places?"));
    CHECK_THROWS_WITH(ElementSystem<double>(system.G(), system.G_prime(), -system.weights()),
                      ContainsSubstring("ElementSystem: width = "));
}

}  // namespace
}  // namespace friction_tests
