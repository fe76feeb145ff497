// rollbem/vehicle/contact_table.hpp: the laws of force elements.
#include "laws/past.hpp"
#include "laws/reaction.hpp"
#include "laws/refusals.hpp"
#include "laws/symmetry.hpp"
#include "laws/tangent.hpp"
#include "laws/units.hpp"
#include "laws/wheels.hpp"

namespace laws {

TEST_CASE("laws: a wheel by look-up", "[contact_table]") {
    const ReducedFriction wet({.adhesion_factor = 0.5, .slip_factor = 0.3, .friction_ratio = 0.4, .fall = 0.2});
    ContactTable::Friction by_zones;
    by_zones.factor = {0.4, 1, 0.7, 1};
    const int kind = GENERATE(0, 1, 2);  // dry, with a roll of its own, and wet by zones
    if (kind == 2) by_zones.reduced = &wet;
    const ForceElement of = wheel_look_up(kind == 1, kind == 2 ? by_zones : ContactTable::Friction());
    has_tangent(of, {.scenes = 100, .step = 2e-3, .error = 1e-7, .share = 0.99, .rough = 1e-3});
    is_symmetric(of);
    if (kind < 2) keeps_units(of, 1e-12);  // friction that falls with the slip velocity has a time of its own
    reacts(of, 1e-11);
    refuses(of);
    has_no_past(of);
}

TEST_CASE("laws: height, roll and loads of wheels on rails", "[contact_table]") {
    for (const ForceElement& of : {height_and_roll(), load_at_height()}) {
        has_tangent(of, {.step = 1e-2, .error = 1e-5, .share = 0.95, .is_curved = false});
        is_symmetric(of, 1e-9);
        has_no_past(of);
    }
    refuses(load_at_height());
}

}  // namespace laws
