// Patches that roll in the time domain with friction.
#pragma once

#include <string>
#include <vector>

#include "patches.hpp"
#include "support/options.hpp"

namespace patch {

/// Declares --transient and what goes with it.
void add_transient_options(study::Options& options);

/// The columns and their meanings.
std::string transient_help();

/// Writes a row for each step of every patch. Throws what write_runs throws, and BadInput.
void run_transient(const study::Options& options, const std::vector<Patch>& patches);

}  // namespace patch
