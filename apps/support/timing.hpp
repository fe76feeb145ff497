// Timing: the median duration of a computation.
// Short ones are repeated within a run so that the clock's resolution does not matter.
#pragma once

#include <algorithm>
#include <cstddef>
#include <ctime>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace study {

/// What --help says of times.
inline constexpr const char* median_of_runs = "median of at least 5 runs, one if it takes a second";

/// One computation, or several alike, whose time is the median over at least 5 runs, or the time of the first run if it
/// takes a second. Several may also be at least 5 in fewer runs, if these take 0.2 seconds.
/// The clock counts the time of the processor, which other programs disturb less than the time on the wall. A run lasts
/// some hundred times the overhead of the clock, and runs are repeated for 8 ms, at most 51 times, which steadies the
/// median of short computations.
class Timer {
public:
    /// `call` must return a double that depends on what it computed, in so many computations. The first call is made
    /// here.
    explicit Timer(std::function<double()> call, std::size_t computations = 1)
        : call_(std::move(call)), computations_(computations) {
        const double first = run(1);
        if (first >= enough) runs_ = {first};
        if (first > 10000) return;  // a first call is slow
        while (calls_ < 4096 && run(calls_) < 100) calls_ *= 2;
    }

    bool done() const {
        if (!runs_.empty() && runs_.front() >= enough) return true;
        const bool many = runs_.size() >= 5 || (runs_.size() * computations_ >= 5 && total_ > 200000);
        return many && (total_ > 8000 || runs_.size() >= 51);
    }
    void run_again() {
        if (calls_ > 1) run(1);  // refills the caches after other computations
        runs_.push_back(run(calls_));
        total_ += runs_.back();
    }
    /// The time of one computation [us].
    double median() {
        const auto middle = runs_.begin() + std::ptrdiff_t(runs_.size() / 2);
        std::nth_element(runs_.begin(), middle, runs_.end());
        return *middle / static_cast<double>(calls_ * computations_);
    }

private:
    static constexpr double enough = 1e6;  // [us]

    double run(std::size_t count) const {
        [[maybe_unused]] volatile double kept = 0;  // keeps the optimiser from dropping the computation
        const std::clock_t start = std::clock();
        for (std::size_t i = 0; i < count; ++i) kept = call_();
        return 1e6 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    }

    std::function<double()> call_;
    std::size_t computations_;  // in a call
    std::size_t calls_ = 1;     // in a run
    std::vector<double> runs_;
    double total_ = 0;
};

/// The time of call() by a Timer.
template <class Call>
double median_time_us(const Call& call) {
    Timer timer(call);
    while (!timer.done()) timer.run_again();
    return timer.median();
}

/// The median time [us] of call(), or nothing after one call unless it is `timed`. call() may keep what it computes.
template <class Call>
std::optional<double> time_us_if(bool timed, const Call& call) {
    if (timed) return median_time_us(call);
    call();
    return std::nullopt;
}

}  // namespace study
