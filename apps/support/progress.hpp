// Progress: one line on the terminal during long runs, drawn at most five times a second.
// Silent in the first half second, and if standard error is no terminal.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <mutex>
#include <string>
#include <utility>

#include <unistd.h>

namespace study {

class Progress {
public:
    Progress(std::string what, std::size_t total, bool enabled, std::string unit = "rows")
        : what_(std::move(what)), unit_(std::move(unit)), total_(total), enabled_(enabled && isatty(STDERR_FILENO)) {}
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress() { clear(); }

    void update(std::size_t done) {
        const std::lock_guard lock(mutex_);
        done_ = done;
        show();
    }

    /// What is being computed, e.g. "n = 20".
    void doing(const std::string& now) {
        const std::lock_guard lock(mutex_);
        now_ = now;
        show();
    }

    /// Ends the line.
    void clear() {
        if (std::exchange(shown_, false)) std::fputs("\r\033[K", stderr);
    }

private:
    using Clock = std::chrono::steady_clock;

    void show() {
        if (!enabled_ || Clock::now() < next_) return;
        next_ = Clock::now() + std::chrono::milliseconds(200);
        const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
        std::fprintf(stderr, "\r\033[K%s: %zu of %zu %s%s%s, %.0f s", what_.c_str(), done_, total_, unit_.c_str(),
                     now_.empty() ? "" : ", ", now_.c_str(), elapsed);
        if (done_ > 0) {
            std::fprintf(stderr, ", about %.0f s to go", elapsed * double(total_ - done_) / double(done_));
        }
        shown_ = true;
    }

    std::string what_, unit_, now_;
    std::size_t total_, done_ = 0;
    bool enabled_, shown_ = false;
    Clock::time_point start_ = Clock::now(), next_ = start_ + std::chrono::milliseconds(500);
    std::mutex mutex_;
};

}  // namespace study
