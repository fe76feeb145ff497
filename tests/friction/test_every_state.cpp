// rollbem/friction/model.hpp, state.hpp: for every law, in one direction and in two, what results depend
// on, and what becomes of input that is refused.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "extremes/drawn.hpp"
#include "friction/any_model.hpp"
#include "support/catch.hpp"
#include "support/refusal.hpp"

namespace any_model {
namespace {

using drawn::Draw;

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();

/// A step, a shift or a steady solution, some under a load of their own.
struct Task {
    int kind;
    double dq;
    Creepage start, end;
    Load load;

    static Task any(Draw& draw, const Setup& setup, double half_length) {
        constexpr double lengths[] = {
            0.05, 0.1, 0.1 * (1 + 1e-9), 0.1 * (1 - 5e-7), 0.1 * (1 - std::numbers::sqrt2 / 2), 1, 1e-9, 1e6};
        const auto drawn = [&] { return creepage(draw.uniform(-1.6, 1.6), draw.uniform(-90, 90)); };
        Task task{draw.integer(6), lengths[draw.integer(8)], drawn(), drawn(), {}};
        const double longer = task.kind == 1 || task.kind == 2 ? 0 : draw.uniform(-0.04, 0.04) * std::min(task.dq, 1.0);
        task.load = {draw.uniform(0.9, 1.1) * setup.pressure(), half_length + longer * a, setup.pressure()};
        if (draw.one_in(4)) task.load.pressure_rate.resize(0);
        return task;
    }
    /// `held` is given where the task has no load of its own.
    Step run(const FrictionModel& model, const State& from, State& to, Workspace& workspace,
             const Load* held = nullptr) const {
        const Load* const own = kind % 2 == 0 ? held : &load;
        if (kind == 0) return model.steady(from, rolling_step(Travel::at_speed(speed), end, own), to, workspace);
        if (kind < 3) {
            const Motion shifts = Motion::shift({0.1 * a * end.longitudinal, 0.1 * a * end.lateral});
            return model.advance(from, rolling_step(Ride::travel(0), shifts, own), to, workspace);
        }
        const Motion rolls = kind == 3 ? Motion(end) : Motion::linear(start, end);
        return model.advance(from, rolling_step(Ride::travel(dq), rolls, own), to, workspace);
    }
};

TEST_CASE("Results depend on state and arguments alone, to the last bit", "[friction]") {
    for (const Setup& setup : every_setup()) {
        INFO(words(setup));
        Draw draw(5);
        int mixed = 0;
        for (const int n : {4, 17}) {
            // the same equations with another integrator, another law, without tangents; other equations
            std::vector<Setup> setups(5, setup);
            setups[1].integrator = Integrator::implicit_euler;
            setups[2].constant *= 0.5;
            setups[2].falling.half_velocity *= 0.5;
            setups[3].with_tangents = false;
            setups[4].scheme = {.alpha_L = 0, .alpha_T = 0.5};
            for (Setup& each : setups) each.mesh = cosine_mesh<double>(n);
            std::vector<Ride> rides;
            for (const Setup& each : setups) rides.emplace_back(each);
            Workspace used = rides[0].model.workspace();
            for (int k = 0; k < 250; ++k) {
                const int who = k < 60 ? 0 : draw.integer(5);
                Ride& ride = rides[static_cast<std::size_t>(who)];
                const Task task = Task::any(draw, setups[0], ride.now.half_length);
                State from = ride.now, alone = from;
                const bool is_refused = draw.one_in(20);
                if (is_refused) from.normal_pressure[draw.integer(n)] = -1;
                alone.traction.setOnes();  // what is written to holds anything
                alone.unrotated_traction.setOnes();
                alone.normal_pressure.setOnes();
                Workspace fresh = ride.model.workspace();
                const Step found = task.run(ride.model, from, ride.next, used);
                const Step expected = task.run(ride.model, from, alone, fresh);
                CAPTURE(n, k, who, task.kind, task.dq, name(found.status));
                REQUIRE(same(found, expected));
                REQUIRE((found.status == Status::invalid_load) == is_refused);
                if (is_refused) continue;
                REQUIRE((found.status == Status::ok || setup.falls));
                REQUIRE(same(ride.next, alone));
                REQUIRE(same(used.slip(), fresh.slip()));
                REQUIRE(same(used.slip_work(), fresh.slip_work()));
                mixed += found.stick_count > 0 && found.stick_count < n ? 1 : 0;
                // without tangents the step is the same
                if (who == 0 && setup.falls) {
                    const Step bare = task.run(rides[3].model, from, alone, fresh);
                    REQUIRE(same(ratios(bare), ratios(found)));
                    REQUIRE(same(ride.next, alone));
                    REQUIRE(detail::is_nan(bare.tangent.by_longitudinal.longitudinal));
                    REQUIRE(detail::is_nan(bare.tangent_by_load.longitudinal));
                }
                // under the load of the state the step is the same
                if (task.kind % 2 == 0) {
                    const Load held{from.normal_pressure, from.half_length, {}};
                    Step loaded = task.run(ride.model, from, alone, fresh, &held);
                    REQUIRE(detail::is_nan(found.tangent_by_half_length.longitudinal));
                    REQUIRE(detail::is_nan(loaded.tangent_by_half_length.longitudinal) ==
                            (task.kind < 4 || who == 3 || found.status != Status::ok));
                    loaded.tangent_by_half_length = found.tangent_by_half_length;
                    REQUIRE(same(loaded, found));
                    REQUIRE(same(ride.next, alone));
                    REQUIRE(same(used.slip(), fresh.slip()));
                }
                if (!draw.one_in(3)) ride.accept();  // otherwise the trial is rejected
            }
        }
        CHECK(mixed > 100);
    }
}

TEST_CASE("Long runs in which nothing changes do not depend on the workspace, and are cheap", "[friction]") {
    for (Setup setup : every_setup_in_time(10e-6)) {
        if (setup.falls && setup.distance == 0 && setup.integrator == Integrator::sdirk2) continue;  // does not settle
        INFO(words(setup));
        setup.mesh = cosine_mesh<double>(16);
        Ride ride(setup);
        for (int k = 0; k < 1000; ++k) ride.step(0.2, creepage(0.4, 20));
        State alone = ride.now;
        Draw draw(4);
        int settled = 0, cut_short = 0;
        for (int k = 0; k < 300; ++k) {
            // interrupted by another creepage, distance or shift, by the same motion as a shift, and by trials that are
            // thrown away
            const double ratio = k == 150 ? 0.15 : 0.4, dq = k % 100 < 80 ? 0.2 : 0.1;
            const Creepage held = creepage(ratio, 20);
            const Motion motion = k == 220   ? shift(0.3, 20)
                                  : k == 230 ? Motion::shift({dq * a * held.longitudinal, dq * a * held.lateral})
                                             : Motion(held);
            const Travel travel = Ride::travel(k == 220 ? 0 : dq);
            if (draw.one_in(6)) Task::any(draw, setup, a).run(ride.model, ride.now, ride.next, ride.own);
            Workspace fresh = ride.model.workspace();
            const Step found = ride.model.advance(ride.now, {travel, motion}, ride.next, ride.own);
            const Step expected = ride.model.advance(ride.now, {travel, motion}, alone, fresh);
            CAPTURE(k, found.rounds);
            REQUIRE(found.status == Status::ok);
            REQUIRE(same(found, expected));
            REQUIRE(same(ride.next, alone));
            REQUIRE(same(ride.own.slip(), fresh.slip()));
            REQUIRE(same(ride.own.slip_work(), fresh.slip_work()));
            const int stages = setup.integrator == Integrator::sdirk2 ? 2 : 1;
            settled += found.rounds <= stages ? 1 : 0;
            cut_short += ride.next.zones != ride.now.zones ? 1 : 0;
            ride.accept();
        }
        CAPTURE(settled, cut_short);
        CHECK((settled >= 80 || setup.directions == 2));
        CHECK((cut_short > 0 || setup.directions == 2));
    }
}

TEST_CASE("Contact may be lost and regained", "[friction]") {
    for (Setup setup : every_setup_in_time()) {
        for (const int n : {1, 3, 24}) {
            INFO(words(setup));
            CAPTURE(n);
            setup.mesh = uniform_mesh<double>(n);
            setup.strip = n == 24;
            Ride ride(setup);
            Load load{setup.pressure(), a, setup.pressure()};
            double largest = 0;
            for (int k = 0; k < 68; ++k) {
                const double part = std::max(0.0, 0.4 + std::sin(0.3 * k));  // lifts off at each trough
                const Eigen::ArrayXd x = setup.mesh.centres();
                load.normal_pressure = peak_pressure * (part - x.square()).max(0).sqrt();
                const double dq = k % 6 == 5 ? 0 : 0.15;
                const Step step = ride.step(dq, dq == 0 ? shift(0.6, 9.0 * k) : creepage(0.6, 9.0 * k), &load);
                CAPTURE(k, part, step.rounds);
                REQUIRE(step.status == Status::ok);
                CHECK(step.complementarity_residual < 1e-9);
                CHECK(step.slip_work >= 0);
                const Eigen::ArrayXd traction = ride.now.traction.rowwise().norm();
                CHECK((traction <= law.mu_0 * load.normal_pressure * (1 + 1e-12)).all());
                CHECK(matrix(step.tangent).allFinite());
                CHECK(vector(step.tangent_by_load).allFinite());
                if (setup.falls) CHECK((load.normal_pressure > 0 || ride.now.friction_coefficient == law.mu_0).all());
                if (part == 0) {
                    CHECK(vector(step.force).isZero(0));
                    CHECK(matrix(step.tangent).isZero(0));
                    CHECK(step.stick_count == 0);
                }
                largest = std::max(largest, traction.maxCoeff());
            }
            CHECK(largest > 0.1 * law.mu_0 * peak_pressure);
        }
    }
}

TEST_CASE(
    "Models of other equations or pressures have other fingerprints; the mesh follows the half-length within a step",
    "[friction]") {
    for (Setup setup : every_setup_in_time(1e-6)) {
        INFO(words(setup));
        setup.mesh = cosine_mesh<double>(8);
        Ride ride(setup);
        const Creepage creeps = creepage(0.5, 30);
        std::vector<Setup> others(4, setup);
        others[0].mesh = uniform_mesh<double>(8);
        others[1].half_width *= 1.1;
        others[2].scheme.alpha_L = 0;
        others[3].own_pressure = 1.1 * setup.pressure();
        for (const Setup& other : others) CHECK(make(other).fingerprint() != ride.model.fingerprint());
        Load load{setup.pressure(), a, setup.pressure()};
        for (const double way : {1.0, -1.0}) {
            load.half_length = a * (1 + way * 0.099);
            CHECK(ride.try_step(0.1, creeps, &load).status == Status::ok);
            CHECK(ride.next.half_length == load.half_length);
            const State kept = ride.next;
            for (const double change : {0.125, 0.11}) {
                load.half_length = a * (1 + way * change);
                CHECK(ride.try_step(change == 0.125 ? 0.125 : 0.1, creeps, &load).status == Status::needs_fixed_mesh);
            }
            load.half_length = a * (1 + way * 1e-9);
            CHECK(ride.try_step(0, shift(0.5), &load).status == Status::needs_fixed_mesh);
            CHECK(same(ride.next, kept));
        }
        load.normal_pressure[0] = -1;
        CHECK(refusal([&] { ride.model.at_rest(load); }) ==
              "FrictionModel: status of the load at rest = invalid_load must be ok: pressures of all elements, "
              "finite and not negative, on semi-axes that the mesh can follow");
    }
}

TEST_CASE("A system with a single half-length is reported as needs_fixed_mesh", "[friction]") {
    for (Setup setup : every_setup()) {
        setup.strip = true;
        INFO(words(setup));
        Ride ride(setup);
        const Creepage creeps = creepage(0.5, 30);
        const Load held{setup.pressure(), a, {}}, load{setup.pressure(), 1.001 * a, {}};
        const Step kept = ride.try_step(0.1, creeps, &held);
        CHECK(kept.status == Status::ok);
        CHECK(detail::is_nan(kept.tangent_by_half_length.longitudinal));
        CHECK(ride.try_step(0.1, creeps, &load).status == Status::needs_fixed_mesh);
        CHECK(ride.try_steady(creeps, &load).status == Status::needs_fixed_mesh);
        ride.now.half_length = load.half_length;
        CHECK(detail::is_nan(ride.model.elastic_energy(ride.now)));
        CHECK(ride.try_step(0.1, creeps).status == Status::needs_fixed_mesh);
        CHECK(ride.try_steady(creeps).status == Status::needs_fixed_mesh);
    }
}

TEST_CASE("A step that overflows leaves a copy of its initial state", "[friction][not_finite]") {
    for (const Setup& setup : every_setup_in_time()) {
        INFO(words(setup));
        Ride ride(setup);
        const State rest = ride.now;
        REQUIRE(ride.step(1, creepage(0.7, 20)).status == Status::ok);
        REQUIRE(ride.now.zones != rest.zones);
        const Step failed = ride.try_step(1e3, Creepage{1e308, 1e308});
        CHECK(failed.status == Status::not_finite);
        CHECK(detail::is_nan(failed.force.longitudinal));
        CHECK(same(ride.next, ride.now));
        CHECK(ride.own.slip().isZero(0));  // nothing slid
        // what follows in the same workspace is what follows in a new one
        State after = rest;
        Workspace fresh = ride.model.workspace();
        const Step alone = ride.model.advance(ride.now, {Ride::travel(0.1), creepage(-0.3)}, after, fresh);
        CHECK(alone.status == Status::ok);
        CHECK(same(ride.try_step(0.1, creepage(-0.3)), alone));
        // a traction that is no number
        for (const Eigen::Index i : {0, 7, 19}) {
            ride.now = rest;
            ride.now.traction(i, setup.directions == 1 ? 0 : i % 2) = nan;
            CHECK(ride.try_step(0.2, creepage(0.5)).status == Status::not_finite);
            CHECK_FALSE(detail::all_finite(ride.next.traction));
        }
    }
}

TEST_CASE("Laws, pressures and integrators out of range are refused by name", "[friction][not_finite]") {
    for (Setup setup : every_setup(1e-6)) {
        INFO(words(setup));
        setup.mesh = cosine_mesh<double>(8);
        const Setup good = setup;
        const auto refused = [&](const std::string& words) {
            CHECK(refusal([&] { make(setup); }) == "FrictionModel: " + words);
            if (setup.integrator == good.integrator) {
                CHECK(refusal([&] { make(setup, true); }) == "FrictionModel: " + words);
            }
            setup = good;
        };
        const std::string mu = setup.falls ? "friction coefficient at rest" : "friction_coefficient";
        const ArrayX<double> pressure = setup.pressure();
        for (const auto& [bad, text] : {std::pair(-0.1, "-0.1"), std::pair(-1e-300, "-1e-300"), std::pair(nan, "nan"),
                                        std::pair(infinite, "inf")}) {
            const std::string range = std::string(" = ") + text + " must be finite and not negative";
            if (setup.falls && bad == -1e-300) continue;  // rounding hides it in a law that falls from it
            setup.constant = setup.falling.mu_0 = bad;
            refused(mu + range);
            setup.own_pressure = pressure;
            (*setup.own_pressure)[3] = bad;
            refused("normal_pressure" + range);
            if (setup.distance == 0) continue;
            setup.distance = bad;
            refused("distance of the memory" + range);
            setup.least = bad;
            refused("least_velocity of the memory" + range);
        }
        setup.own_pressure = pressure.head(7);
        refused("length of normal_pressure = 7 must equal the number of elements");
        setup.own_pressure = 0 * pressure;
        refused("largest normal_pressure = 0 must be positive");
        setup.integrator = Integrator::matrix_exponential;
        refused("integrator = matrix_exponential must solve stages, as implicit_euler and sdirk2 do");
    }
}

TEST_CASE("A law that returns NaN leads to a status", "[friction][not_finite]") {
    for (const int directions : {1, 2}) {
        Setup setup{.directions = directions};
        setup.any = [](double v) { return v > 0.05 ? nan : 0.3; };
        Ride ride(setup);
        ride.now.friction_coefficient.setConstant(0.2);
        CHECK(ride.try_step(0.1, Creepage{0, 0}).status == Status::ok);
        const Step step = ride.try_step(0.1, Creepage{2e-2, 2e-2});
        CHECK(step.status == Status::not_finite);
        CHECK(detail::is_nan(step.force.longitudinal));
        CHECK(same(ride.next.traction, ride.now.traction));
        CHECK((ride.next.friction_coefficient == 0.2).all());
        CHECK(ride.try_steady({2e-2, 2e-2}).status == Status::not_finite);
    }
}

TEST_CASE("If no coefficient fits its slip, status and residual say so", "[friction]") {
    for (const int directions : {1, 2}) {
        Setup setup{.directions = directions, .integrator = Integrator::implicit_euler};
        setup.mesh = uniform_mesh<double>(1);
        // the element sticks at the coefficient of slip, and slips at the coefficient of rest
        setup.any = [](double v) { return v > 0 ? 0.3 : 0.1; };
        Ride ride(setup);
        int failed = 0;
        for (int k = 1; k <= 60; ++k) {
            const Step step = ride.try_step(0.1, Creepage{8e-4 * k, 6e-4 * k});
            if (step.status == Status::ok) continue;
            REQUIRE(step.status == Status::no_solution);
            CHECK(step.complementarity_residual > 0.05);
            CHECK(step.complementarity_residual < 0.21);
            CHECK(vector(step.force).allFinite());
            CHECK(matrix(step.tangent).hasNaN());
            ++failed;
        }
        CHECK(failed >= 5);
        CHECK(failed <= 55);
    }
}

}  // namespace
}  // namespace any_model
