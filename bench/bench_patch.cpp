// Contact patches of n x n elements: G and G' of the joined system, steady creep coefficients by subsystems, and for
// comparison one LU decomposition of all 2 n^2 unknowns. Counter error: the error of c11 at a/b = 1, nu = 0.25.
// - BM_PatchFriction solves for stick and slip from rest, matrices ready, in the mean over nine creepages. Counter
//   error: the largest error of F_y over mu N under creepage, spin, and both, against limits at nu = 0.28.
// - BM_PatchCreepCurve solves along a curve up to full sliding, each point from the one before.
// - Counter LU of both: processor time of one solution over the time of one LU decomposition.
// - BM_CreepTable looks forces up in a table, BM_SimplifiedTheory computes them by strips.
// Sample run: ./bench_patch --benchmark_filter=/12$
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <Eigen/LU>
#include <benchmark/benchmark.h>

#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/closed_form/carter.hpp>
#include <rollbem/elasticity/patch_kernel.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/normal/load.hpp>
#include <rollbem/steady/creep_coefficients.hpp>
#include <rollbem/steady/steady.hpp>
#include <rollbem/vehicle/creep_force_table.hpp>
#include <rollbem/vehicle/simplified_theory.hpp>

namespace {

using namespace rollbem;

constexpr NodeDifference scheme{Nodes::chebyshev};
const PatchContact contact = PatchContact::dimensionless(1, 0.25);
const HalfSpace<double> kernel(0.25);

// with friction
const PatchContact circle = PatchContact::dimensionless(1, 0.28);
const HalfSpace<double> steel(0.28);

FrictionModel steady_model(const PatchMesh<double>& mesh) {
    return {circle, steady_system(mesh, scheme, steel), {1.0, hertz_pressures(circle, mesh, 1)}};
}

void BM_PatchLu(benchmark::State& state) {
    const PatchMesh<double> mesh = patch_mesh(contact, state.range(0), state.range(0));
    const MatrixX<double> G_prime = rolling_system(mesh, scheme, kernel).joined().G_prime();
    for (auto _ : state) benchmark::DoNotOptimize(Eigen::PartialPivLU<MatrixX<double>>(G_prime));
}

/// Processor time so far [us].
double now_us() { return 1e6 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Counters of `count` solutions an iteration, all of which took `elapsed` [us].
void count_solutions(benchmark::State& state, const PatchMesh<double>& mesh, double elapsed, int count) {
    constexpr int repetitions = 5;
    const MatrixX<double> whole = detail::joined(assemble_G_prime(mesh, scheme, kernel));
    const double start = now_us();
    for (int k = 0; k < repetitions; ++k) benchmark::DoNotOptimize(Eigen::PartialPivLU<MatrixX<double>>(whole));
    const double of_one = elapsed / static_cast<double>(state.iterations() * count);
    state.counters["us_of_one"] = of_one;
    state.counters["LU"] = of_one * repetitions / (now_us() - start);
}

void BM_PatchSystem(benchmark::State& state) {
    const PatchMesh<double> mesh = patch_mesh(contact, state.range(0), state.range(0));
    for (auto _ : state) benchmark::DoNotOptimize(rolling_system(mesh, scheme, kernel));
    state.SetComplexityN(state.range(0));
}

void BM_PatchSteady(benchmark::State& state) {
    const PatchMesh<double> mesh = patch_mesh(contact, state.range(0), state.range(0));
    double c11 = 0;
    for (auto _ : state) {
        c11 = solve_steady(contact, mesh, scheme, kernel).c11();
        benchmark::ClobberMemory();
    }
    state.counters["error"] = std::abs(c11 / 4.111 - 1);
    state.SetComplexityN(state.range(0));
}

void BM_PatchFriction(benchmark::State& state) {
    struct Point {
        double eta, phi, lateral_force;  ///< over mu N/(G a^2), with a for phi; over -mu N in the limit
    };
    const double eta = 1 / 3.7049, phi = 1 / 1.4881, both = std::sqrt(0.5);
    const std::array<Point, 9> points{{{0.4 * eta, 0, 0.35213},
                                       {eta, 0, 0.71638},
                                       {2.5 * eta, 0, 0.99916},
                                       {0, 0.4 * phi, 0.37446},
                                       {0, phi, 0.60539},
                                       {0, 2.5 * phi, 0.38034},
                                       {0.4 * both * eta, 0.4 * both * phi, 0.50366},
                                       {both * eta, both * phi, 0.84704},
                                       {2.5 * both * eta, 2.5 * both * phi, 0.75458}}};
    const PatchMesh<double> mesh = patch_mesh(circle, state.range(0), state.range(0));
    const auto model = steady_model(mesh);
    auto workspace = model.workspace();
    const auto rest = model.at_rest();
    auto solved = rest;
    double error = 0, rounds = 0;
    const double start = now_us();
    for (auto _ : state) {
        rounds = 0;
        for (const Point& point : points) {
            const FrictionStep step = model.steady(rest, {.motion = {0, point.eta, point.phi}}, solved, workspace);
            error = std::max(error, std::abs(-step.force.lateral - point.lateral_force));
            rounds += step.rounds / 9.0;
        }
    }
    count_solutions(state, mesh, now_us() - start, 9);
    state.counters["error"] = error;
    state.counters["rounds"] = rounds;
    state.SetComplexityN(state.range(0));
}

void BM_PatchCreepCurve(benchmark::State& state) {
    constexpr int points = 30;
    const PatchMesh<double> mesh = patch_mesh(circle, state.range(0), state.range(0));
    const auto model = steady_model(mesh);
    auto workspace = model.workspace();
    auto now = model.at_rest(), next = now;
    const double start = now_us();
    for (auto _ : state) {
        now = model.at_rest();
        for (int k = 1; k <= points; ++k) {
            const double level = 2.5 * k / points;
            benchmark::DoNotOptimize(
                model.steady(now, {.motion = {level / 4.2262, level / 3.7049, 0.3 * level / 1.4881}}, next, workspace));
            std::swap(now, next);
        }
    }
    count_solutions(state, mesh, now_us() - start, points);
    state.SetComplexityN(state.range(0));
}

/// A look-up in a table of the default size, tangent included; its forces approach full sliding linearly.
void BM_CreepTable(benchmark::State& state) {
    constexpr int shapes = 13, levels = 19;
    const CreepCoefficients<double> c{4.1, 3.7, 1.5, -1.5, 1.2};
    const CreepForceTable::Grid grid(0.28, 0.1, 10, levels, std::vector<CreepCoefficients<double>>(shapes, c));
    Eigen::Array3Xd forces(3, grid.nodes() * shapes);
    for (Eigen::Index i = 0; i < forces.cols(); ++i) {
        const Eigen::Index shape = i / grid.nodes();
        const Creepage v = grid.creepage(shape, i % grid.nodes());
        const double size = std::hypot(v.longitudinal, v.lateral, v.spin);
        const auto full = full_sliding(grid.a_over_b(shape), v.longitudinal, v.lateral, v.spin);
        forces.col(i) = size / (1 + size) * Eigen::Array3d(full.longitudinal, full.lateral, full.moment);
    }
    const CreepForceTable table(grid, forces);
    // ellipses and creepages all over the table, or of a vehicle's eight contacts
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<PatchContact> contacts;
    std::vector<Creepage> creepages;
    for (int i = 0; i < state.range(0); ++i) {
        const double root = std::pow(10, uniform(random) / 2);
        contacts.push_back(PatchContact({5e-3 * root, 5e-3 / root, 8e10, 0.28}));
        creepages.push_back({3e-3 * uniform(random), 3e-3 * uniform(random), uniform(random)});
    }
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(table.look_up(contacts[i], 0.3, 8e4, creepages[i]));
        i = i + 1 == contacts.size() ? 0 : i + 1;
    }
}

// The forces of a contact under creepages and spin by FASTSIM (0) and by FaStrip (1), n strips of n elements.
void BM_SimplifiedTheory(benchmark::State& state) {
    const bool by_strips = state.range(0) == 1;
    const int n = static_cast<int>(state.range(1));
    const SimplifiedTheory theory(circle, {4.2, 3.7, 1.5, -1.5, 1.2}, 1, 1, {n, n});
    const Creepage creepage{0.14, 0.1, 0.2};
    for (auto _ : state) {
        benchmark::DoNotOptimize(by_strips ? theory.fastrip(creepage) : theory.fastsim(creepage));
    }
}

// A step of sdirk2 under a load that varies, tangents included: 0 on a fixed mesh, 1 with semi-axes in proportion, 2
// with a new a/b as well.
void BM_PatchStep(benchmark::State& state) {
    const Eigen::Index n = state.range(0);
    const std::int64_t follows = state.range(1);
    const PatchMesh<double> mesh = patch_mesh(circle, n, n);
    const ElementSystem<double, 2> system =
        follows == 0   ? rolling_system(mesh, scheme, steel)
        : follows == 1 ? breathing_system(circle, mesh, scheme, steel)
                       : PatchShapes<double>(n, n, scheme, steel, {.least = 0.4, .largest = 2.5}).system(1);
    const ArrayX<double> pressure = hertz_pressures(circle, mesh, 1);
    const FrictionModel model(circle, system, unchecked, {1.0, pressure});
    auto workspace = model.workspace();
    auto now = model.at_rest(), next = now;
    NormalLoad load{pressure, 1, pressure, 1};
    double q = 0, rounds = 0, steps = 0;
    for (auto _ : state) {
        q += 0.2;
        const double size = std::cbrt(1 + 0.5 * std::sin(std::numbers::pi / 4 * q));
        load.normal_pressure = size * pressure;
        if (follows > 0) load.half_length = load.half_width = size;
        if (follows > 1) load.half_width *= 1 + 0.5 * std::sin(0.3 * q);
        const FrictionStep step = model.advance(now, {0.2, {{0.14, 0.1, 0.2}}, load}, next, workspace);
        if (step.status != Status::ok) {
            state.SkipWithError("a step failed");
            break;
        }
        std::swap(now, next);
        rounds += step.rounds;
        ++steps;
    }
    state.counters["rounds"] = rounds / steps;
}

BENCHMARK(BM_PatchStep)
    ->ArgNames({"n", "follows"})
    ->ArgsProduct({{6, 8, 12}, {0, 1, 2}})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(BM_PatchLu)->ArgsProduct({{6, 8, 12, 16, 24}})->Unit(benchmark::kMicrosecond);
BENCHMARK(BM_PatchSystem)->ArgsProduct({{8, 12, 16, 24}})->Unit(benchmark::kMicrosecond)->Complexity();
BENCHMARK(BM_PatchSteady)->ArgsProduct({{8, 12, 16, 24}})->Unit(benchmark::kMicrosecond)->Complexity();
BENCHMARK(BM_PatchFriction)->ArgsProduct({{8, 12, 16, 24}})->Unit(benchmark::kMicrosecond)->Complexity();
BENCHMARK(BM_PatchCreepCurve)->ArgsProduct({{8, 12, 16}})->Unit(benchmark::kMicrosecond)->Complexity();
BENCHMARK(BM_SimplifiedTheory)->ArgNames({"fastrip", "n"})->ArgsProduct({{0, 1}, {10, 12, 20, 40}});
BENCHMARK(BM_CreepTable)->ArgName("contacts")->Arg(8)->Arg(4096);

}  // namespace

BENCHMARK_MAIN();
