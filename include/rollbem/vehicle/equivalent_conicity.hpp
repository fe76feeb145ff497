// Equivalent conicity (EN 15302): the cone on which a free wheelset has the same wave length, from the rolling radii of
// both wheels over its lateral position. Rigid contact, no roll, no yaw. SI units.
#pragma once

#include "../detail/decl.hpp"

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "../normal/rigid_contact.hpp"
#include "wheelset_on_track.hpp"

namespace rollbem {

/// The points at which both wheels of a wheelset touch their rails, at one lateral position.
struct RollingRadii {
    double lateral = 0;                    ///< y_ws [m]
    std::array<RigidContact, 2> wheels{};  ///< left, right, each as on the right wheel
    Status status = Status::not_finite;    ///< the worse of both wheels; beyond_clearance where a wheel climbs over its
                                           ///< flange

    /// Delta r = r_right - r_left [m].
    double difference() const { return wheels[1].rolling_radius - wheels[0].rolling_radius; }
    /// Lateral distance between both points of contact [m].
    double distance() const { return wheels[1].y + wheels[0].y; }
};

/// Finds the rolling radii of a wheelset without roll and yaw. Throws std::invalid_argument unless wheels are round and
/// rails straight.
RollingRadii rolling_radii(const WheelsetOnTrack& wheelset, double lateral);

/// Delta r over the lateral position, straight between points, and its integral.
class RadiusDifference {
public:
    /// `lateral` grows [m]; the distance e between the points of contact and the mean radius r0 [m] determine wave
    /// lengths. Throws std::invalid_argument unless there are at least two points, all finite, and the lengths are
    /// positive.
    RadiusDifference(Eigen::ArrayXd lateral, Eigen::ArrayXd difference, double distance, double radius);

    double low() const { return y_[0]; }               ///< the least lateral position [m]
    double high() const { return y_[y_.size() - 1]; }  ///< the largest [m]
    double distance() const { return distance_; }      ///< e [m]
    double radius() const { return radius_; }          ///< r0 [m]
    const Eigen::ArrayXd& lateral() const { return y_; }
    const Eigen::ArrayXd& difference() const { return difference_; }

    /// Delta r [m] at low() <= lateral <= high().
    double at(double lateral) const;
    /// The integral of Delta r from low() on [m^2].
    double integral(double lateral) const;

private:
    Eigen::Index interval(double lateral) const;
    double slope(Eigen::Index i) const { return (difference_[i + 1] - difference_[i]) / (y_[i + 1] - y_[i]); }

    Eigen::ArrayXd y_, difference_, integral_;
    double distance_, radius_;
};

/// The wave of one amplitude. Its numbers are valid only if the status is ok.
struct EquivalentConicity {
    double amplitude = 0;         ///< A [m], half of y_max - y_min
    double tan_gamma = 0;         ///< cone with the same wave length as the solution of y'' = -Delta r/(e r0)
    double tan_gamma_linear = 0;  ///< cone by harmonic linearisation of Delta r
    double wavelength = 0;        ///< wave length of tan_gamma [m]
    double y_min = 0, y_max = 0;  ///< lateral positions where the wave turns [m]
    /// beyond_clearance where the wave does not fit between the ends of Delta r; unstable where no wave of this
    /// amplitude passes the equilibrium, as Delta r falls. It is the worse status of both waves: a conicity has no
    /// numbers without the other one.
    Status status = Status::not_finite;
};

/// Both methods of EN 15302: the integral of the kinematic wave, of any shape, and the harmonic wave with the same
/// amplitude and a middle of its own about which Delta r is balanced. On cones both are Klingel's wave; where Delta r
/// is 0 all over the wave, the conicity is 0 and the wave length infinite. Throws std::invalid_argument unless the
/// amplitude [m] is finite and at least 1e-6.
EquivalentConicity equivalent_conicity(const RadiusDifference& radii, double amplitude);

/// The nonlinearity parameter of EN 15302 [1/m]: the conicity at 4 mm minus the conicity at 2 mm, over 2 mm; nothing
/// without both.
std::optional<double> conicity_nonlinearity(const RadiusDifference& radii);

/// Delta r in steps [m] from the middle of the track to both ends of the range in which neither wheel is lifted, at an
/// end of a profile or climbing over its flange. The benchmark of EN 15302 has the same step; a jump of Delta r is
/// smeared over one step. Nothing where a wheel has no contact in the middle, or Delta r does not rise through 0.
/// Throws std::invalid_argument as rolling_radii() does, and unless the step lies in [1e-6, 1e-3].
std::optional<RadiusDifference> radius_difference(const WheelsetOnTrack& wheelset, double step = 1e-4);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/equivalent_conicity.ipp"
#endif
