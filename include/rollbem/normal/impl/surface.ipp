// Bodies of normal/surface.hpp. Internal.
#pragma once

#include "../surface.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"

namespace rollbem {

ROLLBEM_DECL Sections::Sections(std::vector<Sections::Section> sections, Interpolation interpolation)
    : sections_(std::move(sections)), interpolation_(interpolation) {
    detail::require(sections_.size() >= 2, "Sections", "number of sections", sections_.size(), "be at least 2");
    for (std::size_t k = 0; k < sections_.size(); ++k) check(k);
    const std::size_t features = sections_[0].features.size();
    for (std::size_t part = 0; part < (std::max<std::size_t>)(features, 2) - 1; ++part) add_part(part);
}

ROLLBEM_DECL auto Sections::at(std::size_t part, double s, double u) const noexcept -> Point {
    const Part& of = parts_[part];
    const std::size_t k = of.nearest[interval(u)];
    const double step = sections_[k + 1].u - sections_[k].u, t = (u - sections_[k].u) / step;
    return value(of, k, s, (std::min)((std::max)(t, 0.0), 1.0), t >= 0 && t <= 1 ? 1 / step : 0);
}

ROLLBEM_DECL Sections Sections::moved(double angle, double dy, double dz) const {
    Sections result = *this;
    for (Sections::Section& section : result.sections_) section.profile = section.profile.moved(angle, dy, dz);
    return result;
}

ROLLBEM_DECL void Sections::check(std::size_t k) const {
    const Sections::Section& section = sections_[k];
    const std::string of = " of section " + std::to_string(k + 1);
    const auto named = [&](const char* quantity) { return quantity + of; };
    detail::require_finite("Sections", named("u").c_str(), section.u);
    detail::require(k == 0 || section.u > sections_[k - 1].u, "Sections", named("u").c_str(), section.u,
                    "be greater than u of the section before");
    const std::vector<double>& features = section.features;
    detail::require(features.size() == sections_[0].features.size(), "Sections", named("number of features").c_str(),
                    features.size(), "equal the number of features of section 1");
    detail::require(features.size() != 1, "Sections", named("number of features").c_str(), 1,
                    "be 0 or at least 2, for a part lies between two");
    double before = -1;
    for (const double feature : features) {
        detail::require_finite("Sections", named("length of a feature").c_str(), feature);
        if (feature < 0) continue;
        detail::require(feature > before && before < section.profile.length(), "Sections",
                        named("length of a feature").c_str(), feature,
                        "be greater than the length of the feature before, which must lie on the profile");
        before = feature;
    }
}

ROLLBEM_DECL void Sections::add_part(std::size_t number) {
    const std::size_t n = sections_.size();
    Part part;
    double sum = 0;
    std::size_t count = 0;
    for (const Sections::Section& section : sections_) {
        const bool whole = section.features.empty();
        const double end = section.profile.length(), from = whole ? 0 : section.features[number],
                     to = whole ? end : (std::min)(section.features[number + 1], end);
        const bool there = from >= 0 && to > from;
        part.from.push_back(from);
        part.lengths.push_back(there ? to - from : 0);
        sum += part.lengths.back();
        if (there) ++count;
    }
    std::vector<std::size_t> covered;
    for (std::size_t k = 0; k + 1 < n; ++k) {
        part.weights.push_back(covers(part, k) ? weights_of(part, k) : decltype(part.weights)::value_type{});
        if (covers(part, k)) covered.push_back(k);
    }
    detail::require(!covered.empty(), "Sections", "number of the part", number + 1,
                    "be the number of a part that is there in two neighbouring sections");
    for (std::size_t k = 0; k + 1 < n; ++k) {
        const auto after = std::lower_bound(covered.begin(), covered.end(), k);
        const bool forward = after != covered.end() && (after == covered.begin() || *after - k < k - *(after - 1));
        part.nearest.push_back(forward ? *after : *(after - 1));
    }
    part.length = sum / static_cast<double>(count);
    starts_.push_back(starts_.back() + part.length);
    parts_.push_back(std::move(part));
}

ROLLBEM_DECL std::size_t Sections::interval(double u) const noexcept {
    const auto after = std::upper_bound(sections_.begin() + 1, sections_.end() - 1, u,
                                        [](double at, const Sections::Section& section) { return at < section.u; });
    return static_cast<std::size_t>(after - sections_.begin()) - 1;
}

ROLLBEM_DECL bool Sections::intervals_with(std::size_t part, double u) const noexcept {
    const std::size_t k = interval(u);
    const auto there = [&](std::size_t i) { return parts_[part].nearest[i] == i; };
    return there(k) || (k > 0 && u == sections_[k].u && there(k - 1));
}

ROLLBEM_DECL double Sections::knot(const Part& part, std::size_t k, int j) const {
    const auto u = [&](std::size_t i) { return sections_[i].u; };
    std::size_t first = k, last = k + 1;
    while (first > 0 && covers(part, first - 1)) --first;
    while (last + 1 < sections_.size() && covers(part, last)) ++last;
    const long i = static_cast<long>(k) - 1 + j, low = static_cast<long>(first), high = static_cast<long>(last);
    if (i < low) return u(first) - static_cast<double>(low - i) * (u(first + 1) - u(first));
    if (i > high) return u(last) + static_cast<double>(i - high) * (u(last) - u(last - 1));
    return u(static_cast<std::size_t>(i));
}

ROLLBEM_DECL auto Sections::weights_of(const Part& part, std::size_t k) const -> std::array<std::array<double, 4>, 4> {
    const bool before = k > 0 && covers(part, k - 1), after = k + 2 < sections_.size() && covers(part, k + 1);
    std::array<std::array<double, 4>, 4> w =
        interpolation_ == Interpolation::through ? cubic(part, k, before, after) : b_spline(part, k);
    for (std::size_t m = 0; m < 4 && interpolation_ == Interpolation::spline; ++m) {
        // a section beyond the end is 2 P_0 - P_1
        for (const auto& [beyond, at, next] : {std::array<std::size_t, 3>{0, 1, 2}, {3, 2, 1}}) {
            if (beyond == 0 ? before : after) continue;
            w[at][m] += 2 * w[beyond][m];
            w[next][m] -= w[beyond][m];
            w[beyond][m] = 0;
        }
    }
    return w;
}

ROLLBEM_DECL auto Sections::cubic(const Part& part, std::size_t k, bool before, bool after) const
    -> std::array<std::array<double, 4>, 4> {
    const double h = knot(part, k, 2) - knot(part, k, 1);
    std::array<std::array<double, 4>, 4> w{};
    w[1] = {1, 0, -3, 2};
    w[2] = {0, 0, 3, -2};
    // h times the slope at section i of the three sections j, j + 1, j + 2
    const auto add_slope = [&](std::size_t i, std::size_t j, std::array<double, 4> by) {
        std::array<double, 3> u;
        for (std::size_t l = 0; l < 3; ++l) u[l] = knot(part, k, static_cast<int>(j + l));
        const double at = knot(part, k, static_cast<int>(i));
        for (std::size_t l = 0; l < 3; ++l) {
            const double a = u[(l + 1) % 3], b = u[(l + 2) % 3];
            const double slope = h * (2 * at - a - b) / ((u[l] - a) * (u[l] - b));
            for (std::size_t m = 0; m < 4; ++m) w[j + l][m] += slope * by[m];
        }
    };
    const std::array<double, 4> at_first{0, 1, -2, 1}, at_last{0, 0, -1, 1};
    if (!before && !after) {
        w[1] = {1, -1, 0, 0};
        w[2] = {0, 1, 0, 0};
        return w;
    }
    add_slope(1, before ? 0 : 1, at_first);
    add_slope(2, after ? 1 : 0, at_last);
    return w;
}

ROLLBEM_DECL auto Sections::b_spline(const Part& part, std::size_t k) const -> std::array<std::array<double, 4>, 4> {
    std::array<double, 6> u;  // the knots -2 .. 3 counted from the interval's first
    for (int j = 0; j < 6; ++j) u[static_cast<std::size_t>(j)] = knot(part, k, j - 1);
    const double h = u[3] - u[2];
    std::array<std::array<double, 4>, 4> w{};
    w[3][0] = 1;
    for (std::size_t degree = 1; degree <= 3; ++degree) {
        std::array<std::array<double, 4>, 4> next{};
        for (std::size_t j = 3 - degree; j < 4; ++j) {
            // N_j of the knots u[j - 1 ...]: the rising share of its own first knot, and the falling share of the
            // next
            const auto add = [&](std::size_t from, double constant, double slope) {
                for (std::size_t m = 0; m < 4; ++m) {
                    next[j][m] += constant * w[from][m];
                    if (m > 0) next[j][m] += slope * w[from][m - 1];
                }
            };
            const auto left = [&](std::size_t i) { return u[i - 1]; };
            if (j >= 4 - degree) {
                const double a = left(j), span = left(j + degree) - a;
                add(j, (u[2] - a) / span, h / span);
            }
            if (j < 3) {
                const double b = left(j + degree + 1), span = b - left(j + 1);
                add(j + 1, (b - u[2]) / span, -h / span);
            }
        }
        w = next;
    }
    return w;
}

ROLLBEM_DECL auto Sections::value(const Part& part, std::size_t k, double s, double t, double by_t) const noexcept
    -> Point {
    Point point{};
    const double share = s / part.length;
    for (std::size_t j = 0; j < 4; ++j) {
        if (k + j < 1 || k + j > sections_.size()) continue;
        const std::size_t i = k + j - 1;
        const auto& w = part.weights[k][j];
        if (w == std::array<double, 4>{}) continue;
        const double weight = w[0] + t * (w[1] + t * (w[2] + t * w[3])),
                     slope = by_t * (w[1] + t * (2 * w[2] + t * 3 * w[3])), speed = part.lengths[i] / part.length;
        const Profile::Point at = sections_[i].profile.at(part.from[i] + share * part.lengths[i]);
        point.y += weight * at.y;
        point.z += weight * at.z;
        point.by_s[0] += weight * speed * at.slope[0];
        point.by_s[1] += weight * speed * at.slope[1];
        point.by_u[0] += slope * at.y;
        point.by_u[1] += slope * at.z;
    }
    return point;
}

ROLLBEM_DECL double Sections::extreme(double sign) const {
    double most = -std::numeric_limits<double>::infinity();
    for (const Sections::Section& section : sections_) most = (std::max)(most, (sign * section.profile.z()).maxCoeff());
    return sign * most;
}

ROLLBEM_DECL RailSurface RailSurface::roller(Profile profile, double radius) {
    detail::require_positive("RailSurface", "roller radius", radius);
    RailSurface rail(std::move(profile));
    rail.radius_ = radius;
    return rail;
}

ROLLBEM_DECL auto RailSurface::at(double s, double x) const noexcept -> RailSurface::Point {
    if (const auto* sections = std::get_if<Sections>(&curve_)) {
        const Sections::Point p = sections->at(s, x);
        return {p.y, p.z, p.by_s, sections->reaches(s, x)};
    }
    const Profile::Point p = std::get_if<Profile>(&curve_)->at(s);
    if (radius_ == 0) return {p.y, p.z, p.slope, true};
    const double sine = x / (radius_ - p.z);
    if (!(std::abs(sine) <= steepest)) return {p.y, p.z, p.slope, false};
    const double cosine = std::sqrt(1 - sine * sine);
    return {p.y, p.z + x * sine / (1 + cosine), {p.slope[0], p.slope[1] / cosine}, true};
}

ROLLBEM_DECL auto WheelSurface::at(double s, double angle) const noexcept -> Point {
    if (const auto* profile = std::get_if<Profile>(&curve_)) {
        const Profile::Point p = profile->at(s);
        return {p.y, p.z, p.slope, {0, 0}};
    }
    const Sections& sections = *std::get_if<Sections>(&curve_);
    const double middle = (sections.first() + sections.last()) / 2;
    const Sections::Point p = sections.at(s, middle + std::remainder(angle - middle, 2 * std::numbers::pi));
    return {p.y, p.z, p.by_s, p.by_u};
}

ROLLBEM_DECL auto WheelSurface::Placed::silhouette(double s) const -> Place {
    const Profile::Point p = surface_->profile().at(s);
    const double across = sin_yaw_ * p.slope[1], sine = across == 0 ? 0 : -across / (cos_yaw_ * p.slope[0]);
    if (!(std::abs(sine) <= steepest) || !(p.slope[0] > 0 || across == 0)) return {0, 0, 0, false};
    return place(p.y, p.z, sine);
}

ROLLBEM_DECL auto WheelSurface::Placed::unplaced(double s, double x) const -> std::optional<WheelSurface::Point> {
    if (surface_->is_round()) return surface_->at(s, 0);
    double sine = x / radius_;
    WheelSurface::Point p{};
    for (int k = 0; k < 20; ++k) {
        p = surface_->at(s, std::asin(sine) - pitch_);
        const double next = sine_of(p, x);
        if (!(std::abs(next) <= steepest)) return std::nullopt;
        const double change = next - std::exchange(sine, next);
        if (std::abs(change) < 1e-14) break;
    }
    return p;
}

ROLLBEM_DECL auto WheelSurface::Placed::section(double s, double x) const -> RailSurface::Point {
    const auto p = unplaced(s, x);
    return p ? section_of(*p, x) : RailSurface::Point{0, 0, {0, 0}, false};
}

ROLLBEM_DECL auto WheelSurface::Placed::place(double y, double z, double sine) const -> Place {
    const double eta = origin_ + y, r = radius_ + z, cosine = std::sqrt((std::max)(1 - sine * sine, 0.0));
    const double across = sin_yaw_ * r * sine + cos_yaw_ * eta;
    return {cos_yaw_ * r * sine - sin_yaw_ * eta, lateral_ + cos_roll_ * across - sin_roll_ * r * cosine,
            -radius_ + sin_roll_ * across + cos_roll_ * r * cosine, true};
}

ROLLBEM_DECL auto WheelSurface::Placed::section_of(const WheelSurface::Point& p, double x) const -> RailSurface::Point {
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
