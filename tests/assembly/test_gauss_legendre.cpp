// rollbem/detail/gauss_legendre.hpp
#include <cmath>
#include <limits>

#include <rollbem/detail/gauss_legendre.hpp>

#include "support/catch.hpp"
#include "support/scalars.hpp"

namespace {

using rollbem::detail::gauss_legendre;

TEMPLATE_TEST_CASE("Gauss-Legendre quadrature is exact up to degree 2N-1", "[quadrature]", SCALARS) {
    using Scalar = TestType;
    const Scalar eps = std::numeric_limits<Scalar>::epsilon();
    for (const Eigen::Index count : {1, 2, 3, 4, 5, 6, 7, 9}) {
        const auto rule = gauss_legendre<Scalar>(count);
        REQUIRE(rule.nodes.size() == count);
        // the shift, (x + 1/2)^degree, makes odd degrees matter
        const auto error = [&](int degree) {
            Scalar sum = 0;
            for (Eigen::Index k = 0; k < count; ++k) {
                sum += rule.weights[k] * std::pow(rule.nodes[k] + Scalar(0.5), Scalar(degree));
            }
            const auto power = [&](Scalar x) { return std::pow(x, Scalar(degree + 1)) / Scalar(degree + 1); };
            const Scalar low = (degree % 2 == 0 ? -1 : 1) * power(Scalar(0.5));
            return static_cast<double>(std::abs(sum / (power(Scalar(1.5)) - low) - 1));
        };
        const int N = static_cast<int>(count);
        for (int degree = 0; degree < 2 * N; ++degree) {
            CAPTURE(N, degree, error(degree));
            CHECK(error(degree) < 30 * static_cast<double>(eps));
        }
    }
}

TEMPLATE_TEST_CASE("Gauss-Legendre rules of any size are symmetric, increasing and sum to 2", "[quadrature]", SCALARS) {
    using Scalar = TestType;
    for (const Eigen::Index count : {1, 2, 7, 64, 999, 1000}) {
        const auto rule = gauss_legendre<Scalar>(count);
        CAPTURE(count);
        CHECK((rule.nodes == -rule.nodes.reverse()).all());
        CHECK((rule.weights == rule.weights.reverse()).all());
        CHECK((rule.weights > 0).all());
        CHECK(rule.nodes[count - 1] < 1);
        CHECK((rule.nodes.tail(count - 1) > rule.nodes.head(count - 1)).all());
        const Scalar tolerance = Scalar(count + 8) * std::numeric_limits<Scalar>::epsilon();
        CHECK(std::abs(rule.weights.sum() - 2) < tolerance);
        if (count > 1) CHECK(std::abs((rule.weights * rule.nodes.square()).sum() - Scalar(2) / 3) < tolerance);
    }
}

}  // namespace
