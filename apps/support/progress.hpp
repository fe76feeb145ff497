// Progress: one line on the terminal during long runs, drawn at most five times a second.
// Silent in the first half second, if standard error is no terminal, and if the rows themselves appear there.
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace study {

class Progress {
public:
    Progress(std::string what, std::size_t total, bool enabled, std::string unit = "rows");
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress() { clear(); }

    void update(std::size_t done);

    /// What is being computed, e.g. "n = 20".
    void doing(const std::string& now);

    /// Ends the line.
    void clear();

private:
    using Clock = std::chrono::steady_clock;

    void show();  ///< if it is time

    std::string what_, unit_, now_;
    std::size_t total_, done_ = 0;
    bool enabled_, shown_ = false;
    Clock::time_point start_ = Clock::now(), next_ = start_ + std::chrono::milliseconds(500);
    std::mutex mutex_;
};

}  // namespace study
