// A wheel and a rail in place: surfaces, dimensions of the track, origins. SI units.
#pragma once

#include "../detail/decl.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

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

class CurveIndex;

}  // namespace detail

/// The right wheel and the right rail of a track; left ones are mirror images. Immutable.
class ContactGeometry {
public:
    /// Throws std::invalid_argument unless dimensions are positive and finite, 0 <= nu <= 0.5, profiles that are no
    /// pieces look like a wheel and a rail (require_wheel, require_rail), and the rail's place is given by rail_origin
    /// or, of a straight rail, by its inner side.
    ContactGeometry(WheelSurface wheel, RailSurface rail, const TrackDimensions& dimensions);

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
    const detail::CurveIndex& index() const { return *index_; }

    PlacedWheel placed(const WheelsetPosition& at) const { return {wheel_, wheel_origin_, dimensions_.radius, at}; }

    /// A point of the rail in track axes; x [m] along the track.
    CurvePoint rail_at(std::size_t part, double s, double x) const;

private:
    WheelSurface wheel_;
    RailSurface rail_;
    TrackDimensions dimensions_;
    TrackDimensions::Origin origin_{};
    double wheel_origin_ = 0;
    std::shared_ptr<const detail::CurveIndex> index_;  ///< shared by copies; none unless is_plain()
};

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/contact_geometry.ipp"
#endif
