// The patches of patch_study, and their friction: steady, forces over creepages and spin and the tractions of all
// elements, and in the time domain. G = 1 and mu N = G a b: a creepage is the given number.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <rollbem/discretisation/patch_mesh.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/rectangle_kernel.hpp>
#include <rollbem/scene/creepage.hpp>
#include <rollbem/scene/patch_contact.hpp>

#include "friction/tractions.hpp"
#include "support/named_scheme.hpp"
#include "support/options.hpp"
#include "support/plot.hpp"
#include "support/sheet.hpp"

namespace patch {

// --- patches

/// One contact patch and its mesh.
struct Patch {
    rollbem::PatchContact<double> contact;  ///< a = G = 1; an outline in its own unit of length
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

/// Declares --a-over-b, --outline, --layer, --strips, --strip-edges and --strip-grading, and says what the common
/// options mean here.
void add_options(study::Options& options);

/// All patches: n is the outermost loop, then the number of strips, a/b and Poisson's ratio. Throws BadInput.
std::vector<Patch> make_patches(const study::Options& options);

/// The first columns of every table, and the last.
inline constexpr const char* identity = "a_over_b, poisson, n, strips";
inline constexpr const char* distinctions = "nodes, scheme, layer";

/// The cell of one of these.
study::Cell scene_cell(const Patch& patch, const std::string& column);

// --- friction

/// Creepages times G a b/(mu N), spin times G a b c/(mu N).
using CreepPoint = rollbem::Creepage<double>;

/// The creepages themselves.
inline rollbem::Creepage<double> creepage(const Patch& patch, const CreepPoint& point) {
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

/// Throws BadInput, also if an outline has no --pressure.
Pressure read_pressure(const study::Options& options);

/// Declares --longitudinal, --lateral, --spin, --pressure and --tractions.
void add_friction_options(study::Options& options);

/// The options that ask for friction, the last five in the time domain.
std::vector<std::string> ways_of_friction();

/// Whether any of these was given.
bool asks_for_friction(const study::Options& options);

/// All creepages, longitudinal outermost. Throws BadInput, also if a patch would gain energy from rolling with spin.
std::vector<CreepPoint> read_points(const study::Options& options, const std::vector<Patch>& patches);

/// Throws BadInput if a patch would gain energy from rolling with spin.
void require_no_gain(const study::Options& options, const std::vector<Patch>& patches);

/// The columns and their meanings, of forces and of tractions.
std::string friction_help();

/// Writes a row for each patch and creepage, solved from rest. Throws what write_table throws, and BadInput.
void run_friction(const study::Options& options, const std::vector<Patch>& patches);

// --- in the time domain

/// Declares --transient and what goes with it.
void add_transient_options(study::Options& options);

/// The columns and their meanings.
std::string transient_help();

/// Writes a row for each step of every patch. Throws what write_runs throws, and BadInput.
void run_transient(const study::Options& options, const std::vector<Patch>& patches);

// --- pictures

/// Creep coefficients over a/b with Kalker's table as points; over n if there is one a/b.
study::Plot draw_coefficients(const std::vector<std::string>& columns, const std::vector<study::Row>& rows);

/// Real and imaginary parts over the frequency.
study::Plot draw_responses(const std::vector<std::string>& columns, const std::vector<study::Row>& rows);

/// Forces, or along x the creepage found `by_force`, and moment over the creepage, or else a/b or n, that varies most.
study::Plot draw_friction(const std::vector<std::string>& columns, const std::vector<study::Row>& rows, bool by_force);

/// Each patch at one creepage, side by side: outline, stick and slip, tractions as arrows, pole of spin.
study::Plot draw_from_above(const std::vector<Patch>& patches, const CreepPoint& point,
                            const friction::Tractions& tractions);

/// Forces, or along x the creepage found `by_force`, and moment over the distance rolled, with the load if that varies.
study::Plot draw_in_time(const std::vector<std::string>& columns, const std::vector<study::Row>& rows, bool load_varies,
                         bool by_force);

}  // namespace patch
