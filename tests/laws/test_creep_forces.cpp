// rollbem/vehicle/creep_force_table.hpp, simplified_theory.hpp: the laws of force elements.
#include "laws/creep_forces.hpp"
#include "laws/past.hpp"
#include "laws/refusals.hpp"
#include "laws/symmetry.hpp"
#include "laws/tangent.hpp"
#include "laws/units.hpp"
#include "laws/work.hpp"

namespace laws {

TEST_CASE("laws: a table of creep forces, without and with reduced friction") {
    const ForceElement of = GENERATE(0, 1) == 0 ? creep_force_table() : reduced_friction();
    has_tangent(of, {.scenes = 100});
    is_symmetric(of);
    keeps_units(of, 1e-12);
    dissipates(of);
    refuses(of);
    has_no_past(of);
}

TEST_CASE("laws: FASTSIM and FaStrip") {
    const ForceElement of = simplified_theory(GENERATE(false, true));
    is_symmetric(of, 1e-11);
    keeps_units(of, 1e-11);
    dissipates(of);
    refuses(of);
    has_no_past(of);
}

}  // namespace laws
