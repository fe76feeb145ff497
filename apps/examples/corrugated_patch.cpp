// A wheel with spin over a corrugated rail, in SI units: the load varies by half, the ellipse grows and shrinks with it,
// and so does the mesh. The slip work of the elements is a map of the wear over the patch; over whole waves it balances
// with the work of the forces.
//
//     ./examples/corrugated_patch
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <utility>

#include <rollbem/normal/hertz_patch_load.hpp>
#include <rollbem/rollbem.hpp>

int main() {
    using namespace rollbem;
    constexpr double mean_load = 8e4, wave = 50e-3, modulus = 2.1e11, poisson = 0.28;  // [N], [m], [Pa], [-]
    constexpr double infinite = std::numeric_limits<double>::infinity();
    constexpr Creepage<double> creepage{1e-3, 5e-4, 0.15};  // spin [1/m]
    constexpr int steps_per_wave = 100;

    // 1. The ellipse under the mean load, and a system that breathes: a/b stays
    const ElasticBody<double> steel{modulus, poisson};
    const HertzEllipse<double> ellipse(
        {.load = mean_load, .radii_1 = {0.46, infinite}, .radii_2 = {infinite, 0.3}, .body_1 = steel, .body_2 = steel});
    const PatchContact<double> contact({.half_length = ellipse.half_length(),
                                        .half_width = ellipse.half_width(),
                                        .shear_modulus = modulus / 2 / (1 + poisson),
                                        .poisson_ratio = poisson});
    const PatchMesh<double> mesh = patch_mesh(contact, 8, 8);
    const NodeDifference scheme{Nodes::chebyshev};
    const HalfSpace<double> kernel(poisson);
    const auto hertz = HertzPatchLoad<double>::breathing(ellipse, contact, mesh);
    NormalLoad<double> load = hertz.at(mean_load);
    const FrictionModel model(contact, breathing_system(contact, mesh, scheme, kernel),
                              judge_stability(patch_parts(mesh, scheme, kernel)), {0.3, load.normal_pressure});

    // 2. Two waves to forget the start, and one to look at
    auto workspace = model.workspace();
    auto now = model.at_rest(), next = now;
    VectorX<double> wear = VectorX<double>::Zero(mesh.size());  // [J]
    double heat = 0, work = 0, elastic = 0, power = 0, least = infinite, largest = 0;
    for (int k = 1; k <= 3 * steps_per_wave; ++k) {
        const double dq = wave / steps_per_wave;
        if (k == 2 * steps_per_wave + 1) elastic = model.elastic_energy(now);
        hertz.set(mean_load * (1 + 0.5 * std::sin(2 * std::numbers::pi * k / steps_per_wave)), load);
        const FrictionStep<2> step = model.advance(now, dq, creepage, load, next, workspace);
        if (step.status != StepStatus::ok) return EXIT_FAILURE;
        const double before = std::exchange(
            power, -(step.force.longitudinal * creepage.longitudinal + step.force.lateral * creepage.lateral +
                     step.force.moment * creepage.spin));  // [J/m]
        std::swap(now, next);
        if (k <= 2 * steps_per_wave) continue;
        heat += step.slip_work;
        work += dq * (before + power) / 2;
        wear += workspace.slip_work();
        least = std::min(least, step.force.longitudinal);
        largest = std::max(largest, step.force.longitudinal);
    }
    elastic = model.elastic_energy(now) - elastic;

    // 3. Strip by strip, from the trailing to the leading edge
    std::printf("F_x from %.0f to %.0f N, heat %.4f J, gap %.1e\n", largest, least, heat,
                (work - heat - elastic) / heat);
    std::printf("share of the heat in each element, percent; rolling to the right\n");
    for (Eigen::Index j = 0; j < 8; ++j) {
        for (Eigen::Index i = 0; i < 8; ++i) std::printf("%6.2f", 100 * wear[8 * j + i] / heat);
        std::printf("\n");
    }
    const bool adds_up = std::abs(wear.sum() / heat - 1) < 1e-12;
    return adds_up && std::abs(work - heat - elastic) < 3e-2 * heat ? EXIT_SUCCESS : EXIT_FAILURE;
}
