// A wheel with spin over a corrugated rail, in SI units: the load varies by half, the ellipse grows and shrinks with
// it, and so does the mesh. The slip work of the elements is a map of the wear over the patch. Over a whole wave it is
// the work of the forces, to second order in 1/n.
//
//     ./examples/corrugated_patch
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numbers>

#include <rollbem/normal/hertz.hpp>
#include <rollbem/rollbem.hpp>

namespace {

using namespace rollbem;

constexpr double mean_load = 8e4, wave = 50e-3, modulus = 2.1e11, poisson = 0.28;  // [N], [m], [Pa], [-]
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr Creepage creepage{1e-3, 5e-4, 0.15};  // spin [1/m]

/// The share of the heat that the work of the forces does not account for, with n x n elements; infinite if a step
/// fails.
double ride(Eigen::Index n, int steps_per_wave) {
    // 1. The ellipse under the mean load, and a system that breathes: a/b stays
    const ElasticBody steel{modulus, poisson};
    const HertzEllipse ellipse(
        {.load = mean_load, .radii_1 = {0.46, infinite}, .radii_2 = {infinite, 0.3}, .body_1 = steel, .body_2 = steel});
    const PatchContact contact = ellipse.contact();
    const PatchMesh<double> mesh = patch_mesh(contact, n, n);
    const NodeDifference scheme{Nodes::chebyshev};
    const HalfSpace<double> kernel(poisson);
    const auto hertz = HertzEllipse::Load::breathing(ellipse, contact, mesh);
    NormalLoad load = hertz.at(mean_load);
    const FrictionModel model(contact, breathing_system(contact, mesh, scheme, kernel),
                              judge_stability(patch_subsystems(mesh, scheme, kernel)), {0.3, load.normal_pressure});

    // 2. Two waves to forget the start, and one to look at
    Run run(model);
    VectorX<double> wear = VectorX<double>::Zero(mesh.size());  // [J]
    double work = 0, power = 0, elastic = 0, least = infinite, largest = 0;
    for (int k = 1; k <= 3 * steps_per_wave; ++k) {
        const double dq = wave / steps_per_wave;
        if (k == 2 * steps_per_wave + 1) elastic = model.elastic_energy(run.now());
        hertz.set(mean_load * (1 + 0.5 * std::sin(2 * std::numbers::pi * k / steps_per_wave)), load);
        const FrictionStep step = run.advance({dq, creepage, load});
        if (step.status != Status::ok) return infinite;
        const auto& [F_x, F_y, M_z] = step.force;
        const double before = power;  // [J/m]
        power = -(F_x * creepage.longitudinal + F_y * creepage.lateral + M_z * creepage.spin);
        if (k <= 2 * steps_per_wave) continue;
        work += dq * (before + power) / 2;
        wear += run.workspace().slip_work();
        least = std::min(least, -F_x);
        largest = std::max(largest, -F_x);
    }
    const double heat = wear.sum(), gap = (work - heat - (model.elastic_energy(run.now()) - elastic)) / heat;

    // 3. Strips of y from -b to b, each from the trailing to the leading edge
    std::printf("%d x %d: -F_x from %.0f to %.0f N, heat %.4f J of a wave, gap %.1e; its percent in each element\n",
                int(n), int(n), least, largest, heat, gap);
    for (Eigen::Index i = 0; i < mesh.size(); ++i) {
        std::printf("%6.2f%s", 100 * wear[i] / heat, (i + 1) % n == 0 ? "\n" : "");
    }
    return std::abs(gap);
}

}  // namespace

int main() {
    const double coarse = ride(6, 50), fine = ride(12, 50);
    return fine < 0.03 && fine < coarse / 3 ? EXIT_SUCCESS : EXIT_FAILURE;
}
