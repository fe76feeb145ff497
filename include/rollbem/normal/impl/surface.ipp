// Bodies of normal/surface.hpp. Internal.
#pragma once

#include "../surface.hpp"

#include <numbers>

#include "../../detail/require.hpp"

namespace rollbem {

ROLLBEM_DECL RailSurface RailSurface::roller(Profile profile, double radius) {
    detail::require_positive("RailSurface", "roller radius", radius);
    RailSurface rail(std::move(profile));
    rail.radius_ = radius;
    return rail;
}

ROLLBEM_DECL auto RailSurface::at(std::size_t part, double s, double x) const noexcept -> CurvePoint {
    if (const auto* sections = std::get_if<Sections>(&curve_)) {
        const Sections::Point p = sections->at(part, s, x);
        return {p.y, p.z, p.by_s, true};
    }
    const Profile::Point p = std::get_if<Profile>(&curve_)->at(s);
    if (radius_ == 0) return {p.y, p.z, p.slope, true};
    const double sine = x / (radius_ - p.z);
    if (!(std::abs(sine) <= steepest)) return {p.y, p.z, p.slope, false};
    const double cosine = std::sqrt(1 - sine * sine);
    return {p.y, p.z + x * sine / (1 + cosine), {p.slope[0], p.slope[1] / cosine}, true};
}

ROLLBEM_DECL auto WheelSurface::at(std::size_t part, double s, double angle) const noexcept -> Point {
    if (const auto* profile = std::get_if<Profile>(&curve_)) {
        const Profile::Point p = profile->at(s);
        return {p.y, p.z, p.slope, {0, 0}};
    }
    const Sections& sections = *std::get_if<Sections>(&curve_);
    const double middle = (sections.first() + sections.last()) / 2;
    const Sections::Point p = sections.at(part, s, middle + std::remainder(angle - middle, 2 * std::numbers::pi));
    return {p.y, p.z, p.by_s, p.by_u};
}

ROLLBEM_DECL auto PlacedWheel::silhouette(double s) const -> Place {
    const Profile::Point p = surface_->profile().at(s);
    const double across = sin_yaw_ * p.slope[1], sine = across == 0 ? 0 : -across / (cos_yaw_ * p.slope[0]);
    if (!(std::abs(sine) <= steepest) || !(p.slope[0] > 0 || across == 0)) return {0, 0, 0, false};
    return place(p.y, p.z, sine);
}

ROLLBEM_DECL auto PlacedWheel::unplaced(std::size_t part, double s, double x) const
    -> std::optional<WheelSurface::Point> {
    if (surface_->is_round()) return surface_->at(part, s, 0);
    double sine = x / radius_;
    WheelSurface::Point p{};
    for (int k = 0; k < 20; ++k) {
        p = surface_->at(part, s, std::asin(sine) - pitch_);
        const double next = sine_of(p, x);
        if (!(std::abs(next) <= steepest)) return std::nullopt;
        const double change = next - std::exchange(sine, next);
        if (std::abs(change) < 1e-14) break;
    }
    return p;
}

ROLLBEM_DECL auto PlacedWheel::section(std::size_t part, double s, double x) const -> CurvePoint {
    const auto p = unplaced(part, s, x);
    return p ? section_of(*p, x) : CurvePoint{0, 0, {0, 0}, false};
}

ROLLBEM_DECL auto PlacedWheel::place(double y, double z, double sine) const -> Place {
    const double eta = origin_ + y, r = radius_ + z, cosine = std::sqrt((std::max)(1 - sine * sine, 0.0));
    const double across = sin_yaw_ * r * sine + cos_yaw_ * eta;
    return {cos_yaw_ * r * sine - sin_yaw_ * eta, lateral_ + cos_roll_ * across - sin_roll_ * r * cosine,
            -radius_ + sin_roll_ * across + cos_roll_ * r * cosine, true};
}

ROLLBEM_DECL auto PlacedWheel::section_of(const WheelSurface::Point& p, double x) const -> CurvePoint {
    const double sine = sine_of(p, x), r = radius_ + p.z;
    if (!(std::abs(sine) <= steepest)) return {0, 0, {0, 0}, false};
    const double cosine = std::sqrt(1 - sine * sine);
    const double across = sin_yaw_ * r * sine + cos_yaw_ * (origin_ + p.y), down = r * cosine;
    // the angle's derivative at constant x
    const double turn = (sin_yaw_ * p.by_s[0] - cos_yaw_ * sine * p.by_s[1]) /
                        (cos_yaw_ * (r * cosine + sine * p.by_angle[1]) - sin_yaw_ * p.by_angle[0]);
    const double dy = p.by_s[0] + p.by_angle[0] * turn, dr = p.by_s[1] + p.by_angle[1] * turn;
    const double d_across = sin_yaw_ * (dr * sine + r * cosine * turn) + cos_yaw_ * dy,
                 d_down = dr * cosine - r * sine * turn;
    return {lateral_ + cos_roll_ * across - sin_roll_ * down,
            -radius_ + sin_roll_ * across + cos_roll_ * down,
            {cos_roll_ * d_across - sin_roll_ * d_down, sin_roll_ * d_across + cos_roll_ * d_down},
            true};
}

}  // namespace rollbem
