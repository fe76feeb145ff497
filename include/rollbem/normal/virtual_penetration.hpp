// Contacts by the virtual penetration of Kik and Piotrowski, as in the time loop of vehicle codes: quick, and an
// approximation of the contacts of Hertz and of NormalContact. SI units.
#pragma once

#include "../detail/decl.hpp"

#include <vector>

#include <Eigen/Core>

#include "../status.hpp"
#include "wheel_on_rail.hpp"

namespace rollbem {

/// A contact by the virtual penetration (J. Piotrowski, W. Kik, Vehicle System Dynamics 46, 2008, without a correction
/// of its shape). It covers the interpenetration that is left when the deepest place of a stretch keeps `share` of its
/// depth, its length follows from the wheel's circle, and its pressure is p_0 sqrt(x_l(s)^2 - x^2)/x_l(s_0), where
/// s_0 is its own deepest place. Between half-spaces this pressure displaces s_0 by its remaining depth over `share`:
/// by the approach, unless the stretch is deeper elsewhere.
struct VirtualPenetration {
    /// Parameters of the pressures.
    struct Parameters {
        double radius;        ///< R of the circle along x: 2 R depth = x_l^2 [m]
        double compliance;    ///< 1/E* [1/Pa]
        double share = 0.55;  ///< part of the approach; 1/2 gives circular contacts the right size
    };

    double y = 0, z = 0;                     ///< deepest place on the rail, in track axes [m]
    double angle = 0;                        ///< angle of the plane [rad]
    double approach = 0;                     ///< the largest depth of the undeformed surfaces [m]
    double load = 0;                         ///< load over the plane [N]
    double peak_pressure = 0;                ///< p_0 [Pa]
    double area = 0;                         ///< [m^2]
    double half_length = 0, half_width = 0;  ///< x_l(s_0), half the extent along s [m]
    /// ok; without numbers: end_of_profile where the surfaces are not known beside it, or why the wheel at this
    /// position has no contacts to be found: no_contact beside the rail, undefined_section, too_deep, not_finite.
    Status status = Status::not_finite;
};

/// Contacts in one plane of undeformed surfaces, from their depths in one another [m] in rows `step` [m] apart. Depths
/// in the first and the last row must not be positive; y is s from row 0, z and angle are 0. Throws
/// std::invalid_argument unless step, radius and compliance are positive, the share lies in (0, 1] and there are 3
/// rows.
std::vector<VirtualPenetration> virtual_penetration(const Eigen::ArrayXd& depth, double step,
                                                    const VirtualPenetration::Parameters& contact);

/// Contacts of a wheel at a position, under any load, in the order along its profile, in the planes of WheelOnRail;
/// none where the wheel is lifted, one without numbers where contacts cannot be found. Patches do not displace each
/// other. The sections at the middle of each contact determine it, so yaw has no other effect. Throws
/// std::invalid_argument unless the wheel is round and the rail straight, and the share lies in (0, 1].
std::vector<VirtualPenetration> virtual_penetration(const WheelOnRail& wheel, const WheelsetPosition& position,
                                                    double share = 0.55);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/virtual_penetration.ipp"
#endif
