// Steady friction on the patches of patch_study: forces over creepages and spin, and the tractions of all elements.
// G = 1 and mu N = G a b: a creepage is the given number.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <rollbem/scene/creepage.hpp>

#include "patches.hpp"
#include "support/options.hpp"
#include "support/sheet.hpp"

namespace patch {

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
    return {{"longitudinal", "xi times G a b/(mu N)", [](const Row& r) { return r.point.longitudinal; }},
            {"lateral", "eta times G a b/(mu N)", [](const Row& r) { return r.point.lateral; }},
            {"spin", "phi times G a b c/(mu N)", [](const Row& r) { return r.point.spin; }}};
}

/// Mean pressures of a patch's elements [G], which carry the load mu N = G a b with mu = 1: Hertz's, or of --pressure.
/// Throws BadInput if less than half of the load of --pressure lies on them, or if it covers less than nine tenths.
using Pressure = std::function<Eigen::ArrayXd(const Patch&)>;

/// Throws BadInput, also if an outline has no --pressure.
Pressure read_pressure(const study::Options& options);

/// Declares --longitudinal, --lateral, --spin, --pressure and --tractions.
void add_friction_options(study::Options& options);

/// Whether any of the creepages was given.
bool asks_for_friction(const study::Options& options);

/// All creepages, longitudinal outermost. Throws BadInput, also if a patch would gain energy from rolling with spin.
std::vector<CreepPoint> read_points(const study::Options& options, const std::vector<Patch>& patches);

/// The columns and their meanings, of forces and of tractions.
std::string friction_help();

/// Writes a row for each patch and creepage, solved from rest. Throws what write_table throws, and BadInput.
void run_friction(const study::Options& options, const std::vector<Patch>& patches);

}  // namespace patch
