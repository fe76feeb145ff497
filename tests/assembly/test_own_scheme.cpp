// User-defined schemes, rollbem/discretisation/scheme.hpp and any_scheme.hpp: all that the library asks for
// is rows(). The scheme here takes the mean over two collocation points, so that its matrices are the means of the
// points' matrices; problems see nothing else of a scheme.
#include <stdexcept>

#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/spectral/chebyshev.hpp>

#include "support/catch.hpp"

namespace own_scheme_tests {
namespace {

using namespace rollbem;

// Finite differences at alpha_l - half and alpha_l + half.
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
        const Collocation halves{0.5, 0.5};
        CHECK(assemble_G(mesh, OneWidthAhead{}, kernel) == assemble_G(mesh, halves, kernel));
        CHECK(assemble_G_prime(mesh, OneWidthAhead{}, kernel) == assemble_G_prime(mesh, halves, kernel));
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
}  // namespace own_scheme_tests
