// apps/precision/front.hpp
#include <optional>
#include <string>
#include <vector>

#include "precision/front.hpp"
#include "support/catch.hpp"

namespace precision_front_tests {
namespace {

using precision::Point;

Point point(const std::string& scheme, long n, std::optional<double> error, double time,
            std::optional<bool> stable = true, const std::string& quantity = "c11") {
    return {.scheme = scheme,
            .n = n > 0 ? std::optional(n) : std::nullopt,
            .quantity = quantity,
            .relative_error = error,
            .time_us = time,
            .stable = stable};
}

TEST_CASE("An error counts as the largest at this and every larger n", "[precision]") {
    const std::vector<Point> points{point("cosine", 40, -1e-3, 4), point("cosine", 10, 1e-9, 1),
                                    point("cosine", 20, 2e-3, 2),  point("knothe", 10, 5e-2, 1),
                                    point("knothe", 20, {}, 2),    point("cosine", 20, 0.5, 2, true, "traction")};
    const std::vector<double> sustained = precision::sustained_errors(points);
    CHECK(sustained[0] == 1e-3);
    CHECK(sustained[1] == 2e-3);  // a lucky zero
    CHECK(sustained[2] == 2e-3);
    CHECK(std::isinf(sustained[3]));  // no result at a larger n
    CHECK(std::isinf(sustained[4]));
    CHECK(sustained[5] == 0.5);
}

TEST_CASE("No other discretisation is as fast and as precise as one on the front", "[precision]") {
    std::vector<Point> points{point("cosine", 10, 1e-2, 10),
                              point("cosine", 20, 1e-3, 20),
                              point("knothe", 10, 1e-2, 10.5),      // slower, no better
                              point("knothe", 20, 5e-4, 19),        // beats cosine at 20
                              point("geometric", 10, -5e-3, 15),    // negative errors count by their size
                              point("uniform-0/0.63", 10, {}, 1),   // no result
                              point("polynomial", 20, 1e-16, 0.1),  // no discretisation
                              point("closed-form", 0, 0.0, 0.01),   //
                              point("cosine", 10, 0.5, 9, true, "traction")};
    points.push_back(points[0]);
    points.back().time_us.reset();
    precision::mark_front(points);
    const auto on_front = [&](std::size_t i) { return points[i].on_front; };
    CHECK(on_front(0) == true);
    CHECK(on_front(1) == false);
    CHECK(on_front(2) == false);
    CHECK(on_front(3) == true);
    CHECK(on_front(4) == true);
    CHECK(on_front(5) == false);
    CHECK_FALSE(on_front(6).has_value());
    CHECK_FALSE(on_front(7).has_value());
    CHECK(on_front(8) == true);  // a front for each quantity
    CHECK_FALSE(on_front(9).has_value());

    points.push_back(point("chebyshev", 8, 1e-3, 9));  // faster and more precise than elements
    precision::mark_front(points);
    CHECK(on_front(10) == true);
    CHECK(on_front(0) == false);
    CHECK(on_front(3) == true);  // slower, but more precise
    CHECK(on_front(4) == false);
    CHECK(on_front(8) == true);  // of another quantity
}

TEST_CASE("The cheapest scheme for a tolerance is the fastest that keeps it", "[precision]") {
    const std::vector<Point> points{point("cosine", 10, 1e-2, 10),
                                    point("cosine", 20, 1e-3, 20),
                                    point("uniform-0/0.63", 10, 1e-5, 5, false),
                                    point("uniform-0/0.63", 20, 1e-3, 8, false),
                                    point("knothe", 10, 1e-3, 7, std::nullopt),
                                    point("chebyshev", 5, 1e-5, 3),
                                    point("chebyshev", 6, 1e-6, 4, std::nullopt),
                                    point("polynomial", 10, 1e-9, 1)};
    const std::vector<double> sustained = precision::sustained_errors(points);
    const auto best = [&](double tolerance, const char* group) {
        return precision::cheapest(points, sustained, "c11", tolerance, group);
    };
    CHECK(best(1e-2, "elements") == 2U);
    CHECK(best(1e-3, "elements") == 2U);
    CHECK_FALSE(best(1e-4, "elements").has_value());  // the 1e-5 at n = 10 is not sustained
    CHECK(best(1e-2, "stable-elements") == 0U);
    CHECK(best(1e-3, "stable-elements") == 1U);  // what is not known to be stable is not
    CHECK(best(1e-2, "stable") == 5U);           // elements or states
    CHECK(best(1e-5, "stable") == 5U);
    CHECK_FALSE(best(1e-6, "stable").has_value());
    CHECK_FALSE(best(1e-4, "stable-elements").has_value());
    CHECK(best(1e-9, "all") == 7U);
    CHECK_FALSE(best(1e-10, "all").has_value());
    CHECK_FALSE(precision::cheapest(points, sustained, "traction", 1, "all").has_value());
}

}  // namespace
}  // namespace precision_front_tests
