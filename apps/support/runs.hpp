// Time-domain runs that a failed step ends: steps divided in halves, why a run ended, and the exit code for it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <rollbem/status.hpp>

#include "load_history.hpp"
#include "options.hpp"
#include "table.hpp"

namespace study {

/// How often a step without a solution is divided in halves before the run ends.
inline constexpr int most_halvings = 6;

/// Rolls between two places by step(from, to), which moves on if its status is ok: divided where the `load` has a knot,
/// and in halves where a step has no solution. `load` may be null. Returns where a step failed for good; nothing if none
/// did.
std::optional<double> roll(double from, double to, const LoadHistory* load,
                           const std::function<rollbem::StepStatus(double, double)>& step);

/// Why a run has no results from the step to q [a] on.
std::string why_ended(double q, rollbem::StepStatus status);

/// Writes a table whose tasks are runs. `ended` says of each, once it is computed, why it ended early, if it did.
/// Throws what write_table throws, and std::runtime_error if a run ended early.
void write_runs(const Options& options, const Table& table, const std::vector<std::string>& ended);

}  // namespace study
