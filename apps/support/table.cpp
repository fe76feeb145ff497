#include "table.hpp"

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <rollbem/detail/parallel_for.hpp>

#include "input.hpp"
#include "progress.hpp"
#include "scenes.hpp"

namespace study {

namespace {

/// --shard K/N, the K-th of N blocks of rows.
RowRange shard_of(const Options& options) {
    if (!options.given("shard")) return {1, 1};
    const std::vector<std::string> parts = cells_of(options.text("shard"), '/');
    const auto index = detail::parse_number<std::uint32_t>(parts.front());
    const auto count = detail::parse_number<std::uint32_t>(parts.back());
    options.require(parts.size() == 2 && index && count && *index >= 1 && *index <= *count && *count <= 1000000,
                    "shard", "be K/N with 1 <= K <= N <= 1000000");
    return {*index, *count};
}

/// Rows of one task that are asked for.
struct Task {
    std::size_t index;
    RowRange range;
};

/// The tasks and their rows that make up `wanted` rows of the table.
std::vector<Task> tasks_of(const Table& table, RowRange wanted) {
    std::vector<Task> tasks;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < table.rows_of_task.size(); ++i) {
        const std::size_t end = begin + table.rows_of_task[i];
        const std::size_t first = std::max(begin, wanted.first), last = std::min(end, wanted.last);
        if (first < last) tasks.push_back({i, {first - begin, last - begin}});
        begin = end;
    }
    return tasks;
}

/// Computes tasks in `jobs` threads and emits their rows in order.
void compute_in_order(const std::vector<Task>& tasks, std::size_t jobs,
                      const std::function<void(const Task& task, const Emit& emit)>& compute, const Emit& emit) {
    if (jobs == 1) {
        for (const Task& task : tasks) compute(task, emit);
        return;
    }
    std::vector<std::optional<std::vector<Row>>> rows_of(tasks.size());  // of tasks that are done
    std::size_t next = 0;
    std::mutex mutex;
    rollbem::detail::parallel_for(tasks.size(), jobs, [&](std::size_t i) {
        std::vector<Row> rows;
        compute(tasks[i], [&](Row row) { rows.push_back(std::move(row)); });
        const std::lock_guard lock(mutex);
        rows_of[i] = std::move(rows);
        while (next < tasks.size() && rows_of[next]) {
            const std::size_t ready = std::exchange(next, tasks.size());  // none follows a row that cannot be written
            for (Row& row : *rows_of[ready]) emit(std::move(row));
            rows_of[ready]->clear();
            next = ready + 1;
        }
    });
}

}  // namespace

std::size_t job_count(const Options& options) { return static_cast<std::size_t>(options.integer("jobs", 1, 1024)); }

bool has_times(const Options& options) { return job_count(options) == 1 && !options.flag("no-timing"); }

namespace {

/// Whether the run writes no file but --output.
bool writes_nothing_else(const Options& options) {
    const std::vector<Given> given = options.given();
    return std::none_of(given.begin(), given.end(), [](const Given& option) {
        return !option.repeats && option.name != "jobs" && option.name != "output";
    });
}

/// The columns for people. What tells scenes apart is of the case, also where a study has it among its results.
std::vector<Heading> headings_of(const Table& table) {
    std::vector<Heading> headings = table.headings;
    if (headings.empty()) {
        for (const std::string& name : table.columns) headings.push_back({name});
    }
    const std::vector<std::string> of_scene =
        columns_of("method,derivative,mesh,n,alpha_L,alpha_T,lambda," + distinctions);
    for (Heading& heading : headings) {
        heading.of_case = heading.of_case || contains(of_scene, heading.name);
    }
    return headings;
}

/// The first of the tasks that ended early, and how many more; empty where none did.
std::string ends_of(const Table& table) {
    std::string first;
    std::size_t count = 0;
    for (std::size_t i = 0; table.ended && i < table.rows_of_task.size(); ++i) {
        const std::string why = table.ended(i);
        if (!why.empty() && count++ == 0) first = table.label(i) + ": " + why;
    }
    if (count < 2) return first;
    return first + "; " + std::to_string(count - 1) + " more of " + std::to_string(table.rows_of_task.size()) +
           " runs ended";
}

/// Calls the function that comes before all rows.
void prepare(const Options& options, const Table& table, const std::vector<Task>& tasks) {
    std::vector<std::size_t> indices;
    for (const Task& task : tasks) indices.push_back(task.index);
    Progress preparing(options.program(), 100, shows_progress(options), "percent");
    table.prepare(indices, [&](double part) { preparing.update(static_cast<std::size_t>(100 * part)); });
}

/// Draws the rows, and throws if runs ended early, with why the picture failed if it did.
void conclude(const Table& table, OutputFile* drawing, const Records& rows) {
    std::string early = ends_of(table);
    try {
        if (drawing != nullptr) {
            drawing->write(drawing_of(table.plot(rows), drawing->path()));
            drawing->commit();
        }
    } catch (const PlotError& error) {
        if (early.empty()) throw;
        early += std::string("; ") + error.what();
    }
    if (!early.empty()) throw std::runtime_error(early);
}

}  // namespace

void write_table(const Options& options, const Table& table, OutputFiles& files) {
    const std::size_t jobs = job_count(options);
    const auto [index, count] = shard_of(options);
    const bool plots = options.given("plot");
    const std::string path = plots ? options.text("plot") : "";
    options.require(!plots || path.ends_with(".svg") || path.ends_with(".png"), "plot", "end in .svg or .png");

    // 1. Every file is opened first, so that an output that cannot be written costs no computing time.
    const auto header = [first = index == 1](const std::vector<std::string>& names) {
        return first ? csv_line(Row(names.begin(), names.end())) : "";
    };
    OutputFile& file = files.open_table(options, "output", "");
    OutputFile* side = nullptr;
    if (table.beside && options.given(table.beside->option)) {
        side = &files.open_table(options, table.beside->option, header(table.beside->columns));
    }
    std::optional<OutputFile> drawing;
    if (plots) drawing.emplace(path, "--plot");

    // 2. The rows.
    std::size_t total = 0;
    for (const std::size_t rows : table.rows_of_task) total += rows;
    const RowRange wanted{total * (index - 1) / count, total * index / count};
    const std::vector<Task> tasks = tasks_of(table, wanted);
    if (table.prepare) prepare(options, table, tasks);
    const bool for_people = file.is_terminal() && !options.given("output") && !options.flag("csv");
    TerminalTable shown(headings_of(table), options.given("scheme"));
    if (!for_people) file.write(header(table.columns));
    Progress progress(options.program(), wanted.last - wanted.first, shows_progress(options));
    std::size_t written = 0;
    Records kept{table.columns};
    const auto compute = [&](const Task& task, const Emit& emit) {
        if (table.label) progress.doing(table.label(task.index));
        table.compute(task.index, task.range, emit);
    };
    const bool only_output = writes_nothing_else(options);
    const auto emit = [&](Row row) {
        const auto write = [&] {
            file.write(csv_line(row));
            file.flush();
        };
        for_people ? shown.add(row) : file.is_terminal() ? progress.beside(write) : write();
        if (only_output && file.has_no_reader()) throw Unread(file.path() + " is read no longer");
        progress.update(++written);
        if (plots) kept.rows.push_back(std::move(row));
    };
    compute_in_order(tasks, jobs, compute, emit);
    progress.clear();

    // 3. The files take their names.
    if (for_people) file.write(table.blocks ? shown.text(*table.blocks) : shown.text(file.width()));
    if (table.finish) table.finish();
    for (std::size_t i = 0; side != nullptr && i < table.beside->rows.size(); ++i) {
        for (const Row& row : table.beside->rows[i]) side->write(csv_line(row));
    }
    files.commit();
    conclude(table, drawing ? &*drawing : nullptr, kept);
}

}  // namespace study
