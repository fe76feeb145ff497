// The whole computation of c11, with its error: element schemes including the mesh, Chebyshev states, the polynomial
// approach and the closed form. Baselines are a plain double loop over elements with LU, and monomials.
// Sample run: ./bench_precision --benchmark_filter='Recommended|Polynomial'
#include <cmath>
#include <complex>

#include <Eigen/LU>
#include <benchmark/benchmark.h>

#include <rollbem/accuracy/recommendation.hpp>
#include <rollbem/closed_form/carter.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/reference/bessel.hpp>
#include <rollbem/spectral/chebyshev.hpp>
#include <rollbem/steady/steady.hpp>

#include "naive.hpp"
#include "studies/monomial.hpp"

namespace {

using namespace rollbem;
using namespace rollbem::studies;
using Complex = std::complex<double>;

constexpr double nu = 0.28, aspect = 1000;
const PlaneKernel<double> kernel(aspect, 1 - nu, nu);
constexpr Collocation halves{.alpha_L = 0.5, .alpha_T = 0.5};

double error(double c11) { return c11 / steady_c11(nu) - 1; }
double error(Complex c11, double z) { return std::abs(c11 / reference::plane_c11({0, z}, nu, aspect) - 1.0); }

template <class Compute>
void measure(benchmark::State& state, double n, const Compute& compute) {
    double c11 = 0;
    for (auto _ : state) benchmark::DoNotOptimize(c11 = compute());
    state.counters["n"] = n;
    state.counters["relative_error"] = error(c11);
}

template <class MakeMesh>
void richardson_c11(benchmark::State& state, double order, const MakeMesh& make_mesh) {
    const Eigen::Index n = state.range(0);
    measure(state, static_cast<double>(n), [&] {
        const double coarse = solve_steady(make_mesh(n / 2), halves, kernel).c11();
        return richardson(coarse, solve_steady(make_mesh(n), halves, kernel).c11(), order);
    });
}
void BM_RichardsonUniform(benchmark::State& state) {
    richardson_c11(state, 1, [](Eigen::Index n) { return uniform_mesh(n); });
}
void BM_RichardsonCosine(benchmark::State& state) {
    richardson_c11(state, 2, [](Eigen::Index n) { return cosine_mesh(n); });
}
BENCHMARK(BM_RichardsonUniform)->Arg(16)->Arg(40)->Arg(80)->Arg(160);
BENCHMARK(BM_RichardsonCosine)->Arg(14)->Arg(40)->Arg(80)->Arg(160);

const auto c11_of = [](const auto&... method) { return solve_steady(method..., kernel).c11(); };

// Argument: the number of digits requested, for a kernel whose aspect is not given.
void BM_Recommended(benchmark::State& state) {
    const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
    const Eigen::Index m = recommended_scheme(tolerance, Purpose::steady).scheme.states;
    measure(state, static_cast<double>(m),
            [&] { return recommended_scheme(tolerance, Purpose::steady).evaluate(c11_of); });
}
BENCHMARK(BM_Recommended)->DenseRange(2, 8);

// The same with elements.
void BM_RecommendedElements(benchmark::State& state) {
    const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
    const Eigen::Index n = recommended_elements(tolerance, Purpose::steady).n;
    measure(state, static_cast<double>(n),
            [&] { return recommended_elements(tolerance, Purpose::steady).evaluate(c11_of); });
}
BENCHMARK(BM_RecommendedElements)->DenseRange(2, 8);

// The plain implementation of Kalker's scheme: four antiderivatives per entry, and LU of the full matrix.
void BM_Naive(benchmark::State& state) {
    const Eigen::Index n = state.range(0);
    measure(state, static_cast<double>(n), [&] {
        const Mesh<double> mesh = uniform_mesh(n);
        const MatrixX<double> G_prime =
            naive::G_prime(mesh, halves, [](double x) { return naive::plane_H(x, aspect, nu); });
        const Eigen::PartialPivLU<MatrixX<double>> lu(G_prime);
        const VectorX<double> traction = lu.solve(VectorX<double>::Ones(n));
        return -mesh.widths().matrix().dot(traction);
    });
}
BENCHMARK(BM_Naive)->Arg(16)->Arg(40)->Arg(80)->Arg(160);

// Complex c11 at omega a/V = 1. Argument: the order.
void BM_Polynomial(benchmark::State& state) {
    EstimatedC11<double> solution{};
    for (auto _ : state) benchmark::DoNotOptimize(solution = polynomial_c11(Complex(0, 1), nu, aspect, state.range(0)));
    state.counters["n"] = static_cast<double>(state.range(0));
    state.counters["relative_error"] = error(solution.c11, 1);
}
BENCHMARK(BM_Polynomial)->Arg(5)->Arg(10)->Arg(20)->Arg(34)->Arg(80);

// The same with the default order.
void BM_PolynomialDefault(benchmark::State& state) {
    EstimatedC11<double> solution{};
    for (auto _ : state) benchmark::DoNotOptimize(solution = polynomial_c11(Complex(0, 1), nu, aspect));
    state.counters["n"] = static_cast<double>(default_polynomial_order(Complex(0, 1)));
    state.counters["relative_error"] = error(solution.c11, 1);
}
BENCHMARK(BM_PolynomialDefault);

// The monomials of the paper.
void BM_PolynomialMonomial(benchmark::State& state) {
    PolynomialSolution<double> solution{};
    for (auto _ : state) benchmark::DoNotOptimize(solution = solve_monomial(Complex(0, 1), nu, aspect, state.range(0)));
    state.counters["n"] = static_cast<double>(state.range(0));
    state.counters["relative_error"] = error(solution.c11, 1);
}
BENCHMARK(BM_PolynomialMonomial)->Arg(5)->Arg(10)->Arg(20);

// Bessel functions of GSL; the error is the difference from the polynomial approach.
void BM_ClosedForm(benchmark::State& state) {
    Complex c11 = 0;
    for (auto _ : state) benchmark::DoNotOptimize(c11 = reference::plane_c11({0, 1}, nu, aspect));
    state.counters["n"] = 0;
    state.counters["relative_error"] = error(polynomial_c11(Complex(0, 1), nu, aspect).c11, 1);
}
BENCHMARK(BM_ClosedForm);

}  // namespace

BENCHMARK_MAIN();
