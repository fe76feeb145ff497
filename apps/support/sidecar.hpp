// The file beside a table, which says how it was made: comments for people, and the options for --config.
#pragma once

#include <string>

#include "options.hpp"

namespace study {

/// The beginning of its first line, which ends with the name of the program.
inline constexpr const char* sidecar_start = "# program = ";

/// The file beside a table of this run. Throws BadInput if an option's text cannot be read back.
std::string sidecar_text(const Options& options);

}  // namespace study
