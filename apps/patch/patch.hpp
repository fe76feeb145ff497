// The patches of patch_study, and their friction: steady, forces over creepages and spin and the tractions of all
// elements, and in the time domain. G = 1 and mu N = G a b: a creepage is the given number.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <rollbem/discretisation/patch_mesh.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/patch_kernel.hpp>
#include <rollbem/friction/law.hpp>
#include <rollbem/scene/creepage.hpp>
#include <rollbem/scene/patch_contact.hpp>

#include "support/friction_laws.hpp"
#include "support/named_scheme.hpp"
#include "support/options.hpp"
#include "support/plot.hpp"
#include "support/runs.hpp"
#include "support/sheet.hpp"

namespace patch {

// --- patches

/// One contact patch and its mesh.
struct Patch {
    rollbem::PatchContact contact;  ///< a = G = 1; an outline in its own unit of length
    rollbem::PatchMesh<double> mesh;
    rollbem::Mesh<double> across;  ///< that cuts it into strips
    rollbem::NodeDifference scheme;
    study::NamedScheme named;  ///< scheme and strips by their names
    double layer;              ///< compliance between the bodies [c/G]

    std::string label() const;  ///< for the progress line
    rollbem::HalfSpace<double> kernel() const {
        return rollbem::HalfSpace<double>(contact.poisson_ratio(), layer * contact.c());
    }
};

/// The first columns of every table, and the last.
inline constexpr const char* identity = "a_over_b, poisson, n, strips";
inline constexpr const char* distinctions = "nodes, scheme, layer";

/// The cell of one of these columns.
study::Cell scene_cell(const Patch& patch, const std::string& column);

// --- friction

/// Creepages times G a b/(mu N), spin times G a b c/(mu N).
using CreepPoint = rollbem::Creepage;

/// The creepages themselves.
inline rollbem::Creepage creepage(const Patch& patch, const CreepPoint& point) {
    return {point.longitudinal, point.lateral, point.spin / patch.contact.c()};
}

inline double mu_N(const Patch& patch) { return patch.contact.half_length() * patch.contact.half_width(); }

/// longitudinal, lateral and spin, of rows that know their `point`.
template <class Row>
std::vector<study::Column<Row>> creepage_columns() {
    return {
        {"longitudinal", "longitudinal creepage xi G a b/(mu N)", [](const Row& r) { return r.point.longitudinal; }},
        {"lateral", "lateral creepage eta G a b/(mu N)", [](const Row& r) { return r.point.lateral; }},
        {"spin", "spin phi G a b c/(mu N)", [](const Row& r) { return r.point.spin; }}};
}

/// Mean pressures of a patch's elements [G], which carry the load mu N = G a b with mu = 1: Hertz's, or of --pressure.
/// Throws BadInput if less than half of the load of --pressure lies on them, or if it covers less than nine tenths.
using Pressure = std::function<Eigen::ArrayXd(const Patch&)>;

/// The law of friction under these pressures, constant or one of friction_laws(), in the units of the patch.
rollbem::Friction friction_of(const std::optional<study::ChosenLaw>& law, const Patch& patch, Eigen::ArrayXd pressures);

/// The units of forces [N] and moments [N m] of a patch given in SI.
struct SiUnits {
    double force, moment;
};

/// Steady friction.
struct Friction {
    const std::vector<Patch>& patches;
    std::vector<CreepPoint> points;
    Pressure pressure;
    bool timed;
    bool from_above;                ///< the picture shows the patches at the one creepage
    bool keeps_tractions;           ///< for a file or that picture
    std::optional<double> force{};  ///< -F_x/(mu N) in place of the longitudinal creepages
    std::optional<study::ChosenLaw> law{};
    std::optional<SiUnits> si{};  ///< of the one patch of --creepage
};

/// The columns and their meanings, of forces and of tractions.
std::string friction_help();

/// A row for each patch and creepage, solved from rest. It refers to the scene.
study::Table friction_table(const Friction& scene);

// --- in the time domain

inline const study::HistoryColumns history_columns{
    {"longitudinal", "lateral", "spin"}, {"shift_x", "shift_y"}, {"load_ratio", "a_ratio", "b_ratio"}};

/// Semi-axes over the semi-axes under N_0.
struct AxisRatios {
    double a, b;
};

/// Friction in time.
struct TimeScene {
    const std::vector<Patch>& patches;
    Pressure pressure;
    study::Run run;
    std::optional<study::ChosenLaw> law{};

    /// Just before (or at) q.
    CreepPoint at(double q) const {
        const auto value = [&](const char* column) { return run.imposed.at(column, q, false); };
        return {value("longitudinal"), value("lateral"), value("spin")};
    }
    /// Whether columns of a table give the ratios of the semi-axes. By Hertz they are the cube root of the load.
    bool has_axes() const { return run.imposed.has("a_ratio"); }
    AxisRatios axes(double q) const {
        if (has_axes()) return {run.imposed.at("a_ratio", q), run.imposed.at("b_ratio", q)};
        return {std::cbrt(run.load_ratio(q)), std::cbrt(run.load_ratio(q))};
    }
    /// The ratios of a mesh that covers the contact during the whole run.
    AxisRatios largest_axes() const {
        if (has_axes()) return {run.imposed.largest("a_ratio"), run.imposed.largest("b_ratio")};
        const double ratio = std::cbrt(run.imposed.largest("load_ratio"));
        return {ratio, ratio};
    }
    /// Least and largest a/b over a/b under N_0; 1 lies between them.
    std::pair<double, double> shapes() const {
        std::pair<double, double> range{1, 1};
        if (!has_axes()) return range;
        for (const double q : run.imposed.places()) {  // between these a/b is monotonic
            const double ratio = axes(q).a / axes(q).b;
            range = {std::min(range.first, ratio), std::max(range.second, ratio)};
        }
        return range;
    }
};

/// The columns and their meanings.
std::string transient_help();

/// A row for each step of every patch. It refers to the scene.
study::Table transient_table(const TimeScene& scene);

// --- the options, read at the door. The readers throw BadInput.

/// Declares all options of patches, and of friction on them, steady or in time.
void add_options(study::Options& options);
void add_friction_options(study::Options& options);
void add_si_options(study::Options& options);
void add_transient_options(study::Options& options);

/// The options that ask for friction.
std::vector<std::string> ways_of_friction();

/// n is the outermost loop, then the number of strips, a/b and Poisson's ratio.
std::vector<Patch> read_patches(const study::Options& options);
Friction read_friction(const study::Options& options, const std::vector<Patch>& patches);
TimeScene read_time_scene(const study::Options& options, const std::vector<Patch>& patches);

// --- pictures

/// Creep coefficients over a/b with Kalker's table as points; over n if there is one a/b.
study::Picture draw_coefficients(const study::Records& rows);

/// Real and imaginary parts over the frequency.
study::Picture draw_responses(const study::Records& rows);

/// Forces, or along x the creepage found `by_force`, and moment over the creepage, or else a/b or n, that varies most.
study::Picture draw_friction(const study::Records& rows, bool by_force);

/// Each patch at one creepage, one below the other: outline, stick and slip, tractions as arrows, pole of spin.
study::Picture draw_from_above(const std::vector<Patch>& patches, const CreepPoint& point,
                               const study::SideTable& tractions);

/// Forces, or along x the creepage found `by_force`, and moment over the distance rolled, with the load if that varies.
study::Picture draw_in_time(const study::Records& rows, bool load_varies, bool by_force);

}  // namespace patch
