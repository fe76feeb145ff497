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
            const RollingStep step{Travel::at_speed(speed), creepage(0.5, 37)};
            const Step refused = Run(steady).steady(step), given = Run(asked_for).steady(step);
            CHECK_FALSE(steady.converges());
            CHECK(refused.status == Status::assists_creepage);
            CHECK(std::isnan(refused.force.longitudinal));
            CHECK(std::isnan(refused.slip_work));
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
        Run run(steady);
        const Travel travel = Travel::at_speed(speed);
        REQUIRE(run.steady({travel, creepage(0.5, 37)}).status == Status::ok);
        const State now = run.now(), before = run.next();
        for (const Motion& motion : {Motion(creepage(0.5)), shift(0.5)}) {
            CHECK(run.advance({Ride::travel(motion.is_shift() ? 0 : 0.1), motion}).status == Status::invalid_step);
            CHECK(run.next().traction.isZero(0));
        }
        CHECK(same(run.next(), before));
        CHECK(std::isnan(steady.elastic_energy(now)));
        // under other pressures, but not on another half-length
        Load half{now.normal_pressure / 2, a, {}};
        const Step step = run.steady({travel, creepage(0.5, 37), half});
        CHECK(step.status == Status::ok);
        CHECK(ratios(step).norm() < vector(steady.force(now)).norm() / full_force);
        CHECK((run.now().normal_pressure == half.normal_pressure).all());
        half.half_length = 1.1 * a;
        CHECK(run.steady({travel, creepage(0.5, 37), half}).status == Status::needs_fixed_mesh);
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
                      "G is for steady friction alone");
    CHECK_THROWS_WITH(AdhesionModel<2>(setup.contact(), both, unchecked), ContainsSubstring("number of rows of G = 0"));
    CHECK_THROWS_WITH(FrequencySweep(along), ContainsSubstring("number of rows of G = 0"));
    CHECK_THROWS_WITH(both_directions<double>(along, across), ContainsSubstring("number of rows of G = 0"));
}

TEST_CASE("Models with the same G' share states, but no factors", "[friction]") {
    const Setup setup;
    const ElementSystem<double> own = setup.system(false);
    const auto model_of = [&](double factor) {
        const ElementSystem<double> system(factor * own.G(), own.G_prime(), own.weights());
        return FrictionModel(setup.contact(), system, unchecked, {setup.constant, setup.pressure()});
    };
    const FrictionModel soft = model_of(1.5), stiff = model_of(0.5);
    REQUIRE(soft.fingerprint() == stiff.fingerprint());
    const RollingStep rolling{Ride::travel(0.1), creepage(0.3)};
    Workspace used = soft.workspace(), fresh = soft.workspace();
    State next = soft.at_rest();
    const Step other = soft.advance(soft.at_rest(), rolling, next, used);
    const Step step = stiff.advance(soft.at_rest(), rolling, next, used);
    CHECK(same(step, stiff.advance(soft.at_rest(), rolling, next, fresh)));
    CHECK_FALSE(same(ratios(step), ratios(other)));
}

}  // namespace
}  // namespace any_model
