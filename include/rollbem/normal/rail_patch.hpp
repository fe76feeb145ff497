// RailPatch: one patch of a wheel on a rail, made from the pressures in a plane.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../scene/mirror.hpp"
#include "../scene/outline.hpp"
#include "../status.hpp"
#include "detail/contact_gaps.hpp"
#include "detail/patch_shape.hpp"
#include "normal_contact.hpp"

namespace rollbem {

namespace detail {

/// The vertical load [N] of pressures in a plane turned by `angle`, which act along the normals of a surface whose rows
/// have the slopes dn/ds.
template <std::same_as<double> Real = double>
double vertical_load(const Eigen::ArrayXXd& pressure, const CellGrid& grid, const Eigen::ArrayXd& slope, double angle) {
    return (pressure.colwise().sum().transpose() * (std::cos(angle) - std::sin(angle) * slope)).sum() * grid.dx *
           grid.dy;
}

}  // namespace detail

/// The plane of contact has its origin at the reference point, s along y turned by the angle, and n into the rail;
/// patch and pressures are in the axes (x, s) from there.
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
    CellGrid grid{};           ///< grid of the pressures
    Eigen::ArrayXXd pressure;  ///< [Pa], nx x ny
    /// n of the rail's surface in each row of cells (ny), and of the wheel's where it lies deepest, undeformed [m].
    Eigen::ArrayXd rail_n, wheel_n;
    /// dn/ds of the rail's surface in each row of cells (ny) [-]. Pressures act along its normals (0, -dn/ds, 1).
    Eigen::ArrayXd rail_slope;
    std::optional<Outline<double>> outline;
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
    double vertical_load() const { return detail::vertical_load(pressure, grid, rail_slope, angle); }

private:
    /// Numbers of rows of cells at s, linear between their middles.
    double in_rows(const Eigen::ArrayXd& rows, double s) const {
        const double row = std::clamp((s - grid.y_0) / grid.dy, 0.0, double(grid.ny - 1));
        const auto low = (std::min)(Eigen::Index(row), grid.ny - 2);
        return rows[low] + (row - double(low)) * (rows[low + 1] - rows[low]);
    }
};

/// The mirror image of a patch. Lengths along the profiles stay as they are.
template <std::same_as<double> Real = double>
RailPatch mirrored(RailPatch patch, const Mirror& mirror) {
    const auto [x, y, z] = mirror.of_vector();
    patch.x *= x;
    for (double* of : {&patch.y, &patch.rail_y, &patch.wheel_y, &patch.angle}) *of *= y;
    if (x < 0) {
        patch.grid.x_0 = -patch.grid.x(patch.grid.nx - 1);
        patch.pressure = patch.pressure.colwise().reverse().eval();
    }
    if (y < 0) {
        patch.grid.y_0 = -patch.grid.y(patch.grid.ny - 1);
        patch.pressure = patch.pressure.rowwise().reverse().eval();
        for (Eigen::ArrayXd* of : {&patch.rail_n, &patch.wheel_n}) *of = of->reverse().eval();
        patch.rail_slope = -patch.rail_slope.reverse().eval();
    }
    if (patch.outline) patch.outline = mirrored(*patch.outline, mirror);
    return patch;
}

namespace detail {

/// The pressures of one plane, with the wheel lower than its gaps assume.
struct PlanePressures {
    const ContactPlane& plane;
    const CellGrid& grid;
    const Gaps& gaps;
    const NormalContact::Solution& solution;
    const NormalContact::Grid& pressure;
    double lower;  ///< along n [m]
};

/// The worst status of the cells beside pressures: not ok where a surface has no point there.
template <std::same_as<double> Real = double>
Status border_of(const Gaps& gaps, const Eigen::ArrayXXd& pressure) {
    Status worst = Status::ok;
    if (gaps.all_known) return worst;
    const Eigen::Index nx = pressure.rows(), ny = pressure.cols();
    for (Eigen::Index j = 0; j < ny; ++j) {
        for (Eigen::Index i = 0; i < nx; ++i) {
            if (!(pressure(i, j) > 0)) continue;
            const Eigen::Index left = (std::max)(i - 1, Eigen::Index(0)), low = (std::max)(j - 1, Eigen::Index(0));
            worst = (std::max)(
                worst,
                gaps.known.block(left, low, (std::min)(i + 2, nx) - left, (std::min)(j + 2, ny) - low).maxCoeff());
        }
    }
    return worst;
}

/// Sets the extents and the area of an outline.
inline void measure(RailPatch& patch) {
    const Outline<double>& outline = *patch.outline;
    patch.area = outline.area();
    patch.half_width = (outline.high() - outline.low()) / 2;
    double ahead = outline.leading(outline.low()), behind = ahead;
    for (const double at : outline.y()) {
        ahead = (std::max)(ahead, outline.leading(at));
        behind = (std::min)(behind, outline.trailing(at));
    }
    patch.half_length = (ahead - behind) / 2;
}

/// The turn of the rail's surface across the outline [rad].
inline double turn_across(const ContactGeometry& geometry, const ContactPlane& plane, double track_x,
                          const Outline<double>& outline) {
    const auto angle = [&](double s) {
        const CurvePoint p = geometry.rail_at(plane.rail_s + s, track_x + plane.x);
        return std::atan2(p.slope[1], p.slope[0]);
    };
    return std::abs(angle(outline.high()) - angle(outline.low()));
}

/// The largest depth of the undeformed surfaces over the cells of a piece: where they are smooth, the vertex of the
/// parabolas through the deepest cell and its neighbours.
template <std::same_as<double> Real = double>
double largest_depth(const NormalContact::Grid& h, const Eigen::ArrayXXd& piece) {
    constexpr double smooth = 0.1;  // across edges of profiles parabolas are meaningless
    Eigen::Index i = 0, j = 0;
    double least = (piece > 0).select(h, h.maxCoeff()).minCoeff(&i, &j);
    const auto vertex = [&](double before, double after) {
        const double bend = before - 2 * h(i, j) + after, slope = (after - before) / 2;
        return std::abs(slope) < bend && bend < smooth * std::abs(h(i, j)) ? slope * slope / (2 * bend) : 0;
    };
    if (i > 0 && i + 1 < h.rows()) least -= vertex(h(i - 1, j), h(i + 1, j));
    if (j > 0 && j + 1 < h.cols()) least -= vertex(h(i, j - 1), h(i, j + 1));
    return -least;
}

/// The common part of all pieces of a plane.
template <std::same_as<double> Real = double>
RailPatch patch_on(const ContactGeometry& geometry, const WheelsetPosition& at, const PlanePressures& of) {
    const ContactPlane& plane = of.plane;
    const PlacedWheel placed = geometry.placed(at);
    RailPatch patch;
    patch.x = plane.x;
    patch.y = plane.y;
    patch.z = plane.z;
    patch.rail_s = plane.rail_s;
    patch.wheel_s = GapFinder<>::wheel_place(placed, at.height, plane);
    patch.rail_y = plane.y - geometry.rail_origin().y;
    const WheelSurface::Point wheel = placed.unplaced(patch.wheel_s, plane.x)
                                          .value_or(geometry.wheel().at(patch.wheel_s, -at.pitch));
    patch.wheel_y = wheel.y;
    patch.angle = plane.angle;
    patch.rolling_radius = geometry.dimensions().radius + wheel.z;
    patch.steps = of.solution.steps;
    patch.residual = of.solution.residual;
    patch.grid = of.grid;
    patch.rail_n = of.gaps.rail_n;
    patch.rail_slope = of.gaps.rail_slope;
    patch.wheel_n = of.gaps.rail_n - of.gaps.h.colwise().minCoeff().transpose() + of.lower;
    return patch;
}

/// Divides pressures into patches that every row cuts in one interval. Crumbs (pieces too small for an outline that
/// carry less than `crumb` [N]) are dropped.
template <std::same_as<double> Real = double>
void add_patches(const ContactGeometry& geometry, const WheelsetPosition& at, const PlanePressures& of, double crumb,
                 std::vector<RailPatch>& patches) {
    constexpr double doubtful = 0.2;  // [rad]
    const RailPatch common = patch_on(geometry, at, of);
    for (Eigen::ArrayXXd& piece : pieces(of.pressure)) {
        RailPatch patch = common;
        patch.status = of.solution.status;
        patch.load = piece.sum() * of.grid.dx * of.grid.dy;
        patch.outline = contact_outline(of.grid, piece);
        if (!patch.outline && patch.load < crumb) continue;
        patch.approach = of.lower + largest_depth(of.gaps.h, piece);
        patch.peak_pressure = detail::peak_pressure(piece);
        if (!patch.outline) {
            if (patch.has_numbers()) patch.status = Status::few_cells;
        } else {
            measure(patch);
            if (patch.status == Status::ok && turn_across(geometry, of.plane, at.along, *patch.outline) > doubtful) {
                patch.status = Status::doubtful_plane;
            }
        }
        patch.status = (std::max)(patch.status, border_of(of.gaps, piece));
        patch.pressure = std::move(piece);
        patches.push_back(std::move(patch));
    }
}

}  // namespace detail
}  // namespace rollbem
