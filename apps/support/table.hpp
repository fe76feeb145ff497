// Table: the rows of a study. Computed in parallel, written in order as they come, in shards if asked for, then drawn.
// The result does not depend on the number of jobs.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "csv.hpp"
#include "options.hpp"
#include "output.hpp"
#include "plot.hpp"
#include "progress.hpp"
#include "terminal_table.hpp"

namespace study {

/// Rows first ... last-1 of a task.
struct RowRange {
    std::size_t first, last;
};

using Emit = std::function<void(Row)>;

/// A second table, such as the tractions of all elements: kept to the end, for a file of its own or for a picture.
struct SideTable {
    std::string option;  ///< which names its file
    std::vector<std::string> columns;
    bool wanted;                           ///< in a file or for a picture
    std::vector<std::vector<Row>> rows{};  ///< of each task, which one thread computes

    Records of(std::size_t task) const { return {columns, rows[task]}; }
};

/// The rows of a study in tasks, each computed in one go. Tasks may run at the same time in several threads.
struct Table {
    std::vector<std::string> columns;
    std::vector<Heading> headings{};        ///< of the columns, for people; without them all columns are results
    std::optional<Blocks> blocks{};         ///< the form of the rows on a terminal, if not that of a table
    std::vector<std::size_t> rows_of_task;  ///< known beforehand, so that rows can be divided into shards
    /// A function called once, if set, with the tasks of this run, before any of them is computed and anything written.
    /// It reports its progress by done(part), 0 ... 1.
    std::function<void(const std::vector<std::size_t>& tasks, const std::function<void(double part)>& done)> prepare{};
    std::function<void(std::size_t task, RowRange range, const Emit& emit)> compute;  ///< emits just these rows
    /// A function called, if set, when all rows are computed, to write the other files of the run. If it throws, no
    /// file takes its name.
    std::function<void()> finish{};
    std::function<Picture(const Records& rows)> plot;  ///< for --plot
    std::shared_ptr<SideTable> beside{};               ///< if set
    /// The reason, if set, why a computed task, a run in time, ended early; empty if it did not.
    std::function<std::string(std::size_t task)> ended{};
    /// The words of the progress line, if set, on a task, e.g. "n = 20".
    std::function<std::string(std::size_t task)> label{};

    /// Puts a second table beside this one, which must have its tasks.
    SideTable& put_beside(const std::string& option, std::vector<std::string> its_columns, bool wanted) {
        beside = std::make_shared<SideTable>(SideTable{option, std::move(its_columns), wanted});
        beside->rows.resize(rows_of_task.size());
        return *beside;
    }
};

/// A table with a task of `rows` rows for each of `cases`, which may have a label() and must outlive it.
template <class Case>
Table table_of(std::vector<std::string> columns, const std::vector<Case>& cases, std::size_t rows = 1) {
    Table table;
    table.columns = std::move(columns);
    table.rows_of_task.assign(cases.size(), rows);
    if constexpr (requires(const Case& one) { one.label(); }) {
        table.label = [&cases](std::size_t task) { return cases[task].label(); };
    }
    return table;
}

/// The number of threads by --jobs.
std::size_t job_count(const Options& options);

/// Whether rows have times: one job, which no other disturbs, and no --no-timing.
bool has_times(const Options& options);

/// Whether a progress line is wanted: not with --quiet.
inline bool shows_progress(const Options& options) { return !options.flag("quiet"); }

/// The threads of --jobs.
inline Threads read_threads(const Options& options) {
    return {options.program(), job_count(options), shows_progress(options)};
}

/// Writes the table to --output, with its companion file, gives these and `files` their names, and draws it. Throws
/// BadInput before it computes anything, WriteError, and when the rows are written PlotError, or std::runtime_error if
/// a run ended early.
void write_table(const Options& options, const Table& table, OutputFiles& files);
inline void write_table(const Options& options, const Table& table) {
    OutputFiles files;
    write_table(options, table, files);
}

}  // namespace study
