// Steps of the contact in the time domain, compared with one matrix-vector product of the same size.
#include <utility>

#include <benchmark/benchmark.h>

#include <rollbem/compiled/transient.hpp>
#include <rollbem/reference/step_response.hpp>
#include <rollbem/spectral/chebyshev.hpp>

namespace {

using namespace rollbem;

TransientModel<double> make_model(Eigen::Index n, Integrator integrator) {
    const Contact<double> contact = Contact<double>::dimensionless(100, 0.25);
    return {contact,
            rolling_system(cosine_mesh<double>(n), Collocation{.alpha_L = 0.5, .alpha_T = 0.5},
                           PlaneKernel<double>::longitudinal(contact)),
            unchecked, integrator};
}

/// Relative error of the force at q/a = 1 after a step of creepage, by the steps of dq that are timed.
template <class Dq>
double step_error(const TransientModel<double>& model, const Dq& dq, int steps) {
    TransientState<double> state = model.at_rest(), next = state;
    double force = 0;
    for (int k = 0; k < steps; ++k) {
        force = model.advance(state, dq, 1.0, next).force_per_width;
        std::swap(state, next);
    }
    return -force / reference::step_response_de_hoog(1, 0.25, 100) - 1;
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

/// A prepared step.
void step(benchmark::State& bench, const TransientModel<double>& model) {
    const PreparedStep<double> prepared = model.prepare(1.0 / steps_to_one);
    TransientState<double> state = model.at_rest(), next = state;
    for (auto _ : bench) {
        benchmark::DoNotOptimize(model.advance(state, prepared, 1.0, next));
        std::swap(state, next);
    }
    count(bench, step_error(model, prepared, steps_to_one));
}
void BM_TransientStep(benchmark::State& bench) { step(bench, make_model(bench.range(0), Integrator::sdirk2)); }
void BM_TransientStepEuler(benchmark::State& bench) {
    step(bench, make_model(bench.range(0), Integrator::implicit_euler));
}
void BM_TransientStepExponential(benchmark::State& bench) {
    step(bench, make_model(bench.range(0), Integrator::matrix_exponential));
}
/// A prepared step of Chebyshev states.
void BM_ChebyshevStep(benchmark::State& bench) {
    const Contact<double> contact = Contact<double>::dimensionless(100, 0.25);
    step(bench, {contact, rolling_system(Chebyshev{bench.range(0)}, PlaneKernel<double>::longitudinal(contact)),
                 unchecked, Integrator::matrix_exponential});
}
BENCHMARK(BM_TransientStep)->Arg(20)->Arg(40)->Arg(80)->Arg(160)->Arg(320);
BENCHMARK(BM_TransientStepEuler)->Arg(40);
BENCHMARK(BM_TransientStepExponential)->Arg(40);
BENCHMARK(BM_ChebyshevStep)->Arg(4)->Arg(8)->Arg(12)->Arg(24)->Arg(40);

/// A step of an unprepared dq.
void BM_TransientNewStep(benchmark::State& bench) {
    const TransientModel<double> model = make_model(bench.range(0), Integrator::sdirk2);
    TransientState<double> state = model.at_rest(), next = state;
    for (auto _ : bench) {
        benchmark::DoNotOptimize(model.advance(state, 1.0 / steps_to_one, 1.0, next));
        std::swap(state, next);
    }
    count(bench, step_error(model, 1.0 / steps_to_one, steps_to_one));
}
BENCHMARK(BM_TransientNewStep)->Arg(20)->Arg(40)->Arg(80)->Arg(128);

void prepare(benchmark::State& bench, Integrator integrator) {
    const TransientModel<double> model = make_model(bench.range(0), integrator);
    for (auto _ : bench) benchmark::DoNotOptimize(model.prepare(1.0 / steps_to_one));
    count(bench, step_error(model, model.prepare(1.0 / steps_to_one), steps_to_one));
}
void BM_TransientPrepare(benchmark::State& bench) { prepare(bench, Integrator::sdirk2); }
void BM_TransientPrepareExponential(benchmark::State& bench) { prepare(bench, Integrator::matrix_exponential); }
BENCHMARK(BM_TransientPrepare)->Arg(20)->Arg(40)->Arg(80)->Arg(160)->Arg(320);
BENCHMARK(BM_TransientPrepareExponential)->Arg(20)->Arg(40)->Arg(80)->Arg(160)->Arg(320);

}  // namespace

BENCHMARK_MAIN();
