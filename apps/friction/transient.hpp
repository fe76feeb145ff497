// Rolling in the time domain with friction, from rest or from a shift.
#pragma once

#include <string>

#include "support/options.hpp"

namespace friction {

/// The columns and their meanings, for --help.
std::string transient_help();

/// Writes the table. Throws what write_table throws.
void run_transient(const study::Options& options);

}  // namespace friction
