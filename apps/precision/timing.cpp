#include "timing.hpp"

#include <algorithm>
#include <ctime>

namespace precision {

namespace {

/// One computation, repeated. Its time is that of the processor, which other programs disturb less than that of the
/// clock on the wall.
struct Timer {
    const Case* scheme;
    Quantity quantity;
    std::size_t calls = 1;  ///< in a run, which then lasts some hundred times the overhead of the clock
    std::vector<double> runs{};
    double total = 0;

    double run(std::size_t count) const {
        [[maybe_unused]] volatile double kept = 0;  // keeps the optimiser from dropping the computation
        const std::clock_t start = std::clock();
        for (std::size_t i = 0; i < count; ++i) kept = scheme->run(quantity);
        return 1e6 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    }
    bool done() const { return runs.size() >= 5 && (total > 8000 || runs.size() >= 51); }
    double median() {
        const auto middle = runs.begin() + std::ptrdiff_t(runs.size() / 2);
        std::nth_element(runs.begin(), middle, runs.end());
        return *middle / static_cast<double>(calls);
    }
};

}  // namespace

std::vector<std::map<Problem, double>> measure(const std::vector<Task>& tasks, const std::vector<std::size_t>& wanted,
                                               const std::function<void(double part)>& done) {
    std::vector<std::map<Problem, Timer>> timers(tasks.size());
    for (const std::size_t i : wanted) {
        for (const Quantity& quantity : tasks[i].quantities) {
            timers[i].try_emplace(quantity.problem, Timer{&tasks[i].scheme, quantity});
        }
    }
    for (auto& of_task : timers) {
        for (auto& [problem, timer] : of_task) {
            timer.run(1);  // a first call is slow
            while (timer.calls < 4096 && timer.run(timer.calls) < 100) timer.calls *= 2;
        }
    }
    bool again = true;
    for (int round = 0; again; ++round) {
        again = false;
        done(std::min(round, 5) / 5.0);
        for (auto& of_task : timers) {
            for (auto& [problem, timer] : of_task) {
                if (timer.done()) continue;
                if (timer.calls > 1) timer.run(1);  // refills the caches after the previous computation
                timer.runs.push_back(timer.run(timer.calls));
                timer.total += timer.runs.back();
                again = true;
            }
        }
    }
    std::vector<std::map<Problem, double>> times(tasks.size());
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        for (auto& [problem, timer] : timers[i]) times[i][problem] = timer.median();
    }
    return times;
}

}  // namespace precision
