// Bodies of vehicle/contact_zones.hpp. Internal.
#pragma once

#include "../contact_zones.hpp"

#include <algorithm>
#include <utility>

#include "../../detail/require.hpp"

namespace rollbem {

ROLLBEM_DECL ContactZones::ContactZones(std::vector<Cut> cuts) : cuts_(std::move(cuts)) {
    constexpr const char* name = "ContactZones";
    detail::require(count() <= most, name, "number of zones", count(), "be at most 4");
    for (std::size_t k = 0; k < cuts_.size(); ++k) {
        detail::require_finite(name, "y of a cut", cuts_[k].y);
        detail::require_positive(name, "half_width of a cut", cuts_[k].half_width);
        if (k == 0) continue;
        detail::require(low(k) >= high(k - 1), name, "lower end of a cut", low(k),
                        "be at least the upper end of the one before");
    }
}

ROLLBEM_DECL double ContactZones::weight(Eigen::Index zone, double y) const {
    const auto k = static_cast<std::size_t>(zone);
    const double from = k > 0 ? beyond(cuts_[k - 1], y) : 1, to = k < cuts_.size() ? beyond(cuts_[k], y) : 0;
    return (std::max)(from - to, 0.0);
}

ROLLBEM_DECL double ContactZones::beyond(const Cut& cut, double y) {
    const double t = ((y - cut.y) / cut.half_width + 1) / 2;
    if (t <= 0) return 0;
    return t < 1 ? t * t * t * (10 + t * (6 * t - 15)) : 1;
}

}  // namespace rollbem
