// Contact patches of n x n elements: G and G' of the whole, steady creep coefficients by halves, and for comparison one
// LU decomposition of all 2 n^2 unknowns. The counter error is that of c11 at a/b = 1, nu = 0.25.
// Sample run: ./bench_patch --benchmark_filter=/12$
#include <cmath>

#include <Eigen/LU>
#include <benchmark/benchmark.h>

#include <rollbem/compiled/patch.hpp>

namespace {

using namespace rollbem;

constexpr NodeDifference scheme{Nodes::chebyshev};
const PatchContact<double> contact = PatchContact<double>::dimensionless(1, 0.25);
const HalfSpace<double> kernel(0.25);

void patch_lu(benchmark::State& state) {
    const PatchMesh<double> mesh = patch_mesh(contact, state.range(0), state.range(0));
    const MatrixX<double> G_prime = rolling_system(mesh, scheme, kernel).whole().G_prime();
    for (auto _ : state) benchmark::DoNotOptimize(Eigen::PartialPivLU<MatrixX<double>>(G_prime));
}

void patch_system(benchmark::State& state) {
    const PatchMesh<double> mesh = patch_mesh(contact, state.range(0), state.range(0));
    for (auto _ : state) benchmark::DoNotOptimize(rolling_system(mesh, scheme, kernel));
    state.SetComplexityN(state.range(0));
}

void patch_steady(benchmark::State& state) {
    const PatchMesh<double> mesh = patch_mesh(contact, state.range(0), state.range(0));
    double c11 = 0;
    for (auto _ : state) benchmark::DoNotOptimize(c11 = solve_steady(contact, mesh, scheme, kernel).c11);
    state.counters["error"] = std::abs(c11 / 4.111 - 1);
    state.SetComplexityN(state.range(0));
}

BENCHMARK(patch_lu)->Name("BM_PatchLu")->Arg(8)->Arg(12)->Arg(16)->Arg(24)->Unit(benchmark::kMicrosecond);
BENCHMARK(patch_system)
    ->Name("BM_PatchSystem")
    ->Arg(8)
    ->Arg(12)
    ->Arg(16)
    ->Arg(24)
    ->Unit(benchmark::kMicrosecond)
    ->Complexity();
BENCHMARK(patch_steady)
    ->Name("BM_PatchSteady")
    ->Arg(8)
    ->Arg(12)
    ->Arg(16)
    ->Arg(24)
    ->Unit(benchmark::kMicrosecond)
    ->Complexity();

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
}
