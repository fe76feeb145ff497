// Bodies of vehicle/make_creep_force_table.hpp. Internal.
#pragma once

#include "../make_creep_force_table.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "../../assembly/patch_system.hpp"
#include "../../detail/parallel_for.hpp"
#include "../../detail/require.hpp"
#include "../../discretisation/scheme.hpp"
#include "../../elasticity/patch_kernel.hpp"
#include "../../friction/model.hpp"
#include "../../normal/hertz.hpp"
#include "../../rolling/run.hpp"
#include "../../steady/creep_coefficients.hpp"

namespace rollbem::detail {

inline constexpr NodeDifference chebyshev_nodes{Nodes::chebyshev};

}  // namespace rollbem::detail

namespace rollbem {

/// The ellipse on one mesh. With a = G = 1 and mu N = G a b, creepages are the given numbers, and a force over mu N
/// is the force over b.
struct CreepForceTable::Source::Patch {
    using Model = FrictionModel;

    Patch(const PatchContact& contact, PatchMesh<double> given)
        : mesh(std::move(given)),
          model(contact, steady_system(mesh, detail::chebyshev_nodes, HalfSpace<double>(contact.poisson_ratio())),
                {1.0, hertz_pressures(contact, mesh, contact.half_width())}),
          rest(model.at_rest()),
          run(model) {}
    Patch(const Patch&) = delete;
    Patch& operator=(const Patch&) = delete;

    Solution solve(const PatchContact& contact, const Creepage& creepage, bool from_rest) {
        const Creepage given{creepage.longitudinal, creepage.lateral, creepage.spin / contact.c()};
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
    Model::State rest;
    Run<Model> run;
};

ROLLBEM_DECL CreepForceTable::Source::Source(double a_over_b, double poisson_ratio, Eigen::Index n)
    : contact_(PatchContact::dimensionless(a_over_b, poisson_ratio)),
      patch_(std::make_shared<Patch>(contact_, first(n))) {}

ROLLBEM_DECL auto CreepForceTable::Source::mesh() const -> const PatchMesh<double>& { return patch_->mesh; }

ROLLBEM_DECL auto CreepForceTable::Source::in_adhesion() const -> Response<double> {
    const HalfSpace<double> kernel(contact_.poisson_ratio());
    return contact_.a_over_b() > 10 ? solve_steady(contact_, mesh(), detail::chebyshev_nodes, kernel)
                                    : solve_steady(mesh(), detail::chebyshev_nodes, kernel);
}

ROLLBEM_DECL auto CreepForceTable::Source::solve(const Creepage& creepage, bool from_rest) -> Solution {
    Solution solution = patch_->solve(contact_, creepage, from_rest);
    if (from_rest && shifted_) shifted_->run.now() = shifted_->rest;
    const double share = share_of_shifted(creepage);
    if (share == 0 || solution.step.status != Status::ok) return solution;

    if (!shifted_) shifted_ = std::make_shared<Patch>(contact_, shifted());
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

ROLLBEM_DECL auto CreepForceTable::Source::first(Eigen::Index n) const -> PatchMesh<double> {
    detail::require(n >= 2 && n <= 1000, "CreepForceTable::Source", "n", n, "lie in [2, 1000]");
    const double per_strip = std::clamp(std::pow(contact_.a_over_b(), 0.6), 0.25, 2.0), side = static_cast<double>(n);
    const long along = (std::max)(std::lround(side * std::sqrt(per_strip)), 2L);
    const long across = 2 * (std::max)(std::lround(side * side / static_cast<double>(2 * along)), 1L);
    return patch_mesh(contact_, cosine_mesh((std::min)(along, 2 * across)), uniform_mesh(across));
}

ROLLBEM_DECL auto CreepForceTable::Source::shifted() const -> PatchMesh<double> {
    return patch_mesh(contact_, cosine_mesh(mesh().elements_per_strip() + 1), uniform_mesh(mesh().strip_count() + 1));
}

ROLLBEM_DECL double CreepForceTable::Source::share_of_shifted(const Creepage& v) const {
    // the pole's distance from the middle in units of the semi-axes, times the spin
    const double a_over_b = contact_.a_over_b(), spin = std::abs(v.spin),
                 pole = std::hypot(v.longitudinal * std::sqrt(a_over_b), v.lateral / std::sqrt(a_over_b));
    const double sliding = (spin - 2) / 2, inside = (1.5 * spin - pole) / (0.3 * spin);
    return spin > 2 ? 0.5 * std::clamp((std::min)(sliding, inside), 0.0, 1.0) : 0;
}

ROLLBEM_DECL CreepForceTable::Grid make_creep_force_grid(const CreepForceTable::Grid::Range& range, std::size_t jobs) {
    constexpr const char* who = "make_creep_force_grid";
    detail::require(range.shapes >= 4 && range.shapes <= 1000, who, "shapes", range.shapes, "lie in [4, 1000]");
    std::vector<CreepCoefficients<double>> coefficients(static_cast<std::size_t>(range.shapes));
    detail::parallel_for(coefficients.size(), jobs, [&](std::size_t i) {
        const double a_over_b = CreepForceTable::Grid::a_over_b_of(static_cast<Eigen::Index>(i), range.shapes,
                                                                   range.smallest_a_over_b, range.largest_a_over_b);
        CreepForceTable::Source source(a_over_b, range.poisson_ratio, range.n);
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

ROLLBEM_DECL CreepForceTable make_creep_force_table(const CreepForceTable::Grid::Range& range, std::size_t jobs,
                                                    const std::function<void(std::size_t, std::size_t)>& progress) {
    const CreepForceTable::Grid grid = make_creep_force_grid(range, jobs);
    const std::vector<CreepForceTable::Grid::Slab> slabs = grid.slabs();
    Eigen::Array3Xd forces(3, grid.shapes() * grid.nodes());
    std::size_t done = 0;
    detail::parallel_for(
        slabs.size(), jobs,
        [&](std::size_t k) {
            const auto [shape, first, last] = slabs[k];
            CreepForceTable::Source source(grid.a_over_b(shape), range.poisson_ratio, range.n);
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
