// The patches from which tables of creep forces are made, and the making of a table.
#pragma once

#include "../detail/decl.hpp"

#include <cstddef>
#include <functional>
#include <memory>

#include <Eigen/Core>

#include "../discretisation/patch_mesh.hpp"
#include "../friction/state.hpp"
#include "../scene/creepage.hpp"
#include "../scene/patch_contact.hpp"
#include "../system/response.hpp"
#include "creep_force_table.hpp"

namespace rollbem {

/// Steady forces of one ellipse by about n^2 elements; under large spin with its pole on the ellipse or near its edge,
/// a mean of two meshes.
class CreepForceTable::Source {
public:
    /// Throws std::invalid_argument unless a/b and Poisson's ratio are a contact's, and n lies in [2, 1000].
    Source(double a_over_b, double poisson_ratio, Eigen::Index n);
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;

    const PatchContact& contact() const { return contact_; }
    /// The first of the two meshes.
    const PatchMesh<double>& mesh() const;
    /// Response in full adhesion, on the same elements and with the same errors as the forces; on long patches other
    /// meshes must confirm it.
    Response<double> in_adhesion() const;

    struct Solution {
        Eigen::Array3d force;  ///< -F_x, -F_y over mu N, -M_z over mu N c; valid if the status is ok
        FrictionStep step;     ///< step on the first mesh; its status and its residual are the worse of both meshes
    };
    /// Takes creepages times G a b/(mu N), spin times G a b c/(mu N); starts from the tractions of the last solution or
    /// from rest.
    Solution solve(const Creepage& creepage, bool from_rest);

private:
    struct Patch;  // internal

    /// A mesh whose elements are so long that about n^2 of them have the least error under large spin. The error comes
    /// from the pole of the slip, where one element turns at once; it is smaller if strips are equally wide and their
    /// number follows the ellipse (docs/vehicle-measured.md). The number of strips is even: the pole of a lateral force
    /// and spin moves on y = 0, and elements there could slip to either side of it, which breaks the symmetry of the
    /// discrete problem.
    PatchMesh<double> first(Eigen::Index n) const;

    /// A mesh with one more element in each strip and one more strip: it has centres where the first mesh has edges,
    /// across at y = 0 and along each strip at x = 0.
    PatchMesh<double> shifted() const;

    /// Weight of the shifted mesh. As the pole of the slip passes from the edge of an element to its centre, forces
    /// swing about their true value, on the two meshes in opposite directions (docs/vehicle-measured.md).
    ///
    /// - Spin above 4 and pole within 1.2 of the ellipse, where nearly all elements slide: both meshes have equal
    ///   weight.
    /// - Spin below 2 or pole beyond 1.5 of the ellipse: the first mesh alone.
    double share_of_shifted(const Creepage& v) const;

    PatchContact contact_;
    std::shared_ptr<Patch> patch_, shifted_;  // the second one is made when it is first needed
};

/// The grid of a range, with the creep coefficients of its ellipses; `jobs` threads share the work. Throws
/// std::invalid_argument if the range is not a grid's, or the patches of an ellipse have no coefficients or no force
/// under large spin (n is too small, or a/b too far from 1).
CreepForceTable::Grid make_creep_force_grid(const CreepForceTable::Grid::Range& range, std::size_t jobs = 1);

/// A table of steady creep forces, of the ellipses and creepages of `range`. `jobs` threads share the work, and the
/// result does not depend on their number; progress(done, all) is called as forces become known, by one thread at a
/// time. Throws std::invalid_argument as make_creep_force_grid, and std::runtime_error where a patch has no solution.
CreepForceTable make_creep_force_table(
    const CreepForceTable::Grid::Range& range, std::size_t jobs = 1,
    const std::function<void(std::size_t, std::size_t)>& progress = [](std::size_t, std::size_t) {});

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/make_creep_force_table.ipp"
#endif
