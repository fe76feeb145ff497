// Hertz's line contact under a varying load: half-length and pressures of the elements for each load, on a mesh that
// breathes with the contact, or on a fixed mesh on which the contact grows and shrinks.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../discretisation/mesh.hpp"
#include "../status.hpp"
#include "../types.hpp"
#include "hertz.hpp"
#include "load.hpp"

namespace rollbem {

/// Makes the NormalLoad of a load per width P [N/m], for two cylinders with the radius and moduli of a HertzLine.
///
///     const HertzLoad hertz = HertzLoad::breathing(line, mesh);
///     NormalLoad load = hertz.at(line.load_per_width());
///     hertz.set(load_per_width, load);                                   // no allocation
///     const auto step = model.advance(now, {dq, motion, load}, next, workspace);
///     const auto by_load =
///         step.tangent_by_load + hertz.half_length_rate(load_per_width) * step.tangent_by_half_length;
class HertzLoad {
public:
    /// The mesh follows the contact: half-length a(P), the shape of the pressures constant.
    static HertzLoad breathing(const HertzLine& line, const Mesh<double>& mesh) {
        return HertzLoad(line, mesh, std::nullopt);
    }

    /// The mesh covers -half_length ... half_length [m], with the contact in its middle. Elements at the edges of the
    /// contact may be partly covered; each carries its exact mean pressure. Throws std::invalid_argument unless
    /// 0 < half_length < inf.
    static HertzLoad fixed(const HertzLine& line, const Mesh<double>& mesh, double half_length) {
        detail::require_positive("HertzLoad", "half_length", half_length);
        return HertzLoad(line, mesh, half_length);
    }

    bool breathes() const { return !fixed_; }

    /// a [m] of the contact under P [N/m] >= 0.
    double half_length(double load_per_width) const {
        return line_.half_length() * std::sqrt(load_per_width / line_.load_per_width());
    }

    /// d NormalLoad::half_length / dP [m^2/N]: da/dP if the mesh breathes, 0 if it is fixed.
    double half_length_rate(double load_per_width) const {
        return fixed_ ? 0.0 : half_length(load_per_width) / (2 * load_per_width);
    }

    /// Sets pressures, their derivatives with respect to P, and the half-length of the mesh. A fixed mesh without load,
    /// P = 0, has no pressure. The status is invalid_load, which a step under the resulting `load` also returns, if P
    /// is negative or not finite, if a fixed mesh does not cover the contact, or if P = 0 on a mesh that breathes: it
    /// would have no length.
    Status set(double load_per_width, NormalLoad& load) const noexcept {
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

    /// A new load, which set() can overwrite. Throws std::invalid_argument if the status of set() is not ok.
    NormalLoad at(double load_per_width) const {
        NormalLoad load{ArrayX<double>::Zero(size()), 0, ArrayX<double>::Zero(size())};
        const Status status = set(load_per_width, load);
        detail::require(
            status == Status::ok, "HertzLoad", "load_per_width", load_per_width,
            breathes() ? "be positive and finite" : "be finite, not negative, and have a contact that the mesh covers");
        return load;
    }

private:
    HertzLoad(const HertzLine& line, const Mesh<double>& mesh, const std::optional<double>& half_length)
        : line_(line), mesh_(mesh), mean_(mean_hertz_pressure(mesh)), fixed_(half_length) {}

    Eigen::Index size() const { return mesh_.size(); }

    // Sets the load of a contact of half-length a on a fixed mesh. At constant x, dp_n/dP = 1/(pi sqrt(a^2 - x^2)).
    void cover(double load_per_width, double a, NormalLoad& load) const noexcept {
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
                radius > 0 ? integrate_covered(element, radius) : integrate_beginning(element);
            const double width = *fixed_ * mesh_.widths()[i];
            load.normal_pressure[i] = peak_times_a * integrals.area / width;
            load.pressure_rate[i] = integrals.angle / (std::numbers::pi * width);
        }
    }

    // Integrals of a contact of zero length in the middle of the mesh: it lies in one element, or on the edge between
    // two.
    static detail::SemicircleIntegrals integrate_beginning(const detail::UnitStretch& element) {
        const auto angle = [](double trailing, double leading) {
            const double pi = std::numbers::pi;
            return trailing < leading ? 0.0 : trailing > leading ? pi : pi / 2;
        };
        return {0, angle(element.trailing_2, element.leading_2) - angle(element.trailing_1, element.leading_1)};
    }

    // Integrals over the part of an element inside a contact of half-length `radius`. The distances are measured from
    // the ends of the contact, and negative where the element extends beyond it.
    static detail::SemicircleIntegrals integrate_covered(const detail::UnitStretch& element, double radius) {
        if (element.trailing_2 <= 0 || element.leading_1 <= 0) return {0, 0};
        const bool begins = element.trailing_1 < 0, ends = element.leading_2 < 0;
        const double whole = 2 * radius;
        const double width = begins && ends ? whole
                             : begins       ? element.trailing_2
                             : ends         ? element.leading_1
                                            : element.width;
        return detail::integrate_semicircle({(std::max)(element.trailing_1, 0.0) / radius,
                                             (std::min)(element.leading_1, whole) / radius,
                                             (std::min)(element.trailing_2, whole) / radius,
                                             (std::max)(element.leading_2, 0.0) / radius, width / radius});
    }

    HertzLine line_;
    Mesh<double> mesh_;
    ArrayX<double> mean_;
    std::optional<double> fixed_;  // half-length of a fixed mesh [m]
};

}  // namespace rollbem
