// rollbem/rollbem.hpp under -ffast-math, where compilers assume that every number is finite: no result that is NaN or
// infinite has status ok, and none is accepted as input.
#include <complex>
#include <cstdint>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <rollbem/accuracy/recommendation.hpp>
#include <rollbem/adhesion/frequency.hpp>
#include <rollbem/adhesion/stability_count.hpp>
#include <rollbem/adhesion/steady.hpp>
#include <rollbem/adhesion/transient.hpp>
#include <rollbem/closed_form/friction.hpp>
#include <rollbem/friction/friction.hpp>
#include <rollbem/spectral/polynomial.hpp>

#include "support/catch.hpp"
#include "support/refusal.hpp"

#ifndef __FAST_MATH__
#error "compile this file with -ffast-math"
#endif

namespace {

using namespace rollbem;
using Catch::Matchers::ContainsSubstring;

// numbers that the compiler cannot reason about
double from_bits(std::uint64_t number) {
    const volatile std::uint64_t hidden = number;
    const std::uint64_t bits = hidden;
    double value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}
const double nan = from_bits(0x7ff8'0000'0000'0000U), infinity = from_bits(0x7ff0'0000'0000'0000U);

bool finite(double value) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return (bits >> 52 & 0x7ffU) != 0x7ffU;
}

const Contact<double> contact = Contact<double>::dimensionless(10, 0.25);
const StripKernel<double> kernel = StripKernel<double>::longitudinal(contact);
const Collocation scheme{.alpha_L = 0.5, .alpha_T = 0.5};
constexpr Eigen::Index n = 6;

struct Fixture {
    Mesh<double> mesh = uniform_mesh(n);
    ArrayX<double> widths = mesh.widths();
    ElementSystem<double> good = rolling_system(mesh, scheme, kernel);
    Friction<> friction{0.3, ArrayX<double>::Ones(n)};
};

TEST_CASE_METHOD(Fixture, "Fast math: steady rolling reports what is not finite", "[fast_math]") {
    CHECK(solve_steady(contact, mesh, scheme, 1e-3).status == Status::ok);
    for (const double creepage : {nan, infinity, -infinity}) {
        CHECK(solve_steady(contact, mesh, scheme, creepage).status == Status::not_finite);
    }
    const Contact<double> stiff({.half_length = 1, .half_width = 10, .shear_modulus = 1e300, .poisson_ratio = 0.25});
    CHECK(solve_steady(stiff, mesh, scheme, 1e10).status == Status::not_finite);
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

TEST_CASE_METHOD(Fixture, "Fast math: frequency response and stability report what is not finite", "[fast_math]") {
    const FrequencySweep<double> sweep(good);
    REQUIRE(sweep.reduced());
    CHECK(sweep(1).status == Status::ok);
    CHECK(solve_harmonic(good, 1).status == Status::ok);
    CHECK(count_unstable(good).status == Status::ok);
    CHECK_THAT(refusal([&] { sweep(nan); }), ContainsSubstring("omega a/V = nan must be finite"));
    CHECK_THAT(refusal([&] { sweep.at({0, infinity}); }), ContainsSubstring("Im(s) = inf must be finite"));
    CHECK_THAT(refusal([&] { solve_harmonic(good, nan); }), ContainsSubstring("must be finite"));
    // finite input with a result that overflows
    const ElementSystem<double> huge(1e-3 * good.G(), 1e-3 * good.G_prime(), 1e308 * widths);
    CHECK(solve_harmonic(huge, 1).status == Status::not_finite);
    CHECK(FrequencySweep<double>(huge)(1).status == Status::not_finite);
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
    const SteadyFrictionModel<> steady(contact, good.G_prime(), widths, friction);
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
        CHECK(!finite(steady.steady(still, value, rolling, workspace).force_per_width));
        CHECK(solve_stick_border(contact, kernel, 0.3, HertzPressure<double>{}, value).status ==
              StepStatus::not_finite);
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
    CHECK((far.status != StepStatus::ok || finite(far.force_per_width)));
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
                       SteadyFrictionModel<ConstantFriction<>, 2>(contact, good.G_prime(), spoilt, widths, friction);
                   }),
                   ContainsSubstring("G_prime_yy(3, 0) = "));
    }
    const SteadyFrictionModel<ConstantFriction<>, 2> steady(contact, good.G_prime(), lateral.G_prime(), widths,
                                                            friction);
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
                CHECK(!finite(steady.steady(still, spoilt, rolling, workspace).force_per_width.lateral));
            }
            for (Eigen::Index k = 0; k < 2 * n; ++k) {
                Model::State spoilt = now;
                spoilt.traction(k) = value;
                const FrictionStep<2> step = model.advance(spoilt, 0.1, creepage, next, workspace);
                CHECK(step.status == StepStatus::not_finite);
                CHECK(!finite(step.force_per_width.longitudinal));
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
        CHECK((far.status != StepStatus::ok ||
               (finite(far.force_per_width.longitudinal) && finite(far.force_per_width.lateral))));
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
