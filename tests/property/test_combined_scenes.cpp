// rollbem/friction/combined.hpp: random scenes from the whole domain, against an independent solver.
// The number of scenes is ROLLBEM_SCENES (default 10000) / 30; ROLLBEM_SEED is the seed of the generator.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <rollbem/compiled/friction.hpp>

#include "drawn_scenes.hpp"
#include "support/catch.hpp"

namespace {

using namespace rollbem;

using drawn_scenes::Draw, drawn_scenes::from_environment, drawn_scenes::Tally;

Mesh<double> draw_mesh(Draw& draw) {
    const Eigen::Index n = 1 + draw.integer(14);
    switch (draw.integer(3)) {
        case 0: return uniform_mesh<double>(n);
        case 1: return geometric_mesh<double>(std::max<Eigen::Index>(n, 2), draw.decades(-0.5, 0.5));
        default: return cosine_mesh<double>(n);
    }
}

// A few steps and shifts under random pressures and creepages, each compared with the fixed point.
template <class Kernel>
void ride(Draw& draw, double aspect, Tally& tally) {
    const double a = draw.decades(-4, 1), G = draw.decades(0, 11), mu = draw.uniform(0.01, 1);
    const Contact<double> contact({.half_length = a,
                                   .half_width = a * aspect,
                                   .shear_modulus = G,
                                   .poisson_ratio = draw.integer(4) == 0 ? 0 : draw.uniform(0, 0.5)});
    const Mesh<double> mesh = draw_mesh(draw);
    const Eigen::Index n = mesh.size();
    const Collocation scheme{.alpha_L = 0.5, .alpha_T = 0.5};
    const ElementSystem<double> along = rolling_system(mesh, scheme, Kernel::longitudinal(contact));
    const ElementSystem<double> across = rolling_system(mesh, scheme, Kernel::lateral(contact));
    const double peak = G * draw.decades(-5, -2);
    const auto pressures = [&](bool holes) {
        ArrayX<double> result = peak * mean_hertz_pressure(mesh);
        for (double& pressure : result) {
            pressure *= draw.uniform(0.2, 1.5);
            if (holes && draw.integer(5) == 0) pressure = 0;
        }
        return result;
    };
    // the fixed point opposes the slip of each equation itself
    const Friction<> law{.law = {mu}, .normal_pressure = pressures(false), .turned = false};
    const FrictionModel<ConstantFriction<>, 2> model(contact, {along, across}, unchecked, law,
                                                     Integrator::implicit_euler);
    FrictionState<2> now = model.at_rest(), next = now;
    FrictionWorkspace<2> workspace = model.workspace();
    NormalLoad<double> load{now.normal_pressure, a, {}};
    for (int k = 0; k < 6; ++k) {
        const double size = mu * peak / G * draw.decades(-1.5, 1), angle = draw.uniform(-3.2, 3.2);
        const Creepage<double> creepage{size * std::cos(angle), draw.integer(6) == 0 ? 0 : size * std::sin(angle)};
        if (draw.integer(2) == 0) load.normal_pressure = pressures(true);
        // steady rolling, a step, or a shift
        const int kind = draw.integer(3);
        const double dq = kind == 1 ? draw.decades(-1.5, 1) : 0;
        MatrixX<double> x = -along.G_prime(), y = -across.G_prime();
        ElementVectors<double> constant = ElementVectors<double>::Zero(n, 2);
        double imposed = 1;
        if (kind != 0) {
            x = along.G() + dq * x;
            y = across.G() + dq * y;
            constant.col(0) = -along.G() * now.traction.col(0) / G;
            constant.col(1) = -across.G() * now.traction.col(1) / G;
            imposed = kind == 1 ? dq : 1;
        }
        constant.col(0).array() += imposed * creepage.longitudinal;
        constant.col(1).array() += imposed * creepage.lateral;
        const auto step =
            kind == 0 ? model.steady(now, creepage, load, next, workspace)
            : kind == 1
                ? model.advance(now, dq * a, creepage, load, next, workspace)
                : model.advance(now, 0,
                                RigidMotion<Creepage<double>>::shift({a * creepage.longitudinal, a * creepage.lateral}),
                                load, next, workspace);
        const VectorX<double> bound = mu / G * load.normal_pressure.matrix();
        CAPTURE(k, kind, n, aspect, dq, size, angle, step.rounds, step.stick_count);
        REQUIRE(step.status == StepStatus::ok);
        REQUIRE(step.complementarity_residual < 1e-10);
        REQUIRE(step.slip_work_per_width >= 0);
        if (const auto p = drawn_scenes::projected_fixed_point({x, y}, constant, bound)) {
            REQUIRE((*p * G - next.traction).cwiseAbs().maxCoeff() <= 1e-8 * mu * peak);
            ++tally.compared;
            tally.mixed += step.stick_count > 0 && step.stick_count < n ? 1 : 0;
        }
        std::swap(now, next);
    }
}

TEST_CASE("Stick and slip in two directions agree with a projected fixed point", "[property]") {
    const std::uint64_t scenes = from_environment("ROLLBEM_SCENES", 10000) / 30 + 1;
    const std::uint64_t seed = from_environment("ROLLBEM_SEED", 1);
    Tally tally;
    for (std::uint64_t scene = 0; scene < scenes; ++scene) {
        CAPTURE(seed, scene);
        Draw draw(seed * 1000003 + scene);
        const double aspect = draw.decades(0, 4);
        if (aspect > 3 && draw.integer(2) == 0) {
            ride<PlaneKernel<double>>(draw, aspect, tally);
        } else {
            ride<StripKernel<double>>(draw, aspect, tally);
        }
    }
    CAPTURE(scenes, tally.compared, tally.mixed);
    CHECK(tally.compared > static_cast<int>(4 * scenes));
    CHECK(tally.mixed > static_cast<int>(scenes));
}

}  // namespace
