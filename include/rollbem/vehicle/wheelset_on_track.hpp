// A wheelset on real rails: the position in which both wheels carry their loads, creepages, and normal contacts.
#pragma once

#include "../detail/decl.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include <Eigen/Core>

#include "../normal/pressure.hpp"
#include "../normal/wheel_on_rail.hpp"
#include "../scene/creepage.hpp"
#include "../scene/patch_contact.hpp"
#include "../scene/wheelset.hpp"

namespace rollbem {

/// The place, in track axes, at which the creepages of a patch are taken and the force and moment of its friction act:
/// the wheel's surface at the reference point, below the rail's surface.
inline std::array<double, 3> creepage_place(const RailPatch& patch) { return patch.place(0, 0, patch.approach); }

/// V [m/s] at which a patch rolls, the mean of the wheelset's speed and the circumferential speed at the reference
/// point: negative when rolling backwards, 0 if the patch does not roll.
inline double rolling_velocity_of(const RailPatch& patch, const WheelsetSpeeds& speeds) {
    return (speeds.forward - speeds.pitch_rate * patch.rolling_radius) / 2;
}

/// The rigid slip of the wheel on the rail at the reference point of a patch, over |V| of rolling_velocity_of, in the
/// axes (x, s, n) of its plane [-, -, 1/m]: a wheel braked while it rolls forward has a positive longitudinal creepage.
/// Not finite where V = 0. Its forces act on the wheel. CONTACT's CKSI, CETA and CPHI have the opposite sign, and
/// CONTACT's forces act on the rail.
Creepage creepage_of(const RailPatch& patch, const WheelsetPosition& at, const WheelsetSpeeds& speeds, double radius);

/// The rigid slip of curved surfaces at points (x, s) of the plane in addition to creepage_of, a row for each point,
/// along x and s [-]: slip of the wheel's undeformed surface in each row of cells, along the tangent midway between
/// both surfaces. It matters where arcs of a rail join: a patch is so wide there that its rolling radii differ by 1e-3.
Eigen::MatrixX2d curved_slip_of(const RailPatch& patch, const WheelsetPosition& at, const WheelsetSpeeds& speeds,
                                double radius, const Eigen::ArrayXd& x, const Eigen::ArrayXd& s);

/// The contact patch in the form for friction: its outline in the axes (x, s) of its plane.
PatchContact contact_of(const RailPatch& patch, const WheelOnRail::Dimensions& dimensions);

/// The pressures of a patch, bilinear between the centres of the cells.
PressureGrid pressure_of(const RailPatch& patch);

/// Both wheels of a wheelset on both rails. Immutable.
///
/// \code
/// #include <rollbem/vehicle.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const WheelsetOnTrack wheelset(WheelOnRail(s1002(), rail_60e1()));
///     WheelsetOnTrack::Workspace workspace;
///     const auto contacts = wheelset.solve({.lateral = 2e-3, .yaw = 1e-3}, {80e3, 80e3}, workspace);
///     return contacts.status == Status::ok ? 0 : 1;
/// }
/// \endcode
class WheelsetOnTrack {
public:
    using Side = WheelsetSide;
    static constexpr std::array<Side, 2> sides{Side::left, Side::right};

    /// Both wheels on both rails, as mirror images of each other.
    explicit WheelsetOnTrack(const WheelOnRail& both) : WheelsetOnTrack(both, both) { is_mirrored_ = true; }
    /// The left wheel is given as its mirror image, a right wheel on a right rail. If radii of tape circles differ,
    /// heights of the wheelset refer to the right wheel's radius, heights of a wheel to its own.
    WheelsetOnTrack(WheelOnRail left, WheelOnRail right) : wheels_{std::move(left), std::move(right)} {}

    /// Whether the left wheel and rail are mirror images of the right ones, which the choice of constructor determines.
    bool is_mirrored() const { return is_mirrored_; }
    const WheelOnRail& wheel(Side side = Side::right) const { return wheels_[std::size_t(side)]; }
    /// Height of a wheel minus height of the wheelset [m].
    double height_above(Side side) const { return wheel(side).dimensions().radius - wheel().dimensions().radius; }

    /// The points at which both wheels of a wheelset touch their rails, at one lateral position.
    struct RollingRadii {
        double lateral = 0;                                 ///< y_ws [m]
        std::array<WheelOnRail::RigidContact, 2> wheels{};  ///< left, right, each as on the right wheel
        Status status =
            Status::not_finite;  ///< the worse of both wheels; beyond_clearance where a wheel climbs over its
                                 ///< flange

        /// Delta r = r_right - r_left [m].
        double difference() const { return wheels[1].rolling_radius - wheels[0].rolling_radius; }
        /// Lateral distance between both points of contact [m].
        double distance() const { return wheels[1].y + wheels[0].y; }
    };

    /// Delta r over the lateral position, straight between points, and its integral.
    ///
    /// \code
    /// #include <rollbem/vehicle.hpp>
    ///
    /// int main() {
    ///     using namespace rollbem;
    ///     const WheelsetOnTrack wheelset(WheelOnRail(s1002(), rail_60e1()));
    ///     const auto radii = radius_difference(wheelset);
    ///     return radii && equivalent_conicity(*radii, 3e-3).tan_gamma > 0.01 ? 0 : 1;
    /// }
    /// \endcode
    class RadiusDifference {
    public:
        /// The wave of one amplitude. Its numbers are valid only if the status is ok.
        struct Conicity {
            double amplitude = 0;         ///< A [m], half of y_max - y_min
            double tan_gamma = 0;         ///< cone with the same wave length as the solution of y'' = -Delta r/(e r0)
            double tan_gamma_linear = 0;  ///< cone by harmonic linearisation of Delta r
            double wavelength = 0;        ///< wave length of tan_gamma [m]
            double y_min = 0, y_max = 0;  ///< lateral positions where the wave turns [m]
            /// beyond_clearance where the wave does not fit between the ends of Delta r; unstable where no wave of this
            /// amplitude passes the equilibrium, as Delta r falls. It is the worse status of both waves: a conicity has
            /// no numbers without the other one.
            Status status = Status::not_finite;
        };

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

    struct Workspace {
        std::array<WheelOnRail::Workspace, 2> wheels;
    };

    /// Quantities that follow from the loads; the others are given by the position.
    enum class Free {
        height_and_roll,  ///< a wheelset on its rails
        height,           ///< height of each wheel for itself, at the given roll
        nothing,          ///< the loads follow from the position
    };

    struct Contacts {
        WheelsetPosition position;  ///< position whose height and roll carry the loads; a wheel has its own height
        /// Left, right, each as on the right wheel: y, angle, roll, yaw and lateral quantities of the left one
        /// reversed.
        std::array<WheelOnRail::Contact, 2> wheels;
        Status status = Status::not_finite;  ///< the worse of both wheels

        /// The position in the sense of one wheel.
        WheelsetPosition seen(Side side) const;
    };

    /// A position in the sense of the wheel of one side: reversed for the left one.
    static WheelsetPosition seen_from(Side side, const WheelsetPosition& position);
    static WheelsetSpeeds seen_from(Side side, const WheelsetSpeeds& speeds);

    /// Position and contacts in which normal forces carry the wheels' vertical loads [N], left and right, at this
    /// lateral position and yaw.
    Contacts solve(WheelsetPosition position, const std::array<double, 2>& loads, Workspace& workspace,
                   Free free = Free::height_and_roll, const WheelOnRail::Options& options = {}) const;

private:
    std::array<WheelOnRail, 2> wheels_;
    bool is_mirrored_ = false;
};

/// Finds the rolling radii of a wheelset without roll and yaw. Throws std::invalid_argument unless wheels are round and
/// rails straight.
WheelsetOnTrack::RollingRadii rolling_radii(const WheelsetOnTrack& wheelset, double lateral);

/// Both methods of EN 15302: the integral of the kinematic wave, of any shape, and the harmonic wave with the same
/// amplitude and a middle of its own about which Delta r is balanced. On cones both are Klingel's wave; where Delta r
/// is 0 all over the wave, the conicity is 0 and the wave length infinite. Throws std::invalid_argument unless the
/// amplitude [m] is finite and at least 1e-6.
WheelsetOnTrack::RadiusDifference::Conicity equivalent_conicity(const WheelsetOnTrack::RadiusDifference& radii,
                                                                double amplitude);

/// The nonlinearity parameter of EN 15302 [1/m]: the conicity at 4 mm minus the conicity at 2 mm, over 2 mm; nothing
/// without both.
std::optional<double> conicity_nonlinearity(const WheelsetOnTrack::RadiusDifference& radii);

/// Delta r in steps [m] from the middle of the track to both ends of the range in which neither wheel is lifted, at an
/// end of a profile or climbing over its flange. The benchmark of EN 15302 has the same step; a jump of Delta r is
/// smeared over one step. Nothing where a wheel has no contact in the middle, or Delta r does not rise through 0.
/// Throws std::invalid_argument as rolling_radii() does, and unless the step lies in [1e-6, 1e-3].
std::optional<WheelsetOnTrack::RadiusDifference> radius_difference(const WheelsetOnTrack& wheelset, double step = 1e-4);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/wheelset_on_track.ipp"
#endif
