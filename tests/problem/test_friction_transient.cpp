// rollbem/problem/friction_transient.hpp: what a used state keeps, and what becomes of it where a step fails.
#include <cmath>
#include <numbers>
#include <vector>

#include "rollbem/problem/friction_transient.hpp"
#include "rollbem/problem/hertz.hpp"
#include "support/catch.hpp"

namespace {

using namespace rollbem;

constexpr double peak = 1e-3;  // mu p0, with a = G = 1

double creepage(double ratio) { return 1.5 * peak * ratio; }

FrictionModel<double> make_model(Integrator integrator) {
    const Contact<double> contact = Contact<double>::dimensionless(10, 0.25);
    const Mesh<double> mesh = cosine_mesh<double>(20);
    return {contact,
            mesh,
            Collocation{.alpha_L = 0.5, .alpha_T = 0.5},
            PlaneKernel<double>::longitudinal(contact),
            {1, peak * mean_hertz_pressure(mesh)},
            integrator};
}

TEST_CASE("A used state takes a step of nearly the same length as a fresh one does", "[friction]") {
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
        const FrictionModel<double> model = make_model(integrator);
        for (const double change : {5e-7, -5e-7, 1e-9}) {
            FrictionState<double> now = model.at_rest(), used = now, fresh = now;
            REQUIRE(model.advance(now, 0.1, creepage(0.4), used).status == FrictionStatus::ok);
            const FrictionStep<double> again = model.advance(now, 0.1 * (1 + change), creepage(0.4), used);
            const FrictionStep<double> first = model.advance(now, 0.1 * (1 + change), creepage(0.4), fresh);
            CAPTURE(static_cast<int>(integrator), change, again.force_per_width / first.force_per_width - 1);
            CHECK(std::abs(again.force_per_width / first.force_per_width - 1) < 1e-12);
            CHECK(std::abs(again.tangent_per_width / first.tangent_per_width - 1) < 1e-12);
        }
    }
}

TEST_CASE("A step that overflows leaves a copy of the state it started from", "[friction]") {
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
        const FrictionModel<double> model = make_model(integrator);
        FrictionState<double> rest = model.at_rest(), rolled = rest, next = rest, fresh = rest;
        REQUIRE(model.advance(rest, 1.0, creepage(0.7), rolled).status == FrictionStatus::ok);
        REQUIRE(rolled.zones() != rest.zones());
        const FrictionStep<double> failed = model.advance(rolled, 1e3, 1e308, next);
        CHECK(failed.status == FrictionStatus::not_finite);
        CHECK(std::isnan(failed.force));
        CHECK(next.traction() == rolled.traction());
        CHECK(next.slip() == rolled.slip());
        CHECK(next.zones() == rolled.zones());
        // and both ways it goes on as from the state itself
        const double expected = model.advance(rolled, 0.1, creepage(-0.3), fresh).force_per_width;
        FrictionState<double> after = rest;
        CHECK(model.advance(next, 0.1, creepage(-0.3), after).force_per_width == Approx(expected).epsilon(1e-13));
        CHECK(model.advance(rolled, 0.1, creepage(-0.3), next).force_per_width == Approx(expected).epsilon(1e-13));
    }
}

}  // namespace
