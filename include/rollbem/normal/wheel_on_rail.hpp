// A wheel on a rail: the geometry of both surfaces, contact patches under a load or at a height, and rigid contact.
#pragma once

#include "../detail/decl.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../detail/hidden.hpp"
#include "../scene/patch_contact.hpp"
#include "../scene/wheelset.hpp"
#include "../status.hpp"
#include "normal_contact.hpp"
#include "profile.hpp"
#include "surface.hpp"

namespace rollbem {

namespace detail {

class CurveIndex;

}  // namespace detail

/// The plane of contact has its origin at the reference point, s along y turned by the angle, and n into the rail;
/// patch and pressures are in the axes (x, s) from there. Patches of one plane share its reference point.
struct RailPatch {
    double x = 0, y = 0, z = 0;              ///< reference point, on the rail, in track axes [m]
    double rail_y = 0, wheel_y = 0;          ///< reference point in both profiles [m]
    double rail_s = 0, wheel_s = 0;          ///< arc lengths of both profiles up to it [m]
    double angle = 0;                        ///< delta of the plane [rad]: s = (0, cos delta, sin delta)
    double rolling_radius = 0;               ///< r0 + z of the wheel at the reference point [m]
    double load = 0;                         ///< integral of the pressures over the plane [N]
    double approach = 0;                     ///< the largest of wheel_n - rail_n over the cells, undeformed [m]
    double peak_pressure = 0;                ///< [Pa]
    double area = 0;                         ///< [m^2]
    double half_length = 0, half_width = 0;  ///< half the extents [m]
    int steps = 0;                           ///< number of steps of the last normal problem
    double residual = 0;                     ///< largest gap under pressure, over the approach
    Status status = Status::not_finite;
    NormalContact::Cells grid{};  ///< grid of the pressures
    Eigen::ArrayXXd pressure;     ///< [Pa], nx x ny
    /// n of the rail's surface in each row of cells (ny), and of the wheel's where it lies deepest, undeformed [m].
    Eigen::ArrayXd rail_n, wheel_n;
    /// dn/ds of the rail's surface in each row of cells (ny) [-]. Pressures act along its normals (0, -dn/ds, 1).
    Eigen::ArrayXd rail_slope;
    std::optional<PatchContact::Outline> outline;
    bool has_numbers() const { return rollbem::has_numbers(status); }

    /// A vector given in the plane's axes, in track axes, and the place (x, s, n).
    std::array<double, 3> in_track(double along, double across, double normal) const {
        const double sine = std::sin(angle), cosine = std::cos(angle);
        return {along, across * cosine - normal * sine, across * sine + normal * cosine};
    }
    std::array<double, 3> place(double along, double across, double normal) const {
        const std::array<double, 3> arm = in_track(along, across, normal);
        return {x + arm[0], y + arm[1], z + arm[2]};
    }
    /// delta of the rail's surface [rad] and y of its profile [m] at s.
    double surface_angle(double s) const { return angle + std::atan(in_rows(rail_slope, s)); }
    double surface_y(double s) const { return rail_y + s * std::cos(angle) - in_rows(rail_n, s) * std::sin(angle); }
    /// The vertical load of the pressures [N].
    double vertical_load() const;

private:
    /// Numbers of rows of cells at s, linear between their middles.
    double in_rows(const Eigen::ArrayXd& rows, double s) const;
};

namespace detail {
class RegionSolver;
}  // namespace detail

/// The right wheel of a wheelset on the right rail; a left one is its mirror image, with y, roll, yaw and lateral
/// quantities reversed. Immutable.
///
/// \code
/// #include <rollbem/profiles.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const WheelOnRail wheel(s1002(), rail_60e1());
///     WheelOnRail::Workspace workspace;
///     const auto contact = wheel.solve_for_load({.lateral = 2e-3}, 80e3, workspace);
///     return contact.status == Status::ok && contact.patches[0].peak_pressure > 1e9 ? 0 : 1;
/// }
/// \endcode
class WheelOnRail {
public:
    /// Dimensions that place profiles in the track. Track axes: x forward, y to the right, z down, the origin between
    /// the rails at the height of their tops.
    struct Dimensions {
        double gauge = 1.435,
               gauge_depth = 0.014;     ///< least distance between the rails down to this depth below their tops [m]
        double flange_back = 1.36;      ///< distance between the backs of both flanges [m]
        double tape_offset = 0.07;      ///< distance of the tape circle from the flange's back [m]
        double radius = 0.46;           ///< radius r0 of the tape circle [m]
        double shear_modulus = 8.2e10;  ///< G [Pa] of both bodies
        double poisson_ratio = 0.28;    ///< nu [-] of both bodies
        struct Origin {
            double y, z;
        };
        /// Origin of the right rail's profile in track axes [m], in place of the gauge: for rollers, rails that change
        /// along the track, and profiles without an inner side.
        std::optional<Origin> rail_origin{};
    };

    /// The right wheel and the right rail of a track; left ones are mirror images. Immutable.
    class Geometry {
    public:
        /// Throws std::invalid_argument unless dimensions are positive and finite, 0 <= nu <= 0.5, profiles that are no
        /// pieces look like a wheel and a rail (require_wheel, require_rail), and the rail's place is given by
        /// rail_origin or, of a straight rail, by its inner side.
        Geometry(WheelSurface wheel, RailSurface rail, const Dimensions& dimensions);

        const WheelSurface& wheel() const { return wheel_; }
        const RailSurface& rail() const { return rail_; }
        const Dimensions& dimensions() const { return dimensions_; }
        double compliance() const {
            return (1 - dimensions_.poisson_ratio) / dimensions_.shear_modulus;
        }                                                           ///< 1/E* [1/Pa]
        Dimensions::Origin rail_origin() const { return origin_; }  ///< origin of the right rail in track axes [m]
        /// Origin of the right wheel, from the middle of the axle [m].
        double wheel_origin() const { return wheel_origin_; }

        /// Whether neither the wheel nor the rail changes along the way: contacts are then found on the wheel's
        /// silhouette.
        bool is_plain() const { return wheel_.is_round() && rail_.is_straight(); }
        /// Whether both profiles are rough from point to point, where is_plain(), as raw measurements are.
        bool is_rough() const { return rough_; }
        /// The rail's points, where is_plain().
        const detail::CurveIndex& index() const { return *index_; }

        WheelSurface::Placed placed(const WheelsetPosition& at) const {
            return {wheel_, wheel_origin_, dimensions_.radius, at};
        }

        /// A point of the rail in track axes; x [m] along the track.
        RailSurface::Point rail_at(double s, double x) const;

    private:
        WheelSurface wheel_;
        RailSurface rail_;
        Dimensions dimensions_;
        Dimensions::Origin origin_{};
        double wheel_origin_ = 0;
        bool rough_ = false;
        std::shared_ptr<const detail::CurveIndex> index_;  ///< shared by copies; none unless is_plain()
    };

    /// Throws std::invalid_argument as Geometry.
    WheelOnRail(WheelSurface wheel, RailSurface rail, const Dimensions& dimensions)
        : geometry_(std::move(wheel), std::move(rail), dimensions) {}
    WheelOnRail(WheelSurface wheel, RailSurface rail) : WheelOnRail(std::move(wheel), std::move(rail), Dimensions{}) {}

    /// The right wheel on the right rail; for a left wheel, y, angle and places belong to its mirror image.
    struct RigidContact {
        double height = 0;               ///< z_ws [m] at which the wheel, lowered, begins to touch
        double x = 0, y = 0, z = 0;      ///< point of contact in track axes [m]
        double rail_y = 0, wheel_y = 0;  ///< point of contact in both profiles [m]
        double wheel_s = 0;              ///< arc length of the wheel's profile up to it [m]
        double angle = 0;                ///< delta of both surfaces at the point [rad]
        double rolling_radius = 0;       ///< r0 + z of the wheel at the point [m]
        Status status =
            Status::not_finite;  ///< ok, no_contact, undefined_section, or end_of_profile: a curve ends there
    };

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
        /// many, the sooner if both profiles are rough (Geometry::is_rough()). If not, results are those of the given
        /// cells. Square cells are halved for outlines alone.
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

    const Geometry& geometry() const { return geometry_; }
    const Dimensions& dimensions() const { return geometry_.dimensions(); }
    double compliance() const { return geometry_.compliance(); }          ///< 1/E* [1/Pa]
    double rail_origin() const { return geometry_.rail_origin().y; }      ///< y of the right rail's origin [m]
    double wheel_origin() const { return geometry_.wheel_origin(); }      ///< of the right wheel, from the middle [m]
    const Profile& wheel() const { return geometry_.wheel().profile(); }  ///< profile of a round wheel
    const Profile& rail() const { return geometry_.rail().profile(); }    ///< profile of a straight rail or a roller

private:
    Geometry geometry_;
};

/// Finds the contact at this lateral position, roll and yaw; nothing else of `position` is used. Throws
/// std::invalid_argument unless the wheel is round and the rail straight.
WheelOnRail::RigidContact rigid_contact(const WheelOnRail& wheel, const WheelsetPosition& position);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/wheel_on_rail.ipp"
#endif
