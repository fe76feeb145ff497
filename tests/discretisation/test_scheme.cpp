// rollbem/discretisation/scheme.hpp
#include <limits>
#include <stdexcept>
#include <utility>

#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/steady/steady.hpp>

#include "support/brute_force.hpp"
#include "support/catch.hpp"
#include "support/scalars.hpp"

namespace scheme_tests {
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

// --- User-defined schemes: all that the library asks for is rows().

// Finite differences at alpha_l - half and alpha_l + half: its matrices are the means of those of both points.
struct TwoPoints {
    double alpha_L, alpha_T, half;

    template <class Scalar>
    SchemeRows<Scalar> rows(Quantity quantity, const Mesh<Scalar>& mesh) const {
        SchemeRows<Scalar> rows = rows_about(mesh, alpha_L, alpha_T);
        rows.offsets.resize(2);
        rows.offsets << static_cast<Scalar>(-half), static_cast<Scalar>(half);
        rows.weights.setConstant(2, Scalar(0.5));
        rows.averages = quantity == Quantity::slope ? 1 : 0;
        return rows;
    }
    Collocation behind() const { return {alpha_L - half, alpha_T - half}; }
    Collocation ahead() const { return {alpha_L + half, alpha_T + half}; }
};
// Differences between each centre and the point one width ahead of it: Collocation at alpha = 0.5, put another way.
struct OneWidthAhead {
    template <class Scalar>
    SchemeRows<Scalar> rows(Quantity quantity, const Mesh<Scalar>& mesh) const {
        SchemeRows<Scalar> rows =
            rows_between<Scalar>(ArrayX<Scalar>::Zero(mesh.size()), ArrayX<Scalar>::Ones(mesh.size()));
        rows.averages = quantity == Quantity::slope ? 1 : 0;
        return rows;
    }
};
static_assert(RollingScheme<TwoPoints> && RollingScheme<TwoPoints, float> && RollingScheme<TwoPoints, long double>);

const Contact contact = Contact::dimensionless(100, 0.28);
const StripKernel<double> kernel = StripKernel<double>::longitudinal(contact);
const TwoPoints stable{0.5, 0.5, 0.125}, unstable{0, 1, 0.15};

ElementSystem<double> mean_of_both(const Mesh<double>& mesh, const TwoPoints& scheme) {
    const auto mean = [&](auto&& assemble) -> MatrixX<double> {
        return (assemble(scheme.behind()) + assemble(scheme.ahead())) / 2;
    };
    return {mean([&](const auto& one) { return assemble_G(mesh, one, kernel); }),
            mean([&](const auto& one) { return assemble_G_prime(mesh, one, kernel); }), mesh.widths()};
}

TEST_CASE("A row can be written as a mean about a point or as a difference between two", "[scheme]") {
    for (const Mesh<double>& mesh : {uniform_mesh(20), cosine_mesh(17), geometric_mesh(12, 3.0)}) {
        CHECK(assemble_G(mesh, OneWidthAhead{}, kernel) == assemble_G(mesh, Collocation{}, kernel));
        CHECK(assemble_G_prime(mesh, OneWidthAhead{}, kernel) == assemble_G_prime(mesh, Collocation{}, kernel));
    }
}

TEST_CASE("The matrices of a scheme with two points are the means of the matrices of each point", "[scheme]") {
    for (const TwoPoints& scheme : {stable, unstable}) {
        for (const Mesh<double>& mesh : {uniform_mesh(20), cosine_mesh(17), geometric_mesh(12, 3.0)}) {
            const ElementSystem<double> own = rolling_system(mesh, scheme, kernel), mean = mean_of_both(mesh, scheme);
            CAPTURE(scheme.alpha_T, mesh.size());
            CHECK((own.G() - mean.G()).cwiseAbs().maxCoeff() < 1e-14 * mean.G().cwiseAbs().maxCoeff());
            CHECK((own.G_prime() - mean.G_prime()).cwiseAbs().maxCoeff() <
                  1e-13 * mean.G_prime().cwiseAbs().maxCoeff());
            CHECK((own.weights() == mesh.widths()).all());
        }
    }
}

TEST_CASE("AnyScheme has the matrices of the scheme that it holds", "[scheme]") {
    for (const Mesh<double>& mesh : {uniform_mesh(7), cosine_mesh(9)}) {
        const auto check = [&](const auto& scheme) {
            const AnyScheme any = scheme, copy = any;
            CHECK(assemble_G(mesh, copy, kernel) == assemble_G(mesh, scheme, kernel));
            CHECK(assemble_G_prime(mesh, copy, kernel) == assemble_G_prime(mesh, scheme, kernel));
        };
        check(Collocation{0, 0.63});
        check(Galerkin{.alpha_L = 0, .alpha_T = 0.63, .quadrature = 3});
        check(KnotheBoundary{});
        check(NodeDifference{});
        check(stable);
    }
    const auto alpha = [](const auto& mesh, const AnyScheme& any) { return any.rows(Quantity::slope, mesh).alpha[0]; };
    CHECK(alpha(uniform_mesh<float>(3), Collocation{0, 0.63}) == 0.63F);
    CHECK(alpha(uniform_mesh<double>(3), TwoPoints{0, 0.63, 0.1}) == 0.63);
    CHECK_THROWS_AS(alpha(uniform_mesh<float>(3), TwoPoints{0, 0.63, 0.1}), std::invalid_argument);
    AnyScheme any;
    REQUIRE(any.get_if<Collocation>() != nullptr);
    any = Galerkin{.alpha_T = 0.63};
    CHECK(any.get_if<Collocation>() == nullptr);
    CHECK(any.get_if<Galerkin>()->alpha_T == 0.63);
}

}  // namespace
}  // namespace scheme_tests
