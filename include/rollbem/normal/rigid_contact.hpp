// Contact of a rigid wheel with a rigid rail, the limit of a vanishing load. SI units.
#pragma once

#include <cmath>
#include <optional>

#include "../detail/require.hpp"
#include "../scene/wheelset.hpp"
#include "../status.hpp"
#include "detail/silhouette_search.hpp"
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
inline RigidContact rigid_contact(const WheelOnRail& wheel, const WheelsetPosition& position) {
    const ContactGeometry& geometry = wheel.geometry();
    detail::require(geometry.is_plain(), "rigid_contact", "sections of wheel and rail", "several",
                    "be one: a round wheel on a straight rail");
    RigidContact contact;
    const WheelsetPosition used{.lateral = position.lateral, .roll = position.roll, .yaw = position.yaw};
    if (!detail::is_finite(used)) return contact;
    detail::SilhouetteSearch<> search;
    contact.status = search.locate(geometry, used);
    if (contact.status != Status::ok) return contact;
    const std::optional<detail::SurfaceCut> cut = search.first_point();
    if (!cut) {
        contact.status = Status::end_of_profile;
        return contact;
    }
    const Profile::Point on_wheel = wheel.wheel().at(cut->wheel_s);
    // the deepest sample touches, this point lies a little below the rail
    const double raised = cut->foot.depth / std::cos(cut->foot.angle());
    contact.height = search.touch() - raised;
    contact.x = cut->x;
    contact.y = cut->y;
    contact.z = cut->z - raised;
    contact.rail_y = cut->y - wheel.rail_origin();
    contact.wheel_y = on_wheel.y;
    contact.wheel_s = cut->wheel_s;
    contact.angle = cut->foot.angle();
    contact.rolling_radius = wheel.dimensions().radius + on_wheel.z;
    return contact;
}

}  // namespace rollbem
