// rollbem/discretisation/scheme.hpp
#include <limits>
#include <utility>

#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/steady/steady.hpp>

#include "support/brute_force.hpp"
#include "support/catch.hpp"
#include "support/scalars.hpp"

namespace {

using namespace rollbem;
using Catch::Matchers::ContainsSubstring;

TEMPLATE_TEST_CASE("Alpha is exact at both ends: 0.5 must not become a point beyond the edge", "[scheme]", SCALARS) {
    for (const Eigen::Index n : {3, 4, 10, 41, 160}) {
        for (const auto& [name, mesh] : brute_force::every_mesh<TestType>(n)) {
            for (const auto& [alpha_L, alpha_T] : {std::pair{0.0, 0.5}, {0.5, 0.0}, {0.0, 0.63}, {1.0, -0.25}}) {
                const auto alpha = interpolate_alpha(mesh, alpha_L, alpha_T);
                CAPTURE(n, name, alpha_L, alpha_T);
                CHECK(alpha[0] == static_cast<TestType>(alpha_T));
                CHECK(alpha[n - 1] == static_cast<TestType>(alpha_L));
            }
        }
    }
}

TEST_CASE("Knothe's boundary condition drops the width of the leading element", "[scheme]") {
    const Mesh<double> mesh = geometric_mesh(7, 3.0);
    CHECK((unknown_widths(mesh, Collocation{}) == mesh.widths()).all());
    CHECK((unknown_widths(mesh, Galerkin{}) == mesh.widths()).all());
    const Eigen::ArrayXd trailing = unknown_widths(mesh, KnotheBoundary{});
    REQUIRE(trailing.size() == 6);
    CHECK((trailing == mesh.widths().head(6)).all());
}

TEST_CASE("Schemes are imposed at the leading edges by default", "[scheme]") {
    for (const Quantity quantity : {Quantity::slope, Quantity::displacement}) {
        CHECK((Collocation{}.rows(quantity, uniform_mesh(4)).alpha == 0.5).all());
        CHECK((Galerkin{}.rows(quantity, uniform_mesh(4)).alpha == 0.5).all());
    }
}

TEST_CASE("Steps of slip are whole widths of elements in any order of differences, and not for Galerkin's equations",
          "[scheme]") {
    const auto mesh = geometric_mesh(4, 3.0);
    for (const auto derivative : {Derivative::finite_difference, Derivative::fourth_order}) {
        const PlaneKernel<double> kernel(1000, 0.75, 0.25);
        const auto ways = steady_system(mesh, Collocation{0.25, 0.5, derivative}, kernel).elements().intervals;
        CHECK((ways / mesh.widths() - 1).abs().maxCoeff() < 1e-15);
    }
    CHECK_THROWS_WITH((Galerkin{.derivative = Derivative::fourth_order}.rows(Quantity::slope, mesh)),
                      ContainsSubstring("finite_difference"));
}

TEST_CASE("Chebyshev nodes require the cosine mesh", "[scheme]") {
    const NodeDifference chebyshev{Nodes::chebyshev};
    CHECK_NOTHROW(check_scheme(chebyshev, mesh_from_edges<double>(cosine_mesh(40).edges())));
    CHECK_NOTHROW(check_scheme(chebyshev, uniform_mesh(2)));  // both are the same
    CHECK_THROWS_WITH(
        check_scheme(chebyshev, uniform_mesh(3)),
        ContainsSubstring("NodeDifference: width of an element over its width in the cosine mesh = 1.333333") &&
            ContainsSubstring("must be 1: Chebyshev nodes require the cosine mesh"));
    CHECK_THROWS_AS(check_scheme(chebyshev, geometric_mesh(8, 1.5)), std::invalid_argument);
}

// A scheme with the rows that a test gives it.
struct Given {
    SchemeRows<double> slope, displacement;

    SchemeRows<double> rows(Quantity quantity, const Mesh<double>&) const {
        return quantity == Quantity::slope ? slope : displacement;
    }
};

TEST_CASE("Rows that break the requirements on a scheme are rejected", "[scheme]") {
    const auto check = [](const auto& change, Quantity quantity = Quantity::slope) {
        Given scheme{Collocation{}.rows(Quantity::slope, uniform_mesh(5)),
                     Collocation{}.rows(Quantity::displacement, uniform_mesh(5))};
        change(quantity == Quantity::slope ? scheme.slope : scheme.displacement);
        check_scheme(scheme, uniform_mesh(5));
    };
    using Rows = SchemeRows<double>;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_NOTHROW(check([](Rows&) {}));
    CHECK_THROWS_WITH(check([&](Rows& rows) { rows.alpha[3] = nan; }), "SchemeRows: alpha = nan must be finite");
    CHECK_THROWS_WITH(check([](Rows& rows) { rows.lengths[4] = 0; }),
                      "SchemeRows: length = 0 must be positive and finite");
    CHECK_THROWS_WITH(check([](Rows& rows) { rows.alpha.setZero(4); }),
                      "SchemeRows: number of alphas = 4 must equal the number of elements");
    CHECK_THROWS_WITH(check([](Rows& rows) { rows.lengths.resize(0); }),
                      "SchemeRows: number of lengths = 0 must equal the number of elements");
    CHECK_THROWS_WITH(check([](Rows& rows) { rows.offsets.resize(0); }),
                      "SchemeRows: number of offsets = 0 must be at least 1");
    CHECK_THROWS_WITH(check([](Rows& rows) { rows.weights.setConstant(2, 0.5); }),
                      "SchemeRows: number of weights = 2 must equal the number of offsets");
    CHECK_THROWS_WITH(check([&](Rows& rows) { rows.offsets[0] = nan; }), "SchemeRows: offset = nan must be finite");
    CHECK_THROWS_WITH(check([](Rows& rows) { rows.weights[0] = 2; }), "SchemeRows: sum of weights = 2 must be 1");
    CHECK_THROWS_WITH(check([&](Rows& rows) { rows.weights[0] = nan; }), "SchemeRows: sum of weights = nan must be 1");
    CHECK_THROWS_WITH(check([](Rows& rows) { rows.averages = 3; }),
                      "SchemeRows: averages = 3 must be 0, 1 or 2 for the slope");
    CHECK_THROWS_WITH(check([](Rows& rows) { rows.averages = 2; }, Quantity::displacement),
                      "SchemeRows: averages = 2 must be 0 or 1 for the displacement");
    CHECK_THROWS_AS(check([](Rows& rows) { rows.averages = -1; }), std::invalid_argument);
    for (const Eigen::Index count : {0, 6}) {
        CHECK_THROWS_AS(check([=](Rows& rows) { rows.unknown_count = count; }), std::invalid_argument);
    }
    for (const Eigen::Index first : {-1, 1}) {
        CHECK_THROWS_AS(check([=](Rows& rows) { rows.first_equation = first; }), std::invalid_argument);
    }
}

TEST_CASE("A scheme whose rows for G and G' differ in number or position is rejected", "[scheme]") {
    const auto build = [](Eigen::Index first_equation, Eigen::Index unknown_count) {
        Given scheme{KnotheBoundary{}.rows(Quantity::slope, uniform_mesh(5)),
                     KnotheBoundary{}.rows(Quantity::displacement, uniform_mesh(5))};
        scheme.displacement.first_equation = first_equation;
        scheme.displacement.unknown_count = unknown_count;
        return rolling_system(uniform_mesh(5), scheme, PlaneKernel<double>(100, 0.75, 0.25)).size();
    };
    CHECK(build(1, 4) == 4);
    CHECK_THROWS_WITH(build(0, 4),
                      "rolling_system: first_equation of the scheme for G = 0 must equal that for G_prime");
    CHECK_THROWS_WITH(build(1, 3), "rolling_system: unknown_count of the scheme for G = 3 must equal that for G_prime");
}

}  // namespace
