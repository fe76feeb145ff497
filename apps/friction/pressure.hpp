// What the parts of friction_study share: the pressure, and the units of the columns. With mu = p0 = a = G = 1 all
// results are in these units, except forces and works, which are in mu N.
#pragma once

#include <functional>
#include <numbers>
#include <optional>

#include <Eigen/Core>

#include <rollbem/discretisation/mesh.hpp>

#include "support/csv.hpp"
#include "support/options.hpp"
#include "support/scenes.hpp"

namespace friction {

inline constexpr double mu_N = std::numbers::pi / 2;

/// A pressure at every x/a and its mean on each element of a mesh, scaled to the load of Hertz's pressure with p0 = 1.
struct Pressure {
    std::function<double(double)> at;
    std::function<Eigen::ArrayXd(const rollbem::Mesh<double>&)> mean;
    bool hertz;  ///< the closed forms hold

    double operator()(double x_over_a) const { return at(x_over_a); }
    Eigen::ArrayXd operator()(const rollbem::Mesh<double>& mesh) const { return mean(mesh); }
};

/// Hertz's pressure, or that of --pressure. Throws BadInput.
Pressure make_pressure(const study::Options& options);

/// Creepage xi [-] of a ratio delta = xi G/(2 (1-nu) mu p0).
double creepage(const study::Scene& scene, double ratio);

/// value/exact - 1 where both are defined.
study::Cell relative_error(double value, std::optional<double> exact);

}  // namespace friction
