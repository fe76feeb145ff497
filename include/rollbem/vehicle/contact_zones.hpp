// ContactZones: smooth weights that divide the rail's surface into zones and sum up to 1 everywhere.
#pragma once

#include "../detail/decl.hpp"

#include <cstddef>
#include <vector>

#include <Eigen/Core>

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
    explicit ContactZones(std::vector<Cut> cuts);

    Eigen::Index count() const { return static_cast<Eigen::Index>(cuts_.size()) + 1; }
    const std::vector<Cut>& cuts() const { return cuts_; }

    /// The share of a zone in a quantity at y, 0 to 1; twice continuously differentiable.
    double weight(Eigen::Index zone, double y) const;

private:
    double low(std::size_t k) const { return cuts_[k].y - cuts_[k].half_width; }
    double high(std::size_t k) const { return cuts_[k].y + cuts_[k].half_width; }
    static double beyond(const Cut& cut, double y);

    std::vector<Cut> cuts_;
};

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/contact_zones.ipp"
#endif
