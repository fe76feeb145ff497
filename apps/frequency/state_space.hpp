// --state-space: the contact of one scheme as linear ordinary differential equations, a file for each matrix.
#pragma once

#include <string>
#include <vector>

#include <rollbem/adhesion/state_space.hpp>

#include "support/csv.hpp"
#include "support/options.hpp"
#include "support/output_folder.hpp"
#include "support/scenes.hpp"

namespace frequency {

/// A.csv, B.csv, C.csv, D.csv and state_space.toml, which says how they were made. All are on the disk before the first
/// takes its name.
class StateSpaceFiles {
public:
    static std::vector<std::string> names();

    /// Computes and writes what commit() names. Throws BadInput unless there is one scene, whose G is regular and whose
    /// tractions converge to full adhesion, and where the folder cannot be written; WriteError.
    StateSpaceFiles(const study::Options& options, const std::vector<study::Scene>& scenes);

    /// Throws WriteError.
    void commit();

private:
    StateSpaceFiles(const study::Options& options, const rollbem::StateSpace<double>& space);

    study::OutputFolder folder_;
    std::vector<study::OutputFile> files_;
};

}  // namespace frequency
