// rollbem/detail/in_place_lu.hpp: factors, solutions and inverses of every size, also of part of a larger matrix.
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include <rollbem/detail/in_place_lu.hpp>

#include "extremes/drawn.hpp"
#include "support/catch.hpp"
#include "support/scalars.hpp"

namespace in_place_lu_tests {

using Index = Eigen::Index;

TEMPLATE_TEST_CASE("in_place_lu: solution and inverse of a permuted matrix", "", SCALARS) {
    using Matrix = Eigen::Matrix<TestType, Eigen::Dynamic, Eigen::Dynamic>;
    using Vector = Eigen::Matrix<TestType, Eigen::Dynamic, 1>;
    drawn::Draw draw(1);
    std::vector<Index> sizes{64, 65, 131};
    for (Index n = 1; n <= 30; ++n) sizes.push_back(n);
    for (const Index n : sizes) {
        CAPTURE(n);
        // dominated by one entry of each row, none on the diagonal, so that only pivoting gives small errors
        Matrix all(n + 3, n + 3);
        for (TestType& entry : all.reshaped()) entry = static_cast<TestType>(draw.uniform(-0.5, 0.5));
        for (Index i = 0; i < n; ++i) all(i, (i + n / 2) % n) += static_cast<TestType>(2 * n);
        const Matrix before = all, A = before.topLeftCorner(n, n);
        std::vector<Index> swaps(static_cast<std::size_t>(n));
        auto factors = all.topLeftCorner(n, n);
        rollbem::detail::factorise_in_place<TestType>(factors, swaps.data());
        CHECK(all.rightCols(3) == before.rightCols(3));
        CHECK(all.bottomRows(3) == before.bottomRows(3));

        Matrix inverse(n, n);
        rollbem::detail::invert_factors<TestType>(factors, swaps.data(), inverse);
        Vector x = Vector::LinSpaced(n, 1, 2);
        const Vector right = A * x;
        Vector y = right;
        rollbem::detail::solve_in_place<TestType>(factors, swaps.data(), y);
        Matrix columns = A * inverse.transpose();
        rollbem::detail::solve_columns_in_place<TestType>(factors, swaps.data(), columns);
        const TestType rounding = 100 * Eigen::NumTraits<TestType>::epsilon();
        CHECK((A * inverse - Matrix::Identity(n, n)).cwiseAbs().maxCoeff() < rounding);
        CHECK((columns - inverse.transpose()).cwiseAbs().maxCoeff() < rounding * inverse.cwiseAbs().maxCoeff());
        CHECK((y - x).cwiseAbs().maxCoeff() < rounding);
    }
}

TEMPLATE_TEST_CASE("in_place_lu: elimination of the first unknowns leaves the Schur complement", "", SCALARS) {
    using Matrix = Eigen::Matrix<TestType, Eigen::Dynamic, Eigen::Dynamic>;
    using Vector = Eigen::Matrix<TestType, Eigen::Dynamic, 1>;
    drawn::Draw draw(2);
    for (Index n = 1; n <= 14; ++n) {
        Matrix A(n, n);
        for (TestType& entry : A.reshaped()) entry = static_cast<TestType>(draw.uniform(-0.5, 0.5));
        for (Index i = 0; i < n; ++i) A(i, i) += static_cast<TestType>(n);
        for (Index count = 0; count <= n; ++count) {
            CAPTURE(n, count);
            const Index rest = n - count;
            Matrix table = A;
            std::vector<Index> swaps(static_cast<std::size_t>(n));
            rollbem::detail::eliminate_in_place<TestType>(table, swaps.data(), count);
            Matrix factors = A.topLeftCorner(count, count), across = A.topRightCorner(count, rest);
            if (count > 0) {
                rollbem::detail::factorise_in_place<TestType>(factors, swaps.data());
                for (Index k = 0; k < rest; ++k) {
                    rollbem::detail::solve_in_place<TestType>(factors, swaps.data(), across.col(k));
                }
            }
            const TestType rounding = 100 * Eigen::NumTraits<TestType>::epsilon();
            const Matrix schur = A.bottomRightCorner(rest, rest) - A.bottomLeftCorner(rest, count) * across;
            const auto largest = [](const Matrix& of) {
                return of.size() == 0 ? TestType(0) : of.cwiseAbs().maxCoeff();
            };
            CHECK(largest(table.bottomRightCorner(rest, rest) - schur) < rounding * static_cast<TestType>(n));
            // a solution with the rest given: x_2, and x_1 from it
            const Vector x = Vector::LinSpaced(n, 1, 2), right = A * x;
            Vector y = right;
            rollbem::detail::eliminate_vector_in_place<TestType>(table, swaps.data(), count, y);
            CHECK(largest(y.tail(rest) - schur * x.tail(rest)) < rounding * static_cast<TestType>(n * n));
            y.head(count) -= table.topRightCorner(count, rest) * x.tail(rest);
            rollbem::detail::substitute_in_place<TestType>(table, count, y);
            CHECK(largest(y.head(count) - x.head(count)) < rounding);
        }
    }
}

}  // namespace in_place_lu_tests
