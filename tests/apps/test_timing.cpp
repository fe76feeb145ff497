// apps/support/timing.hpp
#include <chrono>
#include <optional>

#include "support/catch.hpp"
#include "support/timing.hpp"

namespace timing_tests {
namespace {

/// A computation that takes 100 us, and how often it was done.
struct Computation {
    int calls = 0;

    double operator()() {
        const auto end = std::chrono::steady_clock::now() + std::chrono::microseconds(100);
        while (std::chrono::steady_clock::now() < end) {
        }
        return ++calls;
    }
};

TEST_CASE("What takes long enough is timed once, other computations at least 5 times", "[timing]") {
    Computation once, often;
    CHECK(study::median_time_us([&] { return once(); }, 50) >= 100);
    CHECK(once.calls == 1);
    CHECK(study::median_time_us([&] { return often(); }) >= 100);
    CHECK(often.calls >= 6);
}

TEST_CASE("A computation that is not timed is done once", "[timing]") {
    Computation once, often;
    CHECK_FALSE(study::time_us_if(false, [&] { return once(); }));
    CHECK(once.calls == 1);
    CHECK(study::time_us_if(true, [&] { return often(); }) >= std::optional(100.0));
    CHECK(often.calls > 1);
}

}  // namespace
}  // namespace timing_tests
