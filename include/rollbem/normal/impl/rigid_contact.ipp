// Bodies of normal/rigid_contact.hpp. Internal.
#pragma once

#include "../rigid_contact.hpp"

#include <cmath>
#include <optional>

#include "../../detail/require.hpp"
#include "../detail/finite_position.hpp"
#include "../detail/silhouette_search.hpp"

namespace rollbem {

ROLLBEM_DECL RigidContact rigid_contact(const WheelOnRail& wheel, const WheelsetPosition& position) {
    const ContactGeometry& geometry = wheel.geometry();
    detail::require(geometry.is_plain(), "rigid_contact", "sections of wheel and rail", "several",
                    "be one: a round wheel on a straight rail");
    RigidContact contact;
    const WheelsetPosition used{.lateral = position.lateral, .roll = position.roll, .yaw = position.yaw};
    if (!detail::is_finite(used)) return contact;
    detail::SilhouetteSearch search;
    contact.status = search.locate(geometry, used);
    if (contact.status != Status::ok) return contact;
    const std::optional<detail::PenetrationSample> point = search.first_point();
    if (!point) {
        contact.status = Status::end_of_profile;
        return contact;
    }
    const Profile::Point on_wheel = wheel.wheel().at(point->wheel_s);
    // the deepest sample touches, this point lies a little below the rail
    const double raised = point->closest.depth / std::cos(point->closest.angle());
    contact.height = search.touch() - raised;
    contact.x = point->x;
    contact.y = point->y;
    contact.z = point->z - raised;
    contact.rail_y = point->y - wheel.rail_origin();
    contact.wheel_y = on_wheel.y;
    contact.wheel_s = point->wheel_s;
    contact.angle = point->closest.angle();
    contact.rolling_radius = wheel.dimensions().radius + on_wheel.z;
    return contact;
}

}  // namespace rollbem
