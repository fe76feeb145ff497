// What simplified theories make of friction on a patch, for comparison: Kalker's linear theory with saturation (Shen,
// Hedrick and Elkins 1983) and FASTSIM (Kalker 1982), beside this library. Forces over mu N on an ellipse of a/b = 1.5,
// nu = 0.28, over the longitudinal and the lateral creepage, the latter with the spin of a contact angle.
//
//     ./examples/simplified_theories > simplified_theories.csv
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <rollbem/rollbem.hpp>

using namespace rollbem;

using Force = std::array<double, 2>;  // -F_x, -F_y over mu N

/// mu N = G = a = 1.
struct Patch {
    double a_over_b, b = 1 / a_over_b, c = std::sqrt(b);
    double c11, c22, c23;
};

/// |F| = |L| - |L|^2/3 + |L|^3/27 in the direction of Kalker's force L, as long as |L| < 3.
Force saturated(const Patch& patch, const Creepage<double>& creepage) {
    const double x = patch.b * patch.c11 * creepage.longitudinal,
                 y = patch.b * (patch.c22 * creepage.lateral + patch.c * patch.c23 * creepage.spin);
    const double size = std::hypot(x, y), reached = size < 3 ? size - size * size / 3 + std::pow(size, 3) / 27 : 1;
    return size > 0 ? Force{x / size * reached, y / size * reached} : Force{0, 0};
}

/// Displacement is proportional to traction, by the flexibilities that give Kalker's coefficients; the pressure is a
/// paraboloid. Particles are followed from the leading edge through 40 strips of 40 elements.
Force fastsim(const Patch& patch, const Creepage<double>& creepage) {
    constexpr int n = 40;
    const double L1 = 8 / (3 * patch.c11), L2 = 8 / (3 * patch.c22), L3 = std::numbers::pi / (4 * patch.c * patch.c23),
                 peak = 2 / (std::numbers::pi * patch.b);
    Force force{0, 0};
    for (int j = 0; j < n; ++j) {
        const double eta = (2 * j + 1.0) / n - 1, y = patch.b * eta, end = std::sqrt(1 - eta * eta);
        const double dx = 2 * end / n, dy = 2 * patch.b / n;
        double p_x = 0, p_y = 0;
        for (int i = 0; i < n; ++i) {
            const double x = end - (i + 0.5) * dx, bound = peak * (1 - x * x - eta * eta);
            p_x -= dx * (creepage.longitudinal / L1 - creepage.spin * y / L3);
            p_y -= dx * (creepage.lateral / L2 + creepage.spin * x / L3);
            const double size = std::hypot(p_x, p_y);
            if (size > bound) {
                p_x *= bound / size;
                p_y *= bound / size;
            }
            force[0] -= p_x * dx * dy;
            force[1] -= p_y * dx * dy;
        }
    }
    return force;
}

int main() {
    const double a_over_b = 1.5, nu = 0.28;
    const auto contact = PatchContact<double>::dimensionless(a_over_b, nu);
    const NodeDifference scheme{Nodes::chebyshev};
    const HalfSpace<double> kernel(nu);
    const auto adhesion =
        creep_coefficients(contact, solve_steady(contact, patch_mesh(contact, 16, 16), scheme, kernel));
    const Patch patch{.a_over_b = a_over_b, .c11 = adhesion.c11, .c22 = adhesion.c22, .c23 = adhesion.c23};
    const PatchMesh<double> mesh = recommended_patch(0.02, a_over_b).mesh(contact);
    const FrictionModel model(contact, steady_system(mesh, scheme, kernel), {1.0, hertz_pressures(contact, mesh, 1.0)});
    Run run(model);

    double fastsim_off = 0, saturated_off = 0;
    std::puts("spin,creepage,rollbem,fastsim,saturated_linear");  // both in forces without slip, over mu N
    for (const double spin : {0.0, 0.8}) {
        run.now() = model.at_rest();
        for (int k = spin == 0 ? 0 : -40; k <= 40; ++k) {
            const double level = k / 10.0, per_level = 1 / patch.b;
            const Creepage<double> creepage = spin == 0 ? Creepage<double>{level * per_level / patch.c11, 0, 0}
                                                        : Creepage<double>{0, level * per_level / patch.c22,
                                                                           spin * per_level / (patch.c * patch.c23)};
            const auto point = run.steady({.motion = creepage});
            if (point.status != Status::ok) return 1;
            const double own = spin == 0 ? -point.force.longitudinal : -point.force.lateral;
            const std::size_t along = spin == 0 ? 0 : 1;
            const double by_fastsim = fastsim(patch, creepage)[along], linear = saturated(patch, creepage)[along];
            std::printf("%g,%g,%.6f,%.6f,%.6f\n", spin, level, own, by_fastsim, linear);
            fastsim_off = std::max(fastsim_off, std::abs(by_fastsim - own));
            saturated_off = std::max(saturated_off, std::abs(linear - own));
        }
    }
    std::fprintf(stderr, "largest difference over mu N: FASTSIM %.3f, linear theory with saturation %.3f\n",
                 fastsim_off, saturated_off);
    // as far off as CONTACT finds FASTSIM (0.02 to 0.1)
    return fastsim_off > 0.02 && fastsim_off < 0.1 ? 0 : 1;
}
