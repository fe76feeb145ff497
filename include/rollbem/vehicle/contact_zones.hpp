// ContactZones: smooth weights that divide the rail's surface into zones and sum up to 1 everywhere.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../detail/require.hpp"

namespace rollbem {

/// Zones along the lateral place y [m] in track axes, as on the right rail, from the smallest y (the flange's side) to
/// the largest. A quantity of a zone is an integral over the wheel's pressures times the zone's weight, so that it
/// changes continuously when patches merge, part, appear or vanish.
///
/// Invariant: at most four zones; half-widths are positive, and cuts ascend and do not overlap.
class ContactZones {
public:
    static constexpr Eigen::Index most = 4;

    /// The transition between two zones, from y - half_width to y + half_width.
    struct Cut {
        double y, half_width;  ///< [m]
    };

    /// One zone.
    ContactZones() = default;
    /// Throws std::invalid_argument if the cuts break the invariant.
    explicit ContactZones(std::vector<Cut> cuts) : cuts_(std::move(cuts)) {
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

    Eigen::Index count() const { return static_cast<Eigen::Index>(cuts_.size()) + 1; }
    const std::vector<Cut>& cuts() const { return cuts_; }

    /// The share of a zone in a quantity at y, 0 to 1; twice continuously differentiable.
    double weight(Eigen::Index zone, double y) const {
        const auto k = static_cast<std::size_t>(zone);
        const double from = k > 0 ? beyond(cuts_[k - 1], y) : 1, to = k < cuts_.size() ? beyond(cuts_[k], y) : 0;
        return (std::max)(from - to, 0.0);
    }

private:
    double low(std::size_t k) const { return cuts_[k].y - cuts_[k].half_width; }
    double high(std::size_t k) const { return cuts_[k].y + cuts_[k].half_width; }
    static double beyond(const Cut& cut, double y) {
        const double t = ((y - cut.y) / cut.half_width + 1) / 2;
        if (t <= 0) return 0;
        return t < 1 ? t * t * t * (10 + t * (6 * t - 15)) : 1;
    }

    std::vector<Cut> cuts_;
};

}  // namespace rollbem
