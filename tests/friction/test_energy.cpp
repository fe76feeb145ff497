// rollbem/friction/model.hpp: elastic energy, and the balance of work, heat and elastic energy.
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include <rollbem/closed_form/friction.hpp>
#include <rollbem/compiled/steady.hpp>

#include "scene.hpp"
#include "support/catch.hpp"
#include "support/observed_order.hpp"

namespace friction_tests {
namespace {

// Energy of the tractions -mu p0 sqrt(1 - x^2/a^2), a = half_length, with G = 1: a sum of the Chebyshev polynomials T_0
// and T_2, in which the plane kernel is diagonal.
double sliding_energy(double half_length, double half_width) {
    const double c1 = 1 - nu, c2 = nu;
    const double mean = 2 * (c1 * std::log(4 * half_width / half_length) + c2), second = c1;
    return 2 * half_width * std::numbers::pi / 8 * (mean + second / 2) * peak * peak * half_length * half_length;
}

TEST_CASE("The elastic energy of full sliding converges to the exact one", "[friction]") {
    std::vector<double> sizes, errors;
    for (const Eigen::Index n : {20, 40, 80, 160}) {
        const Scene scene(cosine_mesh<double>(n), half, 1, 50);
        const FrictionModel<> model = scene.transient();
        FrictionState<> state = model.at_rest();
        CHECK(model.elastic_energy(state) == 0);
        state.traction = -peak * mean_hertz_pressure(scene.mesh).matrix();
        const double energy = model.elastic_energy(state);
        sizes.push_back(static_cast<double>(n));
        errors.push_back(energy / sliding_energy(1, 50) - 1);
    }
    CAPTURE(errors);
    CHECK(std::abs(errors[1]) < 1e-3);
    CHECK(std::abs(support::observed_order(sizes, errors) - 2) < 0.2);
}

TEST_CASE("The elastic energy follows the half-length, and scales in SI units", "[friction]") {
    const Mesh<double> mesh = cosine_mesh<double>(160);
    const Scene scene(mesh, half, 1, 50);
    const FrictionModel<> model = scene.transient();
    FrictionState<> state = model.at_rest();
    state.traction = -peak * mean_hertz_pressure(mesh).matrix();
    for (const double half_length : {0.7, 1.0, 1.3}) {
        state.half_length = half_length;
        CAPTURE(half_length);
        CHECK(std::abs(model.elastic_energy(state) / sliding_energy(half_length, 50) - 1) < 1e-4);
    }

    // SI units
    const double a = 6e-3, G = 8e10;
    const Contact<double> contact({.half_length = a, .half_width = 50 * a, .shear_modulus = G, .poisson_ratio = nu});
    const FrictionModel<> in_si(contact, scene.system(), unchecked, {1.0, peak * G * mean_hertz_pressure(mesh)});
    FrictionState<> loaded = in_si.at_rest();
    loaded.traction = G * state.traction;
    loaded.half_length = a * state.half_length;
    CHECK(in_si.elastic_energy(loaded) == Approx(G * a * a * a * model.elastic_energy(state)).epsilon(1e-12));

    // a strip has a single half-length
    const auto strip = rolling_system(mesh, half, StripKernel<double>::longitudinal(scene.contact));
    const FrictionModel<> rigid(scene.contact, strip, unchecked, scene.friction);
    CHECK(std::isnan(rigid.elastic_energy(state)));
    state.half_length = 1;
    CHECK(rigid.elastic_energy(state) > 0);
}

// From rest, over a creepage that rises, falls and changes sign: the work lost by the rigid bodies, the heat by slip
// times traction, and the final elastic energy.
struct Balance {
    double spent = 0, heat = 0, elastic = 0;

    double gap() const { return (spent - heat - elastic) / heat; }
};
Balance roll(const Mesh<double>& mesh, const AnyScheme& scheme, Integrator integrator, int steps) {
    const Scene scene(mesh, half, 1, 50);
    const FrictionModel<> model(scene.contact, rolling_system(mesh, scheme, scene.kernel), unchecked, scene.friction,
                                integrator);
    FrictionState<> now = model.at_rest(), next = now;
    FrictionWorkspace<> workspace = model.workspace();
    const double dq = 4.0 / steps;
    const auto xi = [&](int k) { return creepage(1.5 * std::sin(dq * k)); };
    Balance balance;
    double force = 0;
    for (int k = 0; k < steps; ++k) {
        const FrictionStep<> step =
            model.advance(now, dq, RigidMotion<double>::linear(xi(k), xi(k + 1)), next, workspace);
        REQUIRE(step.status == StepStatus::ok);
        balance.spent -= dq * (xi(k) * force + xi(k + 1) * step.force) / 2;
        balance.heat += step.slip_work;
        force = step.force;
        std::swap(now, next);
    }
    balance.elastic = model.elastic_energy(now);
    return balance;
}

TEST_CASE("Galerkin's method loses no energy except by slip", "[friction]") {
    // exactly in space on any mesh; in the time domain at the order of the integrator
    for (const Mesh<double>& mesh : {cosine_mesh<double>(20), uniform_mesh<double>(15), geometric_mesh(12, 5.0)}) {
        for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
            std::vector<double> sizes, gaps;
            for (const int steps : {400, 800, 1600}) {
                sizes.push_back(steps);
                gaps.push_back(roll(mesh, Galerkin{.alpha_L = 0, .alpha_T = 0}, integrator, steps).gap());
            }
            CAPTURE(mesh.size(), name(integrator), gaps);
            CHECK(support::observed_order(sizes, gaps) > (integrator == Integrator::sdirk2 ? 1.6 : 0.8));
            CHECK(std::abs(gaps.back()) < (integrator == Integrator::sdirk2 ? 1e-4 : 2e-2));
        }
    }
}

TEST_CASE("Galerkin about the centres has no force in full adhesion and the right one with slip", "[friction]") {
    std::vector<double> sizes, errors;
    for (const Eigen::Index n : {20, 40, 80, 160}) {
        const Scene scene(uniform_mesh<double>(n), half, 1, 50);
        const Galerkin galerkin{.alpha_L = 0, .alpha_T = 0};
        const ElementSystem<double> system = rolling_system(scene.mesh, galerkin, scene.kernel);
        // w G' is antisymmetric, so that sum w p = p.(w G' p) = 0
        const auto adhesion = solve_steady<double>(system.G_prime(), system.weights());
        CHECK(adhesion.status == Status::assists_creepage);
        CHECK(std::abs(adhesion.c11()) < 1e-12);

        const FrictionModel<> model(scene.contact, system, unchecked, scene.friction);
        const FrictionState<> rest = model.at_rest();
        FrictionState<> state = rest;
        FrictionWorkspace<> workspace = model.workspace();
        const FrictionStep<> point = model.steady(rest, creepage(0.5), state, workspace);
        CHECK(point.status == StepStatus::ok);
        CHECK(point.slip_work == Approx(-point.force * creepage(0.5)).epsilon(1e-11));
        sizes.push_back(static_cast<double>(n));
        errors.push_back(force_ratio(point, scene.contact) / carter_force_ratio(0.5) - 1);
    }
    CAPTURE(errors);
    CHECK(std::abs(errors.back()) < 2e-3);
    CHECK(std::abs(support::observed_order(sizes, errors) - 1) < 0.1);
}

}  // namespace
}  // namespace friction_tests
