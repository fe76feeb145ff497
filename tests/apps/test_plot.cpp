// apps/support/plot.hpp
#include <vector>

#include "support/catch.hpp"
#include "support/csv.hpp"
#include "support/plot.hpp"

namespace plot_tests {
namespace {

TEST_CASE("The cells of a map meet halfway between its places, and those without a value are apart", "[plot]") {
    study::Records rows{{"x", "y", "share"}};
    for (const double x : {0.0, 1.0, 3.0}) {
        for (const double y : {0.0, 2.0}) rows.rows.push_back({x, y, x == 1 && y == 2 ? study::Cell() : 0.5});
    }
    const std::vector<study::Series> map = map_of(rows, "x", "y", "share");
    REQUIRE(map.size() == 2);
    CHECK(map[0].look == study::Look::cells);
    CHECK(map[0].values == std::vector<double>(5, 0.5));
    CHECK(map[0].points.size() == 10);
    CHECK(map[1].look == study::Look::empty_cells);
    CHECK(map[1].values.empty());
    CHECK(map[1].points == std::vector<std::pair<double, double>>{{0.5, 1}, {2, 3}});
}

TEST_CASE("Titles have words in place of the options' values", "[plot]") {
    study::Records rows{{"mesh", "method", "derivative", "nodes", "x", "y"}};
    rows.rows = {{"cosine", "nodes", "fd", "chebyshev", 1, 2}, {"cosine", "nodes", "fd", "chebyshev", 2, 3}};
    study::Plot plot{.title = "Title"};
    add_series(plot, rows, {.by = {"mesh", "method", "derivative", "nodes"}, .x = "x", .y = "y"});
    CHECK(plot.title == "Title, cosine mesh, node differences, finite differences, at Chebyshev points");
}

}  // namespace
}  // namespace plot_tests
