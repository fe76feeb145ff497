// rollbem/adhesion/transient.hpp, friction/model.hpp: the laws of force elements.
#include "laws/past.hpp"
#include "laws/refusals.hpp"
#include "laws/steps.hpp"
#include "laws/symmetry.hpp"
#include "laws/tangent.hpp"
#include "laws/units.hpp"
#include "laws/work.hpp"

namespace laws {
namespace {

template <class Function>
void for_each_stuck(const Function& function) {
    for (const Integrator integrator :
         {Integrator::implicit_euler, Integrator::sdirk2, Integrator::matrix_exponential}) {
        for (const Stuck what : {Stuck::elements, Stuck::states, Stuck::strip}) {
            function(adhesion_step<1>(what, integrator));
        }
        function(adhesion_step<2>(Stuck::patch, integrator));
    }
}

template <class Function>
void for_each_slipping(const Function& function) {
    for (const Rolling what : {Rolling::one, Rolling::both, Rolling::patch}) {
        for (const By by : {By::alone, By::steady, By::implicit_euler, By::sdirk2}) {
            for (const Law law : {Law::constant, Law::falling, Law::remembering}) {
                if (what != Rolling::patch || law != Law::remembering) function(what, by, law);
            }
        }
    }
}

}  // namespace

TEST_CASE("laws: steps in full adhesion", "[transient]") {
    for_each_stuck([](const ForceElement& of) {
        has_tangent(of, {.scenes = 30, .error = 1e-7, .is_curved = false});
        keeps_units(of, 1e-10, 10);
        has_no_past(of, 10);
    });
}

TEST_CASE("laws: friction, steady and in time, of lines and patches", "[friction]") {
    for_each_slipping([](Rolling what, By by, Law law) {
        const ForceElement of = friction(what, by, law);
        has_tangent(of, {.scenes = 20, .step = 2e-5, .error = 1e-6, .rough = 1e-6, .is_curved = false});
        has_no_past(of, 5);
        if (by == By::implicit_euler || by == By::sdirk2) return;
        const ForceElement plain = friction(what, by, law, true);
        if (what != Rolling::one) is_symmetric(plain, 1e-9, 10);
        dissipates(plain, 1e-9, 10);
    });
}

TEST_CASE("laws: steps refuse what cannot be meant", "[transient][friction][not_finite]") {
    for_each_stuck([](const ForceElement& of) { refuses(of); });
    for_each_slipping([](Rolling what, By by, Law law) { refuses(friction(what, by, law), 2); });
}

}  // namespace laws
