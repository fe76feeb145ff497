// Progress: one line on the terminal during long runs.
// Silent in the first half second, where standard error is no terminal, and where rows scroll by anyway.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <string>

#include <unistd.h>

namespace study {

class Progress {
public:
    Progress(std::string what, std::size_t total, bool enabled, std::string unit = "rows")
        : what_(std::move(what)),
          unit_(std::move(unit)),
          total_(total),
          enabled_(enabled && isatty(STDERR_FILENO) != 0) {}
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress() { clear(); }

    bool enabled() const { return enabled_; }

    void update(std::size_t done) {
        if (!enabled_) return;
        const Clock::time_point now = Clock::now();
        if (now - last_ < (shown_ ? std::chrono::milliseconds(200) : std::chrono::milliseconds(500))) return;
        last_ = now;
        shown_ = true;
        const double elapsed = std::chrono::duration<double>(now - start_).count();
        std::fprintf(stderr, "\r\033[K%s: %zu of %zu %s, %.0f s", what_.c_str(), done, total_, unit_.c_str(), elapsed);
        if (done > 0) {
            const double left = elapsed * static_cast<double>(total_ - done) / static_cast<double>(done);
            std::fprintf(stderr, ", about %.0f s to go", left);
        }
        std::fflush(stderr);
    }

    void clear() {
        if (shown_) std::fputs("\r\033[K", stderr);
        shown_ = false;
    }

private:
    using Clock = std::chrono::steady_clock;
    std::string what_, unit_;
    std::size_t total_;
    bool enabled_;
    bool shown_ = false;
    Clock::time_point start_ = Clock::now(), last_ = start_;
};

}  // namespace study
