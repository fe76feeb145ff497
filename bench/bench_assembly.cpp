// Assembly of G' and G, compared with Eigen's LU solve of the same size and with a plain double loop over elements.
// Sample run: ./bench_assembly --benchmark_filter=/80$
#include <string>
#include <utility>

#include <benchmark/benchmark.h>

#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/spectral/chebyshev.hpp>
#include <rollbem/steady/steady.hpp>

#include "naive.hpp"

namespace {

using namespace rollbem;

const Contact contact = Contact::dimensionless(1000, 0.28);

Mesh<double> make_mesh(const std::string& name, Eigen::Index n) {
    return name == "cosine" ? cosine_mesh(n) : uniform_mesh(n);
}

Collocation make_scheme(const std::string& name) {
    return name == "uniform" ? Collocation{.alpha_L = 0, .alpha_T = 0.63} : Collocation{.alpha_L = 0.5, .alpha_T = 0.5};
}

template <class Kernel>
void assemble_gradient(benchmark::State& state, const std::string& mesh_name) {
    const Mesh<double> mesh = make_mesh(mesh_name, state.range(0));
    const Collocation scheme = make_scheme(mesh_name);
    const Kernel kernel = Kernel::longitudinal(contact);
    for (auto _ : state) benchmark::DoNotOptimize(assemble_G_prime(mesh, scheme, kernel));
    state.counters["n"] = static_cast<double>(state.range(0));
}

template <class Kernel>
void assemble_both(benchmark::State& state, const std::string& mesh_name) {
    const Mesh<double> mesh = make_mesh(mesh_name, state.range(0));
    const Collocation scheme = make_scheme(mesh_name);
    const Kernel kernel = Kernel::longitudinal(contact);
    for (auto _ : state) {
        benchmark::DoNotOptimize(assemble_G(mesh, scheme, kernel));
        benchmark::DoNotOptimize(assemble_G_prime(mesh, scheme, kernel));
    }
    state.counters["n"] = static_cast<double>(state.range(0));
}

template <class Kernel>
void galerkin_gradient(benchmark::State& state) {
    const Mesh<double> mesh = uniform_mesh(state.range(0));
    const Kernel kernel = Kernel::longitudinal(contact);
    const Galerkin scheme{.alpha_L = 0, .alpha_T = 0.63};
    for (auto _ : state) benchmark::DoNotOptimize(assemble_G_prime(mesh, scheme, kernel));
    state.counters["n"] = static_cast<double>(state.range(0));
}

enum class KernelName { strip, plane };

template <class Function>
auto with_naive_kernel(KernelName kernel, const Function& function) {
    const double b = contact.aspect(), nu = contact.poisson_ratio();
    return kernel == KernelName::strip ? function([=](double x) { return naive::strip_H(x, b, nu); })
                                       : function([=](double x) { return naive::plane_H(x, b, nu); });
}

void naive_gradient(benchmark::State& state, const std::string& mesh_name, KernelName kernel) {
    const Mesh<double> mesh = make_mesh(mesh_name, state.range(0));
    const Collocation scheme = make_scheme(mesh_name);
    for (auto _ : state) {
        benchmark::DoNotOptimize(
            with_naive_kernel(kernel, [&](const auto& H) { return naive::G_prime(mesh, scheme, H); }));
    }
    state.counters["n"] = static_cast<double>(state.range(0));
}

void naive_both(benchmark::State& state, const std::string& mesh_name, KernelName kernel) {
    const Mesh<double> mesh = make_mesh(mesh_name, state.range(0));
    const Collocation scheme = make_scheme(mesh_name);
    for (auto _ : state) {
        benchmark::DoNotOptimize(with_naive_kernel(kernel, [&](const auto& H) {
            return std::pair{naive::G(mesh, scheme, H), naive::G_prime(mesh, scheme, H)};
        }));
    }
    state.counters["n"] = static_cast<double>(state.range(0));
}

void lu_solve(benchmark::State& state) {
    const MatrixX<double> G_prime =
        assemble_G_prime(uniform_mesh(state.range(0)), Collocation{.alpha_L = 0, .alpha_T = 0.63},
                         StripKernel<double>::longitudinal(contact));
    const VectorX<double> ones = VectorX<double>::Ones(G_prime.rows());
    for (auto _ : state) {
        const Eigen::PartialPivLU<MatrixX<double>> lu(G_prime);
        benchmark::DoNotOptimize(VectorX<double>(lu.solve(ones)));
    }
    state.counters["n"] = static_cast<double>(state.range(0));
}

/// The whole system of m Chebyshev states, to compare with BM_LU.
template <class Kernel>
void chebyshev_system(benchmark::State& state, double aspect) {
    const Kernel kernel = Kernel::longitudinal(Contact::dimensionless(aspect, contact.poisson_ratio()));
    const Chebyshev method{.states = state.range(0)};
    for (auto _ : state) benchmark::DoNotOptimize(rolling_system(method, kernel));
    state.counters["n"] = static_cast<double>(state.range(0));
}

void register_all() {
    for (const std::string mesh : {"uniform", "kalker", "cosine"}) {
        const auto sizes = [](benchmark::internal::Benchmark* bench) {
            for (const int n : {20, 40, 80, 160, 320}) bench->Arg(n);
        };
        const auto name = [&](const std::string& family, const std::string& kernel) {
            // equal alphas on a uniform mesh: Toeplitz
            return "BM_" + family + (mesh == "kalker" ? "Toeplitz/uniform/" : "/" + mesh + "/") + kernel;
        };
        benchmark::RegisterBenchmark(name("AssembleGradient", "plane").c_str(), assemble_gradient<PlaneKernel<double>>,
                                     mesh)
            ->Apply(sizes);
        benchmark::RegisterBenchmark(name("AssembleGradient", "strip").c_str(), assemble_gradient<StripKernel<double>>,
                                     mesh)
            ->Apply(sizes);
        benchmark::RegisterBenchmark(name("AssembleBoth", "plane").c_str(), assemble_both<PlaneKernel<double>>, mesh)
            ->Apply(sizes);
        benchmark::RegisterBenchmark(name("AssembleBoth", "strip").c_str(), assemble_both<StripKernel<double>>, mesh)
            ->Apply(sizes);
        for (const auto& [kernel, kernel_name] :
             {std::pair{KernelName::plane, "plane"}, {KernelName::strip, "strip"}}) {
            benchmark::RegisterBenchmark(name("AssembleGradientNaive", kernel_name).c_str(), naive_gradient, mesh,
                                         kernel)
                ->Apply(sizes);
            benchmark::RegisterBenchmark(name("AssembleBothNaive", kernel_name).c_str(), naive_both, mesh, kernel)
                ->Apply(sizes);
        }
    }
    benchmark::RegisterBenchmark("BM_AssembleGradientGalerkin/uniform/plane", galerkin_gradient<PlaneKernel<double>>)
        ->Arg(80)
        ->Arg(160);
    benchmark::RegisterBenchmark("BM_AssembleGradientGalerkin/uniform/strip", galerkin_gradient<StripKernel<double>>)
        ->Arg(80)
        ->Arg(160);
    const auto plane = [](benchmark::State& state) { chebyshev_system<PlaneKernel<double>>(state, contact.aspect()); };
    const auto strip = [](benchmark::State& state) { chebyshev_system<StripKernel<double>>(state, 1); };
    benchmark::RegisterBenchmark("BM_ChebyshevSystem", plane)->Arg(8)->Arg(12)->Arg(24)->Arg(80);
    benchmark::RegisterBenchmark("BM_ChebyshevSystemStrip", strip)->Arg(8)->Arg(12)->Arg(24)->Arg(80);
    benchmark::RegisterBenchmark("BM_LU", lu_solve)->Arg(20)->Arg(40)->Arg(80)->Arg(160)->Arg(320);
}

}  // namespace

int main(int argc, char** argv) {
    register_all();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
}
