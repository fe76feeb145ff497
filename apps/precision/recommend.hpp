// --recommend: command lines for a required precision.
#pragma once

#include "support/options.hpp"

namespace precision {

/// The recommended command line for each purpose, for the plane kernel or a strip with b/a >= 10.
void print_recommendations(const study::Options& options);

}  // namespace precision
