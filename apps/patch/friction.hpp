// Steady friction on the patches of patch_study: forces over creepages and spin, and the tractions of all elements.
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "patches.hpp"
#include "support/csv.hpp"
#include "support/options.hpp"
#include "support/table.hpp"

namespace patch {

/// Creepages times G a b/(mu N), spin times G a b c/(mu N).
struct CreepPoint {
    double longitudinal, lateral, spin;
};

/// Declares --longitudinal, --lateral, --spin, --pressure and --tractions.
void add_friction_options(study::Options& options);

/// Whether any of the creepages was given.
bool asks_for_friction(const study::Options& options);

/// All creepages, longitudinal outermost. Throws BadInput, also if a patch would gain energy from rolling with spin.
std::vector<CreepPoint> read_points(const study::Options& options, const std::vector<Patch>& patches);

/// The rows of --tractions, which several threads may add to.
class Tractions {
public:
    void add(std::size_t task, std::size_t point, std::vector<study::Row> rows);
    void write(study::TableFile& file) const;
    /// By patch and creepage.
    const std::map<std::pair<std::size_t, std::size_t>, std::vector<study::Row>>& all() const { return rows_; }

private:
    std::mutex mutex_;
    std::map<std::pair<std::size_t, std::size_t>, std::vector<study::Row>> rows_;
};

const std::vector<std::string>& friction_columns();
const std::vector<std::string>& traction_columns();

/// Writes a row for each patch and creepage, solved from rest. Throws what write_table throws, and BadInput.
void run_friction(const study::Options& options, const std::vector<Patch>& patches);

}  // namespace patch
