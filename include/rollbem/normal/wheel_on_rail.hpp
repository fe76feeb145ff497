// Contacts of a wheel on a rail: the patches at a height, and the height at which they carry a load. SI units.
#pragma once

#include "../detail/decl.hpp"

#include <utility>
#include <vector>

#include "../detail/hidden.hpp"
#include "../scene/wheelset.hpp"
#include "contact_geometry.hpp"
#include "rail_patch.hpp"
#include "standard_profiles.hpp"

namespace rollbem {

namespace detail {
class RegionSolver;
}  // namespace detail

/// The right wheel of a wheelset on the right rail; a left one is its mirror image, with y, roll, yaw and lateral
/// quantities reversed. Immutable.
class WheelOnRail {
public:
    /// Throws std::invalid_argument as ContactGeometry.
    WheelOnRail(WheelSurface wheel, RailSurface rail, const TrackDimensions& dimensions = {})
        : geometry_(std::move(wheel), std::move(rail), dimensions) {}

    struct Options {
        Eigen::Index cells_x = 40, cells_s = 20;  ///< numbers of cells across the contact to begin with; cells_s is
                                                  ///< larger in patches with two lobes
        double tolerance = 1e-6;                  ///< relative error of the load, and of gaps over the approach
        /// If positive, the side [m] of square cells, one centred on the reference point, as in CONTACT; replaces the
        /// numbers of cells.
        double cell_size = 0;
        /// Whether patches of one wheel displace each other; those split from one region always do.
        bool interaction = true;
        /// Whether cells are halved, in the directions that need it, where halves would change the largest pressure of
        /// a patch by more than 5 %, or its load or approach by more than 0.5 %; few_cells where this would take too
        /// many. If not, results are those of the given cells. Square cells are halved for outlines alone.
        bool halves_cells = true;
    };

    /// Memory of a solution, and the start of the search for the next one.
    class Workspace {
        friend class WheelOnRail;
        double approach_ = 0;  // vertical approach of the last solution [m]; 0: none
        detail::Hidden<detail::RegionSolver> solver_;
    };

    struct Contact {
        double height = 0;                   ///< z_ws at which the load is carried [m]
        std::vector<RailPatch> patches;      ///< patches, the most loaded first
        double dropped = 0;                  ///< vertical load of patches too small to have an outline [N]
        Status status = Status::not_finite;  ///< status of the worst patch
    };

    /// The contact whose pressures carry the vertical load [N] (RailPatch::vertical_load) at this lateral position,
    /// roll and yaw; the height of `position` is not used. no_contact if the load is not positive. Throws
    /// std::invalid_argument if an option is out of its range, as solve_at_height() does.
    Contact solve_for_load(const WheelsetPosition& position, double load, Workspace& workspace,
                           const Options& options) const;
    Contact solve_for_load(const WheelsetPosition& position, double load, Workspace& workspace) const {
        return solve_for_load(position, load, workspace, Options{});
    }
    /// The contact at this position and height, under any load; no_contact where the wheel is lifted, too_deep where it
    /// lies more than a millimetre within the rail.
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
    ContactGeometry geometry_;
};

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/wheel_on_rail.ipp"
#endif
