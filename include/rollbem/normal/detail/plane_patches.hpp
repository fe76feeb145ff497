// The patches of one plane of contact, made from its pressures.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../wheel_on_rail.hpp"
#include "contact_gaps.hpp"
#include "patch_shape.hpp"

namespace rollbem {

namespace detail {

/// The vertical load [N] of pressures in a plane turned by `angle`, which act along the normals of a surface whose rows
/// have the slopes dn/ds.
inline double vertical_load(const Eigen::ArrayXXd& pressure, const NormalContact::Cells& grid,
                            const Eigen::ArrayXd& slope, double angle) {
    return (pressure.colwise().sum().transpose() * (std::cos(angle) - std::sin(angle) * slope)).sum() * grid.dx *
           grid.dy;
}

/// The pressures of one plane, with the wheel lower than its gaps assume.
struct PlanePressures {
    const ContactPlane& plane;
    const NormalContact::Cells& grid;
    const Gaps& gaps;
    const NormalContact::Solution& solution;
    const NormalContact::Grid& pressure;
    double lower;   ///< along n [m]
    bool resolved;  ///< cells suffice, as far as is known
};

/// The worst status of the cells beside pressures: not ok where a surface has no point there.
inline Status border_of(const Gaps& gaps, const Eigen::ArrayXXd& pressure) {
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
    const PatchContact::Outline& outline = *patch.outline;
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
inline double turn_across(const WheelOnRail::Geometry& geometry, const ContactPlane& plane, double track_x,
                          const PatchContact::Outline& outline) {
    const auto angle = [&](double s) {
        const RailSurface::Point p = geometry.rail_at(plane.rail_s + s, track_x + plane.x);
        return std::atan2(p.slope[1], p.slope[0]);
    };
    return std::abs(angle(outline.high()) - angle(outline.low()));
}

/// The largest depth of the undeformed surfaces in a patch: about its deepest cell, on a line of points across it and
/// then on one along it, with the vertex of the parabola through the deepest point and its neighbours on both.
inline double largest_depth(const WheelOnRail::Geometry& geometry, const WheelsetPosition& at, const PlanePressures& of,
                            const Eigen::ArrayXXd& pressure) {
    constexpr Eigen::Index count = 17;  // of points, over two cells
    const NormalContact::Grid& h = of.gaps.h;
    Eigen::Index i = 0, j = 0, deepest = 0;
    (pressure > 0).select(h, h.maxCoeff()).minCoeff(&i, &j);
    const WheelSurface::Placed placed = geometry.placed(at);
    GapFinder finder;
    Gaps gaps;
    double beside = 0;  // depth of vertices beside points
    const auto least_on = [&](const NormalContact::Cells& line) {
        finder.find(geometry, placed, at.height, at.along, of.plane, line, gaps);
        const Eigen::ArrayXd on = gaps.h.reshaped();
        const double least = on.minCoeff(&deepest);
        const auto is_known = [&](Eigen::Index k) { return gaps.known.reshaped()[k] == Status::ok; };
        if (deepest == 0 || deepest == count - 1 || !is_known(deepest - 1) || !is_known(deepest + 1)) return least;
        const double before = on[deepest - 1], after = on[deepest + 1], bend = before - 2 * least + after,
                     slope = (after - before) / 2;
        if (bend > 0) beside += slope * slope / (2 * bend);
        return least;
    };
    const double dx = 2 * of.grid.dx / (count - 1), ds = 2 * of.grid.dy / (count - 1);
    NormalContact::Cells line{1, count, of.grid.x(i), of.grid.y(j) - of.grid.dy, dx, ds};
    least_on(line);
    line = {count, 1, line.x_0 - of.grid.dx, line.y(deepest), dx, ds};
    return (std::max)(beside - least_on(line), -h(i, j));  // gaps may not be known beside the cell
}

/// What all patches of a plane have in common.
inline RailPatch patch_on(const WheelOnRail::Geometry& geometry, const WheelsetPosition& at, const PlanePressures& of) {
    const ContactPlane& plane = of.plane;
    const WheelSurface::Placed placed = geometry.placed(at);
    RailPatch patch;
    patch.x = plane.x;
    patch.y = plane.y;
    patch.z = plane.z;
    patch.rail_s = plane.rail_s;
    patch.wheel_s = GapFinder::wheel_place(placed, at.height, plane);
    patch.rail_y = plane.y - geometry.rail_origin().y;
    const WheelSurface::Point wheel =
        placed.unplaced(patch.wheel_s, plane.x).value_or(geometry.wheel().at(patch.wheel_s, -at.pitch));
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

/// Splits pressures into patches that every row cuts in one interval. Patches too small for an outline that carry less
/// than `negligible` [N] are dropped.
inline void add_patches(const WheelOnRail::Geometry& geometry, const WheelsetPosition& at, const PlanePressures& of,
                        double negligible, std::vector<RailPatch>& patches) {
    constexpr double doubtful = 0.2;  // [rad]
    const RailPatch common = patch_on(geometry, at, of);
    for (Eigen::ArrayXXd& pressure : split_into_patches(of.pressure)) {
        RailPatch patch = common;
        patch.status = of.solution.status;
        patch.load = pressure.sum() * of.grid.dx * of.grid.dy;
        patch.outline = contact_outline(of.grid, pressure);
        if (!patch.outline && patch.load < negligible) continue;
        patch.approach = of.lower + largest_depth(geometry, at, of, pressure);
        patch.peak_pressure = detail::peak_pressure(pressure);
        const bool unsettled = !of.resolved && patch.status == Status::not_converged;
        if (unsettled || ((!patch.outline || !of.resolved) && patch.has_numbers())) patch.status = Status::few_cells;
        if (patch.outline) {
            measure(patch);
            if (patch.status == Status::ok && turn_across(geometry, of.plane, at.along, *patch.outline) > doubtful) {
                patch.status = Status::doubtful_plane;
            }
        }
        patch.status = (std::max)(patch.status, border_of(of.gaps, pressure));
        patch.pressure = std::move(pressure);
        patches.push_back(std::move(patch));
    }
}

}  // namespace detail

}  // namespace rollbem
