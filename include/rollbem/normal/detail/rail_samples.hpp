// Points of a rail's curve at one place along the track.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "../wheel_on_rail.hpp"
#include "curve_index.hpp"

namespace rollbem::detail {

/// Points of the rail's curve at x, a quarter of a millimetre apart, where it has any.
inline std::vector<SurfaceSample> rail_samples(const WheelOnRail::Geometry& geometry, double x) {
    const double length = geometry.rail().length();
    const auto count = static_cast<std::size_t>(std::ceil(length / CurveIndex::spacing));
    std::vector<SurfaceSample> samples;
    for (std::size_t k = 0; k <= count; ++k) {
        const double s = length * double(k) / double(count);
        const RailSurface::Point p = geometry.rail_at(s, x);
        const double size = std::hypot(p.slope[0], p.slope[1]);
        if (p.defined) samples.push_back({p.y, p.z, -p.slope[1] / size, p.slope[0] / size, s});
    }
    return samples;
}

}  // namespace rollbem::detail
