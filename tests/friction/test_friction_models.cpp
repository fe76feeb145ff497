// rollbem/friction/model.hpp: models with and without G, for every law and both numbers of directions.
#include <cmath>

#include <rollbem/adhesion/frequency.hpp>
#include <rollbem/adhesion/stability.hpp>
#include <rollbem/adhesion/transient.hpp>

#include "friction/any_model.hpp"
#include "support/catch.hpp"

namespace any_model {
namespace {

TEST_CASE("Steady forces of a scheme that does not converge are not given", "[friction]") {
    for (Setup setup : every_setup()) {
        for (const double alpha : {-0.3, 1.3}) {
            INFO(words(setup));
            CAPTURE(alpha);
            setup.mesh = cosine_mesh<double>(10);
            setup.scheme = {.alpha_L = alpha, .alpha_T = alpha};
            const FrictionModel asked_for = make(setup, true);
            setup.checks = StabilityVerdict();
            const FrictionModel steady = make(setup, true);
            State to = steady.at_rest();
            Workspace workspace = steady.workspace();
            const Step refused =
                steady.steady(steady.at_rest(), {Travel::at_speed(speed), creepage(0.5, 37)}, to, workspace);
            CHECK_FALSE(steady.converges());
            CHECK(refused.status == Status::assists_creepage);
            CHECK(std::isnan(refused.force.longitudinal));
            CHECK(std::isnan(refused.slip_work));
            const Step given =
                asked_for.steady(steady.at_rest(), {Travel::at_speed(speed), creepage(0.5, 37)}, to, workspace);
            CHECK(asked_for.converges());
            CHECK(given.status != Status::assists_creepage);
            CHECK(given.stick_count == refused.stick_count);
            CHECK(same(given.complementarity_residual, refused.complementarity_residual));
            setup.checks = unchecked;
        }
    }
    CHECK(make({.checks = StabilityVerdict()}, true).converges());
}

TEST_CASE("A model without G refuses to roll in time", "[friction]") {
    for (const Setup& setup : every_setup()) {
        INFO(words(setup));
        const FrictionModel steady = make(setup, true);
        Workspace workspace = steady.workspace();
        State now = steady.at_rest(), next = now;
        REQUIRE(steady.steady(now, {Travel::at_speed(speed), creepage(0.5, 37)}, next, workspace).status == Status::ok);
        now = next;
        for (const Motion& motion : {Motion(creepage(0.5)), shift(0.5)}) {
            const Travel travel = Ride::travel(motion.is_shift() ? 0 : 0.1);
            CHECK(steady.advance(now, {travel, motion}, next, workspace).status == Status::invalid_step);
        }
        CHECK(same(next, now));
        CHECK(std::isnan(steady.elastic_energy(now)));
        // under other pressures, but not on another half-length
        Load half{now.normal_pressure / 2, a, {}};
        Step step = steady.steady(now, {Travel::at_speed(speed), creepage(0.5, 37), half}, next, workspace);
        CHECK(step.status == Status::ok);
        CHECK(ratios(step).norm() < vector(steady.force(now)).norm() / full_force);
        CHECK((next.normal_pressure == half.normal_pressure).all());
        half.half_length = 1.1 * a;
        step = steady.steady(now, {Travel::at_speed(speed), creepage(0.5, 37), half}, next, workspace);
        CHECK(step.status == Status::needs_fixed_mesh);
    }
}

TEST_CASE("What needs G refuses a system without it", "[friction]") {
    const Setup setup;
    const ElementSystem<double> along = setup.system(false, true), across = setup.system(true, true);
    const ElementSystem both(along, across);
    using Catch::Matchers::ContainsSubstring;
    CHECK_THROWS_WITH(judge_stability(along), ContainsSubstring("number of rows of G = 0"));
    CHECK_THROWS_WITH(judge_stability(both), ContainsSubstring("number of rows of G = 0"));
    CHECK_THROWS_WITH(AdhesionModel<>(setup.contact(), along, unchecked),
                      "AdhesionModel: number of rows of G = 0 must be the number of rows of G_prime: a system without "
                      "G is for steady "
                      "friction alone");
    CHECK_THROWS_WITH(AdhesionModel<2>(setup.contact(), both, unchecked), ContainsSubstring("number of rows of G = 0"));
    CHECK_THROWS_WITH(FrequencySweep(along), ContainsSubstring("number of rows of G = 0"));
    CHECK_THROWS_WITH(both_directions<double>(along, across), ContainsSubstring("number of rows of G = 0"));
}

TEST_CASE("Models with the same G' share states, but no factors", "[friction]") {
    for (Setup setup : every_setup()) {
        INFO(words(setup));
        setup.distance = 0;
        setup.stiffer = 1.5;
        const FrictionModel soft = make(setup);
        setup.stiffer = 0.5;
        const FrictionModel stiff = make(setup);
        REQUIRE(soft.fingerprint() == stiff.fingerprint());
        Workspace used = soft.workspace(), fresh = soft.workspace();
        State one = soft.at_rest(), other = one, again = one;
        const Travel travel = Ride::travel(0.1);
        const Creepage value = creepage(0.3, 37);
        REQUIRE(soft.advance(soft.at_rest(), {travel, value}, one, used).status == Status::ok);
        const Step step = stiff.advance(one, {travel, value}, other, used);
        const Step expected = stiff.advance(one, {travel, value}, again, fresh);
        CHECK(same(ratios(step), ratios(expected)));
        CHECK_FALSE(same(ratios(step), ratios(soft.advance(one, {travel, value}, again, fresh))));
    }
}

}  // namespace
}  // namespace any_model
