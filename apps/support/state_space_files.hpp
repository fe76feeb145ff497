// --state-space: linear ordinary differential equations, a file for each matrix, reduced to --states if that is given.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include <rollbem/adhesion/state_space.hpp>

#include "options.hpp"
#include "output.hpp"

namespace study {

/// Declares --state-space and --states; `what` has the equations.
void add_state_space_options(Options& options, const std::string& what);

/// The words of messages on the equations, and of state_space.toml.
struct StateSpaceWords {
    std::string one;          ///< scheme, or patch
    std::string lists;        ///< options whose values make several
    std::string conventions;  ///< lines that begin with #
    std::string states;       ///< what x is unless it is reduced
    std::string bounded;      ///< what the bound of the reduction's error is of
};

/// Adds A.csv, B.csv, C.csv, D.csv and state_space.toml of the one of `count` cases, whose equations `make` returns, to
/// the files of the run if --state-space is given. Throws BadInput if there are several cases, no equations (`make`
/// throws std::invalid_argument), a file that cannot be opened, or if a system to be reduced does not decay; WriteError
/// where the disk is full.
void write_state_space(const Options& options, OutputFiles& files, std::size_t count,
                       const std::function<rollbem::StateSpace()>& make, const StateSpaceWords& words);

}  // namespace study
