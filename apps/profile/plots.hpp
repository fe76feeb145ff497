// Pictures of profile_study.
#pragma once

#include <string>
#include <vector>

#include <rollbem/normal/wheel_on_rail.hpp>

#include "support/plot.hpp"

namespace profile {

struct Drawn {
    bool left;
    rollbem::RailPatch patch;  ///< as on the right wheel
};

/// Patches from above: pressures in steps of a fifth of the largest one, and outlines.
study::Plot draw_patches(const std::vector<Drawn>& patches);

/// Wheel above rail, and lines that join where they touch, one for each row.
study::Plot draw_contact_points(const rollbem::WheelOnRail& wheel, const std::vector<std::string>& columns,
                                const std::vector<study::Row>& rows);

}  // namespace profile
