// The numbers of a point of contact in a table, and the creepages at which its ellipse has the forces of the patch.
#pragma once

#include <array>
#include <cmath>

#include <Eigen/Core>

#include "creep_force_grid.hpp"

namespace rollbem {

/// Rows of a point of contact. A point stands for the pressures in one zone.
struct ContactRow {
    enum Of : Eigen::Index {
        share,   ///< share of the wheel's vertical load [-]
        arm_x,   ///< x of the point from the middle of the axle, in track axes, over the yaw [m/rad]
        arm_y,   ///< y of the point from there [m]
        arm_z,   ///< z of the point from there [m]
        angle,   ///< angle of the pressures' mean normal [rad]
        radius,  ///< rolling radius [m]
        length,  ///< a/N^(1/3) [m/N^(1/3)]
        width,   ///< b/N^(1/3)
        c11,     ///< coefficient of the ellipse; so are the next two
        c22,
        c23,
        kept,        ///< share of the correction that stays in full sliding, 0 to 1
        scale,       ///< factor of all creepages: the geometric mean of the correction's first two diagonal entries
        correction,  ///< 3 x 3 by rows, of (xi, eta, phi c): divided by the scale, minus the identity
        correction_by_yaw = correction + 9,  ///< odd part of the correction, over the yaw [1/rad]
        peak = correction_by_yaw + 9,        ///< largest pressure over N^(1/3) [Pa/N^(1/3)]
        rail_y,                              ///< place in the rail's profile [m]
        wheel_y,                             ///< place in the wheel's profile [m]
        rows
    };
    /// Rows that are positive where a zone carries.
    static constexpr std::array<Of, 6> positive{length, width, c11, c22, scale, peak};
    using Values = Eigen::Array<double, rows, 1, Eigen::DontAlign>;
};

namespace detail {

/// Creepages at which an ellipse has the forces of the patch that it stands for: the patch's creepages times E^-1 L
/// while the contact sticks. In full sliding two parts remain: the scale, which does not turn the slip, and the share
/// `kept` of the rest. `of(row)` are numbers of the point, `bound` is mu N.
template <class Scalar, class Rows>
std::array<Scalar, 3> ellipse_creepages(const std::array<Scalar, 3>& creepage, const Scalar& a, const Scalar& b,
                                        double shear_modulus, const Scalar& bound, const Rows& of) {
    using std::sqrt;
    using enum ContactRow::Of;
    const Scalar size = of(scale), c = sqrt(a * b);
    const Scalar xi = creepage[0] * size, eta = creepage[1] * size, spin = creepage[2] * c * size;
    const Scalar along = of(c11) * xi, across = of(c22) * eta + of(c23) * spin;
    const Scalar turning = of(c11) * of(c22) * spin * spin, square = along * along + across * across + turning;
    const Scalar slip = sqrt(square + Scalar(1e-200)) * (shear_modulus * a * b);  // no division by 0 in its derivative
    const Scalar sticking = bound * CreepForceGrid::half_way;
    const Scalar sum = sticking + slip;
    const Scalar reach = sum > 0 ? Scalar(of(kept) + (1 - of(kept)) * sticking / sum) : Scalar(1);
    const auto corrected = [&](const Scalar& own, Eigen::Index row) -> Scalar {
        const Eigen::Index entry = correction + 3 * row;
        return own + reach * (of(entry) * xi + of(entry + 1) * eta + of(entry + 2) * spin);
    };
    return {corrected(xi, 0), corrected(eta, 1), corrected(spin, 2) / c};
}

}  // namespace detail

}  // namespace rollbem
