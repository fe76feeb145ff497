// A wheelset on real rails: the position in which both wheels carry their loads, creepages, and normal contacts.
#pragma once

#include "../detail/decl.hpp"

#include <array>
#include <cstddef>
#include <utility>

#include "../normal/pressure_grid.hpp"
#include "../normal/wheel_on_rail.hpp"
#include "../scene/creepage.hpp"
#include "../scene/mirror.hpp"
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
PatchContact contact_of(const RailPatch& patch, const TrackDimensions& dimensions);

/// The pressures of a patch, bilinear between the centres of the cells.
PressureGrid pressure_of(const RailPatch& patch);

/// Both wheels of a wheelset on both rails. Immutable.
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
        WheelsetPosition seen(Side side) const {
            WheelsetPosition at = seen_from(side, position);
            at.height = wheels[std::size_t(side)].height;
            return at;
        }
    };

    /// A position in the sense of the wheel of one side: reversed for the left one.
    static WheelsetPosition seen_from(Side side, const WheelsetPosition& position) {
        return mirrored(position, Mirror::of(side));
    }
    static WheelsetSpeeds seen_from(Side side, const WheelsetSpeeds& speeds) {
        return mirrored(speeds, Mirror::of(side));
    }

    /// Position and contacts in which normal forces carry the wheels' vertical loads [N], left and right, at this
    /// lateral position and yaw.
    Contacts solve(WheelsetPosition position, const std::array<double, 2>& loads, Workspace& workspace,
                   Free free = Free::height_and_roll, const WheelOnRail::Options& options = {}) const;
    [[deprecated("solve")]] Contacts carry(const WheelsetPosition& position, const std::array<double, 2>& loads,
                                           Workspace& workspace, Free free = Free::height_and_roll,
                                           const WheelOnRail::Options& options = {}) const {
        return solve(position, loads, workspace, free, options);
    }

private:
    std::array<WheelOnRail, 2> wheels_;
    bool is_mirrored_ = false;
};

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/wheelset_on_track.ipp"
#endif
