// Regions where a wheel lies below the surface of its rail, and the planes in which they are solved.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "../contact_geometry.hpp"

namespace rollbem::detail {

/// The point of the rail nearest to a point of the wheel.
struct Foot {
    double s, y, z;
    double depth;                 ///< depth of the wheel's point below the rail's surface, along the surface's normal
                                  ///< [m]
    std::array<double, 2> slope;  ///< slope of the curve at the foot
    bool inside;                  ///< false beyond an end of the curve

    double angle() const { return std::atan2(slope[1], slope[0]); }  ///< angle of the surface [rad]
};

/// Finds the foot from a first guess of its place; `x` along the track.
inline Foot foot_on_rail(const ContactGeometry& geometry, double s, double x, double y, double z) {
    const double length = geometry.rail().length();
    constexpr double enough = 1e-7;  // error of the place; the error of the depth is of second order in it
    Foot foot{.s = s, .y = 0, .z = 0, .depth = 0, .slope = {1, 0}, .inside = true};
    for (int k = 0; k < 10; ++k) {
        const CurvePoint p = geometry.rail_at(foot.s, x);
        const double square = p.slope[0] * p.slope[0] + p.slope[1] * p.slope[1],
                     step = ((y - p.y) * p.slope[0] + (z - p.z) * p.slope[1]) / square;
        foot = {foot.s,  p.y,      p.z, ((z - p.z) * p.slope[0] - (y - p.y) * p.slope[1]) / std::sqrt(square),
                p.slope, p.defined};
        if (std::abs(step) < enough) break;
        const double next = std::clamp(foot.s + step, 0.0, length);
        if (next == foot.s) {  // the curve ends before the normal through the point
            foot.inside = false;
            break;
        }
        foot.s = next;
    }
    return foot;
}

/// A point of the wheel and its foot on the rail.
struct SurfaceCut {
    double wheel_s, x, y, z;
    Foot foot;
    double width;  ///< the cut's share of the track's y [m], times its share of x between slices
};

/// Ends of a stretch of the rail's curve [m].
struct RailStretch {
    double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();

    bool contains(double s) const { return s >= low && s < high; }
};

/// Cuts of one region; cuts beside the rail's surface have a depth of 0.
struct Region {
    std::vector<SurfaceCut> cuts;
    double x_low = 0, x_high = 0;  ///< ends of the overlap along x [m]
    double power = 2.5;            ///< power of the depth in the weights of cuts
    RailStretch rail{};            ///< the region's stretch; cuts beyond it belong to other regions
    std::size_t body = 0;          ///< number of the run that holds the region: its parts have the same
};

/// The plane of contact: its origin on the rail, s along y turned by the angle, n into the rail; and the region in it.
struct ContactPlane {
    double x = 0, y = 0, z = 0, angle = 0, sine = 0, cosine = 1;
    double wheel_s = 0, rail_s = 0;  ///< s of both curves at the origin
    double deepest = 0;              ///< the largest depth [m]
    double low = 0, high = 0;        ///< ends of the region along s [m]
    double x_low = 0, x_high = 0;    ///< and along x, from the origin
    RailStretch rail{};              ///< stretch of the region

    double s(double y_track, double z_track) const { return (y_track - y) * cosine + (z_track - z) * sine; }
    double n(double y_track, double z_track) const { return (z_track - z) * cosine - (y_track - y) * sine; }
    /// The distance between the origins of two planes.
    double distance(const ContactPlane& other) const { return std::hypot(x - other.x, y - other.y, z - other.z); }
};

/// The point of the rail's surface below a cut that serves as reference point: z and angle at the cut's y; on a wall,
/// at the cut's foot.
struct Below {
    double depth, angle, s;
};
inline Below below(const ContactGeometry& geometry, const SurfaceCut& cut, double track_x) {
    constexpr double wall = 0.03;  // dy/ds
    const Below at_foot{cut.foot.depth, cut.foot.angle(), cut.foot.s};
    double s = cut.foot.s;
    for (int k = 0; k < 12; ++k) {
        const CurvePoint p = geometry.rail_at(s, track_x + cut.x);
        if (!(p.slope[0] > wall)) return at_foot;
        const double step = std::clamp((cut.y - p.y) / p.slope[0], -1e-3, 1e-3);
        if (std::abs(step) < 1e-7) return {(std::max)(cut.z - p.z, 0.0), std::atan2(p.slope[1], p.slope[0]), s};
        s += step;
    }
    return at_foot;
}

/// The plane of a region, by means over the region, weighted by widths along the track's y and powers of the depth;
/// `track_x`: the place along the track of the rail's curve at x = 0. Nothing if all depths of the region are 0.
inline ContactPlane plane_of(const ContactGeometry& geometry, const Region& region, double track_x) {
    ContactPlane plane;
    double sum = 0, rail_s = 0;
    const auto add = [&](bool by_width) {
        for (const SurfaceCut& cut : region.cuts) {
            if (!(cut.foot.depth > 0)) continue;
            const Below rail = below(geometry, cut, track_x);
            const double weight = (by_width ? cut.width : 1) * std::pow(rail.depth, region.power);
            sum += weight;
            plane.x += weight * cut.x;
            plane.y += weight * cut.y;
            plane.angle += weight * rail.angle;
            plane.wheel_s += weight * cut.wheel_s;
            rail_s += weight * rail.s;
            plane.deepest = (std::max)(plane.deepest, cut.foot.depth);
        }
    };
    add(true);
    if (!(sum > 0)) add(false);  // a wall
    for (double* mean : {&plane.x, &plane.y, &plane.angle, &plane.wheel_s, &rail_s}) *mean /= sum;
    plane.sine = std::sin(plane.angle);
    plane.cosine = std::cos(plane.angle);
    plane.rail = region.rail;
    // the rail's point at y, except on a wall
    CurvePoint on_rail = geometry.rail_at(rail_s, track_x + plane.x);
    for (int k = 0; k < 8 && on_rail.slope[0] > 0.05; ++k) {
        const double step = (plane.y - on_rail.y) / on_rail.slope[0];
        rail_s = std::clamp(rail_s + step, 0.0, geometry.rail().length());
        on_rail = geometry.rail_at(rail_s, track_x + plane.x);
        if (std::abs(step) < 1e-13) break;
    }
    plane.rail_s = rail_s;
    plane.y = on_rail.y;
    plane.z = on_rail.z;
    bool first = true;
    for (const SurfaceCut& cut : region.cuts) {
        if (!(cut.foot.depth > 0)) continue;
        const double s = plane.s(cut.foot.y, cut.foot.z);
        plane.low = first ? s : (std::min)(plane.low, s);
        plane.high = first ? s : (std::max)(plane.high, s);
        first = false;
    }
    plane.x_low = region.x_low - plane.x;
    plane.x_high = region.x_high - plane.x;
    return plane;
}

/// Two regions share a plane if they are less than 4 mm apart along the surface, and their normals differ by less than
/// 20 degrees.
constexpr double joined_distance = 4e-3, joined_angle = 20 * std::numbers::pi / 180;

/// The mean angle of the rail's surface at the feet of cuts or samples [rad], weighted by a power of their depths.
template <class Iterator>
double mean_angle(Iterator first, Iterator last, double power) {
    double sum = 0, angle = 0;
    for (; first != last; ++first) {
        const double weight = std::pow((std::max)(first->foot.depth, 0.0), power);
        sum += weight;
        angle += weight * first->foot.angle();
    }
    return sum > 0 ? angle / sum : 0;
}

/// The place where a run of depths, of cuts or samples in the order of the wheel's curve, parts into two contacts;
/// `last` if it holds one. It parts at the minimum between two maxima whose surroundings have different normals, if the
/// depth there is less than the share `edge` of both. Where a wheel yaws, contacts with different normals lie far apart
/// along x, but one run holds them.
template <class Iterator>
Iterator parting(Iterator first, Iterator last) {
    // depth over the largest depth at the long edges of an ellipse twelve times as long as wide, as on flanges
    constexpr double edge = 0.75;
    const auto deeper = [](const auto& one, const auto& other) { return one.foot.depth < other.foot.depth; };
    const double power = Region{}.power;
    Iterator found = last;
    if (last - first < 3) return found;
    double before = first->foot.depth;
    for (Iterator at = first + 1; at + 1 != last; ++at) {
        const double depth = at->foot.depth;
        const bool lowest = depth < (at - 1)->foot.depth && depth <= (at + 1)->foot.depth && depth < edge * before;
        if (lowest && (found == last || depth < found->foot.depth) &&
            depth < edge * std::max_element(at, last, deeper)->foot.depth &&
            std::abs(mean_angle(first, at, power) - mean_angle(at, last, power)) >= joined_angle) {
            found = at;
        }
        before = (std::max)(before, depth);
    }
    return found;
}

/// The height at which the wheel's deepest point lies on the rail's surface, from a first guess; deepest(height)
/// returns the point's foot, or nullptr if no point is near the rail, where the search ends.
template <class Deepest>
double touching_height(double height, const Deepest& deepest) {
    constexpr double enough = 1e-8, steepest = 0.05;
    for (int k = 0; k < 20; ++k) {
        const Foot* const foot = deepest(height);
        if (foot == nullptr) break;
        const double change = foot->depth / (std::max)(std::cos(foot->angle()), steepest);
        height -= change;
        if (std::abs(change) < enough) break;
    }
    return height;
}

}  // namespace rollbem::detail
