// A wheel and a rail in place: surfaces, dimensions of the track, origins. SI units.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "../detail/require.hpp"
#include "detail/curve_index.hpp"
#include "profile_check.hpp"
#include "surface.hpp"

namespace rollbem {

/// Dimensions that place profiles in the track. Track axes: x forward, y to the right, z down, the origin between the
/// rails at the height of their tops.
struct TrackDimensions {
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

namespace detail {

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

}  // namespace detail

/// The right wheel and the right rail of a track; left ones are mirror images. Immutable.
class ContactGeometry {
public:
    /// Throws std::invalid_argument unless dimensions are positive and finite, 0 <= nu <= 0.5, profiles that are no
    /// pieces look like a wheel and a rail (require_wheel, require_rail), and the rail's place is given by rail_origin
    /// or, of a straight rail, by its inner side.
    ContactGeometry(WheelSurface wheel, RailSurface rail, const TrackDimensions& dimensions)
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
        if (is_plain()) index_.build(rail_samples(0));
    }

    const WheelSurface& wheel() const { return wheel_; }
    const RailSurface& rail() const { return rail_; }
    const TrackDimensions& dimensions() const { return dimensions_; }
    double compliance() const { return (1 - dimensions_.poisson_ratio) / dimensions_.shear_modulus; }  ///< 1/E* [1/Pa]
    TrackDimensions::Origin rail_origin() const { return origin_; }  ///< origin of the right rail in track axes [m]
    double wheel_origin() const {
        return wheel_origin_;
    }  ///< origin of the right wheel, from the middle of the axle
       ///< [m]

    /// Whether neither the wheel nor the rail changes along the way: contacts are then found on the wheel's silhouette.
    bool is_plain() const { return wheel_.is_round() && rail_.is_straight(); }
    /// The rail's points, where is_plain().
    const detail::CurveIndex& index() const { return index_; }

    PlacedWheel placed(const WheelsetPosition& at) const { return {wheel_, wheel_origin_, dimensions_.radius, at}; }

    /// A point of the rail in track axes; x [m] along the track.
    CurvePoint rail_at(double s, double x) const {
        CurvePoint p = rail_.at(s, x);
        p.y += origin_.y;
        p.z += origin_.z;
        return p;
    }

    /// Points of the rail's curve at x, a quarter of a millimetre apart, where it has any.
    std::vector<detail::SurfaceSample> rail_samples(double x) const {
        const double length = rail_.length();
        const auto count = static_cast<std::size_t>(std::ceil(length / detail::CurveIndex::spacing));
        std::vector<detail::SurfaceSample> samples;
        for (std::size_t k = 0; k <= count; ++k) {
            const double s = length * double(k) / double(count);
            const CurvePoint p = rail_at(s, x);
            const double size = std::hypot(p.slope[0], p.slope[1]);
            if (p.defined) samples.push_back({p.y, p.z, -p.slope[1] / size, p.slope[0] / size, s});
        }
        return samples;
    }

private:
    WheelSurface wheel_;
    RailSurface rail_;
    TrackDimensions dimensions_;
    TrackDimensions::Origin origin_{};
    double wheel_origin_ = 0;
    detail::CurveIndex index_;
};

}  // namespace rollbem
