// Hertz's elliptic contact under a load and radii that may vary: semi-axes and pressures of the elements, on a mesh
// that follows the ellipse, or on a fixed mesh on which the ellipse grows and shrinks.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../discretisation/patch_mesh.hpp"
#include "../scene/patch_contact.hpp"
#include "../scene/semi_axes.hpp"
#include "../status.hpp"
#include "../types.hpp"
#include "hertz_ellipse.hpp"
#include "load.hpp"

namespace rollbem {

/// The smallest ellipse [m] that the fixed mesh of a contact resolves, three strips wide and three elements long in the
/// middle of the mesh. On narrower ellipses forces are too large (docs/patch.md).
inline SemiAxes least_resolved(const PatchContact& contact, const PatchMesh<double>& mesh) {
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

/// Makes the NormalLoad of a load N [N] for the bodies of a HertzEllipse, whose axes must lie along x and y, as after
/// HertzEllipse::along_rolling().
///
///     const HertzPatchLoad hertz = HertzPatchLoad::breathing(ellipse, contact, mesh);
///     NormalLoad load = hertz.at(ellipse.load());
///     hertz.set(N, load);                                       // no allocation
///     const auto step = model.advance(now, {dq, motion, load}, next, workspace);
///     const auto by_load = step.tangent_by_load + hertz.half_length_rate(N) * step.tangent_by_half_length +
///                          hertz.half_width_rate(N) * step.tangent_by_half_width;
///     hertz.set(HertzEllipse(radii), load);  // other radii
class HertzPatchLoad {
public:
    /// The mesh, made for `contact`, follows the ellipse: semi-axes a(N) and b(N), the shape of the pressures constant.
    /// Throws std::invalid_argument for an outline, or if the axes of the ellipse do not lie along x and y.
    static HertzPatchLoad breathing(const HertzEllipse& ellipse, const PatchContact& contact,
                                    const PatchMesh<double>& mesh) {
        return HertzPatchLoad(ellipse, contact, mesh, false);
    }

    /// The mesh covers `contact`, the largest ellipse, with the present one in its middle. Throws
    /// std::invalid_argument for an outline, or if the axes of the ellipse do not lie along x and y.
    static HertzPatchLoad fixed(const HertzEllipse& ellipse, const PatchContact& contact,
                                const PatchMesh<double>& mesh) {
        return HertzPatchLoad(ellipse, contact, mesh, true);
    }

    bool breathes() const { return !fixed_; }

    /// a and b [m] of the ellipse under N [N] >= 0.
    SemiAxes semi_axes(double load) const {
        const double scale = std::cbrt(load / ellipse_.load());
        return {scale * ellipse_.half_length(), scale * ellipse_.half_width()};
    }

    /// Derivatives of the semi-axes of the mesh by N [m/N]: 0 if it is fixed.
    double half_length_rate(double load) const { return fixed_ ? 0 : semi_axes(load).half_length / (3 * load); }
    double half_width_rate(double load) const { return fixed_ ? 0 : semi_axes(load).half_width / (3 * load); }

    /// Sets pressures, which carry N exactly, their derivatives with respect to N, and the semi-axes of the mesh. A
    /// fixed mesh without load, N = 0, has no pressure. The status is invalid_load, which a step under the resulting
    /// `load` also returns, if N is negative or not finite, if a fixed mesh does not cover the ellipse, or if N = 0 on
    /// a mesh that follows it: it would have no size. It is unresolved, with all of `result` set, if the ellipse under
    /// N > 0 is smaller than least_resolved() of a fixed mesh. The work on a fixed mesh is an integral for each
    /// element.
    Status set(double load, NormalLoad& result) const noexcept { return set(load, semi_axes(load), result); }

    /// Sets pressures for other bodies, radii or load; the status is also invalid_load if their axes do not lie along x
    /// and y.
    Status set(const HertzEllipse& ellipse, NormalLoad& result) const noexcept {
        const double load = ellipse.turn() == 0 ? ellipse.load() : std::numeric_limits<double>::quiet_NaN();
        return set(load, {ellipse.half_length(), ellipse.half_width()}, result);
    }

    /// A new load, which set() can overwrite. Throws std::invalid_argument if the status of set() is invalid_load.
    NormalLoad at(double load) const {
        NormalLoad result{ArrayX<double>::Zero(size()), 0, ArrayX<double>::Zero(size())};
        const Status status = set(load, result);
        detail::require(
            status != Status::invalid_load, "HertzPatchLoad", "load", load,
            breathes() ? "be positive and finite" : "be finite, not negative, and have a contact that the mesh covers");
        return result;
    }

private:
    HertzPatchLoad(const HertzEllipse& ellipse, const PatchContact& contact, const PatchMesh<double>& mesh, bool fixed)
        : ellipse_(ellipse),
          axes_{contact.half_length(), contact.half_width()},
          least_(least_resolved(contact, mesh)),
          elements_(mesh.rectangles(contact.half_length())),
          shape_(hertz_pressures(contact, mesh, 1) * (contact.half_length() * contact.half_width())),
          fixed_(fixed) {
        detail::require(ellipse.turn() == 0, "HertzPatchLoad", "turn of the ellipse", ellipse.turn(),
                        "be 0: strips lie along x; take along_rolling()");
    }

    Eigen::Index size() const { return shape_.size(); }

    Status set(double load, const SemiAxes& ellipse, NormalLoad& result) const noexcept {
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

    bool is_covered(const SemiAxes& ellipse) const {
        constexpr double rounding = 1 + 4 * std::numeric_limits<double>::epsilon();
        return ellipse.half_length <= axes_.half_length * rounding && ellipse.half_width <= axes_.half_width * rounding;
    }

    Status cover(double load, const SemiAxes& ellipse, NormalLoad& result) const noexcept {
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

    HertzEllipse ellipse_;
    SemiAxes axes_;   // semi-axes for which the mesh was made
    SemiAxes least_;  // smallest semi-axes that a fixed mesh resolves
    std::vector<Rectangle<double>> elements_;
    ArrayX<double> shape_;  // pressures for N = a b = 1
    bool fixed_;
};

}  // namespace rollbem
