// Steady rolling with friction: creep curves by elements or with the exact stick border.
#pragma once

#include "pressure.hpp"
#include "support/options.hpp"

namespace friction {

/// Writes the table, and the tractions where they are asked for. Throws what write_table throws.
void run_steady(const study::Options& options, const Pressure& pressure);

}  // namespace friction
