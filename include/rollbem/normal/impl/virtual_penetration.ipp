// Bodies of normal/virtual_penetration.hpp. Internal.
#pragma once

#include "../virtual_penetration.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../../detail/finite.hpp"
#include "../../detail/gauss_legendre.hpp"
#include "../../detail/require.hpp"
#include "../detail/contact_gaps.hpp"
#include "../detail/elliptic_integrals.hpp"
#include "../detail/finite_position.hpp"
#include "../detail/silhouette_search.hpp"
#include "../hertz.hpp"

namespace rollbem::detail {

/// A contact in a plane from its depths in rows at first + j step along s. Rows low to high, which have neighbours, are
/// all deeper than `sunk`. Only `y`, `z` and `angle` are left open; y is s of the deepest row.
inline VirtualPenetration penetrate(const Eigen::ArrayXd& depth, double first, double step, Eigen::Index low,
                                    Eigen::Index high, double sunk, const VirtualPenetration::Parameters& contact) {
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
                         reach = std::hypot(std::sqrt(square), from);
            volume += weight * std::numbers::pi / 2 * square;
            area += weight * 2 * std::sqrt(square);
            displacement += weight * 2 * square * EllipticIntegrals(from / reach).D / reach;
        }
    }
    found.y = s_0;
    found.approach = depth[deepest];
    found.half_length = std::sqrt(2 * contact.radius * remains);
    found.half_width = (ends[1] - ends[0]) / 2;
    found.area = area;
    // p_0/x_l(s_0); displaced by all of its approach, a lobe that hardly emerges would have an infinite pressure
    const double slope = std::numbers::pi * remains / (contact.share * contact.compliance * displacement);
    found.peak_pressure = slope * found.half_length;
    found.load = slope * volume;
    found.status = is_finite(found.load) ? Status::ok : Status::not_finite;
    return found;
}

/// All contacts of a plane, from depths in rows; a depth is not finite where it is not known. Each stretch deeper
/// than 0 has contacts of its own.
inline std::vector<VirtualPenetration> penetrations(const Eigen::ArrayXd& depth, double first, double step,
                                                    const VirtualPenetration::Parameters& contact) {
    std::vector<VirtualPenetration> found;
    const auto end_of_deeper = [&](Eigen::Index j, double than) {
        while (j < depth.size() && is_finite(depth[j]) && depth[j] > than) ++j;
        return j;
    };
    for (Eigen::Index from = 0; from < depth.size(); ++from) {
        const Eigen::Index to = end_of_deeper(from, 0);
        if (to == from) continue;
        const double sunk = (1 - contact.share) * depth.segment(from, to - from).maxCoeff();
        for (Eigen::Index low = from; low < to; ++low) {
            const Eigen::Index end = end_of_deeper(low, sunk);
            if (end == low) continue;
            if (low > 0 && end < depth.size() && is_finite(depth[low - 1]) && is_finite(depth[end])) {
                found.push_back(penetrate(depth, first, step, low, end - 1, sunk, contact));
            } else {
                found.push_back({.status = Status::end_of_profile});
            }
            low = end;
        }
        from = to;
    }
    return found;
}

}  // namespace rollbem::detail

namespace rollbem {

ROLLBEM_DECL std::vector<VirtualPenetration> virtual_penetration(const Eigen::ArrayXd& depth, double step,
                                                                 const VirtualPenetration::Parameters& contact) {
    constexpr const char* who = "virtual_penetration";
    detail::require(depth.size() >= 3, who, "number of rows", depth.size(), "be at least 3");
    detail::require_positive(who, "step", step);
    detail::require_positive(who, "radius", contact.radius);
    detail::require_positive(who, "compliance", contact.compliance);
    detail::require(contact.share > 0 && contact.share <= 1, who, "share", contact.share, "lie in (0, 1]");
    return detail::penetrations(depth, 0, step, contact);
}

ROLLBEM_DECL std::vector<VirtualPenetration> virtual_penetration(const WheelOnRail& wheel,
                                                                 const WheelsetPosition& position, double share) {
    constexpr const char* who = "virtual_penetration";
    constexpr Eigen::Index rows = 200;
    const WheelOnRail::Geometry& geometry = wheel.geometry();
    detail::require(geometry.is_plain(), who, "sections of wheel and rail", "several",
                    "be one: a round wheel on a straight rail");
    detail::require(share > 0 && share <= 1, who, "share", share, "lie in (0, 1]");
    if (!detail::is_finite(position)) return {{.status = Status::not_finite}};
    detail::SilhouetteSearch search;
    const Status located = search.locate(geometry, position);
    if (located != Status::ok) return {{.status = located}};
    const std::vector<detail::Region> regions = search.regions(position.height);
    if (search.is_too_deep()) return {{.status = Status::too_deep}};
    std::vector<VirtualPenetration> all;
    const WheelSurface::Placed placed = geometry.placed(position);
    detail::GapFinder finder;
    detail::Gaps gaps;
    for (const detail::Region& region : regions) {
        const detail::ContactPlane plane = detail::plane_of(geometry, region, position.along);
        const double step = (plane.high - plane.low) / double(rows - 3), first = plane.low - step;
        if (!(step > 0)) continue;
        finder.find(geometry, placed, position.height, position.along, plane, {1, rows, 0, first, step, step}, gaps);
        const double radius = (wheel.dimensions().radius + geometry.wheel().at(plane.wheel_s, 0).z) / plane.cosine;
        Eigen::ArrayXd depth = -gaps.h.row(0).transpose();
        for (Eigen::Index j = 0; j < rows; ++j) {
            const bool known = gaps.known(0, j) == Status::ok || gaps.known(0, j) == Status::doubtful_plane;
            if (!known) depth[j] = std::nan("");
        }
        std::vector<VirtualPenetration> contacts =
            detail::penetrations(depth, first, step, {radius, wheel.compliance(), share});
        if (contacts.empty() && !gaps.all_known) contacts.push_back({.status = Status::end_of_profile});
        for (VirtualPenetration& found : contacts) {
            const double s = found.y, row = std::clamp(std::round((s - first) / step), 0.0, double(rows - 1)),
                         n = gaps.rail_n[Eigen::Index(row)];
            found.y = plane.y + s * plane.cosine - n * plane.sine;
            found.z = plane.z + s * plane.sine + n * plane.cosine;
            found.angle = plane.angle;
            all.push_back(found);
        }
    }
    return all;
}

}  // namespace rollbem
