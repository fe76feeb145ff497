// apps/precision/front.hpp, places.hpp
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "precision/front.hpp"
#include "precision/places.hpp"
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

TEST_CASE("An error is the largest over the places of a quantity, and names its place", "[precision]") {
    using precision::Place, precision::Values;
    const precision::Quantity force{
        "force", precision::Problem::friction,
        [](const Values& found, const Values& exact) { return (found[0] + found[1] - exact[0] - exact[1]).real(); },
        precision::combined({{"creepage_ratio", {0.5, 0.1}}, {"angle", {15, 45}}})};
    std::vector<std::string> names;
    for (const Place& place : force.places) names.push_back(place.text());
    CHECK(names == std::vector<std::string>{"creepage_ratio=0.5 angle=15", "creepage_ratio=0.5 angle=45",
                                            "creepage_ratio=0.1 angle=15", "creepage_ratio=0.1 angle=45"});
    CHECK(force.places[2]["creepage_ratio"] == 0.1);
    CHECK(force.places[2]["angle"] == 15);
    CHECK(force.runs() == 4);
    const auto judged = [&](const Values& found) {
        const auto [error, place] = precision::worst(force, found, {1, 1, 2, 2, 3, 3, 4, 4});
        return std::pair(error, place->text());
    };
    CHECK(judged({1, 1, 2, 2.25, 2.5, 3, 4.25, 4}) == std::pair(-0.5, names[2]));  // signed
    CHECK(judged({1, 1, 2, 2, 3, 3, 4, 4}) == std::pair(0.0, names[0]));
    CHECK(judged({1.5, 1, 2, 2, 3, 3, 4, 4.25}).second == names[0]);
    const auto failed = judged({1, 1, 2, std::numeric_limits<double>::quiet_NaN(), 9, 9, 4, 4});
    CHECK(std::isnan(failed.first));
    CHECK(failed.second == names[1]);
    CHECK(precision::Quantity{"c11", precision::Problem::steady, {}}.places.front().text().empty());
    CHECK_FALSE(force.competes("richardson:cosine:nodes"));
    CHECK(force.competes("cosine:nodes"));
    CHECK(precision::Quantity{"c11", precision::Problem::patch, {}}.competes("richardson:cosine:nodes"));
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
    points.push_back(point("richardson:cosine", 10, 1e-9, 1));
    points.back().competes = false;
    precision::mark_front(points);
    const auto front = [&] {
        std::vector<std::optional<bool>> found;
        for (const Point& one : points) found.push_back(one.on_front);
        return found;
    };
    const std::optional<bool> none;
    CHECK(front() ==
          std::vector<std::optional<bool>>{true, false, false, true, true, false, none, none, true, none, none});
    points.push_back(point("chebyshev", 8, 1e-3, 9));  // faster and more precise than all but the fourth
    precision::mark_front(points);
    CHECK(front() == std::vector<std::optional<bool>>{false, false, false, true, false, false, none, none, true, none,
                                                      none, true});
}

TEST_CASE("The cheapest scheme for a tolerance is the fastest that keeps it", "[precision]") {
    const std::vector<Point> points{point("cosine", 10, 1e-2, 10),
                                    point("cosine", 20, 1e-3, 20),
                                    point("uniform-0/0.63", 10, 1e-5, 5, false),
                                    point("uniform-0/0.63", 20, 1e-3, 8, false),
                                    point("knothe", 10, 1e-3, 7, std::nullopt),
                                    point("chebyshev", 5, 1e-5, 3),
                                    point("chebyshev", 6, 1e-6, 4, std::nullopt),
                                    point("polynomial", 10, 1e-9, 1),
                                    {.scheme = "richardson:cosine",
                                     .n = 10,
                                     .quantity = "c11",
                                     .relative_error = 1e-12,
                                     .time_us = 0.1,
                                     .competes = false}};
    const std::vector<double> sustained = precision::sustained_errors(points);
    const auto best = [&](const char* among) {
        std::vector<std::optional<std::size_t>> found;
        for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-9, 1e-10}) {
            found.push_back(precision::cheapest(points, sustained, "c11", tolerance, among));
        }
        return found;
    };
    const std::optional<std::size_t> none;
    using Found = std::vector<std::optional<std::size_t>>;
    // the 1e-5 of elements at n = 10 is not sustained
    CHECK(best("elements") == Found{2, 2, none, none, none, none, none});
    // what is not known to be stable is not
    CHECK(best("stable-elements") == Found{0, 1, none, none, none, none, none});
    CHECK(best("stable") == Found{5, 5, 5, 5, none, none, none});  // elements or states
    CHECK(best("all") == Found{7, 7, 7, 7, 7, 7, none});
    CHECK_FALSE(precision::cheapest(points, sustained, "traction", 1, "all").has_value());
}

}  // namespace
}  // namespace precision_front_tests
