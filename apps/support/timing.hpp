// Timing: the median duration of a computation.
// Short ones are repeated within a run so that the clock's resolution does not matter.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>
#include <vector>

namespace study {

/// What --help says of times.
inline constexpr const char* median_of_runs = "median of at least 5 runs, one if it takes a second";

/// A computation that takes so long [us] is timed once.
inline constexpr double enough = 1e6;

/// Median over at least 5 runs of the time of one call [us], or that of the first if it takes `longest`. Runs are
/// repeated for 2 ms, at most 51 times, which steadies the median of short computations. `call` must return a double
/// that depends on what it computed.
template <class Call>
double median_time_us(const Call& call, double longest = enough) {
    using Clock = std::chrono::steady_clock;
    using Microseconds = std::chrono::duration<double, std::micro>;
    [[maybe_unused]] volatile double kept = 0;  // keeps the optimiser from dropping the computation
    const auto run = [&](std::size_t calls) {
        const Clock::time_point start = Clock::now();
        for (std::size_t i = 0; i < calls; ++i) kept = call();
        return Microseconds(Clock::now() - start).count();
    };
    std::size_t calls = 1;
    double time = run(calls);
    if (time >= longest) return time;
    while (calls < 4096 && time < 20) time = run(calls *= 2);  // a run lasts some hundred times the clock's overhead
    std::vector<double> runs;
    double total = 0;
    while (runs.size() < 5 || (total < 2000 && runs.size() < 51)) {
        runs.push_back(run(calls));
        total += runs.back();
    }
    const auto middle = runs.begin() + std::ptrdiff_t(runs.size() / 2);
    std::nth_element(runs.begin(), middle, runs.end());
    return *middle / static_cast<double>(calls);
}

/// The median time [us] of call(), or nothing after one call unless it is `timed`. call() may keep what it computes.
template <class Call>
std::optional<double> time_us_if(bool timed, const Call& call) {
    if (timed) return median_time_us(call);
    call();
    return std::nullopt;
}

}  // namespace study
