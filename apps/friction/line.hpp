// The line contact of friction_study: pressure, law, layer, load and matrices. With mu = p0 = a_0 = G = 1 all results
// are in the units of the columns, except forces and works, which are in mu N; a_0 is the half-length under N_0.
#pragma once

#include <functional>
#include <numbers>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz.hpp>

#include "support/friction_laws.hpp"
#include "support/runs.hpp"
#include "support/scenes.hpp"
#include "support/sheet.hpp"

namespace friction {

using System = rollbem::ElementSystem<double>;

inline constexpr study::Methods methods{.not_extrapolated = "precision_study extrapolates forces with friction"};

inline constexpr double mu_N = std::numbers::pi / 2;

/// A pressure at every point and its mean on each element of a mesh, scaled to the load of Hertz's pressure with p0 =
/// 1.
struct Pressure {
    std::function<double(double)> at;
    std::function<Eigen::ArrayXd(const rollbem::Mesh<double>&)> mean;
    bool hertz;  ///< the closed forms hold

    double operator()(double x_over_a) const { return at(x_over_a); }
    Eigen::ArrayXd operator()(const rollbem::Mesh<double>& mesh) const { return mean(mesh); }
};

/// Half-length of a mesh that covers the contact during the whole run [a_0].
double largest_half_length(const study::Run& run);

/// Hertz's contact with a_0 = 1 and p_0 = 1 under N_0, on the mesh that the run needs.
rollbem::HertzLine::Load hertz_load(const study::Run& run, const rollbem::Mesh<double>& mesh);

/// Creepage ratios delta = xi G/(2 (1-nu) mu p0).
struct CreepPoint {
    double longitudinal;
    std::optional<double> lateral{};  ///< nothing with creepage in one direction only
    double spin = 0;                  ///< times a_0

    rollbem::Creepage times(double unit) const {
        return {unit * longitudinal, unit * lateral.value_or(0), unit * spin};
    }
};

/// Creepage xi [-] of the ratio 1.
inline double creepage_unit(const study::Scene& scene) { return 2 * (1 - scene.contact.poisson_ratio()); }

/// The settings that all scenes share.
struct Line {
    bool both;  ///< friction in both directions
    Pressure pressure;
    double layer;                         ///< compliance [a_0/G]
    std::optional<study::ChosenLaw> law;  ///< nothing where mu is constant
    std::string title;  ///< pressure, law, layer, load and, in time, creepage as given, each after ", "

    /// Whether Carter's closed form holds along the rolling direction.
    bool carter() const { return pressure.hertz && layer == 0 && !law; }

    /// Matrices of a direction, on a mesh that covers more than the contact where half_length > 1 [a_0]: G' alone for
    /// steady rolling, G besides `in_time`. Throw std::invalid_argument where they are not finite.
    enum class Direction { longitudinal, lateral };
    System system(const study::Scene& scene, Direction direction, bool in_time, double half_length = 1) const;
    std::optional<System> lateral_system(const study::Scene& scene, bool in_time, double half_length = 1) const;

    /// The contact under mean pressures, of one direction or both.
    rollbem::FrictionModel contact(const study::Scene& scene, const System& along, const std::optional<System>& across,
                                   const Eigen::ArrayXd& means, const rollbem::StabilityVerdict& checks,
                                   rollbem::Integrator integrator = rollbem::Integrator::sdirk2,
                                   double half_length = 1) const;
};

/// layer and the parameters of the law, of rows that know their `line`.
template <class Row>
std::vector<study::Column<Row>> law_columns() {
    return study::joined<study::Column<Row>>(
        {{"layer", "compliance of the layer [a/G], of --layer", [](const Row& r) { return r.line.layer; }}},
        study::friction_law_columns<Row>([](const Row& r) -> const auto& { return r.line.law; }));
}

/// value/exact - 1 where both are defined.
study::Cell relative_error(double value, std::optional<double> exact);

// --- what pictures share

inline constexpr int line_points = 400;  ///< of an exact curve
inline const std::vector<std::string> case_columns =
    study::joined({"method", "derivative", "mesh", "n", "alpha_L", "alpha_T"}, study::columns_of(study::distinctions));

/// Carter's creep curve between two ratios, 0 included.
study::Series carter_curve(double from, double to);

/// Range of forces up to full sliding, for the signs that occur.
study::PlotRange force_range(const study::Plot& plot);

/// The unit and labels of forces and tractions in pictures.
std::string coefficient(bool falling);
std::string creepage_label(bool falling, const std::string& ratio);
std::string force_label(bool falling, const std::string& force = "-F", const std::string& load = "N");

}  // namespace friction
