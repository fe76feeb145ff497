// rollbem/accuracy/: recommendation.hpp, richardson.hpp, distance_tangent.hpp
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <functional>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include <rollbem/accuracy/recommendation.hpp>
#include <rollbem/scene/creepage.hpp>

#include "support/catch.hpp"

namespace recommendation_tests {
namespace {

using namespace rollbem;
using Complex = std::complex<double>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// --- Richardson's extrapolation

TEST_CASE("Extrapolation cancels exactly the power of n that it is given", "[richardson]") {
    for (const double order : {0.5, 1.0, 2.0, 3.0}) {
        const auto value = [&](double n) { return 2 + 3 * std::pow(n, -order) + std::pow(n, -order - 1); };
        CAPTURE(order);
        // the remainder is exactly (2^-1 - 1)/(2^order - 1) n^-(order+1)
        const double left = richardson(value(8), value(16), order) - 2;
        CHECK(std::abs(left / (-0.5 / (std::exp2(order) - 1) * std::pow(8.0, -order - 1)) - 1) < 1e-9);
        const auto result = extrapolate([&](std::ptrdiff_t n) { return value(static_cast<double>(n)); }, 8, order);
        CHECK(result.status == Status::ok);
        CHECK(result.value == richardson(value(16), value(32), order));
        CHECK(std::abs(result.observed_order - order) < 0.1);
        CHECK(std::abs(result.value - 2) < result.error_estimate);
        const Complex unit(0.6, 0.8);
        const auto wave = extrapolate([&](std::ptrdiff_t n) { return unit * value(static_cast<double>(n)); }, 8, order);
        CHECK(wave.status == Status::ok);
        CHECK(std::abs(wave.value - unit * result.value) < 1e-14);
        CHECK(wave.error_estimate == Approx(result.error_estimate));
    }
    const Complex coarse(1, 2), fine(2, 4);
    CHECK(std::abs(richardson(coarse, fine, 1.0) - Complex(3, 6)) < 1e-15);
    CHECK(std::abs(richardson(1.0F, 2.0F, 1) - 3.0F) < 1e-6F);
}

TEST_CASE("The tangent by the distance rolled is exact for squares and not for cubes, at no negative distance",
          "[tangent]") {
    for (const double dq : {0.0, 9e-6, 1.1e-5, 0.3, 2.0}) {
        const auto power = [](int exponent) {
            return [exponent](double distance) {
                CHECK(distance >= 0);
                return TangentialForce{std::pow(distance, exponent), 1, 2 * distance};
            };
        };
        CAPTURE(dq);
        const TangentialForce square = tangent_by_distance(dq, 1, power(2));
        CHECK(std::abs(square.longitudinal - 2 * dq) < 1e-10 * (1e-5 + dq));
        CHECK(std::abs(square.lateral) < 1e-10);
        CHECK(std::abs(square.moment - 2) < 1e-10);
        const double change = 1e-5 * std::max(dq, 1.0);
        const double error = tangent_by_distance(dq, 1, power(3)).longitudinal - 3 * dq * dq;
        CHECK(std::abs(error / (change * change) - (dq < change ? -2 : 1)) < (dq < 1e-4 ? 1e-5 : 0.5));
    }
}

TEST_CASE("Extrapolation is rejected where the observed order differs from the assumed one",
          "[richardson][not_finite]") {
    const auto run = [](const std::function<double(double)>& value, double order, double band = 0.25) {
        return extrapolate([&](std::ptrdiff_t n) { return value(static_cast<double>(n)); }, 4, order, band);
    };
    const auto first = [](double n) { return 1 + 1 / n; };
    CHECK(run(first, 1).status == Status::ok);
    const auto refused = run(first, 2);
    CHECK(refused.status == Status::order_differs);
    CHECK(refused.value == first(16));  // not extrapolated
    CHECK(std::abs(refused.observed_order - 1) < 1e-12);
    CHECK(run(first, 1.24).status == Status::ok);
    CHECK(run(first, 1.26).status == Status::order_differs);
    CHECK(run(first, 1.26, 0.3).status == Status::ok);
    CHECK(run([](double n) { return n; }, 1).status == Status::order_differs);  // diverges
    CHECK(run([](double n) { return 1 / n - 8 / (n * n); }, 1).status == Status::order_differs);
    CHECK(run([](double) { return 0.1; }, 2).status == Status::ok);
    CHECK(run([](double) { return 0.1; }, 2).value == 0.1);
    CHECK(run([](double n) { return n > 10 ? nan : 1; }, 2).status == Status::not_finite);
    CHECK(run([](double n) { return n < 5 ? nan : 1; }, 2).status == Status::not_finite);
    CHECK_THROWS_WITH(run(first, 0), "extrapolate: order = 0 must be positive and finite");
    CHECK_THROWS_WITH(run(first, 1, nan), "extrapolate: band = nan must be positive and finite");
    CHECK_THROWS_WITH(extrapolate([](std::ptrdiff_t) { return 1.0; }, 0, 1), "extrapolate: n = 0 must be at least 1");
    CHECK_THROWS_WITH(richardson(1.0, 1.0, -1), "richardson: order = -1 must be positive and finite");
}

TEST_CASE("Two equal values out of three are not taken for convergence", "[richardson]") {
    const auto run = [](double coarse, double middle, double fine) {
        return extrapolate([&](std::ptrdiff_t n) { return n == 1 ? coarse : n == 2 ? middle : fine; }, 1, 1);
    };
    for (const auto& result : {run(1, 1, 2), run(1, 2, 2)}) {
        CHECK(result.status == Status::order_differs);
        CHECK(result.value == 2);
    }
}

TEST_CASE("Values that differ by round-off have converged", "[richardson]") {
    // a change in the last digit shows no order
    const double epsilon = std::numeric_limits<double>::epsilon();
    for (const double sign : {1.0, -1.0}) {
        const auto noisy = [&](std::ptrdiff_t n) { return 1 + (n == 8 ? sign * epsilon : 0.0); };
        const auto result = extrapolate(noisy, 4, 2);
        CHECK(result.status == Status::ok);
        CHECK(result.value == 1);
        CHECK(result.error_estimate < 1e-12);
        CHECK(detail::is_nan(result.observed_order));
    }
    const auto coarse = [](std::ptrdiff_t n) { return 1 + (n == 8 ? 1e-12 : 0.0); };
    CHECK(extrapolate(coarse, 4, 2).status == Status::order_differs);
}

// --- Recommended schemes; test_promise.cpp measures their errors

using Counts = std::vector<std::pair<double, Eigen::Index>>;  // of elements or states, behind their tolerances

TEST_CASE("Recommended elements follow the measured table, and tolerances beyond it are rejected", "[recommendation]") {
    const auto elements = [](double tolerance, auto purpose) { return recommended_elements(tolerance, purpose).n; };
    const auto follow = [&](auto purpose, const Counts& counts) {
        for (const auto& [tolerance, n] : counts) {
            CAPTURE(tolerance, n);
            CHECK(elements(tolerance, purpose) == n);
        }
        double smallest = 0.5;  // accepted tolerance, within 3 %
        Eigen::Index largest = 0;
        try {
            while (true) largest = elements(smallest *= 0.97, purpose);
        } catch (const std::invalid_argument&) {
            CHECK(largest > 600);
            CHECK(largest <= 640);
        }
    };
    follow(Purpose::steady, {{0.5, 6}, {1e-3, 6}, {1e-4, 10}, {1e-5, 18}, {1e-6, 32}, {1e-8, 114}});
    follow(Purpose::frequency, {{0.9, 4}, {1e-2, 16}, {1e-4, 70}, {1e-6, 322}});
    follow(Purpose::time_loop, {{0.5, 4}, {1e-2, 5}, {1e-4, 43}, {1e-5, 238}});
    follow(Purpose::friction, {{0.5, 4}, {1e-2, 12}, {1e-3, 37}, {1e-4, 115}});
    const auto nodes = [](const Recommendation<AnyScheme>& best) {
        return best.scheme.get_if<NodeDifference>()->nodes;
    };
    for (const double tolerance : {0.1, 1e-5}) {
        CHECK(nodes(recommended_elements(tolerance, Purpose::steady)) == Nodes::centres);
        CHECK(nodes(recommended_elements(tolerance, Purpose::frequency)) == Nodes::centres);
        CHECK(nodes(recommended_scheme(tolerance > 0.01 ? 0.1 : 1e-4, Purpose::friction)) == Nodes::chebyshev);
        CHECK(recommended_elements(tolerance, Purpose::time_loop).scheme.get_if<Collocation>() != nullptr);
    }
    // the bound holds for the recommended number of elements
    CHECK(recommended_elements(0.5, Purpose::steady).error_bound ==
          Approx(0.785 * std::pow(6, -4) + 0.0075 * std::pow(6, -3)).epsilon(1e-14));
    CHECK(recommended_elements(0.5, Purpose::friction).error_bound == Approx(1.32 * std::pow(4, -2)).epsilon(1e-14));
    CHECK_THROWS_WITH(
        elements(1e-6, Purpose::time_loop),
        "recommended_elements: tolerance = 1e-06 must lie in [3.33984375e-06, 1): smaller ones were not measured");
}

TEST_CASE("States are recommended in full adhesion, elements with friction", "[recommendation]") {
    static_assert(std::is_same_v<decltype(recommended_scheme(0.1, Purpose::steady)), Recommendation<Chebyshev>>);
    CHECK(recommended_scheme(1e-3, Purpose::friction).n == 37);

    const auto states = [](double tolerance, Purpose::Adhesion purpose, double aspect = 10) {
        return recommended_scheme(tolerance, purpose, aspect).scheme.states;
    };
    const auto follow = [&](Purpose::Adhesion purpose, const Counts& counts) {
        for (const auto& [tolerance, m] : counts) {
            CAPTURE(tolerance, m);
            CHECK(states(tolerance, purpose) == m);
        }
    };
    follow(Purpose::steady, {{1e-2, 2}, {1e-6, 5}, {1e-10, 8}});
    follow(Purpose::frequency, {{1e-2, 6}, {1e-4, 9}, {1e-6, 11}, {1e-10, 14}});
    follow(Purpose::time_loop, {{1e-2, 3}, {1e-4, 15}, {1e-6, 149}});
    CHECK(states(1e-6, Purpose::steady, 1) == 16);
    CHECK(states(1e-6, Purpose::steady, 1e6) == 1);
    CHECK(states(1e-11, Purpose::steady, std::numeric_limits<double>::infinity()) == 1);
    CHECK(recommended_scheme(0.1, Purpose::time_loop).error_bound ==
          Approx(0.016 + 0.6 * std::exp(-2 * std::asinh(10))));
    for (const Purpose::Adhesion purpose : {Purpose::steady, Purpose::frequency, Purpose::time_loop}) {
        for (const double aspect : {0.01, 0.3, 10.0, 1e6}) {
            Eigen::Index last = 1;
            for (double tolerance = 0.9; tolerance > 1e-6; tolerance *= 0.7) {
                const Eigen::Index m = states(tolerance, purpose, aspect);
                CHECK(m >= last);  // a smaller tolerance never takes fewer states
                last = m;
            }
            CHECK_THROWS_AS(states(9e-12, purpose, aspect), std::invalid_argument);
        }
    }
    CHECK(states(1.4e-7, Purpose::time_loop) <= 400);
    CHECK_THROWS_WITH(
        states(1e-7, Purpose::time_loop),
        "recommended_scheme: tolerance = 1e-07 must lie in [1.375e-07, 1): smaller ones were not measured");
    CHECK_THROWS_WITH(states(1e-3, Purpose::steady, 0.001),
                      "recommended_scheme: aspect = 0.001 must be at least 0.01: narrower strips were not measured");
}

TEST_CASE("A recommendation passes its method, or its mesh and scheme, to a solver", "[recommendation]") {
    // one solver for both: it is called with a method, or with a mesh and a scheme
    int calls = 0;
    const auto solve = [&](const auto&... method) {
        ++calls;
        if constexpr (sizeof...(method) == 1) {
            return (static_cast<double>(method.states), ...);
        } else {
            return [](const Mesh<double>& mesh, const AnyScheme& scheme) {
                CHECK(unknown_count(scheme, mesh) == mesh.size());
                return 1 + std::pow(static_cast<double>(mesh.size()), -2);
            }(method...);
        }
    };
    CHECK(recommended_scheme(1e-6, Purpose::frequency).evaluate(solve) == 11);
    CHECK(calls == 1);
    CHECK(recommended_scheme(1e-3, Purpose::friction).evaluate(solve) == 1 + std::pow(37, -2));
    CHECK(calls == 2);
    CHECK(std::abs(recommended_elements(1e-4, Purpose::frequency).evaluate(solve) - 1) < 1e-15);  // extrapolated
    CHECK(calls == 4);
}

}  // namespace
}  // namespace recommendation_tests
