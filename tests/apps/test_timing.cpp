// apps/support/timing.hpp
#include <ctime>
#include <optional>

#include "support/catch.hpp"
#include "support/timing.hpp"

namespace timing_tests {
namespace {

/// A computation that takes the processor so long [us], and how often it was done.
struct Computation {
    double time;
    int calls = 0;

    double operator()() {
        const std::clock_t start = std::clock();
        while (1e6 * double(std::clock() - start) / CLOCKS_PER_SEC < time) {
        }
        return ++calls;
    }
};

TEST_CASE("What takes a second is timed once, other computations at least 5 times", "[timing]") {
    Computation once{1e6}, often{100};
    CHECK(study::median_time_us([&] { return once(); }) >= 1e6);
    CHECK(once.calls == 1);
    CHECK(study::median_time_us([&] { return often(); }) >= 100);
    CHECK(often.calls >= 6);
}

TEST_CASE("A call of several computations counts as so many, and its time is that of one", "[timing]") {
    Computation few{1e3}, four{1.5e5}, many{2.5e5};
    const auto median_of = [](Computation& computation, std::size_t count) {
        study::Timer timer([&] { return computation(); }, count);
        while (!timer.done()) timer.run_again();
        return timer.median();
    };
    const double one = median_of(few, 20);
    CHECK(one >= 50);
    CHECK(one < 500);
    CHECK(few.calls >= 6);
    CHECK(median_of(four, 4) >= 3.75e4);
    CHECK(four.calls == 3);  // the first is not timed
    CHECK(median_of(many, 20) >= 1.25e4);
    CHECK(many.calls == 2);
}

TEST_CASE("A computation that is not timed is done once", "[timing]") {
    Computation once{100}, often{100};
    CHECK_FALSE(study::time_us_if(false, [&] { return once(); }));
    CHECK(once.calls == 1);
    CHECK(study::time_us_if(true, [&] { return often(); }) >= std::optional(100.0));
    CHECK(often.calls > 1);
}

}  // namespace
}  // namespace timing_tests
