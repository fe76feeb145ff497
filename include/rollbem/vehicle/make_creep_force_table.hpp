// The patches from which tables of creep forces are made, and the making of a table.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../assembly/patch_system.hpp"
#include "../detail/parallel_for.hpp"
#include "../detail/require.hpp"
#include "../discretisation/patch_mesh.hpp"
#include "../discretisation/scheme.hpp"
#include "../elasticity/rectangle_kernel.hpp"
#include "../friction/model.hpp"
#include "../normal/hertz_ellipse.hpp"
#include "../rolling/run.hpp"
#include "../scene/creepage.hpp"
#include "../scene/patch_contact.hpp"
#include "../status.hpp"
#include "../steady/creep_coefficients.hpp"
#include "creep_force_grid.hpp"
#include "creep_force_table.hpp"

namespace rollbem {

/// Steady forces of one ellipse by about n^2 elements; under large spin with its pole on the ellipse or near its edge,
/// a mean of two meshes.
class CreepForceSource {
public:
    CreepForceSource(double a_over_b, double poisson_ratio, Eigen::Index n)
        : contact_(PatchContact<double>::dimensionless(a_over_b, poisson_ratio)), patch_(contact_, first(n)) {}

    const PatchContact<double>& contact() const { return contact_; }
    const PatchMesh<double>& mesh() const { return patch_.mesh; }  ///< the first of the two
    /// Response in full adhesion, on the same elements and with the same errors as the forces; on long patches other
    /// meshes must confirm it.
    Response<double> in_adhesion() const {
        const HalfSpace<double> kernel(contact_.poisson_ratio());
        return contact_.a_over_b() > 10 ? solve_steady(contact_, mesh(), scheme, kernel)
                                        : solve_steady(mesh(), scheme, kernel);
    }

    struct Solution {
        Eigen::Array3d force;  ///< -F_x, -F_y over mu N, -M_z over mu N c; valid if the status is ok
        FrictionStep step;     ///< step on the first mesh; its status and its residual are the worse of both meshes
    };
    /// Takes creepages times G a b/(mu N), spin times G a b c/(mu N); starts from the tractions of the last solution or
    /// from rest.
    Solution solve(const Creepage<double>& creepage, bool from_rest) {
        Solution solution = patch_.solve(contact_, creepage, from_rest);
        if (from_rest && shifted_) shifted_->run.now() = shifted_->rest;
        const double share = share_of_shifted(creepage);
        if (share == 0 || solution.step.status != Status::ok) return solution;

        if (!shifted_) shifted_.emplace(contact_, shifted());
        Solution other = shifted_->solve(contact_, creepage, from_rest);
        // at xi = 0 the pole lies on the middle strip, whose elements may slip to either side; F_x of the two mirror
        // images cancels
        if (creepage.longitudinal == 0) other.force[0] = 0;
        solution.force = (1 - share) * solution.force + share * other.force;
        solution.step.status = other.step.status;
        solution.step.complementarity_residual =
            (std::max)(solution.step.complementarity_residual, other.step.complementarity_residual);
        return solution;
    }

private:
    static constexpr NodeDifference scheme{Nodes::chebyshev};

    /// The ellipse on one mesh. With a = G = 1 and mu N = G a b, creepages are the given numbers, and a force over mu N
    /// is the force over b.
    struct Patch {
        using Model = FrictionModel;

        Patch(const PatchContact<double>& contact, PatchMesh<double> given)
            : mesh(std::move(given)),
              model(contact, steady_system(mesh, scheme, HalfSpace<double>(contact.poisson_ratio())),
                    {1.0, hertz_pressures(contact, mesh, contact.half_width())}),
              rest(model.at_rest()),
              run(model) {}
        Patch(const Patch&) = delete;
        Patch& operator=(const Patch&) = delete;

        Solution solve(const PatchContact<double>& contact, const Creepage<double>& creepage, bool from_rest) {
            const Creepage<double> given{creepage.longitudinal, creepage.lateral, creepage.spin / contact.c()};
            if (from_rest) run.now() = rest;
            Solution solution;
            solution.step = run.steady({.motion = given});
            if (!from_rest && solution.step.status == Status::no_solution) return solve(contact, creepage, true);
            const auto& force = solution.step.force;
            solution.force =
                -Eigen::Array3d(force.longitudinal, force.lateral, force.moment / contact.c()) / contact.half_width();
            return solution;
        }

        PatchMesh<double> mesh;
        Model model;
        typename Model::State rest;
        Run<Model> run;
    };

    /// A mesh whose elements are so long that about n^2 of them have the least error under large spin. The error comes
    /// from the pole of the slip, where one element turns at once; it is smaller if strips are equally wide and their
    /// number follows the ellipse (docs/vehicle-measured.md). The number of strips is even: the pole of a lateral force
    /// and spin moves on y = 0, and elements there could slip to either side of it, which breaks the symmetry of the
    /// discrete problem.
    PatchMesh<double> first(Eigen::Index n) const {
        detail::require(n >= 2 && n <= 1000, "CreepForceSource", "n", n, "lie in [2, 1000]");
        const double per_strip = std::clamp(std::pow(contact_.a_over_b(), 0.6), 0.25, 2.0),
                     side = static_cast<double>(n);
        const long along = (std::max)(std::lround(side * std::sqrt(per_strip)), 2L);
        const long across = 2 * (std::max)(std::lround(side * side / static_cast<double>(2 * along)), 1L);
        return patch_mesh(contact_, cosine_mesh((std::min)(along, 2 * across)), uniform_mesh(across));
    }

    /// A mesh with one more element in each strip and one more strip: it has centres where the first mesh has edges,
    /// across at y = 0 and along each strip at x = 0.
    PatchMesh<double> shifted() const {
        return patch_mesh(contact_, cosine_mesh(mesh().elements_per_strip() + 1),
                          uniform_mesh(mesh().strip_count() + 1));
    }

    /// Weight of the shifted mesh. As the pole of the slip passes from the edge of an element to its centre, forces
    /// swing about their true value, on the two meshes in opposite directions (docs/vehicle-measured.md).
    ///
    /// - Spin above 4 and pole within 1.2 of the ellipse, where nearly all elements slide: both meshes have equal
    ///   weight.
    /// - Spin below 2 or pole beyond 1.5 of the ellipse: the first mesh alone.
    double share_of_shifted(const Creepage<double>& v) const {
        // the pole's distance from the middle in units of the semi-axes, times the spin
        const double a_over_b = contact_.a_over_b(), spin = std::abs(v.spin),
                     pole = std::hypot(v.longitudinal * std::sqrt(a_over_b), v.lateral / std::sqrt(a_over_b));
        const double sliding = (spin - 2) / 2, inside = (1.5 * spin - pole) / (0.3 * spin);
        return spin > 2 ? 0.5 * std::clamp((std::min)(sliding, inside), 0.0, 1.0) : 0;
    }

    PatchContact<double> contact_;
    Patch patch_;
    std::optional<Patch> shifted_;  // made when it is first needed
};

/// The grid of a range, with the creep coefficients of its ellipses; `jobs` threads share the work. Throws
/// std::invalid_argument if the range is not a grid's, or the patches of an ellipse have no coefficients or no force
/// under large spin (n is too small, or a/b too far from 1).
inline CreepForceGrid make_creep_force_grid(const CreepForceGrid::Range& range, std::size_t jobs = 1) {
    constexpr const char* who = "make_creep_force_grid";
    detail::require(range.shapes >= 4 && range.shapes <= 1000, who, "shapes", range.shapes, "lie in [4, 1000]");
    std::vector<CreepCoefficients<double>> coefficients(static_cast<std::size_t>(range.shapes));
    detail::parallel_for(coefficients.size(), jobs, [&](std::size_t i) {
        const double a_over_b = CreepForceGrid::a_over_b_of(static_cast<Eigen::Index>(i), range.shapes,
                                                            range.smallest_a_over_b, range.largest_a_over_b);
        CreepForceSource source(a_over_b, range.poisson_ratio, range.n);
        const Response<double> found = source.in_adhesion();
        // under a spin so large that both meshes count
        const Status sliding = source.solve({0, 0, 10}, true).step.status;
        if (found.status != Status::ok || sliding != Status::ok) {
            throw std::invalid_argument(std::string(who) + ": a/b = " + detail::to_text(a_over_b) +
                                        " with n = " + detail::to_text(range.n) + " must have the status ok, not " +
                                        (found.status != Status::ok ? name(found.status) : name(sliding)));
        }
        coefficients[i] = creep_coefficients(source.contact(), found);
    });
    return {range.poisson_ratio, range.smallest_a_over_b, range.largest_a_over_b, range.levels, coefficients};
}

/// A table of steady creep forces, of the ellipses and creepages of `range`. `jobs` threads share the work, and the
/// result does not depend on their number; progress(done, all) is called as forces become known, by one thread at a
/// time. Throws std::invalid_argument as make_creep_force_grid, and std::runtime_error where a patch has no solution.
inline CreepForceTable make_creep_force_table(
    const CreepForceGrid::Range& range, std::size_t jobs = 1,
    const std::function<void(std::size_t, std::size_t)>& progress = [](std::size_t, std::size_t) {}) {
    const CreepForceGrid grid = make_creep_force_grid(range, jobs);
    const std::vector<CreepForceGrid::Slab> slabs = grid.slabs();
    Eigen::Array3Xd forces(3, grid.shapes() * grid.nodes());
    std::size_t done = 0;
    detail::parallel_for(
        slabs.size(), jobs,
        [&](std::size_t k) {
            const auto [shape, first, last] = slabs[k];
            CreepForceSource source(grid.a_over_b(shape), range.poisson_ratio, range.n);
            for (Eigen::Index node = first; node < last; ++node) {
                const auto solution = source.solve(grid.creepage(shape, node), grid.begins_line(node));
                if (solution.step.status != Status::ok) {
                    throw std::runtime_error("make_creep_force_table: no forces at node " + std::to_string(node) +
                                             " of ellipse " + std::to_string(shape) + ": " +
                                             name(solution.step.status));
                }
                forces.col(shape * grid.nodes() + node) = solution.force;
            }
        },
        [&] { progress(++done, slabs.size()); });
    return {grid, forces};
}

}  // namespace rollbem
