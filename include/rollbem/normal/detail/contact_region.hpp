// Regions where a wheel lies below the surface of its rail, and the planes in which they are solved.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "../wheel_on_rail.hpp"

namespace rollbem::detail {

/// The point of the rail closest to a point of the wheel.
struct ClosestPoint {
    double s, y, z;
    double depth;                 ///< depth of the wheel's point below the rail's surface, along the surface's normal
                                  ///< [m]
    std::array<double, 2> slope;  ///< slope of the curve there
    bool inside;                  ///< false beyond an end of the curve

    double angle() const { return std::atan2(slope[1], slope[0]); }  ///< angle of the surface [rad]
};

/// Finds the closest point from a first guess of its place; `x` along the track.
inline ClosestPoint closest_on_rail(const WheelOnRail::Geometry& geometry, double s, double x, double y, double z) {
    const double length = geometry.rail().length();
    constexpr double enough = 1e-7;  // error of the place; the error of the depth is of second order in it
    ClosestPoint closest{.s = s, .y = 0, .z = 0, .depth = 0, .slope = {1, 0}, .inside = true};
    for (int k = 0; k < 10; ++k) {
        const RailSurface::Point p = geometry.rail_at(closest.s, x);
        const double square = p.slope[0] * p.slope[0] + p.slope[1] * p.slope[1],
                     step = ((y - p.y) * p.slope[0] + (z - p.z) * p.slope[1]) / square;
        closest = {closest.s, p.y,      p.z, ((z - p.z) * p.slope[0] - (y - p.y) * p.slope[1]) / std::sqrt(square),
                   p.slope,   p.defined};
        if (std::abs(step) < enough) break;
        const double next = std::clamp(closest.s + step, 0.0, length);
        if (next == closest.s) {  // the curve ends before the normal through the point
            closest.inside = false;
            break;
        }
        closest.s = next;
    }
    return closest;
}

/// A point of the wheel and the closest point of the rail.
struct PenetrationSample {
    double wheel_s, x, y, z;
    ClosestPoint closest;
    double width;  ///< share of the track's y [m], times the share of x between slices
};

/// Ends of a stretch of the rail's curve [m].
struct RailStretch {
    double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();

    bool contains(double s) const { return s >= low && s < high; }
};

/// A region where the wheel lies below the rail, by samples; those beside the rail's surface have a depth of 0.
struct Region {
    std::vector<PenetrationSample> samples;
    double x_low = 0, x_high = 0;  ///< ends of the overlap along x [m]
    double power = 2.5;            ///< power of the depth in the weights of samples
    RailStretch rail{};            ///< the region's stretch; samples beyond it belong to other regions
    std::size_t body = 0;          ///< number of the run that holds the region: regions split from one have the same
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

/// The point of the rail's surface below a sample that serves as reference point: z and angle at the sample's y; on a
/// wall, at its closest point.
struct RailPointBelow {
    double depth, angle, s;
};
inline RailPointBelow rail_below(const WheelOnRail::Geometry& geometry, const PenetrationSample& sample,
                                 double track_x) {
    constexpr double wall = 0.03;  // dy/ds
    const RailPointBelow at_closest{sample.closest.depth, sample.closest.angle(), sample.closest.s};
    double s = sample.closest.s;
    for (int k = 0; k < 12; ++k) {
        const RailSurface::Point p = geometry.rail_at(s, track_x + sample.x);
        if (!(p.slope[0] > wall)) return at_closest;
        const double step = std::clamp((sample.y - p.y) / p.slope[0], -1e-3, 1e-3);
        if (std::abs(step) < 1e-7) return {(std::max)(sample.z - p.z, 0.0), std::atan2(p.slope[1], p.slope[0]), s};
        s += step;
    }
    return at_closest;
}

/// The plane of a region, by means over the region, weighted by widths along the track's y and powers of the depth;
/// `track_x`: the place along the track of the rail's curve at x = 0. Nothing if all depths of the region are 0.
inline ContactPlane plane_of(const WheelOnRail::Geometry& geometry, const Region& region, double track_x) {
    ContactPlane plane;
    double sum = 0, rail_s = 0;
    const auto add = [&](bool by_width) {
        for (const PenetrationSample& sample : region.samples) {
            if (!(sample.closest.depth > 0)) continue;
            const RailPointBelow rail = rail_below(geometry, sample, track_x);
            const double weight = (by_width ? sample.width : 1) * std::pow(rail.depth, region.power);
            sum += weight;
            plane.x += weight * sample.x;
            plane.y += weight * sample.y;
            plane.angle += weight * rail.angle;
            plane.wheel_s += weight * sample.wheel_s;
            rail_s += weight * rail.s;
            plane.deepest = (std::max)(plane.deepest, sample.closest.depth);
        }
    };
    add(true);
    if (!(sum > 0)) add(false);  // a wall
    for (double* mean : {&plane.x, &plane.y, &plane.angle, &plane.wheel_s, &rail_s}) *mean /= sum;
    plane.sine = std::sin(plane.angle);
    plane.cosine = std::cos(plane.angle);
    plane.rail = region.rail;
    // the rail's point at y, except on a wall
    RailSurface::Point on_rail = geometry.rail_at(rail_s, track_x + plane.x);
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
    for (const PenetrationSample& sample : region.samples) {
        if (!(sample.closest.depth > 0)) continue;
        const double s = plane.s(sample.closest.y, sample.closest.z);
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

/// The mean angle of the rail's surface at the points closest to samples [rad], weighted by a power of their depths.
template <class Iterator>
double mean_angle(Iterator first, Iterator last, double power) {
    double sum = 0, angle = 0;
    for (; first != last; ++first) {
        const double weight = std::pow((std::max)(first->closest.depth, 0.0), power);
        sum += weight;
        angle += weight * first->closest.angle();
    }
    return sum > 0 ? angle / sum : 0;
}

/// The sample at which samples in the order of the wheel's curve split into two regions; `last` if they belong to one.
/// They split at the minimum between two maxima whose surroundings have different normals, if the
/// depth there is less than the share `edge` of both. Where a wheel yaws, contacts with different normals lie far apart
/// along x, but the samples below the rail follow one another.
template <class Iterator>
Iterator find_split(Iterator first, Iterator last) {
    // depth over the largest depth at the long edges of an ellipse twelve times as long as wide, as on flanges
    constexpr double edge = 0.75;
    const auto deeper = [](const auto& one, const auto& other) { return one.closest.depth < other.closest.depth; };
    const double power = Region{}.power;
    Iterator found = last;
    if (last - first < 3) return found;
    double before = first->closest.depth;
    for (Iterator at = first + 1; at + 1 != last; ++at) {
        const double depth = at->closest.depth;
        const bool lowest =
            depth < (at - 1)->closest.depth && depth <= (at + 1)->closest.depth && depth < edge * before;
        if (lowest && (found == last || depth < found->closest.depth) &&
            depth < edge * std::max_element(at, last, deeper)->closest.depth &&
            std::abs(mean_angle(first, at, power) - mean_angle(at, last, power)) >= joined_angle) {
            found = at;
        }
        before = (std::max)(before, depth);
    }
    return found;
}

/// The height at which the wheel's deepest point lies on the rail's surface, from a first guess; deepest(height)
/// returns the rail's point closest to it, or nullptr if no point is near the rail, where the search ends.
template <class Deepest>
double touching_height(double height, const Deepest& deepest) {
    constexpr double enough = 1e-8, steepest = 0.05;
    for (int k = 0; k < 20; ++k) {
        const ClosestPoint* const closest = deepest(height);
        if (closest == nullptr) break;
        const double change = closest->depth / (std::max)(std::cos(closest->angle()), steepest);
        height -= change;
        if (std::abs(change) < enough) break;
    }
    return height;
}

}  // namespace rollbem::detail
