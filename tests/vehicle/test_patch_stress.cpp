// rollbem/vehicle/patch_stress.hpp
#include <algorithm>
#include <vector>

#include <rollbem/scene/detail/mirror.hpp>
#include <rollbem/vehicle/patch_stress.hpp>
#include <rollbem/vehicle/wheelset_forces.hpp>
#include <rollbem/vehicle/detail/mirrored_forces.hpp>

#include "support/catch.hpp"
#include "vehicle/hertz_patch.hpp"

namespace patch_stress_tests {

using namespace rollbem;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

PatchForce rolling(const RailPatch& patch, double mu, Eigen::Index elements, Eigen::Index strips) {
    return patch_force(patch, {}, {20, -20.2 / 0.46, 0.05, 0, 0, 0.1}, WheelOnRail::Dimensions{},
                       {.coefficient = mu, .elements = elements, .strips = strips});
}

}  // namespace

TEST_CASE("The stress below a ball without friction agrees with Hertz's on the axis", "[profiles]") {
    const double a = 5e-3, nu = 0.28;
    const RailPatch patch = testing::hertz_patch(a, a, 8e4);
    const std::vector<Yield::Peak> strips = stresses_below(rolling(patch, 0, 10, 9), nu);
    REQUIRE(strips.size() == 9);
    const auto worst = std::ranges::max_element(strips, {}, &Yield::Peak::tresca);
    CHECK_THAT(worst->y, WithinAbs(0, 1e-12));
    CHECK_THAT(worst->tresca, WithinRel(0.3146 * patch.peak_pressure, 0.02));  // Johnson 1985, Eq. (3.45)
    CHECK_THAT(worst->tresca_depth, WithinRel(0.474 * a, 0.05));
}

TEST_CASE("Stresses below a mirror image are mirror images, and grow with friction", "[profiles]") {
    const RailPatch patch = testing::hertz_patch(4e-3, 6e-3, 8e4);
    const PatchForce friction = rolling(patch, 0.4, 6, 5);
    const std::vector<Yield::Peak> own = stresses_below(friction, 0.28);
    for (const detail::Mirror& mirror : {detail::Mirror::reversing_x(), detail::Mirror::across_track()}) {
        const std::vector<Yield::Peak> image = stresses_below(mirrored(friction, mirror), 0.28);
        const auto [x, y, z] = mirror.of_vector();
        REQUIRE(image.size() == own.size());
        for (std::size_t k = 0; k < own.size(); ++k) {
            const Yield::Peak& other = image[y < 0 ? own.size() - 1 - k : k];
            CHECK_THAT(other.y, WithinAbs(y * own[k].y, 1e-12));
            CHECK_THAT(other.x, WithinAbs(x * own[k].x, 1e-12));
            CHECK_THAT(other.von_mises, WithinRel(own[k].von_mises, 1e-6));
        }
    }
    CHECK(own[2].von_mises > 1.05 * stresses_below(rolling(patch, 0, 6, 5), 0.28)[2].von_mises);
    const Yield::Shakedown at = shakedown_point(patch, friction, 3e8);
    CHECK(at.traction < 0.4);
    CHECK_THAT(at.load_factor, WithinRel(patch.peak_pressure / 3e8, 1e-12));
    CHECK(stresses_below(PatchForce{}, 0.28).empty());
}

}  // namespace patch_stress_tests
