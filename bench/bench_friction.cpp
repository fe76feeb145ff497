// Friction: steps with unchanged and with changing zones, points of a creep curve from scratch, from the previous point
// and by the exact border. The units of comparison are a matrix-vector product and a solution by LU.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/LU>
#include <benchmark/benchmark.h>

#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/closed_form/carter.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/normal/load.hpp>
#include <rollbem/steady/steady.hpp>

#include "studies/stick_border.hpp"

namespace {

using namespace rollbem;
using namespace rollbem::studies;

constexpr double poisson_ratio = 0.25;
constexpr double peak = 1e-3;  // mu p0 / G

double creepage_size(double ratio) { return 2 * (1 - poisson_ratio) * peak * ratio; }
Creepage creepage(double ratio) { return {creepage_size(ratio)}; }
constexpr double aspect = 1000;
double force_ratio(const FrictionStep& step) {
    return -step.force.longitudinal / (2 * aspect * peak * std::numbers::pi / 2);
}

/// The largest error of steady rolling over creepage ratios, which place the border of stick all over the mesh.
double largest_error(const FrictionModel& model) {
    auto workspace = model.workspace();
    auto now = model.at_rest(), next = now;
    double largest = 0;
    for (int k = 0; k < 20; ++k) {
        const double ratio = 0.05 + 0.9 * k / 19;
        const FrictionStep step = model.steady(now, {.motion = creepage(ratio)}, next, workspace);
        largest = std::max(largest, std::abs(force_ratio(step) / carter_force_ratio(ratio) - 1));
        std::swap(now, next);
    }
    return largest;
}

struct Scene {
    explicit Scene(Eigen::Index n) : mesh(cosine_mesh<double>(n)), friction{1, peak * mean_hertz_pressure(mesh)} {}

    Contact contact = Contact::dimensionless(aspect, poisson_ratio);
    StripKernel<double> kernel = StripKernel<double>::longitudinal(contact);
    StripKernel<double> lateral = StripKernel<double>::lateral(contact);
    Collocation scheme{.alpha_L = 0.5, .alpha_T = 0.5};
    FrictionModel model(Integrator integrator) const {
        return {contact, rolling_system(mesh, scheme, kernel), unchecked, friction, integrator};
    }
    FrictionModel steady_model() const { return {contact, steady_system(mesh, scheme, kernel), friction}; }

    Mesh<double> mesh;
    Friction friction;
};

/// advance(now, next, workspace) from rest, `before` times and then in every iteration. Returns the last step; counts
/// the rounds of a step.
template <class Model, class Advance>
auto roll(benchmark::State& state, const Model& model, int before, const Advance& advance) {
    auto workspace = model.workspace();
    auto now = model.at_rest(), next = now;
    for (int i = 0; i < before; ++i) {
        advance(now, next, workspace);
        std::swap(now, next);
    }
    typename Model::Step step;
    double rounds = 0;
    for (auto _ : state) {
        step = advance(now, next, workspace);
        rounds += step.rounds;
        std::swap(now, next);
        benchmark::DoNotOptimize(step);
    }
    if (step.status != Status::ok) state.SkipWithError(name(step.status));
    state.counters["n"] = static_cast<double>(state.range(0));
    state.counters["rounds"] = rounds / static_cast<double>(state.iterations());
    return step;
}

/// One point of a creep curve from scratch, without assembly.
template <class Model, class Creepage>
auto solve_afresh(benchmark::State& state, const Model& model, const Creepage& creepage) {
    const auto rest = model.at_rest();
    const auto fresh = model.workspace();
    return roll(state, model, 0, [&](const auto&, auto& next, auto& workspace) {
        workspace = fresh;  // without factors
        return model.steady(rest, {.motion = creepage}, next, workspace);
    });
}

void BM_Gemv(benchmark::State& state) {
    const MatrixX<double> matrix = MatrixX<double>::Random(state.range(0), state.range(0));
    const VectorX<double> vector = VectorX<double>::Random(state.range(0));
    VectorX<double> product(state.range(0));
    for (auto _ : state) {
        product.noalias() = matrix * vector;
        benchmark::DoNotOptimize(product.data());
        benchmark::ClobberMemory();
    }
    state.counters["n"] = static_cast<double>(state.range(0));
}
BENCHMARK(BM_Gemv)->Arg(20)->Arg(40)->Arg(80)->Arg(160);

void BM_LuSolve(benchmark::State& state) {
    const Scene scene(state.range(0));
    const MatrixX<double> G_prime = assemble_G_prime(scene.mesh, scene.scheme, scene.kernel);
    const VectorX<double> right = VectorX<double>::Ones(state.range(0));
    Eigen::PartialPivLU<MatrixX<double>> lu(state.range(0));
    VectorX<double> solution(state.range(0));
    for (auto _ : state) {
        lu.compute(G_prime);
        solution = lu.solve(right);
        benchmark::DoNotOptimize(solution.data());
        benchmark::ClobberMemory();
    }
    state.counters["n"] = static_cast<double>(state.range(0));
}
BENCHMARK(BM_LuSolve)->Arg(20)->Arg(30)->Arg(40)->Arg(80)->Arg(160);

// One point of the creep curve by the exact border, all costs included. Argument: 100 times the creepage ratio.
template <class Kernel>
void exact_border(benchmark::State& state) {
    const Contact contact = Contact::dimensionless(aspect, poisson_ratio);
    const Kernel kernel = Kernel::longitudinal(contact);
    const HertzLine::Pressure pressure{peak};
    const double ratio = static_cast<double>(state.range(0)) / 100;
    StickBorderSolution<double> solution;
    for (auto _ : state) {
        solution = solve_stick_border(contact, kernel, 1.0, pressure, creepage_size(ratio));
        benchmark::ClobberMemory();
    }
    const double force = solution.force_per_width;
    state.counters["relative_error"] = -force / (peak * std::numbers::pi / 2) / carter_force_ratio(ratio) - 1;
}
void BM_StickBorder(benchmark::State& state) { exact_border<PlaneKernel<double>>(state); }
BENCHMARK(BM_StickBorder)->Arg(1)->Arg(40)->Arg(50)->Arg(99);
// relative_error contains the difference between strip and plane
void BM_StickBorderStrip(benchmark::State& state) { exact_border<StripKernel<double>>(state); }
BENCHMARK(BM_StickBorderStrip)->Arg(40);

// Steps at constant creepage in the steady state, where no element changes its zone. Implicit Euler solves once per
// step for stick and slip, sdirk2 twice.
void steps_unchanged(benchmark::State& state, Integrator integrator) {
    const FrictionModel model = Scene(state.range(0)).model(integrator);
    roll(state, model, 800, [&](const auto& now, auto& next, auto& workspace) {
        return model.advance(now, {0.05, creepage(0.5)}, next, workspace);
    });
    state.counters["relative_error"] = largest_error(model);
}
void BM_FrictionStep(benchmark::State& state) { steps_unchanged(state, Integrator::implicit_euler); }
BENCHMARK(BM_FrictionStep)->Arg(20)->Arg(40)->Arg(80)->Arg(160);
void BM_FrictionStepSdirk2(benchmark::State& state) { steps_unchanged(state, Integrator::sdirk2); }
BENCHMARK(BM_FrictionStepSdirk2)->Arg(20)->Arg(40)->Arg(80)->Arg(160);

// Steps in the steady state with mu that falls with slip, at 45 m/s, with a memory of 10 um, at 0.6 of the largest
// force.
void falling_steps_unchanged(benchmark::State& state, bool with_tangents,
                             Integrator integrator = Integrator::implicit_euler) {
    constexpr double a = 4e-3, speed = 45;
    const Mesh<double> mesh = cosine_mesh<double>(state.range(0));
    const Contact contact({.half_length = a, .half_width = 1000 * a, .shear_modulus = 82e9, .poisson_ratio = 0.28});
    const Friction friction{
        ExponentialFall{0.3, 0.18, 0.1}, 495.169e6 * mean_hertz_pressure(mesh), {10e-6, 1e-3}, with_tangents};
    const FrictionModel model(contact,
                              rolling_system(mesh, Collocation{0.5, 0.5}, StripKernel<double>::longitudinal(contact)),
                              unchecked, friction, integrator);
    roll(state, model, 2000, [&](const auto& now, auto& next, auto& workspace) {
        return model.advance(now, {{0.05 * a, 0.05 * a / speed}, Creepage{1e-3}}, next, workspace);
    });
}
void BM_FrictionStepFalling(benchmark::State& state) { falling_steps_unchanged(state, false); }
BENCHMARK(BM_FrictionStepFalling)->Arg(20)->Arg(40)->Arg(80)->Arg(160);
void BM_FrictionStepFallingTangent(benchmark::State& state) { falling_steps_unchanged(state, true); }
BENCHMARK(BM_FrictionStepFallingTangent)->Arg(20)->Arg(40)->Arg(80)->Arg(160);
void BM_FrictionStepFallingSdirk2(benchmark::State& state) {
    falling_steps_unchanged(state, false, Integrator::sdirk2);
}
BENCHMARK(BM_FrictionStepFallingSdirk2)->Arg(20)->Arg(40)->Arg(80)->Arg(160);

// A cycle of sinusoidal creepage. Counters: rounds per step, and the share of steps in which elements change zones.
void steps_changing(benchmark::State& state, Integrator integrator) {
    const FrictionModel model = Scene(state.range(0)).model(integrator);
    const int solutions = integrator == Integrator::sdirk2 ? 2 : 1;
    double q = 0, changing = 0;
    roll(state, model, 0, [&](const auto& now, auto& next, auto& workspace) {
        const Creepage before = creepage(0.9 * std::sin(q));
        q += 0.05;
        const auto motion = FrictionModel::Motion::linear(before, creepage(0.9 * std::sin(q)));
        const FrictionStep step = model.advance(now, {0.05, motion}, next, workspace);
        changing += step.rounds > solutions ? 1 : 0;
        return step;
    });
    state.counters["changing"] = changing / static_cast<double>(state.iterations());
}
void BM_FrictionStepChanging(benchmark::State& state) { steps_changing(state, Integrator::implicit_euler); }
BENCHMARK(BM_FrictionStepChanging)->Arg(20)->Arg(40)->Arg(80)->Arg(160);
void BM_FrictionStepChangingSdirk2(benchmark::State& state) { steps_changing(state, Integrator::sdirk2); }
BENCHMARK(BM_FrictionStepChangingSdirk2)->Arg(20)->Arg(40)->Arg(80)->Arg(160);

// A step of a new distance each time, as by an integrator with variable step size. Argument: n. Compare with
// BM_LuSolve.
void steps_of_new_length(benchmark::State& state, Integrator integrator) {
    const FrictionModel model = Scene(state.range(0)).model(integrator);
    double q = 0, dq = 0.05;
    roll(state, model, 0, [&](const auto& now, auto& next, auto& workspace) {
        const Creepage before = creepage(0.9 * std::sin(q));
        dq = dq == 0.05 ? 0.0501 : 0.05;
        q += dq;
        const auto motion = FrictionModel::Motion::linear(before, creepage(0.9 * std::sin(q)));
        return model.advance(now, {dq, motion}, next, workspace);
    });
}
void BM_FrictionStepNewLength(benchmark::State& state) { steps_of_new_length(state, Integrator::implicit_euler); }
BENCHMARK(BM_FrictionStepNewLength)->Arg(20)->Arg(30)->Arg(40)->Arg(80);
void BM_FrictionStepNewLengthSdirk2(benchmark::State& state) { steps_of_new_length(state, Integrator::sdirk2); }
BENCHMARK(BM_FrictionStepNewLengthSdirk2)->Arg(20)->Arg(30)->Arg(40)->Arg(80);

// A load that varies by 50 %, with tangents by the load: on a breathing mesh, where each stage has its own matrix, and
// on a fixed mesh, where the matrix is constant.
void steps_under_load(benchmark::State& state, Integrator integrator, bool breathing) {
    const Eigen::Index n = state.range(0);
    const HertzLine line(
        {.load_per_width = 5e6, .combined_radius = 0.25, .body_1 = {210e9, 0.28}, .body_2 = {210e9, 0.28}});
    const double a = line.half_length() * (breathing ? 1 : 1.25);
    const Contact contact({.half_length = a, .half_width = 1, .shear_modulus = 82e9, .poisson_ratio = 0.28});
    const Mesh<double> mesh = breathing ? cosine_mesh<double>(n) : uniform_mesh<double>(n);
    const HertzLine::Load hertz =
        breathing ? HertzLine::Load::breathing(line, mesh) : HertzLine::Load::fixed(line, mesh, a);
    NormalLoad load = hertz.at(line.load_per_width());
    const FrictionModel model(
        contact,
        rolling_system(mesh, Collocation{.alpha_L = 0.5, .alpha_T = 0.5}, PlaneKernel<double>::longitudinal(contact)),
        unchecked, {0.3, load.normal_pressure}, integrator);
    const double dq = 0.05 * line.half_length();
    double q = 0;
    roll(state, model, 0, [&](const auto& now, auto& next, auto& workspace) {
        q += 0.05;
        if (hertz.set(line.load_per_width() * (1 + 0.5 * std::sin(2 * std::numbers::pi * q / 8)), load) != Status::ok) {
            state.SkipWithError("load");
            return FrictionStep{};
        }
        return model.advance(now, {dq, Creepage{5e-4}, load}, next, workspace);
    });
}
void BM_FrictionStepBreathing(benchmark::State& state) { steps_under_load(state, Integrator::implicit_euler, true); }
BENCHMARK(BM_FrictionStepBreathing)->Arg(20)->Arg(30)->Arg(40)->Arg(80);
void BM_FrictionStepBreathingSdirk2(benchmark::State& state) { steps_under_load(state, Integrator::sdirk2, true); }
BENCHMARK(BM_FrictionStepBreathingSdirk2)->Arg(20)->Arg(30)->Arg(40)->Arg(80);
void BM_FrictionStepFixedMesh(benchmark::State& state) { steps_under_load(state, Integrator::implicit_euler, false); }
BENCHMARK(BM_FrictionStepFixedMesh)->Arg(20)->Arg(30)->Arg(40)->Arg(80);
void BM_FrictionStepFixedMeshSdirk2(benchmark::State& state) { steps_under_load(state, Integrator::sdirk2, false); }
BENCHMARK(BM_FrictionStepFixedMeshSdirk2)->Arg(20)->Arg(30)->Arg(40)->Arg(80);

void BM_FrictionSteady(benchmark::State& state) {
    const FrictionModel model = Scene(state.range(0)).steady_model();
    solve_afresh(state, model, creepage(0.5));
    state.counters["relative_error"] = largest_error(model);
}
BENCHMARK(BM_FrictionSteady)->Arg(20)->Arg(40)->Arg(80)->Arg(160);

// One point of 100 along the curve from 0.01 to 1.
void BM_FrictionSteadyWarm(benchmark::State& state) {
    const FrictionModel model = Scene(state.range(0)).steady_model();
    int point = 0;
    roll(state, model, 0, [&](const auto& now, auto& next, auto& workspace) {
        const int phase = point++ % 200;
        return model.steady(now, {.motion = creepage(0.01 * (phase < 100 ? phase + 1 : 200 - phase))}, next, workspace);
    });
}
BENCHMARK(BM_FrictionSteadyWarm)->Arg(20)->Arg(40)->Arg(80)->Arg(160);

// Both creepages. Unit of comparison: a solution by LU of the equations of both directions together.
void BM_CombinedLuSolve(benchmark::State& state) {
    const Scene scene(state.range(0));
    const Eigen::Index n = state.range(0);
    MatrixX<double> matrix = MatrixX<double>::Zero(2 * n, 2 * n);
    matrix.topLeftCorner(n, n) = assemble_G_prime(scene.mesh, scene.scheme, scene.kernel);
    matrix.bottomRightCorner(n, n) = assemble_G_prime(scene.mesh, scene.scheme, scene.lateral);
    const VectorX<double> right = VectorX<double>::Ones(2 * n);
    Eigen::PartialPivLU<MatrixX<double>> lu(2 * n);
    VectorX<double> solution(2 * n);
    for (auto _ : state) {
        lu.compute(matrix);
        solution = lu.solve(right);
        benchmark::DoNotOptimize(solution.data());
        benchmark::ClobberMemory();
    }
    state.counters["n"] = static_cast<double>(n);
}
BENCHMARK(BM_CombinedLuSolve)->Arg(20)->Arg(40)->Arg(80)->Arg(160);

FrictionModel combined_steady_model(const Scene& scene) {
    return {
        scene.contact,
        {steady_system(scene.mesh, scene.scheme, scene.kernel), steady_system(scene.mesh, scene.scheme, scene.lateral)},
        scene.friction};
}
Creepage creepage(double ratio, double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return {creepage_size(ratio) * std::cos(angle), creepage_size(ratio) * std::sin(angle)};
}

// A solution from rest in the most expensive case, oblique creepage where stick ends.
void BM_CombinedSteady(benchmark::State& state) {
    solve_afresh(state, combined_steady_model(Scene(state.range(0))), creepage(1, 15));
}
BENCHMARK(BM_CombinedSteady)->Arg(20)->Arg(40)->Arg(80)->Arg(160);

// The creepage ratio alternates there between two values 0.1 apart.
void BM_CombinedSteadyWarm(benchmark::State& state) {
    const auto model = combined_steady_model(Scene(state.range(0)));
    int point = 0;
    roll(state, model, 0, [&](const auto& now, auto& next, auto& workspace) {
        return model.steady(now, {.motion = creepage(++point % 2 == 0 ? 1 : 0.9, 15)}, next, workspace);
    });
}
BENCHMARK(BM_CombinedSteadyWarm)->Arg(20)->Arg(40)->Arg(80)->Arg(160);

// A creepage that varies in size and direction.
void combined_steps(benchmark::State& state, Integrator integrator) {
    const Scene scene(state.range(0));
    const FrictionModel model(scene.contact,
                              ElementSystem(rolling_system(scene.mesh, scene.scheme, scene.kernel),
                                            rolling_system(scene.mesh, scene.scheme, scene.lateral)),
                              unchecked, scene.friction, integrator);
    double q = 0;
    roll(state, model, 0, [&](const auto& now, auto& next, auto& workspace) {
        const Creepage before = creepage(0.9 * std::sin(q), 20 * q);
        q += 0.05;
        const auto motion = FrictionModel::Motion::linear(before, creepage(0.9 * std::sin(q), 20 * q));
        return model.advance(now, {0.05, motion}, next, workspace);
    });
}
void BM_CombinedStep(benchmark::State& state) { combined_steps(state, Integrator::implicit_euler); }
BENCHMARK(BM_CombinedStep)->Arg(20)->Arg(40)->Arg(80)->Arg(160);
void BM_CombinedStepSdirk2(benchmark::State& state) { combined_steps(state, Integrator::sdirk2); }
BENCHMARK(BM_CombinedStepSdirk2)->Arg(20)->Arg(40)->Arg(80)->Arg(160);

// The wheel of falling_steps_unchanged in both directions: steps of a steady state with constant friction, and where mu
// falls with slip.
struct CombinedWheel {
    static constexpr double a = 4e-3, dq = 0.05 * a, duration = dq / 45;

    explicit CombinedWheel(Eigen::Index n)
        : mesh(cosine_mesh<double>(n)),
          contact({.half_length = a, .half_width = 1000 * a, .shear_modulus = 82e9, .poisson_ratio = 0.28}),
          pressure(495.169e6 * mean_hertz_pressure(mesh)) {}

    ElementSystem<double, 2> system() const {
        return {rolling_system(mesh, Collocation{0.5, 0.5}, StripKernel<double>::longitudinal(contact)),
                rolling_system(mesh, Collocation{0.5, 0.5}, StripKernel<double>::lateral(contact))};
    }

    Mesh<double> mesh;
    Contact contact;
    ArrayX<double> pressure;
    Creepage creepage{8e-4, 6e-4};
};
void BM_CombinedStepUnchanged(benchmark::State& state) {
    const CombinedWheel wheel(state.range(0));
    const FrictionModel model(wheel.contact, wheel.system(), unchecked, {0.3, wheel.pressure},
                              Integrator::implicit_euler);
    roll(state, model, 2500, [&](const auto& from, auto& to, auto& workspace) {
        return model.advance(from, {wheel.dq, wheel.creepage}, to, workspace);
    });
}
BENCHMARK(BM_CombinedStepUnchanged)->Arg(20)->Arg(40)->Arg(80)->Arg(160);
void combined_falling_steps(benchmark::State& state, bool with_tangents) {
    const CombinedWheel wheel(state.range(0));
    const Friction friction{ExponentialFall{0.3, 0.18, 0.1}, wheel.pressure, {10e-6, 1e-3}, with_tangents};
    const FrictionModel model(wheel.contact, wheel.system(), unchecked, friction, Integrator::implicit_euler);
    roll(state, model, 2500, [&](const auto& from, auto& to, auto& workspace) {
        return model.advance(from, {{wheel.dq, wheel.duration}, wheel.creepage}, to, workspace);
    });
}
void BM_CombinedStepFalling(benchmark::State& state) { combined_falling_steps(state, false); }
BENCHMARK(BM_CombinedStepFalling)->Arg(20)->Arg(40)->Arg(80)->Arg(160);
void BM_CombinedStepFallingTangent(benchmark::State& state) { combined_falling_steps(state, true); }
BENCHMARK(BM_CombinedStepFallingTangent)->Arg(20)->Arg(40)->Arg(80)->Arg(160);

}  // namespace

BENCHMARK_MAIN();
