// Contacts by the virtual penetration of Kik and Piotrowski, as in the time loop of vehicle codes: quick, and an
// approximation of the contacts of Hertz and of NormalContact. SI units.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include "../detail/gauss_legendre.hpp"
#include "../detail/require.hpp"
#include "../normal/detail/contact_gaps.hpp"
#include "../normal/detail/silhouette_search.hpp"
#include "../normal/hertz_ellipse.hpp"
#include "../normal/wheel_on_rail.hpp"

namespace rollbem {

/// A contact by the virtual penetration (J. Piotrowski, W. Kik, Vehicle System Dynamics 46, 2008, without a correction
/// of its shape). It covers the region of interpenetration after an approach of `share` times the approach, its length
/// follows from the wheel's circle, and its pressure is p_0 sqrt(x_l(s)^2 - x^2)/x_l(s_0), where s_0 is the deepest
/// place. Between half-spaces this pressure displaces s_0 by the approach.
struct VirtualPenetration {
    double y = 0, z = 0;                     ///< of the deepest place, on the rail, in track axes [m]
    double angle = 0;                        ///< of the plane [rad]
    double approach = 0;                     ///< the largest depth of the undeformed surfaces [m]
    double load = 0;                         ///< over the plane [N]
    double peak_pressure = 0;                ///< p_0 [Pa]
    double area = 0;                         ///< [m^2]
    double half_length = 0, half_width = 0;  ///< x_l(s_0), half the extent along s [m]
    Status status = Status::not_finite;      ///< ok; end_of_profile where the surfaces are not known beside it
};

/// Parameters of the pressures.
struct VirtualContact {
    double radius;        ///< R of the circle along x: 2 R depth = x_l^2 [m]
    double compliance;    ///< 1/E* [1/Pa]
    double share = 0.55;  ///< part of the approach; 1/2 gives circular contacts the right size
};

namespace detail {

/// A contact in a plane from its depths in rows at first + j step along s. Rows low to high, which have neighbours, are
/// all deeper than `sunk`. Only `y`, `z` and `angle` are left open; y is s of the deepest row.
inline VirtualPenetration penetrate(const Eigen::ArrayXd& depth, double first, double step, Eigen::Index low,
                                    Eigen::Index high, double sunk, const VirtualContact& contact) {
    static const QuadratureRule<double> rule = gauss_legendre<double>(24);
    VirtualPenetration found;
    Eigen::Index deepest = 0;
    depth.segment(low, high - low + 1).maxCoeff(&deepest);
    deepest += low;
    const double remains = depth[deepest] - sunk;
    const auto left_over = [&](double s) {  // depth at s in excess of `sunk`
        const double at = std::clamp((s - first) / step, 0.0, double(depth.size()) - 1.000001);
        const auto j = static_cast<Eigen::Index>(at);
        return (std::max)(depth[j] + (at - double(j)) * (depth[j + 1] - depth[j]) - sunk, 0.0);
    };
    const auto edge = [&](Eigen::Index in, Eigen::Index out) {
        return first + step * (double(in) + double(out - in) * (depth[in] - sunk) / (depth[in] - depth[out]));
    };
    const double s_0 = first + step * double(deepest), ends[] = {edge(low, low - 1), edge(high, high + 1)};
    double volume = 0, displacement = 0, area = 0;  // integrals of three functions: sqrt(x_l^2 - x^2), the same over
                                                    // the distance, and 1
    for (const double end : ends) {
        for (Eigen::Index k = 0; k < rule.nodes.size(); ++k) {
            // the displacement has a logarithm at s_0, the area roots at both ends
            const double t = (1 + rule.nodes[k]) / 2, u = t * t * (3 - 2 * t), from = u * std::abs(end - s_0);
            const double weight = rule.weights[k] / 2 * 6 * t * (1 - t) * std::abs(end - s_0);
            const double square = 2 * contact.radius * left_over(s_0 + u * (end - s_0)),
                         far = std::hypot(std::sqrt(square), from);
            volume += weight * std::numbers::pi / 2 * square;
            area += weight * 2 * std::sqrt(square);
            displacement += weight * 2 * square * EllipticIntegrals<double>(from / far).D / far;
        }
    }
    found.y = s_0;
    found.approach = remains / contact.share;
    found.half_length = std::sqrt(2 * contact.radius * remains);
    found.half_width = (ends[1] - ends[0]) / 2;
    found.area = area;
    const double slope = std::numbers::pi * found.approach / (contact.compliance * displacement);  // p_0/x_l(s_0)
    found.peak_pressure = slope * found.half_length;
    found.load = slope * volume;
    found.status = is_finite(found.load) ? Status::ok : Status::not_finite;
    return found;
}

/// All contacts of a plane, from depths in rows; a depth is NaN where it is not known.
inline std::vector<VirtualPenetration> penetrations(const Eigen::ArrayXd& depth, double first, double step,
                                                    const VirtualContact& contact) {
    std::vector<VirtualPenetration> found;
    const double sunk = (1 - contact.share) * depth.isNaN().select(0, depth).maxCoeff();
    for (Eigen::Index low = 0; low < depth.size(); ++low) {
        if (!(depth[low] > sunk)) continue;
        Eigen::Index high = low;
        while (high + 1 < depth.size() && depth[high + 1] > sunk) ++high;
        const bool known = low > 0 && high + 1 < depth.size() && depth[low - 1] <= sunk && depth[high + 1] <= sunk;
        if (known) {
            found.push_back(penetrate(depth, first, step, low, high, sunk, contact));
        } else {
            found.push_back({.status = Status::end_of_profile});
        }
        low = high;
    }
    return found;
}

}  // namespace detail

/// Contacts in one plane of undeformed surfaces, from their depths in one another [m] in rows `step` [m] apart. Depths
/// in the first and the last row must not be positive; y is s from row 0, z and angle are 0. Throws
/// std::invalid_argument unless step, radius and compliance are positive, the share lies in (0, 1] and there are 3
/// rows.
inline std::vector<VirtualPenetration> virtual_penetration(const Eigen::ArrayXd& depth, double step,
                                                           const VirtualContact& contact) {
    constexpr const char* who = "virtual_penetration";
    detail::require(depth.size() >= 3, who, "number of rows", depth.size(), "be at least 3");
    detail::require_positive(who, "step", step);
    detail::require_positive(who, "radius", contact.radius);
    detail::require_positive(who, "compliance", contact.compliance);
    detail::require(contact.share > 0 && contact.share <= 1, who, "share", contact.share, "lie in (0, 1]");
    return detail::penetrations(depth, 0, step, contact);
}

/// Contacts of a wheel at a position, under any load, in the order along its profile, in the planes of WheelOnRail;
/// none where the wheel is lifted. Patches do not displace each other. The sections at the middle of each contact
/// determine it, so yaw has no other effect. Throws std::invalid_argument unless the wheel is round and the rail
/// straight, and the share lies in (0, 1].
inline std::vector<VirtualPenetration> virtual_penetration(const WheelOnRail& wheel, const WheelsetPosition& position,
                                                           double share = 0.55) {
    constexpr const char* who = "virtual_penetration";
    constexpr Eigen::Index rows = 200;
    const ContactGeometry& geometry = wheel.geometry();
    detail::require(geometry.is_plain(), who, "sections of wheel and rail", "several",
                    "be one: a round wheel on a straight rail");
    detail::require(share > 0 && share <= 1, who, "share", share, "lie in (0, 1]");
    detail::SilhouetteSearch search;
    std::vector<VirtualPenetration> all;
    if (!detail::is_finite(position) || search.locate(geometry, position) != Status::ok) return all;
    const PlacedWheel placed = geometry.placed(position);
    detail::GapFinder finder;
    detail::Gaps gaps;
    for (const detail::Region& region : search.regions(position.height)) {
        const detail::ContactPlane plane = detail::plane_of(geometry, region, position.along);
        const double step = (plane.high - plane.low) / double(rows - 3), first = plane.low - step;
        if (!(step > 0)) continue;
        finder.find(geometry, placed, position.height, position.along, plane, {1, rows, 0, first, step, step}, gaps);
        const double radius = (wheel.dimensions().radius + geometry.wheel().at(0, plane.wheel_s, 0).z) / plane.cosine;
        Eigen::ArrayXd depth = -gaps.h.row(0).transpose();
        for (Eigen::Index j = 0; j < rows; ++j) {
            const bool known = gaps.known(0, j) == Status::ok || gaps.known(0, j) == Status::doubtful_plane;
            if (!known) depth[j] = std::nan("");
        }
        for (VirtualPenetration& found :
             detail::penetrations(depth, first, step, {radius, wheel.compliance(), share})) {
            const double s = found.y;
            found.y = plane.y + s * plane.cosine;
            found.z = plane.z + s * plane.sine;
            found.angle = plane.angle;
            all.push_back(found);
        }
    }
    return all;
}

}  // namespace rollbem
