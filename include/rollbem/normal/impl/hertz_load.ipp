// Bodies of normal/hertz_load.hpp. Internal.
#pragma once

#include "../hertz_load.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../detail/semicircle.hpp"

namespace rollbem {

namespace detail {

/// Integrals of a contact of zero length in the middle of the mesh: it lies in one element, or on the edge between two.
inline SemicircleIntegrals integrate_beginning(const UnitStretch& element) {
    const auto angle = [](double trailing, double leading) {
        const double pi = std::numbers::pi;
        return trailing < leading ? 0.0 : trailing > leading ? pi : pi / 2;
    };
    return {0, angle(element.trailing_2, element.leading_2) - angle(element.trailing_1, element.leading_1)};
}

/// Integrals over the part of an element inside a contact of half-length `radius`. The distances are measured from the
/// ends of the contact, and negative where the element extends beyond it.
inline SemicircleIntegrals integrate_covered(const UnitStretch& element, double radius) {
    if (element.trailing_2 <= 0 || element.leading_1 <= 0) return {0, 0};
    const bool begins = element.trailing_1 < 0, ends = element.leading_2 < 0;
    const double whole = 2 * radius;
    const double width = begins && ends ? whole
                         : begins       ? element.trailing_2
                         : ends         ? element.leading_1
                                        : element.width;
    return integrate_semicircle(
        {(std::max)(element.trailing_1, 0.0) / radius, (std::min)(element.leading_1, whole) / radius,
         (std::min)(element.trailing_2, whole) / radius, (std::max)(element.leading_2, 0.0) / radius, width / radius});
}

}  // namespace detail

ROLLBEM_DECL double HertzLoad::half_length(double load_per_width) const {
    return line_.half_length() * std::sqrt(load_per_width / line_.load_per_width());
}

ROLLBEM_DECL double HertzLoad::half_length_rate(double load_per_width) const {
    return fixed_ ? 0.0 : half_length(load_per_width) / (2 * load_per_width);
}

ROLLBEM_DECL HertzLoad HertzLoad::fixed(const HertzLine& line, const Mesh<double>& mesh, double half_length) {
    detail::require_positive("HertzLoad", "half_length", half_length);
    return HertzLoad(line, mesh, half_length);
}

ROLLBEM_DECL Status HertzLoad::set(double load_per_width, NormalLoad& load) const noexcept {
    const double a = half_length(load_per_width);
    const bool possible = detail::is_finite(load_per_width) && detail::is_finite(a) && load_per_width >= 0 &&
                          (fixed_ ? a <= *fixed_ * (1 + 4 * std::numeric_limits<double>::epsilon()) : a > 0);
    const bool sized = load.normal_pressure.size() == size() && load.pressure_rate.size() == size();
    load.half_length = possible && sized ? fixed_.value_or(a) : std::numeric_limits<double>::quiet_NaN();
    if (!possible || !sized) return Status::invalid_load;
    if (fixed_) {
        cover(load_per_width, a, load);
    } else {
        const double peak = 2 / std::numbers::pi * load_per_width / a;
        load.normal_pressure = peak * mean_;
        load.pressure_rate = peak / (2 * load_per_width) * mean_;
    }
    return Status::ok;
}

ROLLBEM_DECL auto HertzLoad::at(double load_per_width) const -> NormalLoad {
    NormalLoad load{ArrayX<double>::Zero(size()), 0, ArrayX<double>::Zero(size())};
    const Status status = set(load_per_width, load);
    detail::require(
        status == Status::ok, "HertzLoad", "load_per_width", load_per_width,
        breathes() ? "be positive and finite" : "be finite, not negative, and have a contact that the mesh covers");
    return load;
}

ROLLBEM_DECL void HertzLoad::cover(double load_per_width, double a, NormalLoad& load) const noexcept {
    const double radius = a / *fixed_,
                 beside = 1 - radius;  // half-length of the contact, and length of the mesh beyond it, over the
                                       // mesh's half-length
    const double peak_times_a = 2 / std::numbers::pi * load_per_width;
    const auto& trailing = mesh_.edges_from_trailing();
    const auto& leading = mesh_.edges_from_leading();
    for (Eigen::Index i = 0; i < size(); ++i) {
        const detail::UnitStretch element{trailing[i] - beside, leading[i] - beside, trailing[i + 1] - beside,
                                          leading[i + 1] - beside, mesh_.widths()[i]};
        const detail::SemicircleIntegrals integrals =
            radius > 0 ? detail::integrate_covered(element, radius) : detail::integrate_beginning(element);
        const double width = *fixed_ * mesh_.widths()[i];
        load.normal_pressure[i] = peak_times_a * integrals.area / width;
        load.pressure_rate[i] = integrals.angle / (std::numbers::pi * width);
    }
}

}  // namespace rollbem
