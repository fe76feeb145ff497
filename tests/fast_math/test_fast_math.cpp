// The library under -ffast-math, where compilers assume that every number is finite: no result that is NaN or infinite
// has status ok, and none is accepted as input. Here steady rolling and steps in the time domain of one direction.
#include <rollbem/adhesion/steady.hpp>
#include <rollbem/adhesion/transient.hpp>

#include "fast_math/fixture.hpp"

namespace {

using namespace fast_math_tests;
using fast_math_tests::finite, fast_math_tests::nan;  // not the functions of C

TEST_CASE_METHOD(Fixture, "Fast math: steady rolling reports what is not finite", "[fast_math]") {
    CHECK(solve_steady<double>(good.G_prime(), widths).status == Status::ok);
    for (Eigen::Index k = 0; k < n * n; ++k) {
        for (const double value : {nan, infinity, -infinity}) {
            MatrixX<double> spoilt = good.G_prime();
            spoilt(k) = value;
            CHECK(solve_steady<double>(spoilt, widths).status == Status::not_finite);
        }
    }
    ArrayX<double> spoilt = widths;
    spoilt[2] = nan;
    CHECK(solve_steady<double>(good.G_prime(), spoilt).status == Status::not_finite);
    CHECK(solve_steady<double>(MatrixX<double>::Zero(n, n), widths).status != Status::ok);
}

TEST_CASE_METHOD(Fixture, "Fast math: systems reject entries that are not finite", "[fast_math]") {
    for (const double value : {nan, infinity, -infinity}) {
        for (Eigen::Index k = 0; k < n * n; k += 7) {
            MatrixX<double> G = good.G(), G_prime = good.G_prime();
            G(k) = value;
            CHECK_THAT(refusal([&] { ElementSystem<double>(G, good.G_prime(), widths); }), ContainsSubstring(": G("));
            G_prime(k) = value;
            CHECK_THAT(refusal([&] { RollingSystem<double>(good.G(), G_prime, widths); }),
                       ContainsSubstring(": G_prime("));
        }
        ArrayX<double> spoilt = widths;
        spoilt[2] = value;
        CHECK_THAT(refusal([&] { RollingSystem<double>(good.G(), good.G_prime(), spoilt); }),
                   ContainsSubstring("must be finite"));
    }
}

TEST_CASE_METHOD(Fixture, "Fast math: steps in full adhesion report what is not finite", "[fast_math]") {
    using Model = AdhesionModel<>;
    const Contact<double> infinite = Contact<double>::dimensionless(infinity, 0.25);
    CHECK_THAT(refusal([&] { Model(infinite, good, unchecked); }), ContainsSubstring("half_width = inf must be"));
    const Model model(contact, good, unchecked);
    const Model::State now = model.at_rest();
    Model::State next = now;
    Model::Workspace workspace = model.workspace();
    CHECK(model.advance(now, 0.1, 1e-3, next, workspace).status == StepStatus::ok);
    for (const double value : {nan, infinity, -infinity}) {
        CHECK(model.advance(now, value, 1e-3, next, workspace).status == StepStatus::invalid_step);
        CHECK(model.advance(now, 0.1, value, next, workspace).status == StepStatus::not_finite);
        CHECK(model.advance(now, 0.1, RigidMotion<double>::linear(1, value), next, workspace).status ==
              StepStatus::not_finite);
        CHECK_THAT(refusal([&] { model.steady(value); }), ContainsSubstring("must be finite"));
        Model::State spoilt = now;
        spoilt.traction[3] = value;
        for (const double distance : {0.0, 0.1}) {  // of the step before, on which the way to the result depends
            spoilt.distance = distance;
            CHECK(model.advance(spoilt, 0.1, 1e-3, next, workspace).status == StepStatus::not_finite);
        }
        CHECK(model.steady(now, value, next, workspace).status == StepStatus::not_finite);
    }
    const Contact<double> stiff({.half_length = 1, .half_width = 10, .shear_modulus = 1e300, .poisson_ratio = 0.25});
    const Model stiff_model(stiff, good, unchecked);
    CHECK(stiff_model.advance(stiff_model.at_rest(), 0.1, 1e10, next, workspace).status == StepStatus::not_finite);

    // a contact that breathes, and one that cannot
    const Model breathing(contact, rolling_system(mesh, scheme, PlaneKernel<double>::longitudinal(contact)), unchecked);
    const Model::State start = breathing.at_rest();
    CHECK(breathing.advance(start, 0.1, 1e-3, 1.05, next, workspace).status == StepStatus::ok);
    CHECK(model.advance(now, 0.1, 1e-3, 1.05, next, workspace).status == StepStatus::needs_fixed_mesh);
    for (const double value : {nan, infinity, -infinity, 0.0, -1.0}) {
        CHECK(breathing.advance(start, 0.1, 1e-3, value, next, workspace).status == StepStatus::invalid_load);
        CHECK(model.advance(now, 0.1, 1e-3, value, next, workspace).status == StepStatus::invalid_load);
        Model::State spoilt = start;
        spoilt.half_length = value;
        CHECK(breathing.advance(spoilt, 0.1, 1e-3, next, workspace).status == StepStatus::wrong_state);
        CHECK(breathing.advance(spoilt, 0.1, 1e-3, 1.05, next, workspace).status == StepStatus::wrong_state);
    }
    for (const double value : {nan, infinity}) {
        Model::State spoilt = start;
        spoilt.traction[3] = value;
        CHECK(breathing.advance(spoilt, 0.1, 1e-3, 1.05, next, workspace).status == StepStatus::not_finite);
    }
}

TEST_CASE_METHOD(Fixture, "Fast math: friction reports what is not finite", "[fast_math]") {
    using Model = FrictionModel<>;
    for (const double value : {nan, infinity, -infinity}) {
        Friction<> law = friction;
        law.law.coefficient = value;
        CHECK_THAT(refusal([&] { Model(contact, good, unchecked, law); }),
                   ContainsSubstring("friction_coefficient = "));
        law = friction;
        law.normal_pressure[2] = value;
        CHECK_THAT(refusal([&] { Model(contact, good, unchecked, law); }), ContainsSubstring("normal_pressure = "));
    }
    const Model model(contact, good, unchecked, friction);
    FrictionWorkspace<> workspace = model.workspace();
    const FrictionModel<> steady(contact, {{}, good.G_prime(), widths}, friction);
    const Model::State now = model.at_rest(), still = steady.at_rest();
    Model::State next = now, rolling = still;
    CHECK(model.advance(now, 0.1, 0.5, next, workspace).status == StepStatus::ok);
    CHECK(steady.steady(still, 0.5, rolling, workspace).status == StepStatus::ok);
    for (const double value : {nan, infinity, -infinity}) {
        CHECK(model.advance(now, value, 0.5, next, workspace).status == StepStatus::invalid_step);
        CHECK(model.advance(now, 0.1, value, next, workspace).status == StepStatus::not_finite);
        CHECK(model.shift(now, value, next, workspace).status == StepStatus::not_finite);
        CHECK(model.steady(now, value, next, workspace).status == StepStatus::not_finite);
        CHECK(steady.steady(still, value, rolling, workspace).status == StepStatus::not_finite);
        CHECK(!finite(steady.steady(still, value, rolling, workspace).force));
    }
    const NormalLoad<double> load{friction.normal_pressure, contact.half_length(), {}};
    CHECK(model.advance(now, 0.1, 0.5, load, next, workspace).status == StepStatus::ok);
    for (const double value : {nan, infinity, -infinity, -1.0}) {
        NormalLoad<double> pressed = load, long_one = load;
        pressed.normal_pressure[2] = value;
        long_one.half_length = value;
        CHECK(model.advance(now, 0.1, 0.5, pressed, next, workspace).status == StepStatus::invalid_load);
        CHECK(model.advance(now, 0.1, 0.5, long_one, next, workspace).status == StepStatus::invalid_load);
    }
    const FrictionStep<> far = model.advance(now, 1e3, 1e308, next, workspace);
    CHECK((far.status != StepStatus::ok || finite(far.force)));
}

}  // namespace
