// The numbers of a point of contact in a table. Internal.
#pragma once

#include "../../detail/language.hpp"

#include <array>

#include <Eigen/Core>

namespace rollbem {

/// Rows of a point of contact. A point stands for the pressures in one zone.
struct ContactRow {
    /// Rows before `peak` count for forces. Those of the correction's odd part lie a whole number of packets of four
    /// after the correction.
    enum Of : Eigen::Index {
        share,                   ///< share of the wheel's vertical load [-]
        arm_x,                   ///< x of the point from the middle of the axle, in track axes, over the yaw [m/rad]
        arm_y,                   ///< y of the point from there [m]
        correction,              ///< 3 x 3 by rows, of (xi, eta, phi c): divided by the scale, minus the identity
        arm_z = correction + 9,  ///< z of the point from the middle of the axle [m]
        angle,                   ///< angle of the pressures' mean normal [rad]
        plane,   ///< mean angle of the planes of the patches, in which friction acts, minus the angle [rad]
        radius,  ///< rolling radius [m]
        length,  ///< a/N^(1/3) [m/N^(1/3)]
        width,   ///< b/N^(1/3)
        c11,     ///< coefficient of the ellipse; so are the next two
        c22,
        c23,
        full_sliding_share,  ///< share of the correction that stays in full sliding, 0 to 1
        creepage_scale,  ///< factor of all creepages: the geometric mean of the correction's first two diagonal entries
        bend,            ///< 3 x 3 by rows: correction half-way to full sliding, of (xi, eta, phi c) times the scale
        peak = bend + 9,    ///< largest pressure over N^(1/3) [Pa/N^(1/3)]
        rail_y,             ///< place in the rail's profile [m]
        wheel_y,            ///< place in the wheel's profile [m]
        correction_by_yaw,  ///< odd part of the correction, over the yaw [1/rad]
        rows = correction_by_yaw + 9
    };
    static_assert((correction_by_yaw - correction) % 4 == 0);
    /// Rows that are positive where a zone carries.
    static constexpr std::array<Of, 6> positive{length, width, c11, c22, creepage_scale, peak};
    using Values = Eigen::Array<double, rows, 1, Eigen::DontAlign>;
};

}  // namespace rollbem
