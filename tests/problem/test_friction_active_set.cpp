// rollbem/problem/friction_active_set.hpp
#include <cmath>
#include <random>
#include <vector>

#include "rollbem/problem/friction_active_set.hpp"
#include "support/catch.hpp"

namespace {

using namespace rollbem;

TEST_CASE("A solution is found where all elements are alike", "[friction]") {
    // Circulant matrices under one creepage and one bound: every condition is met by several elements at once.
    std::mt19937 generator(1);
    int fallbacks = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const Eigen::Index n = 2 + trial % 9;
        const VectorX<double> first =
            VectorX<double>::NullaryExpr(n, [&] { return static_cast<double>(generator() % 9) - 4; });
        detail::ActiveSet<double> solver(n);
        for (Eigen::Index i = 0; i < n; ++i) {
            for (Eigen::Index j = 0; j < n; ++j) solver.matrix()(i, j) = first[(j - i + n) % n];
        }
        const MatrixX<double> matrix = solver.matrix();
        const double constant = trial % 2 == 0 ? 1 : -1;
        solver.constant().setConstant(constant);
        const auto outcome =
            solver.solve(VectorX<double>::Ones(n), std::vector<Zone>(static_cast<std::size_t>(n), Zone::stick));
        CAPTURE(trial, n, outcome.rounds, outcome.pivots, outcome.residual);
        REQUIRE(outcome.status == FrictionStatus::ok);
        if (outcome.pivots > 0) ++fallbacks;
        // the conditions, from the definition
        const VectorX<double> slip = (matrix * solver.traction()).array() + constant;
        for (Eigen::Index i = 0; i < n; ++i) {
            const double p = solver.traction()[i];
            const bool sticks = std::abs(slip[i]) < 1e-9, slides = slip[i] * p < 0 && std::abs(p) > 1 - 1e-9;
            REQUIRE(std::abs(p) < 1 + 1e-9);
            REQUIRE((sticks || slides));
        }
    }
    CHECK(fallbacks > 1000);
}

}  // namespace
