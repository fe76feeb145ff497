// Contact of a rigid wheel with a rigid rail, the limit of a vanishing load. SI units.
#pragma once

#include "../detail/decl.hpp"

#include "../scene/wheelset.hpp"
#include "../status.hpp"
#include "wheel_on_rail.hpp"

namespace rollbem {

/// The right wheel on the right rail; for a left wheel, y, angle and places belong to its mirror image.
struct RigidContact {
    double height = 0;                   ///< z_ws [m] at which the wheel, lowered, begins to touch
    double x = 0, y = 0, z = 0;          ///< point of contact in track axes [m]
    double rail_y = 0, wheel_y = 0;      ///< point of contact in both profiles [m]
    double wheel_s = 0;                  ///< arc length of the wheel's profile up to it [m]
    double angle = 0;                    ///< delta of both surfaces at the point [rad]
    double rolling_radius = 0;           ///< r0 + z of the wheel at the point [m]
    Status status = Status::not_finite;  ///< ok, no_contact, undefined_section, or end_of_profile: a curve ends there
};

/// Finds the contact at this lateral position, roll and yaw; nothing else of `position` is used. Throws
/// std::invalid_argument unless the wheel is round and the rail straight.
RigidContact rigid_contact(const WheelOnRail& wheel, const WheelsetPosition& position);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/rigid_contact.ipp"
#endif
