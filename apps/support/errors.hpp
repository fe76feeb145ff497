// How a study ends: exceptions that stand for its exit codes.
// Anything else that is thrown is a defect and ends with code 1.
#pragma once

#include <stdexcept>
#include <string>

namespace study {

enum ExitCode : int {
    exit_ok = 0,
    exit_failed = 1,
    exit_bad_input = 2,
    exit_no_plot = 3,
    exit_write_error = 4,
};

/// What was typed cannot be used, or the output cannot be written to: nothing was computed.
class BadInput : public std::invalid_argument {
public:
    using std::invalid_argument::invalid_argument;
};

/// Writing failed after it had begun.
class WriteError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The rows are written, the plot is not.
class PlotError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace study
