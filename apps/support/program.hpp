// The frame of every study's main(): reads the command line, runs, and turns exceptions into exit codes and one line.
#pragma once

#include <functional>

#include "options.hpp"

namespace study {

/// Reads the command line and runs body(options), whose return value is the exit code.
int run_program(Options& options, int argc, const char* const* argv, const std::function<int(const Options&)>& body);

}  // namespace study
