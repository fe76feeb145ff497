// Position and speeds of a wheelset on its track.
#pragma once

#include "../detail/language.hpp"

namespace rollbem {

enum class WheelsetSide { left, right };

/// Track axes: x forward, y to the right, z down, the origin between the rails at the height of their tops. The middle
/// of the axle is at (0, lateral, height - r0), rolled about x, then yawed about z.
struct WheelsetPosition {
    double lateral = 0;  ///< y_ws [m]
    double height = 0;   ///< z_ws [m], positive down; 0 where profiles with z = 0 at the tape circle and the top touch
    double roll = 0;     ///< phi [rad]
    double yaw = 0;      ///< psi [rad]
    double along = 0;    ///< place of the middle of the axle along the track [m], for rails that change along it
    double pitch = 0;    ///< turn about the axle [rad], for wheels that are not round; negative when rolling forward
};

/// Speeds of a wheelset: the middle of its axle moves by `forward` along x. In a curve of radius R to the right the yaw
/// rate is V/R, the left wheel is the outer one, and the yaw is measured from the radial direction.
struct WheelsetSpeeds {
    double forward = 1;                  ///< V [m/s]
    double pitch_rate = 0;               ///< rate of the turn about the axle [rad/s], about -V/r forward; 0: locked
    double lateral = 0, vertical = 0;    ///< velocity of the middle of the axle [m/s]
    double roll_rate = 0, yaw_rate = 0;  ///< [rad/s]
};

}  // namespace rollbem
