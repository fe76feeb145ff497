// --state-space: linear ordinary differential equations, a file for each matrix, reduced to --states if that is given.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include <rollbem/adhesion/state_space.hpp>

#include "csv.hpp"
#include "options.hpp"

namespace study {

/// A.csv, B.csv, C.csv, D.csv and state_space.toml, which says how they were made. All are written before the first
/// gets its final name.
class StateSpaceFiles {
public:
    static std::vector<std::string> names();

    /// Declares --state-space and --states; `what` has the equations.
    static void add_options(Options& options, const std::string& what);

    /// Writes the files, to which commit() gives their names. The sidecar says `conventions`, lines of TOML, and
    /// `states`, what x is unless it is reduced; `bounded` is what the bound of the reduction's error is of. Throws
    /// BadInput if the folder cannot be written, or if a system to be reduced does not decay; throws WriteError.
    StateSpaceFiles(const Options& options, rollbem::StateSpace<double> space, const std::string& conventions,
                    const std::string& states, const std::string& bounded);

    /// Throws WriteError.
    void commit();

private:
    std::deque<OutputFile> files_;
};

}  // namespace study
