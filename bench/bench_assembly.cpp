// Assembly of G' and G beside Eigen's LU solve of the same size and beside the plain double loop over elements.
// Sample run: ./bench_assembly --benchmark_filter=/80$
#include <cmath>
#include <limits>
#include <string>

#include <benchmark/benchmark.h>

#include <rollbem/assembly/influence.hpp>
#include <rollbem/problem/steady.hpp>

namespace {

using namespace rollbem;

const Contact<double> contact = Contact<double>::dimensionless(1000, 0.28);

// The plain way: four antiderivatives for every entry of an fd G', one at a time.
MatrixX<double> naive_G_prime(const Mesh<double>& mesh, const Collocation& scheme, double b, double nu) {
    const double pi = 3.14159265358979323846;
    const auto H = [=](double x) {
        return x == 0 ? 0 : 2 / pi * ((1 - nu) * x * std::asinh(b / std::abs(x)) + b * std::asinh(x / b));
    };
    const ArrayX<double> alpha = interpolate_alpha(mesh, scheme.alpha_L, scheme.alpha_T);
    const Eigen::Index n = mesh.size();
    MatrixX<double> G_prime(n, n);
    for (Eigen::Index l = 0; l < n; ++l) {
        const double width = mesh.widths()[l];
        for (Eigen::Index m = 0; m < n; ++m) {
            const double d = mesh.centres()[l] + alpha[l] * width - mesh.centres()[m];
            const double h = mesh.widths()[m] / 2;
            const auto u = [&](double x) { return H(x + h) - H(x - h); };
            G_prime(l, m) = (u(d + width / 2) - u(d - width / 2)) / width;
        }
    }
    return G_prime;
}

Mesh<double> make_mesh(const std::string& name, Eigen::Index n) {
    return name == "cosine" ? cosine_mesh(n) : uniform_mesh(n);
}

Collocation make_scheme(const std::string& name) {
    return name == "uniform" ? Collocation{} : Collocation{.alpha_L = 0.5, .alpha_T = 0.5};
}

template <class Kernel>
void assemble_gradient(benchmark::State& state, const std::string& mesh_name) {
    const Mesh<double> mesh = make_mesh(mesh_name, state.range(0));
    const Collocation scheme = make_scheme(mesh_name);
    const Kernel kernel = Kernel::longitudinal(contact);
    for (auto _ : state) benchmark::DoNotOptimize(assemble_G_prime(mesh, scheme, kernel));
    state.counters["n"] = static_cast<double>(state.range(0));
    state.SetComplexityN(state.range(0));
}

template <class Kernel>
void assemble_both(benchmark::State& state, const std::string& mesh_name) {
    const Mesh<double> mesh = make_mesh(mesh_name, state.range(0));
    const Collocation scheme = make_scheme(mesh_name);
    const Kernel kernel = Kernel::longitudinal(contact);
    for (auto _ : state) benchmark::DoNotOptimize(assemble(mesh, scheme, kernel));
    state.counters["n"] = static_cast<double>(state.range(0));
    state.SetComplexityN(state.range(0));
}

void galerkin_gradient(benchmark::State& state) {
    const Mesh<double> mesh = uniform_mesh(state.range(0));
    const StripKernel<double> kernel = StripKernel<double>::longitudinal(contact);
    for (auto _ : state) benchmark::DoNotOptimize(assemble_G_prime(mesh, Galerkin{}, kernel));
    state.counters["n"] = static_cast<double>(state.range(0));
}

void naive_gradient(benchmark::State& state, const std::string& mesh_name) {
    const Mesh<double> mesh = make_mesh(mesh_name, state.range(0));
    const Collocation scheme = make_scheme(mesh_name);
    for (auto _ : state) {
        benchmark::DoNotOptimize(naive_G_prime(mesh, scheme, contact.aspect(), contact.poisson_ratio()));
    }
    state.counters["n"] = static_cast<double>(state.range(0));
}

void lu_solve(benchmark::State& state) {
    const MatrixX<double> G_prime =
        assemble_G_prime(uniform_mesh(state.range(0)), Collocation{}, StripKernel<double>::longitudinal(contact));
    const VectorX<double> ones = VectorX<double>::Ones(G_prime.rows());
    for (auto _ : state) {
        const Eigen::PartialPivLU<MatrixX<double>> lu(G_prime);
        benchmark::DoNotOptimize(VectorX<double>(lu.solve(ones)));
    }
    state.counters["n"] = static_cast<double>(state.range(0));
    state.SetComplexityN(state.range(0));
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
        benchmark::RegisterBenchmark(name("AssembleGradientNaive", "strip").c_str(), naive_gradient, mesh)
            ->Apply(sizes);
    }
    benchmark::RegisterBenchmark("BM_AssembleGradientGalerkin/uniform/strip", galerkin_gradient)->Arg(80)->Arg(160);
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
