// rollbem/friction/model.hpp: random histories on a breathing mesh, against independent
// equations of a step and an independent solver.
// The number of scenes is ROLLBEM_SCENES (default 10000) / 30; ROLLBEM_SEED is the seed of the generator.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>

#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/line.hpp>

#include "drawn_scenes.hpp"
#include "support/catch.hpp"
#include "support/unturned.hpp"

namespace breathing_scenes_tests {
namespace {

using namespace rollbem;
using drawn_scenes::Draw, drawn_scenes::from_environment, drawn_scenes::Matrices, drawn_scenes::Tally,
    drawn_scenes::Vectors;

// Both directions of the plane kernel at a = a_0, lengths in a_0 and G = 1, and how they depend on the half-length.
struct Surface {
    Matrices G, G_prime;
    std::array<double, 2> strength;  // of the logarithm
    ArrayX<double> points, widths;

    // U = M(a) p
    MatrixX<double> M(std::size_t d, double a) const {
        const Eigen::Index n = widths.size();
        const VectorX<double> ones = VectorX<double>::Ones(n);
        return a * (G[d] - strength[d] * std::log(a) * ones * widths.matrix().transpose());
    }
    Vectors displacement(const Vectors& p, double a) const {
        Vectors U(p.rows(), 2);
        U << M(0, a) * p.col(0), M(1, a) * p.col(1);
        return U;
    }
    // p at the end of a stage of `part` of a step dq, da: slip = xi part dq - part (dq + da zeta) G' p + M p - U
    std::optional<Vectors> stage(double part, double dq, double da, double a, const Creepage& creepage,
                                 const Vectors& U, const ArrayX<double>& bound) const {
        Matrices slip;
        const ArrayX<double> way = part * (dq + da * points);
        for (std::size_t d = 0; d < 2; ++d) slip[d] = M(d, a) - way.matrix().asDiagonal() * G_prime[d];
        Vectors constant = -U;
        constant.col(0).array() += part * dq * creepage.longitudinal;
        constant.col(1).array() += part * dq * creepage.lateral;
        return drawn_scenes::projected_fixed_point(slip, constant, bound);
    }
    std::optional<Vectors> step(Integrator integrator, double dq, double a, double a_end, const Creepage& creepage,
                                const Vectors& p, const ArrayX<double>& bound, const ArrayX<double>& bound_end) const {
        const Vectors U = displacement(p, a);
        const double da = a_end - a;
        if (integrator == Integrator::implicit_euler) return stage(1, dq, da, a_end, creepage, U, bound_end);
        const double g = 1 - 1 / std::numbers::sqrt2, a_1 = a + g * da;
        const auto p_1 = stage(g, dq, da, a_1, creepage, U, bound + g * (bound_end - bound));
        if (!p_1) return std::nullopt;
        const Vectors between = U + (1 - g) / g * (displacement(*p_1, a_1) - U);
        return stage(g, dq, da, a_end, creepage, between, bound_end);
    }
};

// A few steps under random loads, each compared with the fixed point.
void ride(Draw& draw, Tally& tally) {
    const double nu = draw.integer(4) == 0 ? 0 : draw.uniform(0, 0.5);
    const double a_0 = draw.decades(-4, 1), modulus = draw.decades(0, 11), mu = draw.uniform(0.01, 1);
    const Contact contact(
        {.half_length = a_0, .half_width = a_0 * draw.decades(2, 4), .shear_modulus = modulus, .poisson_ratio = nu});
    const Eigen::Index n = 1 + draw.integer(12);
    const Mesh<double> mesh = draw.integer(2) == 0 ? uniform_mesh<double>(n) : cosine_mesh<double>(n);
    const Collocation scheme{.alpha_L = 0.5, .alpha_T = 0.5};
    const auto along = PlaneKernel<double>::longitudinal(contact), across = PlaneKernel<double>::lateral(contact);
    const Surface surface{{assemble_G(mesh, scheme, along), assemble_G(mesh, scheme, across)},
                          {assemble_G_prime(mesh, scheme, along), assemble_G_prime(mesh, scheme, across)},
                          {2 * (1 - nu) / std::numbers::pi, 2 / std::numbers::pi},
                          mesh.edges_from_trailing().tail(n) - 1,  // leading edges, the points of alpha = 0.5
                          mesh.widths()};
    const bool both = draw.integer(2) == 0;
    const Integrator integrator = draw.integer(2) == 0 ? Integrator::sdirk2 : Integrator::implicit_euler;
    const double peak = draw.decades(-5, -2);  // p_0/G
    const auto pressures = [&] {
        ArrayX<double> result = peak * draw.uniform(0.2, 1.5) * mean_hertz_pressure(mesh);
        for (double& pressure : result) pressure *= draw.integer(6) == 0 ? 0 : draw.uniform(0.7, 1.3);
        return result;
    };
    const Friction law{.law = {mu}, .normal_pressure = modulus * peak * mean_hertz_pressure(mesh)};
    // the fixed point opposes the slip of each equation itself
    const auto x = support::unturned(rolling_system(mesh, scheme, along)),
               y = support::unturned(rolling_system(mesh, scheme, across));
    const FrictionModel model = both ? FrictionModel(contact, {x, y}, unchecked, law, integrator)
                                     : FrictionModel(contact, x, unchecked, law, integrator);
    Run run(model);
    Vectors p = Vectors::Zero(n, 2);
    double a = 1;
    ArrayX<double> bound = mu / modulus * law.normal_pressure;
    for (int k = 0; k < 8; ++k) {
        const double dq = draw.decades(-1.5, 0.7), size = mu * peak * draw.decades(-1.5, 1);
        const double angle = draw.uniform(-3.2, 3.2);
        const Creepage creepage{size * std::cos(angle), both ? size * std::sin(angle) : 0};
        const double a_end = std::clamp(a + draw.uniform(-0.95, 0.95) * dq, 0.5, 2.0);
        const ArrayX<double> pressure = pressures(), bound_end = mu * pressure;
        const NormalLoad load{modulus * pressure, a_0 * a_end, {}};
        const FrictionStep step = run.advance({dq * a_0, creepage, load});
        CAPTURE(k, both, name(integrator), n, nu, dq, a, a_end, size, angle);
        REQUIRE(step.status == Status::ok);
        REQUIRE(step.complementarity_residual < 1e-10);
        Vectors found = Vectors::Zero(n, 2);
        found.leftCols(both ? 2 : 1) = run.now().traction.leftCols(both ? 2 : 1) / modulus;
        if (const auto expected = surface.step(integrator, dq, a, a_end, creepage, p, bound, bound_end)) {
            REQUIRE((*expected - found).cwiseAbs().maxCoeff() <= 1e-8 * mu * peak);
            ++tally.compared;
            tally.mixed += step.stick_count > 0 && step.stick_count < n ? 1 : 0;
        }
        p = found;
        a = a_end;
        bound = bound_end;
    }
}

TEST_CASE("Steps on a breathing mesh agree with a projected fixed point", "[property]") {
    const std::uint64_t scenes = from_environment("ROLLBEM_SCENES", 10000) / 30 + 1;
    const std::uint64_t seed = from_environment("ROLLBEM_SEED", 1);
    Tally tally;
    for (std::uint64_t scene = 0; scene < scenes; ++scene) {
        CAPTURE(seed, scene);
        Draw draw(seed * 1000003 + scene);
        ride(draw, tally);
    }
    CAPTURE(scenes, tally.compared, tally.mixed);
    CHECK(tally.compared > static_cast<int>(6 * scenes));
    CHECK(tally.mixed > static_cast<int>(scenes));
}

}  // namespace
}  // namespace breathing_scenes_tests
