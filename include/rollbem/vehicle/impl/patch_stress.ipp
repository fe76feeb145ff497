// Bodies of vehicle/patch_stress.hpp. Internal.
#pragma once

#include "../patch_stress.hpp"

#include <algorithm>
#include <cmath>

namespace rollbem {

ROLLBEM_DECL std::vector<Yield::Peak> stresses_below(const PatchForce& friction, double poisson_ratio) {
    std::vector<Yield::Peak> found;
    for (Eigen::Index k = 0; k + 1 < friction.edges.size() && !friction.surface.empty(); ++k) {
        const double s = (friction.edges[k] + friction.edges[k + 1]) / 2;
        double low = 0, high = 0;
        for (const Yield::LoadedRectangle& element : friction.surface) {
            low = (std::min)(low, element.x_1);
            high = (std::max)(high, element.x_2);
        }
        Yield::Peak& strip = found.emplace_back(Yield::Peak{.y = s});
        for (const Yield::LoadedRectangle& element : friction.surface) {
            if (!(element.y_1 < s && s < element.y_2)) continue;
            const double x = (element.x_1 + element.x_2) / 2;
            const Yield::Peak own = subsurface_peak(friction.surface, poisson_ratio, {x, s}, high - low);
            if (own.von_mises > strip.von_mises) strip = own;
        }
    }
    return found;
}

ROLLBEM_DECL Yield::Shakedown shakedown_point(const RailPatch& patch, const PatchForce& friction, double shear_yield) {
    return {patch.peak_pressure / shear_yield,
            std::hypot(friction.force.longitudinal, friction.force.lateral) / patch.load};
}

}  // namespace rollbem
