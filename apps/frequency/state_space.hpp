// --state-space: the contact by one scheme as linear ordinary differential equations, a file for each matrix.
#pragma once

#include <string>
#include <vector>

#include <rollbem/adhesion/state_space.hpp>

#include "support/csv.hpp"
#include "support/options.hpp"
#include "support/output_folder.hpp"
#include "support/scenes.hpp"

namespace frequency {

/// A.csv, B.csv, C.csv, D.csv and state_space.toml, which says how they were made. All are written before the first
/// gets its final name.
class StateSpaceFiles {
public:
    static std::vector<std::string> names();

    /// Computes and writes the files, to which commit() gives their names; reduced to --states, if given. Throws
    /// BadInput unless there is one scene, whose G is regular, whose tractions converge to full adhesion, and which
    /// decays where it is to be reduced, and if the folder cannot be written; throws WriteError.
    StateSpaceFiles(const study::Options& options, const std::vector<study::Scene>& scenes);

    /// Throws WriteError.
    void commit();

private:
    struct Contents {
        rollbem::StateSpace<double> space;
        std::string conventions;  // for the sidecar
    };

    static Contents contents(const study::Options& options, const std::vector<study::Scene>& scenes);

    StateSpaceFiles(const study::Options& options, const Contents& contents);

    study::OutputFolder folder_;
    std::vector<study::OutputFile> files_;
};

}  // namespace frequency
