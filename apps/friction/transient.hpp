// Rolling in time with friction, from rest or from a shift.
#pragma once

#include "pressure.hpp"
#include "support/options.hpp"

namespace friction {

/// Writes the table. Throws what write_table throws.
void run_transient(const study::Options& options, const Pressure& pressure);

}  // namespace friction
