// Friction: steps with unchanged and with changing zones, points of a creep curve from scratch, from the previous point
// and by the exact border. The units of comparison are a matrix-vector product and a solution by LU.

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/LU>
#include <benchmark/benchmark.h>

#include <rollbem/closed_form/friction.hpp>
#include <rollbem/compiled/friction.hpp>

namespace {

using namespace rollbem;

constexpr double poisson_ratio = 0.25;
constexpr double peak = 1e-3;  // mu p0 / G

double creepage(double ratio) { return 2 * (1 - poisson_ratio) * peak * ratio; }
double force_ratio(const FrictionStep<>& step) { return -step.force_per_width / (peak * std::numbers::pi / 2); }

struct Scene {
    explicit Scene(Eigen::Index n) : mesh(cosine_mesh<double>(n)), friction{1, peak * mean_hertz_pressure(mesh)} {}

    Contact<double> contact = Contact<double>::dimensionless(1000, poisson_ratio);
    StripKernel<double> kernel = StripKernel<double>::longitudinal(contact);
    StripKernel<double> lateral = StripKernel<double>::lateral(contact);
    Collocation scheme{.alpha_L = 0.5, .alpha_T = 0.5};
    Mesh<double> mesh;
    Friction<> friction;
};

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
void exact_border(benchmark::State& state, double aspect) {
    const Contact<double> contact = Contact<double>::dimensionless(aspect, poisson_ratio);
    const Kernel kernel = Kernel::longitudinal(contact);
    const HertzPressure<double> pressure{peak};
    const double ratio = static_cast<double>(state.range(0)) / 100;
    StickBorderSolution<double> solution;
    for (auto _ : state) {
        solution = solve_stick_border(contact, kernel, 1.0, pressure, creepage(ratio));
        benchmark::ClobberMemory();
    }
    const double force = solution.force_per_width;
    state.counters["relative_error"] = -force / (peak * std::numbers::pi / 2) / carter_force_ratio(ratio) - 1;
}
void BM_StickBorder(benchmark::State& state) { exact_border<PlaneKernel<double>>(state, 1000); }
BENCHMARK(BM_StickBorder)->Arg(1)->Arg(40)->Arg(50)->Arg(99);
// relative_error contains the difference between strip and plane
void BM_StickBorderStrip(benchmark::State& state) { exact_border<StripKernel<double>>(state, 1000); }
BENCHMARK(BM_StickBorderStrip)->Arg(40);

// Steps at constant creepage in the steady state, where no element changes its zone. Implicit Euler solves once per
// step for stick and slip, sdirk2 twice.
void steps_unchanged(benchmark::State& state, Integrator integrator) {
    const Scene scene(state.range(0));
    const FrictionModel<> model(scene.contact, rolling_system(scene.mesh, scene.scheme, scene.kernel), unchecked,
                                scene.friction, integrator);
    FrictionWorkspace<> workspace = model.workspace();
    FrictionState<> now = model.at_rest(), next = now;
    FrictionStep<> step = model.steady(next, creepage(0.5), now, workspace);
    for (int i = 0; i < 400; ++i) {
        step = model.advance(now, 0.05, creepage(0.5), next, workspace);
        std::swap(now, next);
    }
    double rounds = 0;
    for (auto _ : state) {
        step = model.advance(now, 0.05, creepage(0.5), next, workspace);
        rounds += step.rounds;
        std::swap(now, next);
        benchmark::DoNotOptimize(step);
    }
    state.counters["n"] = static_cast<double>(state.range(0));
    state.counters["rounds"] = rounds / static_cast<double>(state.iterations());
    state.counters["relative_error"] = force_ratio(step) / carter_force_ratio(0.5) - 1;
}
void BM_FrictionStep(benchmark::State& state) { steps_unchanged(state, Integrator::implicit_euler); }
BENCHMARK(BM_FrictionStep)->Arg(20)->Arg(40)->Arg(80)->Arg(160);
void BM_FrictionStepSdirk2(benchmark::State& state) { steps_unchanged(state, Integrator::sdirk2); }
BENCHMARK(BM_FrictionStepSdirk2)->Arg(20)->Arg(40)->Arg(80)->Arg(160);

// The same with mu that falls with slip, at 45 m/s, with a memory of 10 um, at 0.6 of the largest force.
void falling_steps_unchanged(benchmark::State& state, bool with_tangents,
                             Integrator integrator = Integrator::implicit_euler) {
    constexpr double a = 4e-3, speed = 45;
    const Mesh<double> mesh = cosine_mesh<double>(state.range(0));
    const Contact<double> contact(
        {.half_length = a, .half_width = 1000 * a, .shear_modulus = 82e9, .poisson_ratio = 0.28});
    const Friction<ExponentialFall<double>> friction{
        {0.3, 0.18, 0.1}, 495.169e6 * mean_hertz_pressure(mesh), {10e-6, 1e-3}, with_tangents};
    const FrictionModel<ExponentialFall<double>> model(
        contact, rolling_system(mesh, Collocation{0.5, 0.5}, StripKernel<double>::longitudinal(contact)), unchecked,
        friction, integrator);
    FrictionWorkspace<> workspace = model.workspace();
    FrictionState<> now = model.at_rest(), next = now;
    FrictionStep<> step;
    for (int i = 0; i < 2000; ++i) {
        step = model.advance(now, {0.05 * a, 0.05 * a / speed}, 1e-3, next, workspace);
        std::swap(now, next);
    }
    double rounds = 0;
    for (auto _ : state) {
        step = model.advance(now, {0.05 * a, 0.05 * a / speed}, 1e-3, next, workspace);
        rounds += step.rounds;
        std::swap(now, next);
        benchmark::DoNotOptimize(step);
    }
    state.counters["n"] = static_cast<double>(state.range(0));
    state.counters["rounds"] = rounds / static_cast<double>(state.iterations());
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
    const Scene scene(state.range(0));
    const FrictionModel<> model(scene.contact, rolling_system(scene.mesh, scene.scheme, scene.kernel), unchecked,
                                scene.friction, integrator);
    FrictionWorkspace<> workspace = model.workspace();
    const int solutions = integrator == Integrator::sdirk2 ? 2 : 1;
    FrictionState<> now = model.at_rest(), next = now;
    double q = 0, rounds = 0, changing = 0;
    for (auto _ : state) {
        const double before = creepage(0.9 * std::sin(q));
        q += 0.05;
        const auto motion = RigidMotion<double>::linear(before, creepage(0.9 * std::sin(q)));
        const FrictionStep<> step = model.advance(now, 0.05, motion, next, workspace);
        rounds += step.rounds;
        changing += step.rounds > solutions ? 1 : 0;
        std::swap(now, next);
    }
    state.counters["n"] = static_cast<double>(state.range(0));
    state.counters["rounds"] = rounds / static_cast<double>(state.iterations());
    state.counters["changing"] = changing / static_cast<double>(state.iterations());
}
void BM_FrictionStepChanging(benchmark::State& state) { steps_changing(state, Integrator::implicit_euler); }
BENCHMARK(BM_FrictionStepChanging)->Arg(20)->Arg(40)->Arg(80)->Arg(160);
void BM_FrictionStepChangingSdirk2(benchmark::State& state) { steps_changing(state, Integrator::sdirk2); }
BENCHMARK(BM_FrictionStepChangingSdirk2)->Arg(20)->Arg(40)->Arg(80)->Arg(160);

// The same with another distance rolled in every step, as by an integrator with variable step size. Argument: n. To be
// compared with BM_LuSolve.
void steps_of_new_length(benchmark::State& state, Integrator integrator) {
    const Scene scene(state.range(0));
    const FrictionModel<> model(scene.contact, rolling_system(scene.mesh, scene.scheme, scene.kernel), unchecked,
                                scene.friction, integrator);
    FrictionWorkspace<> workspace = model.workspace();
    FrictionState<> now = model.at_rest(), next = now;
    double q = 0, rounds = 0, dq = 0.05;
    for (auto _ : state) {
        const double before = creepage(0.9 * std::sin(q));
        dq = dq == 0.05 ? 0.0501 : 0.05;
        q += dq;
        const auto motion = RigidMotion<double>::linear(before, creepage(0.9 * std::sin(q)));
        const FrictionStep<> step = model.advance(now, dq, motion, next, workspace);
        rounds += step.rounds;
        std::swap(now, next);
    }
    state.counters["n"] = static_cast<double>(state.range(0));
    state.counters["rounds"] = rounds / static_cast<double>(state.iterations());
}
void BM_FrictionStepNewLength(benchmark::State& state) { steps_of_new_length(state, Integrator::implicit_euler); }
BENCHMARK(BM_FrictionStepNewLength)->Arg(20)->Arg(30)->Arg(40)->Arg(80);
void BM_FrictionStepNewLengthSdirk2(benchmark::State& state) { steps_of_new_length(state, Integrator::sdirk2); }
BENCHMARK(BM_FrictionStepNewLengthSdirk2)->Arg(20)->Arg(30)->Arg(40)->Arg(80);

// A load that varies by 50 %, with tangents by the load: on a breathing mesh, where each stage has its own matrix, and
// on a fixed mesh, where the matrix is constant.
void steps_under_load(benchmark::State& state, Integrator integrator, bool breathing) {
    const Eigen::Index n = state.range(0);
    const HertzLine<double> line(
        {.load_per_width = 5e6, .combined_radius = 0.25, .body_1 = {210e9, 0.28}, .body_2 = {210e9, 0.28}});
    const double a = line.half_length() * (breathing ? 1 : 1.25);
    const Contact<double> contact({.half_length = a, .half_width = 1, .shear_modulus = 82e9, .poisson_ratio = 0.28});
    const Mesh<double> mesh = breathing ? cosine_mesh<double>(n) : uniform_mesh<double>(n);
    const HertzLoad<double> hertz =
        breathing ? HertzLoad<double>::breathing(line, mesh) : HertzLoad<double>::fixed(line, mesh, a);
    NormalLoad<double> load = hertz.at(line.load_per_width());
    const FrictionModel<> model(
        contact,
        rolling_system(mesh, Collocation{.alpha_L = 0.5, .alpha_T = 0.5}, PlaneKernel<double>::longitudinal(contact)),
        unchecked, {0.3, load.normal_pressure}, integrator);
    FrictionWorkspace<> workspace = model.workspace();
    FrictionState<> now = model.at_rest(), next = now;
    const double dq = 0.05 * line.half_length();
    double q = 0, rounds = 0;
    FrictionStep<> step;
    for (auto _ : state) {
        q += 0.05;
        if (hertz.set(line.load_per_width() * (1 + 0.5 * std::sin(2 * std::numbers::pi * q / 8)), load) !=
            StepStatus::ok) {
            state.SkipWithError("load");
            break;
        }
        step = model.advance(now, dq, 5e-4, load, next, workspace);
        rounds += step.rounds;
        std::swap(now, next);
    }
    if (step.status != StepStatus::ok) state.SkipWithError(name(step.status));
    state.counters["n"] = static_cast<double>(n);
    state.counters["rounds"] = rounds / static_cast<double>(state.iterations());
}
void BM_FrictionStepBreathing(benchmark::State& state) { steps_under_load(state, Integrator::implicit_euler, true); }
BENCHMARK(BM_FrictionStepBreathing)->Arg(20)->Arg(30)->Arg(40)->Arg(80);
void BM_FrictionStepBreathingSdirk2(benchmark::State& state) { steps_under_load(state, Integrator::sdirk2, true); }
BENCHMARK(BM_FrictionStepBreathingSdirk2)->Arg(20)->Arg(30)->Arg(40)->Arg(80);
void BM_FrictionStepFixedMesh(benchmark::State& state) { steps_under_load(state, Integrator::implicit_euler, false); }
BENCHMARK(BM_FrictionStepFixedMesh)->Arg(20)->Arg(30)->Arg(40)->Arg(80);
void BM_FrictionStepFixedMeshSdirk2(benchmark::State& state) { steps_under_load(state, Integrator::sdirk2, false); }
BENCHMARK(BM_FrictionStepFixedMeshSdirk2)->Arg(20)->Arg(30)->Arg(40)->Arg(80);

// One point of the creep curve from scratch, without assembly.
void BM_FrictionSteady(benchmark::State& state) {
    const Scene scene(state.range(0));
    const SteadyFrictionModel<> model(scene.contact, scene.mesh, scene.scheme, scene.kernel, scene.friction);
    const FrictionState<> rest = model.at_rest();
    FrictionState<> next = rest;
    const FrictionWorkspace<> fresh = model.workspace();
    FrictionWorkspace<> workspace = fresh;
    double rounds = 0;
    FrictionStep<> step;
    for (auto _ : state) {
        workspace = fresh;  // without factors
        step = model.steady(rest, creepage(0.5), next, workspace);
        rounds += step.rounds;
        benchmark::DoNotOptimize(step);
    }
    state.counters["n"] = static_cast<double>(state.range(0));
    state.counters["rounds"] = rounds / static_cast<double>(state.iterations());
    state.counters["relative_error"] = force_ratio(step) / carter_force_ratio(0.5) - 1;
}
BENCHMARK(BM_FrictionSteady)->Arg(20)->Arg(40)->Arg(80)->Arg(160);

// One point of 100 along the curve from 0.01 to 1.
void BM_FrictionSteadyWarm(benchmark::State& state) {
    const Scene scene(state.range(0));
    const SteadyFrictionModel<> model(scene.contact, scene.mesh, scene.scheme, scene.kernel, scene.friction);
    FrictionState<> now = model.at_rest(), next = now;
    FrictionWorkspace<> workspace = model.workspace();
    int point = 0;
    double rounds = 0;
    for (auto _ : state) {
        const int phase = point++ % 200;
        const FrictionStep<> step =
            model.steady(now, creepage(0.01 * (phase < 100 ? phase + 1 : 200 - phase)), next, workspace);
        rounds += step.rounds;
        std::swap(now, next);
    }
    state.counters["n"] = static_cast<double>(state.range(0));
    state.counters["rounds"] = rounds / static_cast<double>(state.iterations());
}
BENCHMARK(BM_FrictionSteadyWarm)->Arg(20)->Arg(40)->Arg(80)->Arg(160);

// Both creepages. The unit of comparison: a solution by LU of the equations of both directions together.
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

SteadyFrictionModel<ConstantFriction<>, 2> combined_steady_model(const Scene& scene) {
    return {scene.contact, scene.mesh, scene.scheme, scene.kernel, scene.lateral, scene.friction};
}
Creepage<double> creepage(double ratio, double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return {creepage(ratio) * std::cos(angle), creepage(ratio) * std::sin(angle)};
}

// One point from scratch, without assembly, in the most expensive case: oblique creepage where stick ends. With slip
// turned to its direction at the centres, as by default, or left as it is.
void combined_steady(benchmark::State& state, bool turned) {
    Scene scene(state.range(0));
    scene.friction.turned = turned;
    const SteadyFrictionModel<ConstantFriction<>, 2> model = combined_steady_model(scene);
    const FrictionState<2> rest = model.at_rest();
    FrictionState<2> next = rest;
    const FrictionWorkspace<2> fresh = model.workspace();
    FrictionWorkspace<2> workspace = fresh;
    FrictionStep<2> step;
    for (auto _ : state) {
        workspace = fresh;  // without factors
        step = model.steady(rest, creepage(1, 15), next, workspace);
        benchmark::DoNotOptimize(step);
    }
    state.counters["n"] = static_cast<double>(state.range(0));
    state.counters["rounds"] = step.rounds;
}
void BM_CombinedSteady(benchmark::State& state) { combined_steady(state, true); }
BENCHMARK(BM_CombinedSteady)->Arg(20)->Arg(40)->Arg(80)->Arg(160);
void BM_CombinedSteadyUnturned(benchmark::State& state) { combined_steady(state, false); }
BENCHMARK(BM_CombinedSteadyUnturned)->Arg(20)->Arg(40)->Arg(80)->Arg(160);

// The creepage ratio alternates there between two values 0.1 apart.
void BM_CombinedSteadyWarm(benchmark::State& state) {
    const Scene scene(state.range(0));
    const SteadyFrictionModel<ConstantFriction<>, 2> model = combined_steady_model(scene);
    FrictionState<2> now = model.at_rest(), next = now;
    FrictionWorkspace<2> workspace = model.workspace();
    int point = 0;
    double rounds = 0;
    for (auto _ : state) {
        rounds += model.steady(now, creepage(++point % 2 == 0 ? 1 : 0.9, 15), next, workspace).rounds;
        std::swap(now, next);
    }
    state.counters["n"] = static_cast<double>(state.range(0));
    state.counters["rounds"] = rounds / static_cast<double>(state.iterations());
}
BENCHMARK(BM_CombinedSteadyWarm)->Arg(20)->Arg(40)->Arg(80)->Arg(160);

// A creepage that varies in size and direction.
void combined_steps(benchmark::State& state, Integrator integrator, bool turned = true) {
    Scene scene(state.range(0));
    scene.friction.turned = turned;
    const FrictionModel model(scene.contact,
                              ElementSystem(rolling_system(scene.mesh, scene.scheme, scene.kernel),
                                            rolling_system(scene.mesh, scene.scheme, scene.lateral)),
                              unchecked, scene.friction, integrator);
    FrictionWorkspace<2> workspace = model.workspace();
    FrictionState<2> now = model.at_rest(), next = now;
    double q = 0, rounds = 0;
    for (auto _ : state) {
        const Creepage<double> before = creepage(0.9 * std::sin(q), 20 * q);
        q += 0.05;
        const auto motion = RigidMotion<Creepage<double>>::linear(before, creepage(0.9 * std::sin(q), 20 * q));
        rounds += model.advance(now, 0.05, motion, next, workspace).rounds;
        std::swap(now, next);
    }
    state.counters["n"] = static_cast<double>(state.range(0));
    state.counters["rounds"] = rounds / static_cast<double>(state.iterations());
}
void BM_CombinedStep(benchmark::State& state) { combined_steps(state, Integrator::implicit_euler); }
BENCHMARK(BM_CombinedStep)->Arg(20)->Arg(40)->Arg(80)->Arg(160);
void BM_CombinedStepUnturned(benchmark::State& state) { combined_steps(state, Integrator::implicit_euler, false); }
BENCHMARK(BM_CombinedStepUnturned)->Arg(20)->Arg(40)->Arg(80)->Arg(160);
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
    template <class Model, class Advance>
    void run(benchmark::State& state, const Model& model, const Advance& advance) const {
        auto workspace = model.workspace();
        auto now = model.at_rest(), next = now;
        for (int i = 0; i < 2500; ++i) {
            advance(now, next, workspace);
            std::swap(now, next);
        }
        double rounds = 0;
        for (auto _ : state) {
            rounds += advance(now, next, workspace).rounds;
            std::swap(now, next);
        }
        state.counters["n"] = static_cast<double>(state.range(0));
        state.counters["rounds"] = rounds / static_cast<double>(state.iterations());
    }

    Mesh<double> mesh;
    Contact<double> contact;
    ArrayX<double> pressure;
    Creepage<double> creepage{8e-4, 6e-4};
};
void BM_CombinedStepUnchanged(benchmark::State& state) {
    const CombinedWheel wheel(state.range(0));
    const FrictionModel model(wheel.contact, wheel.system(), unchecked, {0.3, wheel.pressure},
                              Integrator::implicit_euler);
    wheel.run(state, model, [&](const auto& from, auto& to, auto& workspace) {
        return model.advance(from, wheel.dq, wheel.creepage, to, workspace);
    });
}
BENCHMARK(BM_CombinedStepUnchanged)->Arg(20)->Arg(40)->Arg(80)->Arg(160);
void combined_falling_steps(benchmark::State& state, bool with_tangents) {
    using Law = ExponentialFall<double>;
    const CombinedWheel wheel(state.range(0));
    const Friction<Law> friction{{0.3, 0.18, 0.1}, wheel.pressure, {10e-6, 1e-3}, with_tangents};
    const FrictionModel model(wheel.contact, wheel.system(), unchecked, friction, Integrator::implicit_euler);
    wheel.run(state, model, [&](const auto& from, auto& to, auto& workspace) {
        return model.advance(from, {wheel.dq, wheel.duration}, wheel.creepage, to, workspace);
    });
}
void BM_CombinedStepFalling(benchmark::State& state) { combined_falling_steps(state, false); }
BENCHMARK(BM_CombinedStepFalling)->Arg(20)->Arg(40)->Arg(80)->Arg(160);
void BM_CombinedStepFallingTangent(benchmark::State& state) { combined_falling_steps(state, true); }
BENCHMARK(BM_CombinedStepFallingTangent)->Arg(20)->Arg(40)->Arg(80)->Arg(160);

}  // namespace

BENCHMARK_MAIN();
