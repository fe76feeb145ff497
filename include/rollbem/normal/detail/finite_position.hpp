// Whether positions and speeds of a wheelset are numbers.
#pragma once

#include "../../detail/finite.hpp"
#include "../../scene/wheelset.hpp"

namespace rollbem::detail {

inline bool is_finite(const WheelsetPosition& at) {
    return is_finite(at.lateral) && is_finite(at.height) && is_finite(at.roll) && is_finite(at.yaw) &&
           is_finite(at.along) && is_finite(at.pitch);
}
inline bool is_finite(const WheelsetSpeeds& speeds) {
    return is_finite(speeds.forward) && is_finite(speeds.pitch_rate) && is_finite(speeds.lateral) &&
           is_finite(speeds.vertical) && is_finite(speeds.roll_rate) && is_finite(speeds.yaw_rate);
}

}  // namespace rollbem::detail
