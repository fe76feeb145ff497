// Progress: one line on the terminal during long runs. Its clock shows that a long row is still being computed.
// Silent in the first half second, if standard error is no terminal, and if the rows themselves appear there.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <thread>

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

    void show();

    std::string what_, unit_, now_;
    std::size_t total_, done_ = 0;
    bool enabled_, shown_ = false, stop_ = false;
    Clock::time_point start_ = Clock::now();
    std::mutex mutex_;
    std::condition_variable stopped_;
    std::thread clock_;  // draws the line, several times a second
};

}  // namespace study
