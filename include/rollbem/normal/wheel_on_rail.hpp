// Contacts of a wheel on a rail: the patches at a height, and the height at which they carry a load. SI units.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../scene/wheelset.hpp"
#include "contact_geometry.hpp"
#include "detail/contact_parts.hpp"
#include "rail_patch.hpp"
#include "standard_profiles.hpp"

namespace rollbem {

namespace detail {

inline bool is_finite(const WheelsetPosition& at) {
    return is_finite(at.lateral) && is_finite(at.height) && is_finite(at.roll) && is_finite(at.yaw) &&
           is_finite(at.along) && is_finite(at.pitch);
}
inline bool is_finite(const WheelsetSpeeds& speeds) {
    return is_finite(speeds.forward) && is_finite(speeds.pitch_rate) && is_finite(speeds.lateral) &&
           is_finite(speeds.vertical) && is_finite(speeds.roll_rate) && is_finite(speeds.yaw_rate);
}

}  // namespace detail

/// The right wheel of a wheelset on the right rail; a left one is its mirror image, with y, roll, yaw and lateral
/// quantities reversed. Immutable.
class WheelOnRail {
public:
    /// Throws std::invalid_argument as ContactGeometry.
    WheelOnRail(WheelSurface wheel, RailSurface rail, const TrackDimensions& dimensions = {})
        : geometry_(std::move(wheel), std::move(rail), dimensions) {}

    struct Options {
        Eigen::Index cells_x = 40, cells_s = 20;  ///< number of cells across the contact; more in patches with two
                                                  ///< lobes
        double tolerance = 1e-6;                  ///< relative error of the load, and of gaps over the approach
        /// If positive, the side [m] of square cells, one centred on the reference point, as in CONTACT; replaces the
        /// numbers of cells.
        double cell_size = 0;
        /// Whether patches of one wheel displace each other.
        bool interaction = true;
    };

    /// Memory of a solution, and the start of the search for the next one.
    class Workspace {
        friend class WheelOnRail;
        double approach_ = 0;  // vertical approach of the last solution [m]; 0: none
        detail::ContactParts<> parts_;
    };

    struct Contact {
        double height = 0;                   ///< z_ws at which the load is carried [m]
        std::vector<RailPatch> patches;      ///< patches, the most loaded first
        double dropped = 0;                  ///< vertical load of crumbs too small for patches [N]
        Status status = Status::not_finite;  ///< status of the worst patch
    };

    /// The contact whose pressures carry the vertical load [N] (RailPatch::vertical_load) at this lateral position,
    /// roll and yaw; the height of `position` is not used. no_contact if the load is not positive. Throws
    /// std::invalid_argument if an option is out of its range, as solve_at_height() does.
    template <std::same_as<double> Scalar = double>  // for rollbem::compiled
    Contact solve_for_load(const WheelsetPosition& position, double load, Workspace& workspace,
                           const Options& options) const;
    Contact solve_for_load(const WheelsetPosition& position, double load, Workspace& workspace) const {
        return solve_for_load(position, load, workspace, Options{});
    }
    /// The contact at this position and height, under any load; no_contact where the wheel is lifted, too_deep where it
    /// lies more than a millimetre within the rail.
    template <std::same_as<double> Scalar = double>
    Contact solve_at_height(const WheelsetPosition& position, Workspace& workspace, const Options& options) const;

    [[deprecated("solve_for_load")]] Contact carry(const WheelsetPosition& position, double load, Workspace& workspace,
                                                   const Options& options) const {
        return solve_for_load(position, load, workspace, options);
    }
    [[deprecated("solve_for_load")]] Contact carry(const WheelsetPosition& position, double load,
                                                   Workspace& workspace) const {
        return solve_for_load(position, load, workspace);
    }
    [[deprecated("solve_at_height")]] Contact press(const WheelsetPosition& position, Workspace& workspace,
                                                    const Options& options) const {
        return solve_at_height(position, workspace, options);
    }

    const ContactGeometry& geometry() const { return geometry_; }
    const TrackDimensions& dimensions() const { return geometry_.dimensions(); }
    double compliance() const { return geometry_.compliance(); }      ///< 1/E* [1/Pa]
    double rail_origin() const { return geometry_.rail_origin().y; }  ///< y of the right rail's origin [m]
    double wheel_origin() const {
        return geometry_.wheel_origin();
    }                                                                     ///< origin of the right wheel, from the
                                                                          ///< middle [m]
    const Profile& wheel() const { return geometry_.wheel().profile(); }  ///< profile of a round wheel
    const Profile& rail() const { return geometry_.rail().profile(); }    ///< profile of a straight rail or a roller

private:
    using Parts = detail::ContactParts<>;

    static void check(const Options& options) {
        constexpr const char *who = "WheelOnRail", *few = "be at least 5";
        detail::require(options.cells_x >= 5, who, "cells_x", options.cells_x, few);
        detail::require(options.cells_s >= 5, who, "cells_s", options.cells_s, few);
        detail::require(options.tolerance > 0 && options.tolerance < 1, who, "tolerance", options.tolerance,
                        "be positive and below 1");
        const double size = options.cell_size;
        detail::require(size == 0 || (size >= 1e-5 && size <= 1), who, "cell_size", size, "be 0 or lie in [1e-5, 1]");
    }
    static detail::ContactSettings settings(const Options& options) {
        return {options.cells_x, options.cells_s, options.tolerance, options.cell_size, options.interaction};
    }
    // Finds the height on coarse grids, roughly.
    template <std::same_as<double> Scalar = double>
    static Status approach_load(Parts& parts, double load, double& approach);
    // Finds the height on fine grids, the wheel lower by `lower` than its gaps assume.
    template <std::same_as<double> Scalar = double>
    static Status settle_height(Parts& parts, double load, bool first, double& approach, double& lower);
    template <std::same_as<double> Scalar = double>
    static void collect(const Parts& parts, double lower, Contact& contact);

    ContactGeometry geometry_;
};

template <std::same_as<double> Scalar>
Status WheelOnRail::approach_load(Parts& parts, double load, double& approach) {
    // loads grow like the power 3/2 of the approach
    if (!(approach > 0)) approach = 2e-5 * std::cbrt(load / 1e4 * (load / 1e4));
    double low = 0, high = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 60; ++k) {
        parts.divide(parts.touch() + approach);
        const double found = parts.carried();
        if (std::abs(found / load - 1) < 0.02) return Status::ok;
        (found < load ? low : high) = approach;
        if (high - low < 1e-3 * high) return Status::ok;  // loads jump where regions join
        const double to = found > 0 ? approach * std::pow(load / found, 2.0 / 3) : 2 * approach;
        const bool safe = to > low && to < high && (k < 8 || !detail::is_finite(high));
        approach = safe ? to : detail::is_finite(high) ? (low + high) / 2 : 2 * approach;
    }
    return Status::load_not_reached;
}

template <std::same_as<double> Scalar>
Status WheelOnRail::settle_height(Parts& parts, double load, bool first, double& approach, double& lower) {
    // planes rotate with the height: secants on the missing load
    double last = 0, step = 0, rate = -1;
    for (int round = first ? 0 : 1, k = 0; k < 12; ++round, ++k) {
        round = parts.refine(parts.touch() + approach, round, k < 3, k == 0);
        const std::optional<double> missing = parts.lower_until(load);
        if (!missing) return Status::load_not_reached;
        lower = *missing;
        const bool settled = std::abs(lower) < 1e-4 * parts.deepest() && !parts.outgrown();
        if (k > 0) rate = std::clamp((lower - last) / step, -10.0, -0.1);
        last = lower;
        step = settled ? lower : -lower / rate;
        approach += step;
        if (settled && k > 0) return Status::ok;
    }
    lower = step;
    return std::abs(last) < 1e-2 * parts.deepest() ? Status::ok : Status::load_not_reached;
}

template <std::same_as<double> Scalar>
void WheelOnRail::collect(const Parts& parts, double lower, Contact& contact) {
    contact.height = parts.height() + lower;
    contact.patches = parts.patches(lower);
    contact.dropped = parts.carried();
    for (const RailPatch& patch : contact.patches) contact.dropped -= patch.vertical_load();
    contact.status = contact.patches.empty() ? Status::no_contact : Status::ok;
    for (const RailPatch& patch : contact.patches) contact.status = (std::max)(contact.status, patch.status);
    if (parts.is_too_deep()) contact.status = (std::max)(contact.status, Status::too_deep);
    if (has_numbers(contact.status) && parts.outgrown()) contact.status = Status::not_converged;
}

template <std::same_as<double> Scalar>
auto WheelOnRail::solve_for_load(const WheelsetPosition& position, double load, Workspace& workspace,
                                 const Options& options) const -> Contact {
    check(options);
    Contact contact;
    if (!detail::is_finite(position) || !detail::is_finite(load)) return contact;
    contact.status = Status::no_contact;
    if (!(load > 0)) return contact;
    Parts& parts = workspace.parts_;
    contact.status = parts.locate(geometry_, position, settings(options));
    if (contact.status != Status::ok) return contact;
    double approach = workspace.approach_;
    contact.status = approach_load(parts, load, approach);
    if (contact.status != Status::ok) return contact;
    // finer grids if a piece has too few cells
    for (Eigen::Index times = 1; times <= 4; times *= 2) {
        double lower = 0;
        parts.set_cells(times);
        contact.status = settle_height(parts, load, times == 1, approach, lower);
        if (contact.status != Status::ok) return contact;
        workspace.approach_ = approach;
        collect(parts, lower, contact);
        if (contact.status != Status::few_cells) break;
    }
    return contact;
}

template <std::same_as<double> Scalar>
auto WheelOnRail::solve_at_height(const WheelsetPosition& position, Workspace& workspace, const Options& options) const
    -> Contact {
    check(options);
    Contact contact;
    if (!detail::is_finite(position)) return contact;
    Parts& parts = workspace.parts_;
    contact.status = parts.locate(geometry_, position, settings(options));
    if (contact.status != Status::ok) return contact;
    parts.divide(position.height);
    for (Eigen::Index times = 1; times <= 4; times *= 2) {
        parts.set_cells(times);
        parts.refine(position.height, times == 1 ? 0 : 1, true, true);
        parts.settle(0, options.tolerance, false);
        for (int k = 0; k < 4 && parts.outgrown(); ++k) {
            parts.refine(position.height, 1, true, false);
            parts.settle(0, options.tolerance, false);
        }
        collect(parts, 0, contact);
        if (contact.status != Status::few_cells) break;
    }
    return contact;
}

}  // namespace rollbem
