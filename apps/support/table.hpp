// Table: the rows of a study. Computed in parallel, written in order as they come, in shards if asked for, then drawn.
// The result does not depend on the number of jobs.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "csv.hpp"
#include "options.hpp"
#include "plot.hpp"

namespace study {

/// Rows first ... last-1 of a task.
struct RowRange {
    std::size_t first, last;
};

using Emit = std::function<void(Row)>;

/// The rows of a study in tasks, each computed in one go. Tasks may run at the same time in several threads.
struct Table {
    std::vector<std::string> columns;
    std::vector<std::size_t> rows_of_task;  ///< known beforehand, so that rows can be divided into shards
    /// Where set, called once before any task is computed, with those of this run. done(part) of 0 ... 1 tells how far
    /// it has come.
    std::function<void(const std::vector<std::size_t>& tasks, const std::function<void(double part)>& done)> prepare{};
    std::function<void(std::size_t task, RowRange range, const Emit& emit)> compute;  ///< emits just these rows
    /// Where set, called once the rows have their name: files that belong to them take theirs.
    std::function<void()> written{};
    std::function<Plot(const std::vector<Row>& rows)> plot;  ///< for --plot
};

/// Rows of one task that are asked for.
struct Task {
    std::size_t index;
    RowRange range;
};

/// Computes tasks in `jobs` threads, a bounded number ahead of the output, and hands their rows over in order.
void compute_in_order(const Table& table, const std::vector<Task>& tasks, std::size_t jobs, const Emit& emit,
                      const std::function<void()>& task_done);

/// --jobs.
std::size_t job_count(const Options& options);

/// Whether this run's rows come with the header: the others of --shard do not repeat it.
bool has_header(const Options& options);

/// Writes the table where --output says, with its companion file, and draws it. Throws BadInput before it computes
/// anything, WriteError, or PlotError once the rows are written.
void write_table(const Options& options, const Table& table);

}  // namespace study
