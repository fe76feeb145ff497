// A friction history in any scalar type. Compiled once in float and long double, in scalars_float.cpp and
// scalars_long_double.cpp: nothing takes a test of friction longer to compile.
#pragma once

#include <utility>

#include "catch.hpp"
#include "rollbem/problem/friction.hpp"

namespace rollbem {

// Force per width after steps with a changing dq and creepage, and the steady one from there, computed in Scalar with
// a = G = 1 and the creepage at full sliding `sliding`. `matrices`, `widths` and `bound`, mu times the pressure, are of
// double.
template <class Scalar>
std::pair<Scalar, Scalar> rolled_and_steady(const Contact<double>& contact_of_double,
                                            const InfluenceMatrices<double>& matrices,
                                            const ArrayX<double>& widths_of_double, const ArrayX<double>& bound,
                                            double sliding) {
    const Contact<Scalar> contact =
        Contact<Scalar>::dimensionless(Scalar(contact_of_double.aspect()), Scalar(contact_of_double.poisson_ratio()));
    const ArrayX<Scalar> widths = widths_of_double.template cast<Scalar>();
    const CoulombFriction<Scalar> friction{1, bound.template cast<Scalar>()};
    const FrictionModel<Scalar> model(
        contact, {matrices.G.template cast<Scalar>(), matrices.G_prime.template cast<Scalar>()}, widths,
        {friction.friction_coefficient, friction.normal_pressure}, Integrator::sdirk2);
    FrictionState<Scalar> now = model.at_rest(), next = now;
    FrictionStep<Scalar> step;
    for (int k = 0; k < 50; ++k) {
        step = model.advance(now, k % 9 == 0 ? Scalar(0.5) : Scalar(0.25), Scalar(sliding * (k % 20 < 10 ? 0.9 : -0.4)),
                             next);
        REQUIRE(step.status == FrictionStatus::ok);
        std::swap(now, next);
    }
    // the law in braces
    const SteadyFrictionModel<Scalar> steady(contact, matrices.G_prime.template cast<Scalar>(), widths,
                                             {friction.friction_coefficient, friction.normal_pressure});
    return {step.force_per_width, steady.solve(now, Scalar(sliding * 0.95), next).force_per_width};
}

}  // namespace rollbem
