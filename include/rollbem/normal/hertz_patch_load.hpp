// Hertz's elliptic contact under a load and radii that may vary: semi-axes and pressures of the elements, on a mesh
// that follows the ellipse, or on a fixed mesh on which the ellipse grows and shrinks.
#pragma once

#include "../detail/decl.hpp"

#include <vector>

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
SemiAxes least_resolved(const PatchContact& contact, const PatchMesh<double>& mesh);

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
    SemiAxes semi_axes(double load) const;

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
    Status set(const HertzEllipse& ellipse, NormalLoad& result) const noexcept;

    /// A new load, which set() can overwrite. Throws std::invalid_argument if the status of set() is invalid_load.
    NormalLoad at(double load) const;

private:
    HertzPatchLoad(const HertzEllipse& ellipse, const PatchContact& contact, const PatchMesh<double>& mesh, bool fixed);

    Eigen::Index size() const { return shape_.size(); }

    Status set(double load, const SemiAxes& ellipse, NormalLoad& result) const noexcept;

    bool is_covered(const SemiAxes& ellipse) const;

    Status cover(double load, const SemiAxes& ellipse, NormalLoad& result) const noexcept;

    HertzEllipse ellipse_;
    SemiAxes axes_;   // semi-axes for which the mesh was made
    SemiAxes least_;  // smallest semi-axes that a fixed mesh resolves
    std::vector<Rectangle<double>> elements_;
    ArrayX<double> shape_;  // pressures for N = a b = 1
    bool fixed_;
};

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/hertz_patch_load.ipp"
#endif
