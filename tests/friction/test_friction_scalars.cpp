// Friction that falls with slip, in two directions, in long double: the conditions of the law to the rounding of the
// type, and the forces of double. With node differences in double.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <rollbem/compiled/friction.hpp>

#include "friction/conditions.hpp"
#include "friction/falling_scene.hpp"
#include "support/catch.hpp"
#include "support/scalars.hpp"
#include "support/unturned.hpp"

namespace {

using namespace rollbem;
using falling_tests::full_force, falling_tests::law, falling_tests::speed;

// -F/(mu_0 N), along and across, of a ride with a memory of `distance` [m], a steady solution first; each is checked.
template <class Scalar, class Scheme>
std::vector<double> ride(double distance, const Scheme& scheme) {
    const auto a = static_cast<Scalar>(falling_tests::a), modulus = static_cast<Scalar>(falling_tests::shear_modulus);
    const auto V = static_cast<Scalar>(speed);
    const Contact<Scalar> contact({.half_length = a,
                                   .half_width = 1000 * a,
                                   .shear_modulus = modulus,
                                   .poisson_ratio = static_cast<Scalar>(falling_tests::poisson_ratio)});
    const Mesh<Scalar> mesh = cosine_mesh<Scalar>(16);
    const ElementSystem<Scalar, 2> system(
        support::unturned(rolling_system(mesh, scheme, PlaneKernel<Scalar>::longitudinal(contact))),
        support::unturned(rolling_system(mesh, scheme, PlaneKernel<Scalar>::lateral(contact))));
    const ExponentialFall<Scalar> falling{static_cast<Scalar>(law.mu_0), static_cast<Scalar>(law.mu_k),
                                          static_cast<Scalar>(law.half_velocity)};
    const FrictionMemory<Scalar> memory{static_cast<Scalar>(distance),
                                        static_cast<Scalar>(falling_tests::least_velocity)};
    const Friction<ExponentialFall<Scalar>, Scalar> friction{
        .law = falling,
        .normal_pressure = static_cast<Scalar>(falling_tests::peak_pressure) * mean_hertz_pressure(mesh),
        .memory = memory};
    const FrictionModel<ExponentialFall<Scalar>, 2, Scalar> model(contact, system, unchecked, friction,
                                                                  Integrator::implicit_euler);
    auto workspace = model.workspace();
    FrictionState<2, Scalar> now = model.at_rest(), next = now;
    std::vector<double> forces;
    for (int k = 0; k <= 40; ++k) {
        const Creepage<Scalar> creepage{static_cast<Scalar>(0.002 * std::sin(0.2 * k + 0.4)),
                                        static_cast<Scalar>(0.001 * std::cos(0.3 * k))};
        const auto dq = static_cast<Scalar>(0.1);
        const bool steady = k == 0;
        const Scalar way = steady ? 1 : dq, duration = way * a / V;
        const FrictionStep<2, Scalar> step = steady ? model.steady(now, creepage, V, next, workspace)
                                                    : model.advance(now, {dq * a, duration}, creepage, next, workspace);
        CAPTURE(distance, k, step.complementarity_residual);
        REQUIRE(step.status == StepStatus::ok);
        const auto found = friction_conditions::violation<Scalar>(falling, memory, system, a, modulus, way,
                                                                  {way * creepage.longitudinal, way * creepage.lateral},
                                                                  duration, steady ? nullptr : &now, next);
        CAPTURE(found.bound, found.stick, found.direction, found.friction);
        CHECK(found.worst() <= 1);
        CHECK(std::isfinite(step.tangent.by_lateral.longitudinal));
        forces.push_back(-static_cast<double>(step.force.longitudinal) / full_force);
        forces.push_back(-static_cast<double>(step.force.lateral) / full_force);
        std::swap(now, next);
    }
    return forces;
}

TEST_CASE("With node differences a particle takes its coefficient from point to point", "[friction]") {
    for (const double distance : {0.0, 5e-6, 20e-6}) {
        for (const Nodes nodes : {Nodes::centres, Nodes::chebyshev}) ride<double>(distance, NodeDifference{nodes});
    }
}

#ifdef ROLLBEM_SLOW_CHECKS
TEST_CASE("Friction in two directions that falls with slip, in long double", "[friction]") {
    const Collocation scheme{.alpha_L = 0.5, .alpha_T = 0.5};
    for (const double distance : {0.0, 10e-6}) {
        const std::vector<double> forces = ride<long double>(distance, scheme),
                                  expected = ride<double>(distance, scheme);
        double worst = 0;
        for (std::size_t k = 0; k < forces.size(); ++k) worst = std::max(worst, std::abs(forces[k] - expected[k]));
        CAPTURE(distance, worst);
        CHECK(worst < 1e-10);
    }
}
#endif

}  // namespace
