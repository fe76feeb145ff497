// The schemes of a line contact that precision_study compares, and what they compute.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <rollbem/compiled/steady.hpp>
#include <rollbem/discretisation/mesh.hpp>
#include <rollbem/elasticity/any_kernel.hpp>
#include <rollbem/friction/law.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/spectral/chebyshev.hpp>

#include "comparison.hpp"
#include "support/named_scheme.hpp"

namespace precision {

inline constexpr double peak = 1e-3;  ///< mu p0 / G
inline constexpr int steps = 10;      ///< of the response to a step, each by dq

/// What the schemes are applied to.
struct Scene {
    rollbem::Contact<double> contact;                      ///< a = G = 1
    rollbem::LineModel model = rollbem::LineModel::plane;  ///< of the kernel
    double dq = 1;                                         ///< [a]
    double creepage_ratio = 0.5;                           ///< of the problems with friction
    int load_parts = 1;                                    ///< of each step under a load that varies

    double nu() const { return contact.poisson_ratio(); }
    bool plane() const { return model == rollbem::LineModel::plane; }
    rollbem::AnyKernel<double> kernel() const { return rollbem::AnyKernel<double>::longitudinal(model, contact); }
    double creepage() const { return 2 * (1 - nu()) * peak * creepage_ratio; }
    /// mu N of Hertz's pressure.
    double full() const { return peak * std::numbers::pi / 2 * contact.width(); }
    /// b/a for the closed forms; steady results of the plane model do not depend on it.
    double finite_aspect() const { return std::isfinite(contact.aspect()) ? contact.aspect() : 1000; }
};

/// A scheme, which may be extrapolated from n/2 and n.
struct Scheme : study::NamedScheme {
    bool exists(long n) const {
        if (method == "closed-form") return n == 0;
        if (method == "polynomial") return n >= 1;
        if (!has_elements()) return n >= 1 && n <= 10000;
        const long least = std::max(2l, long(rollbem::topology_info(topology()).least_n));
        return richardson ? n % 2 == 0 && n / 2 >= least : n >= least;
    }
    /// Coulomb's law takes elements.
    bool has(Problem problem) const {
        return has_elements() || problem < Problem::friction ||
               (method == "closed-form" && problem == Problem::friction);
    }
};

/// The scheme of a word that is known to be one.
inline Scheme scheme_of(const std::string& word) { return {*study::scheme_named(word)}; }

/// Elements on one mesh, or a number of states.
struct Discrete {
    const Scene& scene;
    rollbem::AnyScheme equations;
    std::optional<rollbem::Mesh<double>> mesh;
    rollbem::Chebyshev states{};
    bool breathes = false;  ///< with the half-length if the load varies

    Eigen::MatrixXd slopes() const { return rollbem::assemble_G_prime(*mesh, equations, scene.kernel()); }
    rollbem::ElementSystem<double> elements() const {
        return rollbem::rolling_system(*mesh, equations, scene.kernel());
    }
    rollbem::RollingSystem<double> system() const {
        if (mesh) return elements();
        return rollbem::rolling_system(states, scene.kernel());
    }
    rollbem::Response<double> steady() const {
        if (mesh) return rollbem::solve_steady<double>(slopes(), rollbem::unknown_widths(*mesh, equations));
        return solve_steady(states, scene.kernel());
    }
    rollbem::Friction<> friction() const { return {1, peak * rollbem::mean_hertz_pressure(*mesh)}; }
};

/// A scheme's mesh of n elements, after that of n/2 if results are extrapolated; or n states.
std::vector<Discrete> discretise(const Scene& scene, const Scheme& scheme, long n);

/// What a quantity other than the traction consists of; not a number if the status is not ok.
Values values(const Discrete& discrete, const Quantity& quantity);

/// The values of a quantity, and those that they should have if these are not the reference.
struct Found {
    Values values, exact{};
};

/// Tractions, on one mesh, or extrapolated from two to pairs of elements, which form the coarser mesh.
Found tractions(const std::vector<Discrete>& meshes, double order = 0);

/// The values of a scheme at n; `reference` holds those of the closed form.
Found evaluate(const Scene& scene, const Scheme& scheme, long n, const Quantity& quantity, const Values& reference);

}  // namespace precision
