// The patches of one plane of contact, made from its pressures.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
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
    double lower;  ///< along n [m]
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
    const Outline& outline = *patch.outline;
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
                          const Outline& outline) {
    const auto angle = [&](double s) {
        const RailSurface::Point p = geometry.rail_at(plane.rail_s + s, track_x + plane.x);
        return std::atan2(p.slope[1], p.slope[0]);
    };
    return std::abs(angle(outline.high()) - angle(outline.low()));
}

/// The largest depth of the undeformed surfaces over the cells of a patch: where they are smooth, the vertex of the
/// parabolas through the deepest cell and its neighbours.
inline double largest_depth(const NormalContact::Grid& h, const Eigen::ArrayXXd& pressure) {
    constexpr double smooth = 0.1;  // across edges of profiles parabolas are meaningless
    Eigen::Index i = 0, j = 0;
    double least = (pressure > 0).select(h, h.maxCoeff()).minCoeff(&i, &j);
    const auto vertex = [&](double before, double after) {
        const double bend = before - 2 * h(i, j) + after, slope = (after - before) / 2;
        return std::abs(slope) < bend && bend < smooth * std::abs(h(i, j)) ? slope * slope / (2 * bend) : 0;
    };
    if (i > 0 && i + 1 < h.rows()) least -= vertex(h(i - 1, j), h(i + 1, j));
    if (j > 0 && j + 1 < h.cols()) least -= vertex(h(i, j - 1), h(i, j + 1));
    return -least;
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
        patch.approach = of.lower + largest_depth(of.gaps.h, pressure);
        patch.peak_pressure = detail::peak_pressure(pressure);
        if (!patch.outline) {
            if (patch.has_numbers()) patch.status = Status::few_cells;
        } else {
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
