// Patches from profiles.
// - BM_NormalContact/n: pressures on 2 n x n cells under Hertz's gap (a/b = 2.6), from nothing. Counter error: the
//   error of the peak pressure against Hertz.
// - BM_ProfilePatch/n: S1002 on 60E1 with 2 n x n cells over the contact, from the profiles to outline and pressures,
//   starting at the position 0.1 mm beside it; /0 from nothing at n = 20.
// - BM_VirtualPenetration/y: the same profiles at y tenths of a millimetre.
// Sample run: ./bench_normal --benchmark_filter=/20$
#include <limits>

#include <benchmark/benchmark.h>

#include <rollbem/normal/hertz.hpp>
#include <rollbem/normal/normal_contact.hpp>
#include <rollbem/normal/profile.hpp>
#include <rollbem/normal/virtual_penetration.hpp>
#include <rollbem/normal/wheel_on_rail.hpp>
#include <rollbem/vehicle/contact_table.hpp>
#include <rollbem/vehicle/creep_force_table.hpp>

namespace {

using namespace rollbem;

void BM_NormalContact(benchmark::State& state) {
    const auto n = static_cast<Eigen::Index>(state.range(0));
    constexpr double shear_modulus = 8.2e10, nu = 0.28, load = 1e5, along = 0.46, across = 0.1;
    const ElasticBody steel{2 * shear_modulus * (1 + nu), nu};
    const double infinite = std::numeric_limits<double>::infinity();
    const HertzEllipse hertz(
        {.load = load, .radii_1 = {along, infinite}, .radii_2 = {infinite, across}, .body_1 = steel, .body_2 = steel});
    const double a = 1.1 * hertz.half_length(), b = 1.1 * hertz.half_width();
    const double dx = a / double(n), dy = 2 * b / double(n);
    const NormalContact::Cells grid{.nx = 2 * n, .ny = n, .x_0 = -a + dx / 2, .y_0 = -b + dy / 2, .dx = dx, .dy = dy};
    Eigen::ArrayXXd gap(grid.nx, grid.ny);
    for (Eigen::Index j = 0; j < grid.ny; ++j) {
        for (Eigen::Index i = 0; i < grid.nx; ++i) {
            gap(i, j) = grid.x(i) * grid.x(i) / (2 * along) + grid.y(j) * grid.y(j) / (2 * across);
        }
    }
    NormalContact normal((1 - nu) / shear_modulus);
    NormalContact::Solution solution;
    for (auto _ : state) {
        solution = normal.carry(grid, gap, load);
        benchmark::DoNotOptimize(solution.approach);
    }
    state.counters["n"] = double(n);
    state.counters["steps"] = solution.steps;
    state.counters["relative_error"] = normal.pressure().maxCoeff() / hertz.peak_pressure() - 1;
}
BENCHMARK(BM_NormalContact)->Arg(10)->Arg(20)->Arg(40)->Arg(80)->Unit(benchmark::kMillisecond);

void BM_ProfilePatch(benchmark::State& state) {
    const bool fresh = state.range(0) == 0;
    const Eigen::Index n = fresh ? 20 : static_cast<Eigen::Index>(state.range(0));
    const WheelOnRail wheel(s1002(), rail_60e1());
    const WheelOnRail::Options options{.cells_x = 2 * n, .cells_s = n};
    WheelOnRail::Workspace workspace;
    int64_t k = 0;
    for (auto _ : state) {
        if (fresh) workspace = {};
        const double lateral = -4e-3 - 1e-4 * double(++k % 2);  // one lobe
        const auto contact = wheel.solve_for_load({.lateral = lateral, .yaw = 5e-3}, 1e5, workspace, options);
        if (contact.status != Status::ok) state.SkipWithError(name(contact.status));
        benchmark::DoNotOptimize(contact.height);
    }
    state.counters["n"] = double(n);
}
BENCHMARK(BM_ProfilePatch)->Arg(0)->Arg(10)->Arg(20)->Arg(40)->Unit(benchmark::kMillisecond);

/// Counter error: the error of the load, against the load of the cells.
void BM_VirtualPenetration(benchmark::State& state) {
    const WheelOnRail wheel(s1002(), rail_60e1());
    WheelOnRail::Workspace workspace;
    WheelsetPosition at{.lateral = double(state.range(0)) * 1e-4};
    const auto exact = wheel.solve_for_load(at, 1e5, workspace, {.cells_x = 80, .cells_s = 40});
    at.height = exact.height;
    double load = 0, expected = 0;
    for (const RailPatch& patch : exact.patches) expected += patch.load;
    for (auto _ : state) {
        load = 0;
        for (const VirtualPenetration& contact : virtual_penetration(wheel, at)) load += contact.load;
        benchmark::DoNotOptimize(load);
    }
    state.counters["error"] = load / expected - 1;
}
BENCHMARK(BM_VirtualPenetration)->Arg(-40)->Arg(30)->Arg(52)->Unit(benchmark::kMicrosecond);

/// With tangents if the argument is 1.
void BM_WheelsetLookUp(benchmark::State& state) {
    const CreepForceTable creep = CreepForceTable::read(ROLLBEM_TABLES "/steel.creep");
    const ContactTable contact = ContactTable::read(ROLLBEM_TABLES "/s1002_60e1.contact");
    int k = 0;
    for (auto _ : state) {
        const double lateral = 6e-3 * ((k++ * 7919 % 1001) / 500.0 - 1);
        const WheelsetSpeeds speeds{.forward = 30, .pitch_rate = -30 / 0.46, .lateral = 0.01, .yaw_rate = 0.01};
        for (const WheelsetSide side : {WheelsetSide::left, WheelsetSide::right}) {
            const WheelsetPosition at{.lateral = lateral, .yaw = lateral / 2};
            const WheelForces now = state.range(0) == 1 ? contact.look_up(creep, side, at, speeds, 1e5, 0.3)
                                                        : contact.forces(creep, side, at, speeds, 1e5, 0.3);
            if (now.status != Status::ok) state.SkipWithError(name(now.status));
            benchmark::DoNotOptimize(now.force[1]);
        }
    }
}
BENCHMARK(BM_WheelsetLookUp)->Arg(1)->Arg(0)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
