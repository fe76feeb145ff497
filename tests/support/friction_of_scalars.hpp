// A friction history in any scalar type. Compiled once in float and long double, in scalars_float.cpp and
// scalars_long_double.cpp, because it takes long to compile.
#pragma once

#include <utility>

#include <rollbem/friction/law.hpp>
#include <rollbem/friction/model.hpp>

#include "support/catch.hpp"

namespace rollbem {

// Force per width after steps with a changing dq and creepage, and the steady one from there, computed in Scalar with
// a = G = 1 and the creepage at full sliding `sliding`. `system` and `bound`, mu times the pressure, are of double.
template <class Scalar>
std::pair<Scalar, Scalar> rolled_and_steady(const Contact<double>& contact_of_double,
                                            const ElementSystem<double>& system, const ArrayX<double>& bound,
                                            double sliding) {
    const Contact<Scalar> contact =
        Contact<Scalar>::dimensionless(Scalar(contact_of_double.aspect()), Scalar(contact_of_double.poisson_ratio()));
    const ArrayX<Scalar> widths = system.weights().template cast<Scalar>();
    const MatrixX<Scalar> G = system.G().template cast<Scalar>(), G_prime = system.G_prime().template cast<Scalar>();
    const Friction<ConstantFriction<Scalar>, Scalar> friction{1, bound.template cast<Scalar>()};
    const FrictionModel<ConstantFriction<Scalar>, 1, Scalar> model(
        contact, {G, G_prime, widths}, unchecked, {friction.law, friction.normal_pressure}, Integrator::sdirk2);
    FrictionState<1, Scalar> now = model.at_rest(), next = now;
    FrictionWorkspace<1, Scalar> workspace = model.workspace();
    FrictionStep<1, Scalar> step;
    for (int k = 0; k < 50; ++k) {
        const auto dq = Scalar(k % 9 == 0 ? 0.5 : 0.25), creepage = Scalar(sliding * (k % 20 < 10 ? 0.9 : -0.4));
        step = model.advance(now, {dq, creepage}, next, workspace);
        REQUIRE(step.status == Status::ok);
        std::swap(now, next);
    }
    // the law in braces
    const FrictionModel<ConstantFriction<Scalar>, 1, Scalar> steady(contact, {{}, G_prime, widths},
                                                                    {friction.law, friction.normal_pressure});
    return {step.force, steady.steady(now, {.motion = Scalar(sliding * 0.95)}, next, workspace).force};
}

}  // namespace rollbem
