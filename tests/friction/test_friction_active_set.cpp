// rollbem/friction/detail/active_set.hpp, complementary_path.hpp, stick_equations.hpp,
// slip_dependent_set.hpp
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include <rollbem/friction/detail/active_set.hpp>
#include <rollbem/friction/detail/directions.hpp>
#include <rollbem/friction/detail/slip_dependent_set.hpp>

#include "support/catch.hpp"
#include "support/dense.hpp"
#include "support/draw.hpp"

namespace {

using namespace rollbem;

TEST_CASE("An active set finds a solution whatever the matrix", "[friction]") {
    support::Draw draw(7);
    int fallbacks = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        const Eigen::Index n = 1 + trial % 12;
        detail::ActiveSet<double> solver(n);
        // a third of the matrices is of rank one, a third definite, a third arbitrary
        const VectorX<double> left = VectorX<double>::NullaryExpr(n, [&] { return draw.normal(); });
        const VectorX<double> right = VectorX<double>::NullaryExpr(n, [&] { return draw.normal(); });
        const MatrixX<double> any = MatrixX<double>::NullaryExpr(n, n, [&] { return draw.normal(); });
        MatrixX<double> matrix = any;
        if (trial % 3 == 0) matrix = dense::product(left, right.transpose());
        if (trial % 3 == 1) {
            matrix = dense::product(any, any.transpose());
            matrix.diagonal().array() += 1;
        }
        solver.new_matrix() = matrix;
        const VectorX<double> constant = VectorX<double>::NullaryExpr(n, [&] { return draw.normal(); });
        VectorX<double> bound = VectorX<double>::NullaryExpr(n, [&] { return std::abs(draw.normal()); });
        if (trial % 5 == 0) bound[0] = 0;
        solver.constant() = constant;
        const auto outcome = solver.solve(bound, std::vector<Zone>(static_cast<std::size_t>(n), Zone::stick));
        CAPTURE(trial, n, outcome.rounds, outcome.pivots, outcome.residual);
        REQUIRE(outcome.status == StepStatus::ok);
        REQUIRE(outcome.residual < 1e-11);
        if (outcome.pivots > 0) ++fallbacks;
        if (trial % 3 == 1 && n < 4) CHECK(outcome.pivots == 0);
        // the conditions, from the definition
        const VectorX<double> slip = matrix * solver.traction() + constant;
        for (Eigen::Index i = 0; i < n; ++i) {
            const double p = solver.traction()[i];
            REQUIRE(std::abs(p) <= bound[i] * (1 + 1e-12));
            if (bound[i] - std::abs(p) > 1e-9 * bound[i]) REQUIRE(std::abs(slip[i]) < 1e-9);
            if (bound[i] > 0) REQUIRE(slip[i] * p < 1e-9);
        }
    }
    CHECK(fallbacks > 100);
}

// An eigenvalue of the circulant matrix with this first row vanishes.
bool is_singular_circulant(const VectorX<double>& first) {
    const Eigen::Index n = first.size();
    for (Eigen::Index j = 0; j < n; ++j) {
        std::complex<double> eigenvalue = 0;
        for (Eigen::Index k = 0; k < n; ++k) {
            eigenvalue += first[k] * std::polar(1.0, 2 * std::numbers::pi * static_cast<double>(j * k % n) /
                                                         static_cast<double>(n));
        }
        if (std::abs(eigenvalue) < 1e-12) return true;
    }
    return false;
}

TEST_CASE("An active set finds a solution if all elements are alike", "[friction]") {
    // Circulant matrices under one creepage and one bound: every condition is met by several elements at once.
    support::Draw draw(1);
    int fallbacks = 0, unsolved = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const Eigen::Index n = 2 + trial % 9;
        const VectorX<double> first =
            VectorX<double>::NullaryExpr(n, [&] { return static_cast<double>(draw.integer(9)) - 4; });
        detail::ActiveSet<double> solver(n);
        MatrixX<double> matrix(n, n);
        for (Eigen::Index i = 0; i < n; ++i) {
            for (Eigen::Index j = 0; j < n; ++j) matrix(i, j) = first[(j - i + n) % n];
        }
        solver.new_matrix() = matrix;
        const double constant = trial % 2 == 0 ? 1 : -1;
        solver.constant().setConstant(constant);
        const auto outcome =
            solver.solve(VectorX<double>::Ones(n), std::vector<Zone>(static_cast<std::size_t>(n), Zone::stick));
        CAPTURE(trial, n, outcome.rounds, outcome.pivots, outcome.residual);
        if (outcome.status != StepStatus::ok) {
            REQUIRE(outcome.status == StepStatus::no_solution);
            REQUIRE(outcome.residual > 1e-3);
            REQUIRE(is_singular_circulant(first));
            ++unsolved;
            continue;
        }
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
    CHECK(unsolved <= 2);
}

TEST_CASE("The transform satisfies the equations or is replaced by them", "[friction]") {
    // diagonals for which elimination without pivoting is accurate, fair and poor
    support::Draw draw(3);
    const Eigen::Index n = 30;
    const auto random = [&] { return VectorX<double>(VectorX<double>::NullaryExpr(n, [&] { return draw.normal(); })); };
    const double rounding = (n + 10) * std::numeric_limits<double>::epsilon();
    int good = 0, inaccurate = 0, left = 0;
    for (int trial = 0; trial < 600; ++trial) {
        MatrixX<double> matrix = MatrixX<double>::NullaryExpr(n, n, [&] { return draw.normal(); });
        matrix.diagonal().array() += std::sqrt(static_cast<double>(n)) * (trial % 3 == 0   ? 3
                                                                          : trial % 3 == 1 ? 1
                                                                                           : 0.3);
        const VectorX<double> bound = VectorX<double>::Constant(n, trial % 2 == 0 ? 1e9 : 0.3);
        detail::ActiveSet<double> solver(n), other(n);
        solver.new_matrix() = other.new_matrix() = matrix;
        solver.constant() = random();
        solver.begin(detail::Effort::equations);
        solver.solve(bound, std::vector<Zone>(static_cast<std::size_t>(n), Zone::stick));
        const std::vector<Zone> zones = solver.zones();
        const VectorX<double> expected = solver.traction();
        for (const double change : {0.0, 1e-3, 3.0}) {
            solver.constant() += change * random();
            const bool checked = change < 1;
            solver.begin(checked ? detail::Effort::transform_check : detail::Effort::transform);
            const auto outcome = solver.solve(bound, zones);
            CAPTURE(trial, change, outcome.residual, outcome.rounds);
            REQUIRE(outcome.status == StepStatus::ok);
            if (!solver.unchanged()) {
                // identical to the solution of the equations alone
                ++(checked && solver.zones() == zones ? inaccurate : left);
                other.constant() = solver.constant();
                other.begin(detail::Effort::equations);
                const auto alone = other.solve(bound, zones);
                REQUIRE(solver.traction() == other.traction());
                REQUIRE(solver.slip() == other.slip());
                REQUIRE(outcome.residual == alone.residual);
                REQUIRE(outcome.rounds == alone.rounds);
                continue;
            }
            ++good;
            REQUIRE(solver.zones() == zones);
            REQUIRE(outcome.rounds == 1);
            if (change == 0) {
                REQUIRE((solver.traction() - expected).cwiseAbs().maxCoeff() < 1e-9 * expected.cwiseAbs().maxCoeff());
            }
            long double largest = 0, off = 0;
            for (Eigen::Index i = 0; i < n; ++i) {
                long double product = 0;
                for (Eigen::Index j = 0; j < n; ++j) {
                    product += static_cast<long double>(matrix(i, j)) * solver.traction()[j];
                }
                largest = std::max(largest, std::abs(product));
                off = std::max(off, std::abs(product + solver.constant()[i] - solver.slip()[i]));
            }
            const long double scale = largest + solver.constant().cwiseAbs().maxCoeff();
            if (checked) REQUIRE(off < 5 * rounding * scale);
            for (Eigen::Index i = 0; i < n; ++i) {
                const double p = solver.traction()[i], s = solver.slip()[i];
                REQUIRE(std::abs(p) <= bound[i]);
                REQUIRE(p * s <= 0);
                REQUIRE((std::abs(p) == bound[i] || s == 0));
            }
        }
    }
    CAPTURE(good, inaccurate, left);
    CHECK(good > 300);
    CHECK(inaccurate > 20);
    CHECK(left > 100);
}

}  // namespace
