// Friction that falls with slip in long double and with node differences: the conditions of the law to the rounding of
// the type, and the forces of double.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <rollbem/compiled/friction.hpp>

#include "friction/falling_conditions.hpp"
#include "friction/falling_scene.hpp"
#include "support/catch.hpp"
#include "support/scalars.hpp"

namespace {

using namespace rollbem;

// -F/(mu_0 N) of a ride with a memory of `distance` [m], a steady solution first; with implicit Euler each is checked.
template <class Scalar, class Scheme = Collocation>
std::vector<double> ride(double distance, Integrator integrator,
                         const Scheme& scheme = {.alpha_L = 0.5, .alpha_T = 0.5}) {
    using falling_tests::law, falling_tests::speed, falling_tests::full_force;
    const auto a = static_cast<Scalar>(falling_tests::a), modulus = static_cast<Scalar>(falling_tests::shear_modulus);
    const auto V = static_cast<Scalar>(speed);
    const Contact<Scalar> contact({.half_length = a,
                                   .half_width = 1000 * a,
                                   .shear_modulus = modulus,
                                   .poisson_ratio = static_cast<Scalar>(falling_tests::poisson_ratio)});
    const Mesh<Scalar> mesh = cosine_mesh<Scalar>(20);
    const auto system = rolling_system(mesh, scheme, PlaneKernel<Scalar>::longitudinal(contact));
    const ExponentialFall<Scalar> falling{static_cast<Scalar>(law.mu_0), static_cast<Scalar>(law.mu_k),
                                          static_cast<Scalar>(law.half_velocity)};
    const FrictionMemory<Scalar> memory{static_cast<Scalar>(distance),
                                        static_cast<Scalar>(falling_tests::least_velocity)};
    const FrictionModel<ExponentialFall<Scalar>, 1, Scalar> model(
        contact, system, unchecked,
        {falling, static_cast<Scalar>(falling_tests::peak_pressure) * mean_hertz_pressure(mesh), memory}, integrator);
    auto workspace = model.workspace();
    FrictionState<1, Scalar> now = model.at_rest(), next = now;
    std::vector<double> forces;
    for (int k = 0; k <= 60; ++k) {
        const auto creepage = static_cast<Scalar>(0.002 * std::sin(0.2 * k + 0.4)), dq = static_cast<Scalar>(0.1);
        const bool steady = k == 0;
        const Scalar duration = (steady ? 1 : dq) * a / V;
        const FrictionStep<1, Scalar> step = steady ? model.steady(now, creepage, V, next, workspace)
                                                    : model.advance(now, {dq * a, duration}, creepage, next, workspace);
        CAPTURE(distance, name(integrator), k, step.complementarity_residual);
        REQUIRE(step.status == StepStatus::ok);
        if (steady || integrator == Integrator::implicit_euler) {
            const auto found =
                falling_tests::violation(falling, memory, system, a, modulus, steady ? 1 : dq,
                                         steady ? creepage : dq * creepage, duration, steady ? nullptr : &now, next);
            CAPTURE(found.bound, found.stick, found.direction, found.friction);
            CHECK(found.worst() <= 1);
        }
        CHECK(std::isfinite(step.tangent));
        forces.push_back(-static_cast<double>(step.force_per_width) / full_force);
        std::swap(now, next);
    }
    return forces;
}

template <class Scalar>
void compare(double tolerance) {
    for (const double distance : {5e-6, 20e-6}) {  // with less memory, solutions vanish: rounding chooses the next
        for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
            const std::vector<double> forces = ride<Scalar>(distance, integrator);
            const std::vector<double> expected = ride<double>(distance, integrator);
            double worst = 0;
            for (std::size_t k = 0; k < forces.size(); ++k) {
                worst = std::max(worst, std::abs(forces[k] - expected[k]));
            }
            CAPTURE(distance, name(integrator), worst);
            CHECK(worst < tolerance);
        }
    }
}

TEST_CASE("With node differences a particle takes its coefficient from point to point", "[friction]") {
    for (const double distance : {0.0, 5e-6, 20e-6}) {
        for (const Nodes nodes : {Nodes::centres, Nodes::chebyshev}) {
            ride<double>(distance, Integrator::implicit_euler, NodeDifference{nodes});
        }
    }
}

TEST_CASE("Friction that falls with slip, in long double", "[friction]") {
    compare<long double>(1e-11);
    ride<long double>(0, Integrator::implicit_euler);
}

}  // namespace
