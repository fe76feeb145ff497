// apps/paper/measures.hpp
#include <cmath>
#include <vector>

#include "paper/measures.hpp"
#include "support/catch.hpp"

namespace paper_measures_tests {

using paper::Points;

namespace {

Points sampled(double (*f)(double), double low, double high, int steps) {
    Points points;
    for (int k = 0; k <= steps; ++k) {
        const double x = low + (high - low) * k / steps;
        points.emplace_back(x, f(x));
    }
    return points;
}

double tilted(double x) { return 1 + (x - 0.3) * (2 - x); }

}  // namespace

TEST_CASE("The best point has the value nearest to 1, on either side", "[paper]") {
    CHECK(paper::best({{0, 1.2}, {1, 0.9}, {2, 1.05}}).first == 2);
    CHECK(paper::best({{0, 1.2}, {1, std::nan("")}, {2, 0.97}}).first == 2);
    CHECK(paper::least_error({{0, 1.2}, {1, 0.75}}) == Approx(0.2));
    CHECK(paper::largest_error({{0, 1.2}, {1, 0.75}}) == Approx(0.25));
    CHECK(paper::mean_error({{0, 1.2}, {1, 0.75}}) == Approx(0.225));
}

TEST_CASE("Only the points of a grid are kept", "[paper]") {
    const Points points = sampled(tilted, 0, 1, 200);
    CHECK(paper::on_grid(points, {0.05, 0.63, 0.6301}).size() == 2);
    CHECK(paper::within(points, 0.4, 0.6).size() == 41);
    CHECK(paper::value_at(points, 0.63) == Approx(tilted(0.63)));
    CHECK(std::isnan(paper::value_at(points, 0.6301)));
}

TEST_CASE("Crossings are all passages through 1", "[paper]") {
    const std::vector<double> found = paper::crossings(sampled(tilted, 0, 3, 1000));
    REQUIRE(found.size() == 2);
    CHECK(found[0] == Approx(0.3).epsilon(1e-4));
    CHECK(found[1] == Approx(2).epsilon(1e-4));
    CHECK(paper::crossings(sampled(tilted, 0.5, 1.5, 100)).empty());
    CHECK(paper::crossings({{0, 0.5}, {1, 1}, {2, 3}}) == std::vector<double>{1});  // met, not straddled
    CHECK(paper::crossings({{0, 0.5}, {1, 1}, {2, 0.5}}).empty());                  // touched
}

TEST_CASE("The true optimum is where a function reaches 1, or comes nearest to it", "[paper]") {
    CHECK(paper::true_optimum(tilted, 0, 1) == Approx(0.3).margin(1e-6));
    CHECK(paper::true_optimum([](double x) { return 1.5 + (x - 0.7) * (x - 0.7); }, 0, 1) == Approx(0.7).margin(1e-4));
    CHECK(paper::true_optimum([](double x) { return 2 + x; }, 0.25, 1) == Approx(0.25).margin(1e-6));
}

TEST_CASE("The oscillation is zero for a monotone distribution and counts reversals twice", "[paper]") {
    const Eigen::ArrayXd falling = Eigen::ArrayXd::LinSpaced(30, 1, -2).exp();
    CHECK(std::abs(paper::oscillation(falling)) < 1e-14);
    Eigen::ArrayXd wavy(4);
    wavy << 0, 0.6, 0.5, 1;  // one reversal of 0.1 in a range of 1
    CHECK(paper::oscillation(wavy) == Approx(0.2));
}

TEST_CASE("The exponent of a power law is found for either sign", "[paper]") {
    CHECK(paper::power({{10, -5e-2}, {20, 2.5e-2}, {80, -6.25e-3}}) == Approx(-1));
    CHECK(paper::power({{1, 3}, {2, 12}, {4, 48}}) == Approx(2));
}

TEST_CASE("The first positive value is found", "[paper]") {
    CHECK(paper::first_positive({{0.1, 0}, {0.2, 0.05}, {0.3, 0}}) == 0.2);
    CHECK_FALSE(paper::first_positive({{0.1, 0}, {0.2, 0}}).has_value());
}

TEST_CASE("Curves with different points are infinitely far apart", "[paper]") {
    CHECK(paper::largest_difference({{0, 1}, {1, 2}}, {{0, 1}, {1, 2.5}}) == Approx(0.5));
    CHECK(std::isinf(paper::largest_difference({{0, 1}}, {{0, 1}, {1, 2}})));
    CHECK(paper::spread({{0, 1}, {1, 2.5}, {2, 0.5}}) == Approx(2));
}

}  // namespace paper_measures_tests
