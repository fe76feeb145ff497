// Problems solved with given influence matrices, each fast method next to the plain one, and the whole steady problem.
// Sample run: ./bench_problems --benchmark_filter='Stability|Sweep'
#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include <rollbem/adhesion/frequency.hpp>
#include <rollbem/adhesion/stability.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/closed_form/carter.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/spectral/chebyshev.hpp>
#include <rollbem/spectral/polynomial.hpp>
#include <rollbem/steady/steady.hpp>

namespace {

using namespace rollbem;

const Contact contact = Contact::dimensionless(1000, 0.25);
const StripKernel<double> kernel = StripKernel<double>::longitudinal(contact);

constexpr Collocation of_paper{.alpha_L = 0, .alpha_T = 0.63};

ElementSystem<double> system_of_paper(Eigen::Index n) { return rolling_system(uniform_mesh(n), of_paper, kernel); }

void finish(benchmark::State& state) { state.counters["n"] = static_cast<double>(state.range(0)); }

double relative_error(const Response<double>& solution) {
    return solution.c11() / steady_c11(contact.poisson_ratio()) - 1;
}

void BM_SteadySolve(benchmark::State& state) {
    const Mesh<double> mesh = uniform_mesh(state.range(0));
    const MatrixX<double> G_prime = assemble_G_prime(mesh, of_paper, kernel);
    Response<double> solution;
    for (auto _ : state) benchmark::DoNotOptimize(solution = solve_steady<double>(G_prime, mesh.widths()));
    state.counters["relative_error"] = relative_error(solution);
    finish(state);
}
BENCHMARK(BM_SteadySolve)->Arg(20)->Arg(40)->Arg(80)->Arg(160)->Arg(320);

template <class MakeMesh, class Scheme>
void steady(benchmark::State& state, MakeMesh make_mesh, const Scheme& scheme) {
    Response<double> solution;
    for (auto _ : state) {
        benchmark::DoNotOptimize(solution = solve_steady(make_mesh(state.range(0)), scheme, kernel));
    }
    state.counters["relative_error"] = relative_error(solution);
    finish(state);
}

void BM_StabilityQZ(benchmark::State& state) {
    const RollingSystem<double> system = system_of_paper(state.range(0));
    Eigen::Index count = 0;
    for (auto _ : state) benchmark::DoNotOptimize(count = solve_stability(system).unstable_count);
    state.counters["unstable_count"] = static_cast<double>(count);
    finish(state);
}
BENCHMARK(BM_StabilityQZ)->Unit(benchmark::kMillisecond)->Arg(20)->Arg(40)->Arg(80)->Arg(160);

void BM_StabilityCount(benchmark::State& state) {
    const RollingSystem<double> system = system_of_paper(state.range(0));
    Eigen::Index count = 0;
    for (auto _ : state) benchmark::DoNotOptimize(count = count_unstable(system).unstable_count);
    state.counters["unstable_count"] = static_cast<double>(count);
    finish(state);
}
BENCHMARK(BM_StabilityCount)->Unit(benchmark::kMillisecond)->Arg(20)->Arg(40)->Arg(80)->Arg(160);

std::vector<double> frequencies() {
    std::vector<double> values(200);
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = 1e-3 * std::pow(5e3, static_cast<double>(k) / 199);
    return values;
}

// Largest relative error of c11(z) against the plane limit, which agrees with the strip to 2e-7 at this width.
template <class Response>
double sweep_error(const Response& c11) {
    double largest = 0;
    for (const double z : frequencies()) {
        const std::complex<double> exact =
            polynomial_c11(std::complex<double>(0, z), contact.poisson_ratio(), contact.aspect()).c11;
        largest = std::max(largest, std::abs(c11(z) / exact - 1.0));
    }
    return largest;
}

void BM_SweepLU(benchmark::State& state) {
    const RollingSystem<double> system = system_of_paper(state.range(0));
    const auto c11 = [&](double z) { return solve_response(system, std::complex<double>(0, z)).coefficients(0, 0); };
    for (auto _ : state) {
        std::complex<double> sum = 0;
        for (const double z : frequencies()) sum += c11(z);
        benchmark::DoNotOptimize(sum);
    }
    state.counters["relative_error"] = sweep_error(c11);
    finish(state);
}
BENCHMARK(BM_SweepLU)->Unit(benchmark::kMillisecond)->Arg(20)->Arg(60)->Arg(200);

// Includes the reduction to Hessenberg form.
void BM_SweepHessenberg(benchmark::State& state) {
    const RollingSystem<double> system = system_of_paper(state.range(0));
    for (auto _ : state) {
        const FrequencySweep sweep(system);
        std::complex<double> sum = 0;
        for (const double z : frequencies()) sum += sweep(z).c11();
        benchmark::DoNotOptimize(sum);
    }
    const FrequencySweep sweep(system);
    state.counters["relative_error"] = sweep_error([&](double z) { return sweep(z).c11(); });
    finish(state);
}
BENCHMARK(BM_SweepHessenberg)->Unit(benchmark::kMillisecond)->Arg(20)->Arg(60)->Arg(200);

template <class MakeMesh, class Scheme>
void register_steady(const std::string& name, MakeMesh make_mesh, const Scheme& scheme) {
    benchmark::RegisterBenchmark(("BM_Steady/" + name).c_str(),
                                 [=](benchmark::State& state) { steady(state, make_mesh, scheme); })
        ->Arg(20)
        ->Arg(40)
        ->Arg(80)
        ->Arg(160)
        ->Arg(320);
}

}  // namespace

int main(int argc, char** argv) {
    const auto uniform = [](Eigen::Index n) { return uniform_mesh(n); };
    const auto cosine = [](Eigen::Index n) { return cosine_mesh(n); };
    const Collocation halves{.alpha_L = 0.5, .alpha_T = 0.5};
    register_steady("uniform_0_0.63", uniform, of_paper);
    register_steady("uniform_0.5_0.5", uniform, halves);
    register_steady("cosine_0.5_0.5", cosine, halves);
    register_steady("galerkin_exact_0_0.63", uniform, Galerkin{.alpha_L = 0, .alpha_T = 0.63});
    register_steady("galerkin_7_0_0.63", uniform, Galerkin{.alpha_L = 0, .alpha_T = 0.63, .quadrature = 7});
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
