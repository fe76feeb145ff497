// Points of a rail's curves at one place along the track.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "../contact_geometry.hpp"
#include "curve_index.hpp"

namespace rollbem::detail {

/// Points of the rail's curves at x, a quarter of a millimetre apart.
inline std::vector<SurfaceSample> rail_samples(const ContactGeometry& geometry, double x) {
    const RailSurface& rail = geometry.rail();
    constexpr double distance = 2.5e-4;
    std::vector<SurfaceSample> samples;
    for (std::size_t part = 0; part < rail.parts(); ++part) {
        if (!rail.covers(part, x)) continue;
        const double length = rail.length(part);
        const auto count = static_cast<std::size_t>(std::ceil(length / distance));
        for (std::size_t k = 0; k <= count; ++k) {
            const double s = length * double(k) / double(count);
            const CurvePoint p = geometry.rail_at(part, s, x);
            const double size = std::hypot(p.slope[0], p.slope[1]);
            if (p.defined) samples.push_back({p.y, p.z, -p.slope[1] / size, p.slope[0] / size, part, s});
        }
    }
    return samples;
}

}  // namespace rollbem::detail
