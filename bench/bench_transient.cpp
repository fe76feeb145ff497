// Steps of the contact in the time domain, compared with one matrix-vector product of the same size.
#include <algorithm>
#include <cmath>
#include <utility>

#include <benchmark/benchmark.h>

#include <rollbem/adhesion/transient.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/reference/bessel.hpp>
#include <rollbem/spectral/chebyshev.hpp>

namespace {

using namespace rollbem;

AdhesionModel<> make_model(Eigen::Index n, Integrator integrator) {
    const Contact contact = Contact::dimensionless(100, 0.25);
    return {contact,
            rolling_system(cosine_mesh<double>(n), Collocation{.alpha_L = 0.5, .alpha_T = 0.5},
                           PlaneKernel<double>::longitudinal(contact)),
            unchecked, integrator};
}

/// Largest relative error of the force from q/a = 1 to 3 after a step of creepage, by the steps of dq that are timed:
/// the front of the step passes the elements, and leaves the contact at 2.
double step_error(const AdhesionModel<>& model, int steps) {
    static const reference::StepResponse exact(0.25, 100);
    AdhesionModel<>::State state = model.at_rest(), next = state;
    AdhesionModel<>::Workspace workspace = model.workspace();
    double largest = 0;
    for (int k = 1; k <= 3 * steps; ++k) {
        const double force = model.advance(state, {1.0 / steps, 1.0}, next, workspace).force_per_width;
        if (k >= steps) largest = std::max(largest, std::abs(-force / exact.step(double(k) / steps) - 1));
        std::swap(state, next);
    }
    return largest;
}

void count(benchmark::State& bench, double error) {
    bench.counters["n"] = static_cast<double>(bench.range(0));
    bench.counters["relative_error"] = error;
}

/// y = A x, the lower bound for a step.
void BM_Gemv(benchmark::State& bench) {
    const Eigen::Index n = bench.range(0);
    const MatrixX<double> A = MatrixX<double>::Random(n, n);
    const VectorX<double> x = VectorX<double>::Random(n);
    VectorX<double> y(n);
    for (auto _ : bench) {
        y.noalias() = A * x;
        benchmark::DoNotOptimize(y.data());
        benchmark::ClobberMemory();
    }
    bench.counters["n"] = static_cast<double>(n);
}
BENCHMARK(BM_Gemv)->Arg(20)->Arg(40)->Arg(80)->Arg(160)->Arg(320);

constexpr int steps_to_one = 64;

/// A step of the same distance as the one before.
void step(benchmark::State& bench, const AdhesionModel<>& model) {
    AdhesionModel<>::State state = model.at_rest(), next = state;
    AdhesionModel<>::Workspace workspace = model.workspace();
    for (auto _ : bench) {
        benchmark::DoNotOptimize(model.advance(state, {1.0 / steps_to_one, 1.0}, next, workspace));
        std::swap(state, next);
    }
    count(bench, step_error(model, steps_to_one));
}
void BM_TransientStep(benchmark::State& bench) { step(bench, make_model(bench.range(0), Integrator::sdirk2)); }
void BM_TransientStepEuler(benchmark::State& bench) {
    step(bench, make_model(bench.range(0), Integrator::implicit_euler));
}
void BM_TransientStepExponential(benchmark::State& bench) {
    step(bench, make_model(bench.range(0), Integrator::matrix_exponential));
}
/// The same of Chebyshev states.
void BM_ChebyshevStep(benchmark::State& bench) {
    const Contact contact = Contact::dimensionless(100, 0.25);
    step(bench, {contact, rolling_system(Chebyshev{bench.range(0)}, PlaneKernel<double>::longitudinal(contact)),
                 unchecked, Integrator::matrix_exponential});
}
BENCHMARK(BM_TransientStep)->Arg(20)->Arg(40)->Arg(80)->Arg(160)->Arg(320);
BENCHMARK(BM_TransientStepEuler)->Arg(40);
BENCHMARK(BM_TransientStepExponential)->Arg(40);
BENCHMARK(BM_ChebyshevStep)->Arg(4)->Arg(8)->Arg(12)->Arg(24)->Arg(40);

/// A step of another distance than the one before.
void BM_TransientNewStep(benchmark::State& bench) {
    const AdhesionModel<> model = make_model(bench.range(0), Integrator::sdirk2);
    AdhesionModel<>::State state = model.at_rest(), next = state;
    AdhesionModel<>::Workspace workspace = model.workspace();
    double dq = 1.0 / steps_to_one;
    for (auto _ : bench) {
        dq = -dq + 2.01 / steps_to_one;
        benchmark::DoNotOptimize(model.advance(state, {dq, 1.0}, next, workspace));
        std::swap(state, next);
    }
    count(bench, step_error(model, steps_to_one));
}
BENCHMARK(BM_TransientNewStep)->Arg(20)->Arg(40)->Arg(80)->Arg(128);

/// The first step of a repeated distance, which computes the matrix for those that follow.
void first(benchmark::State& bench, Integrator integrator) {
    const AdhesionModel<> model = make_model(bench.range(0), integrator);
    AdhesionModel<>::State state = model.at_rest(), next = state;
    AdhesionModel<>::Workspace workspace = model.workspace();
    double dq = 1.0 / steps_to_one;
    for (auto _ : bench) {
        dq = -dq + 2.01 / steps_to_one;
        state.distance = dq;
        benchmark::DoNotOptimize(model.advance(state, {dq, 1.0}, next, workspace));
    }
    count(bench, step_error(model, steps_to_one));
}
void BM_TransientFirstStep(benchmark::State& bench) { first(bench, Integrator::sdirk2); }
void BM_TransientFirstStepExponential(benchmark::State& bench) { first(bench, Integrator::matrix_exponential); }
BENCHMARK(BM_TransientFirstStep)->Arg(20)->Arg(40)->Arg(80)->Arg(160)->Arg(320);
BENCHMARK(BM_TransientFirstStepExponential)->Arg(20)->Arg(40)->Arg(80)->Arg(160)->Arg(320);

}  // namespace

BENCHMARK_MAIN();
