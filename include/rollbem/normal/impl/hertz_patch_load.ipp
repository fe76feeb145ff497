// Bodies of normal/hertz_patch_load.hpp. Internal.
#pragma once

#include "../hertz_patch_load.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../detail/ellipse_pressures.hpp"

namespace rollbem {

ROLLBEM_DECL SemiAxes least_resolved(const PatchContact& contact, const PatchMesh<double>& mesh) {
    const auto half_of_three = [](const auto& lower, const auto& upper) {
        const Eigen::Index count = lower.size(), first = std::max<Eigen::Index>((count - 3) / 2, 0);
        return (upper[(std::min)(first + 3, count) - 1] - lower[first]) / 2;
    };
    const ArrayX<double> edges = mesh.along().edges();
    const Eigen::Index n = mesh.elements_per_strip();
    const double a = contact.half_length(), rounding = 1 - 8 * std::numeric_limits<double>::epsilon();
    return {a * rounding * half_of_three(edges.head(n), edges.tail(n)),
            a * rounding * half_of_three(mesh.lower(), mesh.upper())};
}

ROLLBEM_DECL auto HertzPatchLoad::semi_axes(double load) const -> SemiAxes {
    const double scale = std::cbrt(load / ellipse_.load());
    return {scale * ellipse_.half_length(), scale * ellipse_.half_width()};
}

ROLLBEM_DECL Status HertzPatchLoad::set(const HertzEllipse& ellipse, NormalLoad& result) const noexcept {
    const double load = ellipse.turn() == 0 ? ellipse.load() : std::numeric_limits<double>::quiet_NaN();
    return set(load, {ellipse.half_length(), ellipse.half_width()}, result);
}

ROLLBEM_DECL auto HertzPatchLoad::at(double load) const -> NormalLoad {
    NormalLoad result{ArrayX<double>::Zero(size()), 0, ArrayX<double>::Zero(size())};
    const Status status = set(load, result);
    detail::require(
        status != Status::invalid_load, "HertzPatchLoad", "load", load,
        breathes() ? "be positive and finite" : "be finite, not negative, and have a contact that the mesh covers");
    return result;
}

ROLLBEM_DECL HertzPatchLoad::HertzPatchLoad(const HertzEllipse& ellipse, const PatchContact& contact,
                                            const PatchMesh<double>& mesh, bool fixed)
    : ellipse_(ellipse),
      axes_{contact.half_length(), contact.half_width()},
      least_(least_resolved(contact, mesh)),
      elements_(mesh.rectangles(contact.half_length())),
      shape_(hertz_pressures(contact, mesh, 1) * (contact.half_length() * contact.half_width())),
      fixed_(fixed) {
    detail::require(ellipse.turn() == 0, "HertzPatchLoad", "turn of the ellipse", ellipse.turn(),
                    "be 0: strips lie along x; take along_rolling()");
}

ROLLBEM_DECL Status HertzPatchLoad::set(double load, const SemiAxes& ellipse, NormalLoad& result) const noexcept {
    const bool sized = result.normal_pressure.size() == size() && result.pressure_rate.size() == size();
    const bool possible = sized && detail::is_finite(load) &&
                          (fixed_ ? load >= 0 && is_covered(ellipse) : load > 0 && detail::are_positive(ellipse));
    const SemiAxes& axes = fixed_ ? axes_ : ellipse;
    result.half_length = possible ? axes.half_length : std::numeric_limits<double>::quiet_NaN();
    result.half_width = axes.half_width;
    if (!possible) return Status::invalid_load;
    if (fixed_) return cover(load, ellipse, result);
    const double mean = load / axes.half_length / axes.half_width;
    result.normal_pressure = mean * shape_;
    result.pressure_rate = mean / (3 * load) * shape_;
    return Status::ok;
}

ROLLBEM_DECL bool HertzPatchLoad::is_covered(const SemiAxes& ellipse) const {
    constexpr double rounding = 1 + 4 * std::numeric_limits<double>::epsilon();
    return ellipse.half_length <= axes_.half_length * rounding && ellipse.half_width <= axes_.half_width * rounding;
}

ROLLBEM_DECL Status HertzPatchLoad::cover(double load, const SemiAxes& ellipse, NormalLoad& result) const noexcept {
    // without load, a contact far smaller than any element in the middle
    const double beginning = std::numeric_limits<double>::epsilon();
    const double a = (std::max)(ellipse.half_length, beginning * axes_.half_length),
                 b = (std::max)(ellipse.half_width, beginning * axes_.half_width);
    const double share =
        detail::set_ellipse_pressures(a, b, load, elements_, result.normal_pressure, result.pressure_rate);
    if (share >= detail::least_share) {
        const bool resolved = a >= least_.half_length && b >= least_.half_width;
        return resolved || load == 0 ? Status::ok : Status::unresolved;
    }
    result.half_length = std::numeric_limits<double>::quiet_NaN();
    return Status::invalid_load;
}

}  // namespace rollbem
