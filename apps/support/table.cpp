#include "table.hpp"

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include <unistd.h>

#include "progress.hpp"

namespace study {

namespace {

struct Shard {
    std::size_t index = 1, count = 1;  ///< 1 <= index <= count

    RowRange rows(std::size_t total) const { return {total * (index - 1) / count, total * index / count}; }
};

Shard shard_of(const Options& options) {
    if (!options.given("shard")) return {};
    const std::string text = options.text("shard");
    const std::size_t slash = std::min(text.find('/'), text.size());
    const auto index = detail::parse_number<std::uint32_t>(std::string_view(text).substr(0, slash));
    const auto count =
        detail::parse_number<std::uint32_t>(std::string_view(text).substr(std::min(slash + 1, text.size())));
    if (!index || !count || *index < 1 || *index > *count || *count > 1000000) {
        throw BadInput(options.said("shard") + " must be K/N with 1 <= K <= N <= 1000000");
    }
    return {*index, *count};
}

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

}  // namespace

void compute_in_order(const Table& table, const std::vector<Task>& tasks, std::size_t jobs, const Emit& emit,
                      const std::function<void()>& task_done, const std::function<void(std::size_t index)>& started) {
    if (jobs == 1) {
        for (const Task& task : tasks) {
            if (started) started(task.index);
            table.compute(task.index, task.range, emit);
            task_done();
        }
        return;
    }
    struct Outcome {
        std::vector<Row> rows;
        std::exception_ptr error;
    };
    std::mutex mutex;
    std::condition_variable changed;
    std::map<std::size_t, Outcome> outcomes;
    std::size_t next = 0, emitted = 0;
    bool stop = false;
    const auto work = [&]() {
        std::unique_lock lock(mutex);
        while (true) {
            changed.wait(lock, [&] { return stop || next == tasks.size() || next < emitted + 4 * jobs; });
            if (stop || next == tasks.size()) return;
            const std::size_t mine = next++;
            lock.unlock();
            if (started) started(tasks[mine].index);
            Outcome outcome;
            try {
                table.compute(tasks[mine].index, tasks[mine].range,
                              [&](Row row) { outcome.rows.push_back(std::move(row)); });
            } catch (...) {
                outcome.error = std::current_exception();
            }
            lock.lock();
            outcomes[mine] = std::move(outcome);
            changed.notify_all();
        }
    };
    struct Threads {
        std::vector<std::thread> all;
        std::function<void()> stop;
        ~Threads() {
            stop();
            for (std::thread& thread : all) thread.join();
        }
    } threads{{}, [&] {
                  const std::lock_guard lock(mutex);
                  stop = true;
                  changed.notify_all();
              }};
    for (std::size_t i = 0; i < std::min(jobs, tasks.size()); ++i) threads.all.emplace_back(work);
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        std::unique_lock lock(mutex);
        changed.wait(lock, [&] { return outcomes.count(i) > 0; });
        Outcome outcome = std::move(outcomes.extract(i).mapped());
        emitted = i + 1;
        changed.notify_all();
        lock.unlock();
        for (Row& row : outcome.rows) emit(std::move(row));
        if (outcome.error) std::rethrow_exception(outcome.error);
        task_done();
    }
}

std::size_t job_count(const Options& options) { return static_cast<std::size_t>(options.integer("jobs", 1, 1024)); }

bool has_times(const Options& options) { return job_count(options) == 1 && !options.flag("no-timing"); }

bool shows_progress(const Options& options) {
    const bool to_file = options.given("output") && options.text("output") != "-";
    return !options.flag("quiet") && (to_file || isatty(STDOUT_FILENO) == 0);
}

bool has_header(const Options& options) { return shard_of(options).index == 1; }

void write_table(const Options& options, const Table& table) {
    const std::size_t jobs = job_count(options);
    const Shard shard = shard_of(options);
    const bool plots = options.given("plot");
    const bool png = plots && plot_is_png(options);

    // 1. Every file is opened first, so that an output that cannot be written costs no computing time.
    const std::string header = has_header(options) ? csv_line(Row(table.columns.begin(), table.columns.end())) : "";
    TableFile file(options, "output", header, table.resumable);
    OutputFile& csv = file.rows();
    std::optional<OutputFile> drawing;
    if (plots) drawing.emplace(options.text("plot"), "--plot");

    // 2. The rows.
    std::size_t total = 0;
    for (const std::size_t rows : table.rows_of_task) total += rows;
    RowRange wanted = shard.rows(total);
    const std::size_t count = wanted.last - wanted.first;
    std::vector<std::string> lines = file.found();  // for table.accept
    std::size_t written = std::min(lines.size(), count);
    wanted.first += written;
    const std::vector<Task> tasks = tasks_of(table, wanted);
    const bool shows = shows_progress(options);
    if (table.prepare) {
        std::vector<std::size_t> indices;
        for (const Task& task : tasks) indices.push_back(task.index);
        Progress preparing(options.program(), 100, shows, "percent");
        table.prepare(indices, [&](double part) { preparing.update(static_cast<std::size_t>(100 * part)); });
    }
    Progress progress(options.program(), count, shows);
    std::vector<Row> kept;
    const auto emit = [&](Row row) {
        const std::string line = csv_line(row);
        csv.write(line);
        if (table.resumable) csv.flush();
        if (table.accept) lines.push_back(line);
        progress.update(++written);
        if (plots) kept.push_back(std::move(row));
    };
    const auto started = [&](std::size_t task) {
        if (table.label) progress.doing(table.label(task));
    };
    try {
        compute_in_order(
            table, tasks, jobs, emit, [&] { csv.flush(); }, started);
    } catch (const WriteError&) {
        if (table.resumable) file.keep_part();
        throw;
    }
    progress.clear();

    // 3. The files take their names.
    if (table.accept) table.accept(lines);
    file.commit();
    if (table.written) table.written();
    if (plots) draw(table.plot(kept), *drawing, png);
}

}  // namespace study
