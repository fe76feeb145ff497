// The place of a profile that is nearest to a point.
#pragma once

#include <algorithm>

#include <Eigen/Core>

#include "../profile.hpp"

namespace rollbem::detail {

/// s of the foot of the perpendicular from a point to the spline about the nearest of its points; an end where the
/// point lies beyond it.
inline double foot_of(const Profile& profile, double y, double z) {
    Eigen::Index nearest = 0;
    ((profile.y() - y).square() + (profile.z() - z).square()).minCoeff(&nearest);
    const double low = profile.s()[(std::max<Eigen::Index>)(nearest - 1, 0)],
                 high = profile.s()[(std::min)(nearest + 1, profile.size() - 1)];
    double s = profile.s()[nearest];
    for (int k = 0; k < 8; ++k) {
        const Profile::Point p = profile.at(s);
        const double size = p.slope[0] * p.slope[0] + p.slope[1] * p.slope[1];
        s = std::clamp(s + ((y - p.y) * p.slope[0] + (z - p.z) * p.slope[1]) / size, low, high);
    }
    return s;
}

}  // namespace rollbem::detail
