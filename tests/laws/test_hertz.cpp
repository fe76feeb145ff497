// rollbem/normal/hertz.hpp, scene/patch_contact.hpp: the laws of force elements.
#include "laws/hertz.hpp"
#include "laws/past.hpp"
#include "laws/refusals.hpp"
#include "laws/symmetry.hpp"
#include "laws/tangent.hpp"
#include "laws/units.hpp"

namespace laws {

TEST_CASE("laws: Hertz's ellipse, and a turned one along the rolling direction", "[hertz]") {
    for (const ForceElement& of : {hertz_ellipse(), ellipse_along_rolling()}) {
        has_tangent(of, {.error = 1e-8, .is_curved = false});
        is_symmetric(of, 1e-13);
        keeps_units(of, 1e-13);
        has_no_past(of);
    }
}

TEST_CASE("laws: Hertz's loads on meshes", "[hertz][load]") {
    for (const bool breathes : {true, false}) {
        const Exactness exactness = breathes
                                        ? Exactness{.error = 1e-8, .is_curved = false}
                                        : Exactness{.step = 1e-5, .error = 1e-3, .rough = 1e-1, .is_curved = false};
        for (const ForceElement& of : {hertz_load(breathes), hertz_patch_load(breathes)}) {
            has_tangent(of, exactness);
            refuses(of);
            has_no_past(of);
        }
    }
}

}  // namespace laws
