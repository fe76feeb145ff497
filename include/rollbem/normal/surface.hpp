// Surfaces of rail and wheel: curves swept along the track, about a roller's axle or about the wheel's axle, constant
// or changing along the way. Each is given by its curves at constant x, with derivatives along them.
#pragma once

#include "../detail/decl.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <variant>

#include "../scene/wheelset.hpp"
#include "profile.hpp"
#include "sections.hpp"

namespace rollbem {

/// A point (y, z) [m] of a surface's curve at constant x, and its derivative by the length parameter of the curve.
struct CurvePoint {
    double y, z;
    std::array<double, 2> slope;
    bool defined;  ///< false where the surface has no such point
};

/// A rail, in axes of its own: x along the track, y to the right, z down. Straight: (x, y(s), z(s)). Roller: a disc of
/// radius R about an axle along y at z = R, ((R - z) sin f, y, R - (R - z) cos f). Sections: curves that change along
/// the track. Its curves at constant x have parts, each with a parameter 0 <= s <= length(part) of about unit speed.
class RailSurface {
public:
    RailSurface(Profile profile) : curve_(std::move(profile)) {}     // NOLINT: implicit on purpose
    RailSurface(Sections sections) : curve_(std::move(sections)) {}  // NOLINT: the same

    /// Throws std::invalid_argument unless the radius [m] is positive and finite.
    static RailSurface roller(Profile profile, double radius);

    bool is_straight() const { return radius_ == 0 && !has_sections(); }
    bool has_sections() const { return std::holds_alternative<Sections>(curve_); }
    double roller_radius() const { return radius_; }  ///< [m]; 0 if the rail is no roller
    /// The profile of a straight rail or a roller.
    const Profile& profile() const { return std::get<Profile>(curve_); }

    std::size_t parts() const { return has_sections() ? std::get<Sections>(curve_).parts() : 1; }
    double length(std::size_t part) const {
        return has_sections() ? std::get<Sections>(curve_).length(part) : profile().length();
    }
    bool covers(std::size_t part, double x) const {
        if (has_sections()) return std::get<Sections>(curve_).covers(part, x);
        return radius_ == 0 || std::abs(x) <= steepest * radius_;
    }

    /// The point s of the curve at x [m].
    CurvePoint at(std::size_t part, double s, double x) const noexcept;

    /// Largest sin f at which a roller is searched.
    static constexpr double steepest = 0.5;

private:
    std::variant<Profile, Sections> curve_;
    double radius_ = 0;
};

/// A wheel: a curve turned about the axle, at the distance r0 + z(s) and the place y(s); or curves that change with the
/// angle from the lowest point towards +x, less the pitch, with a period of one turn.
class WheelSurface {
public:
    struct Point {
        double y, z;
        std::array<double, 2> by_s, by_angle;
    };

    WheelSurface(Profile profile) : curve_(std::move(profile)) {}     // NOLINT: implicit on purpose
    WheelSurface(Sections sections) : curve_(std::move(sections)) {}  // NOLINT: the same

    bool is_round() const { return std::holds_alternative<Profile>(curve_); }
    /// The profile of a round wheel.
    const Profile& profile() const { return std::get<Profile>(curve_); }

    std::size_t parts() const { return is_round() ? 1 : std::get<Sections>(curve_).parts(); }
    double length(std::size_t part) const {
        return is_round() ? profile().length() : std::get<Sections>(curve_).length(part);
    }

    Point at(std::size_t part, double s, double angle) const noexcept;

private:
    std::variant<Profile, Sections> curve_;
};

/// A wheel in its place on the track, with the wheelset at height 0: curves at constant x, and the silhouette of a
/// round wheel against a straight rail, where its normal has no component along x.
class PlacedWheel {
public:
    /// `origin` [m]: of the profile from the middle of the axle; `radius`: r0 [m].
    PlacedWheel(const WheelSurface& surface, double origin, double radius, const WheelsetPosition& at)
        : surface_(&surface),
          origin_(origin),
          radius_(radius),
          lateral_(at.lateral),
          pitch_(at.pitch),
          sin_roll_(std::sin(at.roll)),
          cos_roll_(std::cos(at.roll)),
          sin_yaw_(std::sin(at.yaw)),
          cos_yaw_(std::cos(at.yaw)) {}

    /// Largest sin theta at which the wheel is searched.
    static constexpr double steepest = 0.5;

    struct Place {
        double x, y, z;
        bool defined;
    };

    const WheelSurface& surface() const { return *surface_; }
    double radius() const { return radius_; }
    double middle_x() const { return -sin_yaw_ * origin_; }  ///< x of the tape circle's lowest point [m]
    /// Distance along x from middle_x() within which contacts are searched [m]: flanks of 4 in 1 touch ahead because of
    /// the yaw.
    double reach_x() const { return 0.1 + radius_ * (std::min)(4 * std::abs(sin_yaw_), steepest); }

    /// A place on the silhouette of a round wheel.
    Place silhouette(double s) const;

    /// The point s of the curve at x [m], on the wheel's surface before it is placed; nothing where there is none.
    std::optional<WheelSurface::Point> unplaced(std::size_t part, double s, double x) const;
    /// The point s of the curve at x [m] in track axes, the wheelset at height 0.
    CurvePoint section(std::size_t part, double s, double x) const;

private:
    double sine_of(const WheelSurface::Point& p, double x) const {
        return (x + sin_yaw_ * (origin_ + p.y)) / (cos_yaw_ * (radius_ + p.z));
    }
    Place place(double y, double z, double sine) const;
    CurvePoint section_of(const WheelSurface::Point& p, double x) const;

    const WheelSurface* surface_;
    double origin_, radius_, lateral_, pitch_, sin_roll_, cos_roll_, sin_yaw_, cos_yaw_;
};

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/surface.ipp"
#endif
