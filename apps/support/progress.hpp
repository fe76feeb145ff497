// Progress: one line on the terminal during long runs, drawn five times a second, also while one row is computed.
// Silent in the first half second, and if standard error is no terminal.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdio>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include <unistd.h>

#include <rollbem/detail/parallel_for.hpp>

namespace study {

class Progress {
public:
    Progress(std::string what, std::size_t total, bool enabled, std::string unit = "rows")
        : what_(std::move(what)), unit_(std::move(unit)), total_(total) {
        try {
            if (enabled && isatty(STDERR_FILENO) == 1) clock_ = std::thread([this] { draw(); });
        } catch (const std::system_error&) {  // no more threads: no line
        }
    }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress() { clear(); }

    void update(std::size_t done) {
        const std::lock_guard lock(mutex_);
        done_ = done;
    }

    /// Sets the task that the line names, e.g. "n = 20".
    void doing(const std::string& now) {
        const std::lock_guard lock(mutex_);
        now_ = now;
    }

    /// Calls print(), which may write to the terminal, while there is no line.
    template <class Print>
    void beside(const Print& print) {
        const std::lock_guard lock(mutex_);
        erase();
        print();
    }

    /// Ends the line.
    void clear() {
        beside([this] { ended_ = true; });
        end_.notify_one();
        if (clock_.joinable()) clock_.join();
    }

private:
    using Clock = std::chrono::steady_clock;

    void draw() {
        std::unique_lock lock(mutex_);
        std::chrono::milliseconds pause(500);
        for (; !end_.wait_for(lock, pause, [this] { return ended_; }); pause = std::chrono::milliseconds(200)) {
            const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
            std::fprintf(stderr, "\r\033[K%s: %zu of %zu %s%s%s, %.0f s", what_.c_str(), done_, total_, unit_.c_str(),
                         now_.empty() ? "" : ", ", now_.c_str(), elapsed);
            if (done_ > 0) {
                std::fprintf(stderr, ", about %.0f s to go", elapsed * double(total_ - done_) / double(done_));
            }
            shown_ = true;
        }
    }

    void erase() {
        if (std::exchange(shown_, false)) std::fputs("\r\033[K", stderr);
    }

    std::string what_, unit_, now_;
    std::size_t total_, done_ = 0;
    bool shown_ = false, ended_ = false;
    Clock::time_point start_ = Clock::now();
    std::mutex mutex_;
    std::condition_variable end_;
    std::thread clock_;
};

/// Threads that compute, and whether a line on the terminal shows how far they are.
struct Threads {
    std::string program;  ///< which the line names
    std::size_t jobs = 1;
    bool shows = false;
};

/// compute(i) for all i < count.
template <class Compute>
void in_parallel(const Threads& threads, std::size_t count, const std::string& unit, const Compute& compute) {
    Progress progress(threads.program, count, threads.shows, unit);
    std::size_t done = 0;
    progress.update(0);
    rollbem::detail::parallel_for(count, threads.jobs, compute, [&] { progress.update(++done); });
}

}  // namespace study
