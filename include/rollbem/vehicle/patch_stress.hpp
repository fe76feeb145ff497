// Stresses in the rail below a patch that rubs.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include "../elasticity/subsurface_stress.hpp"
#include "patch_force.hpp"

namespace rollbem {

/// The largest stress below a strip of a patch.
struct StripStress {
    double s = 0, x = 0;  ///< the strip's middle, and the place where von Mises' measure is largest below it [m]
    SubsurfacePeak peak;  ///< there
};

/// Below each strip the largest of the stresses under the middles of its elements, down to the length of the patch, by
/// tractions and pressures of all pieces of the plane; in the rail, which is as stiff as the wheel: stresses in the
/// wheel are mirror images under opposite tractions. Empty for friction without a result. Throws as subsurface_stress().
inline std::vector<StripStress> stresses_below(const PatchForce& friction, double poisson_ratio) {
    std::vector<StripStress> found;
    for (Eigen::Index k = 0; k + 1 < friction.edges.size() && !friction.surface.empty(); ++k) {
        const double s = (friction.edges[k] + friction.edges[k + 1]) / 2;
        double low = 0, high = 0;
        for (const LoadedRectangle& element : friction.surface) {
            low = (std::min)(low, element.x_1);
            high = (std::max)(high, element.x_2);
        }
        StripStress& strip = found.emplace_back(StripStress{.s = s, .x = 0, .peak = {}});
        for (const LoadedRectangle& element : friction.surface) {
            if (!(element.y_1 < s && s < element.y_2)) continue;
            const double x = (element.x_1 + element.x_2) / 2;
            const SubsurfacePeak own = subsurface_peak(friction.surface, poisson_ratio, {x, s}, high - low);
            if (own.largest.von_mises <= strip.peak.largest.von_mises) continue;
            strip.x = x;
            strip.peak = own;
        }
    }
    return found;
}

/// A patch in the map of shakedown (Johnson 1989): its load factor and coefficient of traction.
struct ShakedownPoint {
    double load_factor;  ///< the peak pressure over k, the yield stress in shear [-]
    double traction;     ///< force of friction over the load [-]
};
inline ShakedownPoint shakedown_point(const RailPatch& patch, const PatchForce& friction, double shear_yield) {
    return {patch.peak_pressure / shear_yield,
            std::hypot(friction.force.longitudinal, friction.force.lateral) / patch.load};
}

}  // namespace rollbem
