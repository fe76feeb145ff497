// Bodies of normal/contact_geometry.hpp. Internal.
#pragma once

#include "../contact_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "../../detail/require.hpp"
#include "../detail/curve_index.hpp"
#include "../detail/highest_place.hpp"
#include "../detail/rail_samples.hpp"
#include "../profile_check.hpp"

namespace rollbem::detail {

/// The place of the rail in the track: the gauge is measured where the rail's inner side is narrowest down to
/// gauge_depth below its top; the top is at z = 0 (EN 13848-1).
inline TrackDimensions::Origin origin_by_gauge(const Profile& rail, const TrackDimensions& d) {
    const auto root = [](double low, double high, const auto& rises) {
        for (int k = 0; k < 60; ++k) (rises((low + high) / 2) ? low : high) = (low + high) / 2;
        return low;
    };
    Eigen::Index top = 0;
    rail.z().minCoeff(&top);
    const double z_top = rail.at(highest_place(rail)).z;
    // from the top inwards, as far as the depth
    Eigen::Index below = top;
    while (below > 0 && rail.z()[below] - z_top < d.gauge_depth) --below;
    require(rail.z()[below] - z_top >= d.gauge_depth, "WheelOnRail", "depth of the rail's inner side",
            rail.z()[below] - z_top, "be at least the gauge_depth; without an inner side give rail_origin");
    const double deepest =
        root(rail.s()[below], rail.s()[below + 1], [&](double s) { return rail.at(s).z - z_top >= d.gauge_depth; });
    double narrowest = rail.at(deepest).y;
    for (Eigen::Index i = below; i < top; ++i) {
        const double from = (std::max)(rail.s()[i], deepest), to = rail.s()[i + 1];
        if (rail.at(from).slope[0] < 0 && rail.at(to).slope[0] > 0) {
            narrowest =
                (std::min)(narrowest, rail.at(root(from, to, [&](double s) { return rail.at(s).slope[0] < 0; })).y);
        }
        narrowest = (std::min)(narrowest, rail.at(to).y);
    }
    return {d.gauge / 2 - narrowest, -z_top};
}

}  // namespace rollbem::detail

namespace rollbem {

ROLLBEM_DECL ContactGeometry::ContactGeometry(WheelSurface wheel, RailSurface rail, const TrackDimensions& dimensions)
    : wheel_(std::move(wheel)), rail_(std::move(rail)), dimensions_(dimensions) {
    constexpr const char* who = "WheelOnRail";
    const TrackDimensions& d = dimensions_;
    detail::require_positive(who, "gauge", d.gauge);
    detail::require_positive(who, "gauge_depth", d.gauge_depth);
    detail::require_finite(who, "flange_back", d.flange_back);
    detail::require_finite(who, "tape_offset", d.tape_offset);
    detail::require_positive(who, "radius", d.radius);
    detail::require_positive(who, "shear_modulus", d.shear_modulus);
    detail::require_poisson_ratio(who, d.poisson_ratio);
    detail::require_positive(who, "compliance (1 - poisson_ratio) / shear_modulus", compliance());
    if (wheel_.is_round()) require_wheel(wheel_.profile(), d.tape_offset);
    if (!rail_.has_sections()) require_rail(rail_.profile());
    if (d.rail_origin) {
        detail::require_finite(who, "rail_origin.y", d.rail_origin->y);
        detail::require_finite(who, "rail_origin.z", d.rail_origin->z);
        origin_ = *d.rail_origin;
    } else {
        detail::require(rail_.is_straight(), who, "rail_origin", "not given",
                        "be given for a roller and for a rail that changes along the track");
        origin_ = detail::origin_by_gauge(rail_.profile(), d);
    }
    wheel_origin_ = d.flange_back / 2 + d.tape_offset;
    if (is_plain()) {
        auto index = std::make_shared<detail::CurveIndex>();
        index->build(detail::rail_samples(*this, 0));
        index_ = std::move(index);
    }
}

ROLLBEM_DECL auto ContactGeometry::rail_at(std::size_t part, double s, double x) const -> CurvePoint {
    CurvePoint p = rail_.at(part, s, x);
    p.y += origin_.y;
    p.z += origin_.z;
    return p;
}

}  // namespace rollbem
