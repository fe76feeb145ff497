// rollbem/detail/parallel_for.hpp
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include <rollbem/detail/parallel_for.hpp>

#include "support/catch.hpp"

TEST_CASE("Every task runs once and is reported once, on any number of threads", "[parallel]") {
    for (const std::size_t jobs : {1, 2, 7}) {
        for (const std::size_t count : {0, 1, 5, 500}) {
            std::vector<int> runs(count);
            std::size_t reported = 0;
            rollbem::detail::parallel_for(
                count, jobs, [&](std::size_t k) { ++runs[k]; }, [&] { ++reported; });
            INFO("jobs = " << jobs << ", count = " << count);
            CHECK(runs == std::vector<int>(count, 1));
            CHECK(reported == count);
        }
    }
}

TEST_CASE("An exception in a task ends parallel_for and is passed on", "[parallel]") {
    for (const std::size_t jobs : {1, 4}) {
        std::vector<int> runs(100);
        std::string message;
        try {
            rollbem::detail::parallel_for(runs.size(), jobs, [&](std::size_t k) {
                if (k == 10) throw std::runtime_error("task 10");
                ++runs[k];
            });
        } catch (const std::runtime_error& error) {
            message = error.what();
        }
        CHECK(message == "task 10");
        CHECK(runs[9] == 1);
        if (jobs == 1) CHECK(runs[11] == 0);
    }
}
