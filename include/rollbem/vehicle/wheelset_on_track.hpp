// A wheelset on real rails: the position in which both wheels carry their loads, creepages, and normal contacts.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "../detail/finite.hpp"
#include "../detail/rising_root.hpp"
#include "../normal/pressure_grid.hpp"
#include "../normal/wheel_on_rail.hpp"
#include "../scene/creepage.hpp"
#include "../scene/mirror.hpp"
#include "../scene/patch_contact.hpp"
#include "../scene/wheelset.hpp"
#include "detail/wheelset_velocity.hpp"

namespace rollbem {

/// The place, in track axes, at which the creepages of a patch are taken and the force and moment of its friction act:
/// the wheel's surface at the reference point, below the rail's surface.
inline std::array<double, 3> creepage_place(const RailPatch& patch) { return patch.place(0, 0, patch.approach); }

namespace detail {

/// The velocity of the wheel on the rail at a point (x, s, n) of a patch's plane: along x, along s turned by `tilt`
/// into the plane's normal [m/s], and about the plane's normal [rad/s].
class SlipVelocity {
public:
    SlipVelocity(const RailPatch& patch, const WheelsetPosition& at, const WheelsetSpeeds& speeds, double radius)
        : patch_(patch), at_(at), radius_(radius), velocity_(velocity_of(at, speeds)) {}

    Creepage<double> operator()(double x, double s, double n, double tilt) const {
        return at(patch_.place(x, s, n), patch_.angle + tilt);
    }
    Creepage<double> at_reference() const { return at(creepage_place(patch_), patch_.angle); }

private:
    Creepage<double> at(const std::array<double, 3>& place, double angle) const {
        const std::array<double, 3> arm{place[0], place[1] - at_.lateral, place[2] - (at_.height - radius_)};
        const auto slip = velocity_.slip(arm, std::sin(angle), std::cos(angle));
        const double sine = std::sin(patch_.angle), cosine = std::cos(patch_.angle);
        return {slip[0], slip[1], velocity_.turn()[2] * cosine - velocity_.turn()[1] * sine};
    }

    const RailPatch& patch_;
    const WheelsetPosition& at_;
    double radius_;
    WheelsetVelocity<double> velocity_;
};

}  // namespace detail

/// V [m/s] at which a patch rolls, the mean of the wheelset's speed and the circumferential speed at the reference
/// point: negative when rolling backwards, 0 if the patch does not roll.
inline double rolling_velocity_of(const RailPatch& patch, const WheelsetSpeeds& speeds) {
    return (speeds.forward - speeds.pitch_rate * patch.rolling_radius) / 2;
}

/// The rigid slip of the wheel on the rail at the reference point of a patch, over |V| of rolling_velocity_of, in the
/// axes (x, s, n) of its plane [-, -, 1/m]: a wheel braked while it rolls forward has a positive longitudinal creepage.
/// Not finite where V = 0. Its forces act on the wheel. CONTACT's CKSI, CETA and CPHI have the opposite sign, and
/// CONTACT's forces act on the rail.
inline Creepage<double> creepage_of(const RailPatch& patch, const WheelsetPosition& at, const WheelsetSpeeds& speeds,
                                    double radius) {
    const Creepage<double> slip = detail::SlipVelocity(patch, at, speeds, radius).at_reference();
    const double speed = std::abs(rolling_velocity_of(patch, speeds));
    return {slip.longitudinal / speed, slip.lateral / speed, slip.spin / speed};
}

/// The rigid slip of curved surfaces at points (x, s) of the plane in addition to creepage_of, a row for each point,
/// along x and s [-]: slip of the wheel's undeformed surface in each row of cells, along the tangent midway between
/// both surfaces. It matters where arcs of a rail join: a patch is so wide there that its rolling radii differ by 1e-3.
inline Eigen::MatrixX2d curved_slip_of(const RailPatch& patch, const WheelsetPosition& at, const WheelsetSpeeds& speeds,
                                       double radius, const Eigen::ArrayXd& x, const Eigen::ArrayXd& s) {
    const detail::SlipVelocity slip(patch, at, speeds, radius);
    const double speed = std::abs(rolling_velocity_of(patch, speeds));
    const Creepage<double> linear = creepage_of(patch, at, speeds, radius);
    const CellGrid& grid = patch.grid;
    const Eigen::ArrayXd middle = (patch.rail_n + patch.wheel_n) / 2;
    Eigen::MatrixX2d rows(x.size(), 2);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        const double row = std::clamp((s[i] - grid.y(0)) / grid.dy, 0.0, double(grid.ny - 1) - 1e-9);
        const auto j = static_cast<Eigen::Index>(row);
        const double part = row - double(j), n = (1 - part) * patch.wheel_n[j] + part * patch.wheel_n[j + 1];
        const Creepage<double> here = slip(x[i], s[i], n, std::atan((middle[j + 1] - middle[j]) / grid.dy));
        rows(i, 0) = here.longitudinal / speed - (linear.longitudinal - linear.spin * s[i]);
        rows(i, 1) = here.lateral / speed - (linear.lateral + linear.spin * x[i]);
    }
    return rows;
}

/// The contact patch in the form for friction: its outline in the axes (x, s) of its plane.
inline PatchContact<double> contact_of(const RailPatch& patch, const TrackDimensions& dimensions) {
    detail::require(patch.outline.has_value(), "contact_of", "status of the patch", name(patch.status), "be ok");
    return {*patch.outline, dimensions.shear_modulus, dimensions.poisson_ratio};
}

/// The pressures of a patch, bilinear between the centres of the cells.
inline PressureGrid<double> pressure_of(const RailPatch& patch) {
    const CellGrid& grid = patch.grid;
    return {Eigen::ArrayXd::LinSpaced(grid.nx, grid.x(0), grid.x(grid.nx - 1)),
            Eigen::ArrayXd::LinSpaced(grid.ny, grid.y(0), grid.y(grid.ny - 1)), patch.pressure.matrix()};
}

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

inline auto WheelsetOnTrack::solve(WheelsetPosition position, const std::array<double, 2>& loads, Workspace& workspace,
                                   Free free, const WheelOnRail::Options& options) const -> Contacts {
    Contacts contacts;
    // height of the right wheel minus height of the left one; a roll lowers the right wheel, so that the gap falls
    const auto gap = [&](double roll) {
        position.roll = roll;
        for (const Side side : sides) {
            const auto k = static_cast<std::size_t>(side);
            WheelsetPosition at = seen_from(side, position);
            at.height += height_above(side);
            contacts.wheels[k] = free == Free::nothing
                                     ? wheels_[k].solve_at_height(at, workspace.wheels[k], options)
                                     : wheels_[k].solve_for_load(at, loads[k], workspace.wheels[k], options);
        }
        contacts.status = (std::max)(contacts.wheels[0].status, contacts.wheels[1].status);
        return contacts.wheels[1].height - (contacts.wheels[0].height - height_above(Side::left));
    };
    double roll = position.roll, excess = gap(roll);
    contacts.position = position;
    if (free != Free::height_and_roll) return contacts;
    // contacts, and with them heights, jump a little where grids change
    constexpr double precise = 1e-10, jump = 1e-6;  // tolerances of the height [m]
    detail::RisingRoot root(wheels_[0].wheel_origin() + wheels_[1].wheel_origin(), 5e-3);
    // a piece with few cells at one roll need not have few at the next
    const auto goes_on = [&] { return has_numbers(contacts.status) || contacts.status == Status::few_cells; };
    for (int k = 0; k < 40 && goes_on() && std::abs(excess) > precise; ++k) {
        roll = root.next(roll, -excess);
        if (root.width() < 1e-10 && std::abs(excess) < jump) break;
        excess = gap(roll);
    }
    if (has_numbers(contacts.status) && std::abs(excess) > jump) contacts.status = Status::load_not_reached;
    if (!has_numbers(contacts.status)) {
        for (WheelOnRail::Contact& wheel : contacts.wheels) wheel.status = contacts.status;
    }
    position.height = (contacts.wheels[0].height - height_above(Side::left) + contacts.wheels[1].height) / 2;
    contacts.position = position;
    return contacts;
}

}  // namespace rollbem
