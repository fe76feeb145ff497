// A wheel rolls onto a rail of another profile, in SI units: within 20 half-lengths the head becomes so round that the
// ellipse, first short and wide, is long and narrow. One set of systems over a/b, made once, serves all of them.
//
//     ./examples/rail_profile
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include <rollbem/normal/hertz.hpp>
#include <rollbem/rollbem.hpp>

namespace {

using namespace rollbem;

constexpr double modulus = 2.1e11, poisson = 0.28, load = 8e4;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// The ellipse after a part of the change, 0 ... 1: the radius of the head falls from 1.3 m to 0.16 m.
HertzEllipse ellipse(double part) {
    const ElasticBody steel{modulus, poisson};
    return HertzEllipse({.load = load,
                         .radii_1 = {0.46, infinite},
                         .radii_2 = {infinite, 1.3 * std::pow(0.16 / 1.3, part)},
                         .body_1 = steel,
                         .body_2 = steel});
}

}  // namespace

int main() {
    // 1. A model that starts as the first ellipse
    const HertzEllipse first = ellipse(0), last = ellipse(1);
    const PatchContact contact = first.contact();
    const PatchMesh<double> mesh = patch_mesh(contact, 8, 8);
    const PatchShapes<double> shapes(8, 8, NodeDifference{Nodes::chebyshev}, HalfSpace<double>(poisson),
                                     {.least = 0.45, .largest = 2.2, .factor = 1.5});
    const auto hertz = HertzEllipse::Load::breathing(first, contact, mesh);
    NormalLoad normal = hertz.at(load);
    const FrictionModel model(contact, shapes.system(contact.a_over_b()), judge_stability(shapes),
                              {0.3, normal.normal_pressure});
    Run run(model);

    // 2. From steady rolling over the change of profile, and on
    constexpr Creepage creepage{5e-4, 5e-4, 0.15};  // spin [1/m]
    FrictionStep step = run.steady({.motion = creepage});
    std::printf("q/a   a/b      F_x N      F_y N    M_z N m\n");
    for (int k = 0; k <= 400; ++k) {
        if (k > 0) {
            hertz.set(ellipse(std::min(k / 200.0, 1.0)), normal);
            step = run.advance({0.1 * first.half_length(), creepage, normal});
        }
        if (step.status != Status::ok) return EXIT_FAILURE;
        if (k % 40 != 0) continue;
        std::printf("%3d %5.2f %10.0f %10.0f %10.2f\n", k / 10, run.now().half_length / run.now().half_width,
                    step.force.longitudinal, step.force.lateral, step.force.moment);
    }

    // 3. It ends in steady rolling of the last ellipse
    const FrictionStep steady = run.steady({.motion = creepage});
    const double gap =
        std::hypot(step.force.longitudinal - steady.force.longitudinal, step.force.lateral - steady.force.lateral) /
        (0.3 * load);
    std::printf("a/b = %.3f to %.3f; steady rolling differs by %.1e mu N\n", contact.a_over_b(),
                last.half_length() / last.half_width(), gap);
    return gap < 2e-3 ? EXIT_SUCCESS : EXIT_FAILURE;
}
