// The rest of the library under -ffast-math, which takes long to compile: frequency response and stability, friction in
// two directions, the stick border, extrapolation, and every argument by name.
#include <functional>
#include <string>
#include <vector>

#include <rollbem/accuracy/recommendation.hpp>
#include <rollbem/adhesion/frequency.hpp>
#include <rollbem/adhesion/stability_count.hpp>
#include <rollbem/closed_form/friction.hpp>
#include <rollbem/spectral/polynomial.hpp>
#include <rollbem/studies/stick_border.hpp>

#include "fast_math/fixture.hpp"

namespace {

using namespace fast_math_tests;
using namespace rollbem::studies;
using fast_math_tests::finite, fast_math_tests::nan;  // not the functions of C

TEST_CASE_METHOD(Fixture, "Fast math: frequency response and stability report what is not finite", "[fast_math]") {
    const FrequencySweep<double> sweep(good);
    REQUIRE(sweep.reduced());
    CHECK(sweep(1).status == Status::ok);
    CHECK(solve_response(good, {0, 1}).status == Status::ok);
    CHECK(count_unstable(good).status == Status::ok);
    CHECK_THAT(refusal([&] { sweep(nan); }), ContainsSubstring("omega a/V = nan must be finite"));
    CHECK_THAT(refusal([&] { sweep.at({0, infinity}); }), ContainsSubstring("Im(s) = inf must be finite"));
    CHECK_THAT(refusal([&] { solve_response(good, {0, nan}); }), ContainsSubstring("must be finite"));
    // finite input with a result that overflows
    const ElementSystem<double> huge(1e-3 * good.G(), 1e-3 * good.G_prime(), 1e308 * widths);
    CHECK(solve_response(huge, {0, 1}).status == Status::not_finite);
    CHECK(FrequencySweep<double>(huge)(1).status == Status::not_finite);
}

TEST_CASE_METHOD(Fixture, "Fast math: friction in two directions reports what is not finite", "[fast_math]") {
    using Model = FrictionModel<ConstantFriction<>, 2>;
    using Vector = Creepage<double>;
    using Motion = RigidMotion<Vector>;
    const ElementSystem<double> lateral = rolling_system(mesh, scheme, StripKernel<double>::lateral(contact));
    for (const double value : {nan, infinity, -infinity}) {
        Friction<> law = friction;
        law.law.coefficient = value;
        CHECK_THAT(refusal([&] {
                       Model(contact, {good, lateral}, unchecked, law);
                   }),
                   ContainsSubstring("friction_coefficient = "));
        law = friction;
        law.normal_pressure[2] = value;
        CHECK_THAT(refusal([&] {
                       Model(contact, {good, lateral}, unchecked, law);
                   }),
                   ContainsSubstring("normal_pressure = "));
        MatrixX<double> spoilt = lateral.G_prime();
        spoilt(3) = value;
        CHECK_THAT(refusal([&] {
                       FrictionModel<ConstantFriction<>, 2>(
                           contact, {{{}, good.G_prime(), widths}, {{}, spoilt, widths}}, friction);
                   }),
                   ContainsSubstring("G_prime(3, 0) = "));
    }
    const FrictionModel<ConstantFriction<>, 2> steady(
        contact, {{{}, good.G_prime(), widths}, {{}, lateral.G_prime(), widths}}, friction);
    const NormalLoad<double> load{friction.normal_pressure, contact.half_length(), {}};
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
        const Model model(contact, {good, lateral}, unchecked, friction, integrator);
        FrictionWorkspace<2> workspace = model.workspace();
        const Model::State now = model.at_rest(), still = steady.at_rest();
        Model::State next = now, rolling = still;
        const Vector creepage{0.5, 0.3};
        CHECK(model.advance(now, 0.1, creepage, next, workspace).status == StepStatus::ok);
        CHECK(model.advance(now, 0.1, creepage, load, next, workspace).status == StepStatus::ok);
        CHECK(steady.steady(still, creepage, rolling, workspace).status == StepStatus::ok);
        for (const double value : {nan, infinity, -infinity}) {
            CHECK(model.advance(now, value, creepage, next, workspace).status == StepStatus::invalid_step);
            for (const Vector& spoilt : {Vector{value, 0.3}, Vector{0.5, value}}) {
                CHECK(model.advance(now, 0.1, spoilt, next, workspace).status == StepStatus::not_finite);
                CHECK(model.advance(now, 0.1, Motion::linear(creepage, spoilt), next, workspace).status ==
                      StepStatus::not_finite);
                CHECK(model.shift(now, spoilt, next, workspace).status == StepStatus::not_finite);
                CHECK(model.steady(now, spoilt, next, workspace).status == StepStatus::not_finite);
                CHECK(steady.steady(still, spoilt, rolling, workspace).status == StepStatus::not_finite);
                CHECK(!finite(steady.steady(still, spoilt, rolling, workspace).force.lateral));
            }
            for (Eigen::Index k = 0; k < 2 * n; ++k) {
                Model::State spoilt = now;
                spoilt.traction(k) = value;
                const FrictionStep<2> step = model.advance(spoilt, 0.1, creepage, next, workspace);
                CHECK(step.status == StepStatus::not_finite);
                CHECK(!finite(step.force.longitudinal));
                CHECK(!finite(model.elastic_energy(spoilt)));
            }
        }
        for (const double value : {nan, infinity, -infinity, -1.0}) {
            NormalLoad<double> pressed = load, long_one = load;
            pressed.normal_pressure[2] = value;
            long_one.half_length = value;
            CHECK(model.advance(now, 0.1, creepage, pressed, next, workspace).status == StepStatus::invalid_load);
            CHECK(model.advance(now, 0.1, creepage, long_one, next, workspace).status == StepStatus::invalid_load);
            Model::State spoilt = now;
            spoilt.normal_pressure[2] = value;
            CHECK(model.advance(spoilt, 0.1, creepage, next, workspace).status == StepStatus::invalid_load);
            spoilt = now;
            spoilt.half_length = value;
            CHECK(model.advance(spoilt, 0.1, creepage, next, workspace).status == StepStatus::invalid_load);
        }
        // tangents that were not requested
        const FrictionStep<2> step = model.advance(now, 0.1, creepage, load, next, workspace);
        CHECK(!finite(step.tangent_by_load.longitudinal));
        CHECK(!finite(step.tangent_by_half_length.lateral));
        const FrictionStep<2> far = model.advance(now, 1e3, Vector{1e308, 1e308}, next, workspace);
        CHECK((far.status != StepStatus::ok || (finite(far.force.longitudinal) && finite(far.force.lateral))));
    }
}

TEST_CASE("Fast math: the stick border reports what is not finite", "[fast_math]") {
    for (const double value : {nan, infinity, -infinity}) {
        CHECK(solve_stick_border(contact, kernel, 0.3, HertzPressure<double>{}, value).status ==
              StepStatus::not_finite);
    }
}

TEST_CASE("Fast math: arguments that are not finite are rejected by name", "[fast_math]") {
    const auto refuses = [](const std::string& quantity, const std::function<void(double)>& call,
                            const std::vector<double>& values = {nan, infinity, -infinity}) {
        for (const double value : values) CHECK_THAT(refusal([&] { call(value); }), ContainsSubstring(quantity));
    };
    const std::vector<double> no_numbers{nan, -infinity};
    refuses("half_length = ", [](double x) { Contact<double>({x, 1, 1, 0.25}); });
    refuses(
        "half_width = ",
        [](double x) {
            Contact<double>({1, x, 1, 0.25});
        },
        no_numbers);
    refuses("shear_modulus = ", [](double x) { Contact<double>({1, 1, x, 0.25}); });
    refuses("poisson_ratio = ", [](double x) { Contact<double>({1, 1, 1, x}); });
    refuses(
        "half_width = ", [](double x) { StripKernel<double>(x, 1, 0); }, no_numbers);
    refuses("c1 = ", [](double x) { StripKernel<double>(1, x, 0); });
    refuses("c2 = ", [](double x) { PlaneKernel<double>(1, 1, x); });
    refuses("size_ratio = ", [](double x) { geometric_mesh(4, x); });
    refuses("epsilon = ", [](double x) { knothe_mesh(4, x); });
    refuses("edge = ", [](double x) { mesh_from_edges(Eigen::Array4d(-1, 0.5, x, 1)); });
    refuses("first edge = ", [](double x) { mesh_from_edges(Eigen::Array4d(x, 0, 0.5, 1)); });
    refuses("last edge = ", [](double x) { mesh_from_edges(Eigen::Array4d(-1, 0, 0.5, x)); });
    refuses("element width = ", [](double x) {
        Mesh<double>({Eigen::Array2d(0.5, x), Eigen::Array3d(0, 0.5, 2), Eigen::Array3d(2, 1.5, 0)});
    });
    refuses("of an edge = ", [](double x) {
        Mesh<double>({Eigen::Array2d(0.5, 1.5), Eigen::Array3d(0, x, 2), Eigen::Array3d(2, 1.5, 0)});
    });
    refuses("alpha_L = ", [](double x) { check_scheme(Collocation{.alpha_L = x}, uniform_mesh(4)); });
    refuses("alpha_T = ", [](double x) { check_scheme(Galerkin{.alpha_T = x}, uniform_mesh(4)); });
    refuses("lambda = ", [](double x) { check_scheme(Collocation{.lambda = x}, uniform_mesh(4)); });
    refuses("x/a = ", [](double x) { PressureTable<double>(Eigen::Array3d(-1, x, 1), Eigen::Array3d(1, 1, 1)); });
    refuses("pressure = ", [](double x) { PressureTable<double>(Eigen::Array3d(-1, 0, 1), Eigen::Array3d(1, x, 1)); });
    const ElasticBody<double> steel{2e11, 0.28};
    refuses("load_per_width = ", [&](double x) { HertzLine<double>({x, 0.5, steel, steel}); });
    refuses("young_modulus = ", [&](double x) { HertzLine<double>({1, 0.5, steel, {x, 0.28}}); });
    refuses("poisson_ratio = ", [&](double x) { HertzLine<double>({1, 0.5, {2e11, x}, steel}); });
    const Contact<double> wide = Contact<double>::dimensionless(100, 0.25);
    const PlaneKernel<double> plane = PlaneKernel<double>::longitudinal(wide);
    refuses("friction_coefficient = ",
            [&](double x) { solve_stick_border(wide, plane, x, HertzPressure<double>{}, 0.1); });
    refuses("mu p_n / G = ", [&](double x) { solve_stick_border(wide, plane, 0.3, HertzPressure<double>{x}, 0.1); });
    refuses("tolerance = ", [](double x) { recommended_scheme(x, Purpose::steady); });
    refuses("tolerance = ", [](double x) { recommended_scheme(x, Purpose::friction); });
    refuses("order = ", [](double x) { richardson(1.0, 2.0, x); });
    refuses("band = ", [](double x) { extrapolate([](std::ptrdiff_t) { return 1.0; }, 1, 2, x); });
    refuses("Re s = ", [](double x) { polynomial_c11<double>({x, 1}, 0.25, 10, 20); });
    refuses("|s| = ", [](double x) { polynomial_c11<double>({0, x}, 0.25, 10); });
    refuses("aspect = ", [](double x) { polynomial_c11<double>({0, 1}, 0.25, x, 20); });
    refuses("creepage_ratio = ", [](double x) { carter_force_ratio(x); }, {nan});
    refuses("x/a = ", [](double x) { carter_traction(x, 0.25); });
}

TEST_CASE("Fast math: extrapolation reports what is not finite", "[fast_math]") {
    CHECK(extrapolate([](std::ptrdiff_t k) { return 1 + 1 / static_cast<double>(k * k); }, 1, 2, 0.5).status ==
          Status::ok);
    for (const std::ptrdiff_t at : {4, 8, 16}) {
        for (const double value : {nan, infinity}) {
            const auto solve = [&](std::ptrdiff_t k) { return k == at ? value : 1.0; };
            CHECK(extrapolate(solve, 4, 2).status == Status::not_finite);
        }
    }
}

}  // namespace
