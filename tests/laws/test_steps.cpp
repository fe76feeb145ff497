// rollbem/adhesion/transient.hpp, friction/model.hpp: the laws of force elements.
#include "laws/past.hpp"
#include "laws/refusals.hpp"
#include "laws/steps.hpp"
#include "laws/symmetry.hpp"
#include "laws/tangent.hpp"
#include "laws/units.hpp"
#include "laws/work.hpp"

namespace laws {

TEST_CASE("laws: steps in full adhesion", "[transient][not_finite]") {
    const auto obeys = [](const ForceElement& of) {
        has_tangent(of, {.scenes = 30, .step = 1e-3, .error = 1e-7, .is_curved = false});
        keeps_units(of, 1e-10, 10);
        refuses(of);
        has_no_past(of, 10);
    };
    for (const Integrator integrator :
         {Integrator::implicit_euler, Integrator::sdirk2, Integrator::matrix_exponential}) {
        for (const Stuck what : {Stuck::elements, Stuck::states, Stuck::strip})
            obeys(adhesion_step<1>(what, integrator));
        obeys(adhesion_step<2>(Stuck::patch, integrator));
    }
}

TEST_CASE("laws: friction, steady and in time, of lines and patches", "[friction][not_finite]") {
    for (const Rolling what : {Rolling::one, Rolling::both, Rolling::patch}) {
        for (const By by : {By::alone, By::steady, By::implicit_euler, By::sdirk2}) {
            for (const Law law : {Law::constant, Law::falling, Law::remembering}) {
                if (what == Rolling::patch && law == Law::remembering) continue;
                const ForceElement of = friction(what, by, law);
                // what lies above has a kink nearby, if only of a first stage
                has_tangent(of,
                            {.scenes = 20, .step = 2e-5, .error = 1e-6, .share = 0.95, .rough = 1, .is_curved = false});
                refuses(of, 2);
                has_no_past(of, 5);
                if (by == By::implicit_euler || by == By::sdirk2) continue;
                const ForceElement plain = friction(what, by, law, true);
                if (what != Rolling::one) is_symmetric(plain, 1e-9, 10);
                dissipates(plain, 1e-9, 10);
            }
        }
    }
}

}  // namespace laws
