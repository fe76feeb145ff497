// rollbem/steady/steady.hpp
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <rollbem/line.hpp>
#include <rollbem/system/detail/dissipation.hpp>

#include "support/brute_force.hpp"
#include "support/catch.hpp"
#include "support/observed_order.hpp"
#include "support/scalars.hpp"

namespace steady_tests {
namespace {

using namespace rollbem;

constexpr auto analytic = Derivative::analytic;

// c11 over its exact value, minus 1, for a wide strip
double error(const Mesh<double>& mesh, const AnyScheme& scheme, double nu = 0.25) {
    return solve_steady(mesh, scheme, StripKernel<double>(1000, 1 - nu, nu)).c11() / steady_c11(nu) - 1;
}

double plane_error(const Mesh<double>& mesh, const AnyScheme& scheme) {
    return solve_steady(mesh, scheme, PlaneKernel<double>(1000, 0.75, 0.25)).c11() / steady_c11(0.25) - 1;
}

// whether `value` rounds to what is printed with `digits` significant digits
bool rounds_to(double value, double printed, int digits) {
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(printed))) - digits + 1);
    return std::abs(value - printed) <= 0.5000001 * unit;
}

TEST_CASE("Uniform elements and finite differences reproduce the errors of CONTACT", "[steady]") {
    const std::pair<int, double> published[] = {{10, 1.513e-2},  {20, 7.543e-3},  {40, 3.769e-3}, {80, 1.884e-3},
                                                {160, 9.420e-4}, {320, 4.710e-4}, {640, 2.356e-4}};
    for (const auto& [n, value] : published) {
        const double found = error(uniform_mesh(n), Collocation{0.5, 0.5}, 0.28);
        CAPTURE(n, found, value);
        CHECK(rounds_to(found, value, 4));
    }
}

TEST_CASE("The paper's schemes have the documented errors", "[steady]") {
    const auto at = [](int n, double alpha_T) { return error(uniform_mesh(n), Collocation{0, alpha_T}); };
    CHECK(rounds_to(error(uniform_mesh(40), Collocation{0.5, 0.5}), 3.77e-3, 3));
    CHECK(rounds_to(at(40, 0.5), 1.32e-3, 3));
    CHECK(rounds_to(at(40, 0.6), 1.8e-4, 2));
    CHECK(rounds_to(at(40, 0.7), -7.8e-4, 2));
    CHECK(rounds_to(at(20, 0.63), -3.1e-5, 2));
    CHECK(rounds_to(at(40, 0.63), -1.26e-4, 3));
    CHECK(rounds_to(at(60, 0.63), -1.12e-4, 3));
    CHECK(rounds_to(at(80, 0.63), -9.5e-5, 2));
    CHECK(rounds_to(at(160, 0.63), -5.6e-5, 2));
}

TEST_CASE("The c11 converges at order two on cosine meshes", "[steady][convergence]") {
    const std::pair<int, double> published[] = {{20, 4.3e-4},   {40, 1.06e-4},  {80, 2.63e-5},
                                                {160, 6.54e-6}, {320, 1.63e-6}, {640, 4.08e-7}};
    std::vector<double> sizes, cosine;
    for (const auto& [n, value] : published) {
        sizes.push_back(n);
        cosine.push_back(plane_error(cosine_mesh(n), Collocation{0.5, 0.5}));
        CAPTURE(n, cosine.back());
        CHECK(rounds_to(cosine.back(), value, value > 4.2e-4 ? 2 : 3));
    }
    CHECK(std::abs(support::observed_order(sizes, cosine) - 2) < 0.02);
    // smooth enough for Richardson's extrapolation
    const double coarse = plane_error(cosine_mesh(7), Collocation{0.5, 0.5}),
                 fine = plane_error(cosine_mesh(14), Collocation{0.5, 0.5});
    CHECK(rounds_to((4 * fine - coarse) / 3, 6.6e-5, 2));
}

// Relative errors at n = 10, 20, 40, 80 against published ones: within 1 %, and of one order.
void check_errors(const std::vector<double>& errors, const std::vector<double>& published, double order, double band) {
    const std::vector<double> sizes{10, 20, 40, 80};
    CAPTURE(errors, published, support::observed_order(sizes, errors));
    for (std::size_t k = 0; k < 4; ++k) CHECK(std::abs(errors[k] / published[k] - 1) < 0.01);
    CHECK(std::abs(support::observed_order(sizes, errors) - order) < band);
}

TEST_CASE("Node differences are of second order on the cosine mesh, in force and moment", "[steady][convergence]") {
    // creepage: p = -(1/c1) sqrt((1 - x)/(1 + x)), moment about x = 0: pi/(4 c1); rigid slip x, as by spin:
    // p = -(1/c1) sqrt(1 - x^2)/2, force -pi/(4 c1), all in units of a = G = 1
    const double c1 = 0.72;
    const PlaneKernel<double> kernel(1000, c1, 0.28);
    struct Case {
        Nodes nodes;
        std::vector<double> c11, spin_force, moment;
        double moment_order;
    };
    for (const Case& expected : {Case{Nodes::centres,
                                      {4.992e-4, 1.213e-4, 3.009e-5, 7.510e-6},
                                      {1.92e-2, 5.04e-3, 1.30e-3, 3.30e-4},
                                      {-1.91e-2, -4.84e-3, -1.22e-3, -3.05e-4},
                                      2},
                                 Case{Nodes::chebyshev,
                                      {3.044e-3, 7.627e-4, 1.908e-4, 4.770e-5},
                                      {1.11e-2, 2.90e-3, 7.43e-4, 1.88e-4},
                                      {-1.37e-3, -1.70e-4, -2.11e-5, -2.64e-6},
                                      3}}) {
        std::vector<double> c11, spin_force, moment;
        for (const Eigen::Index n : {10, 20, 40, 80}) {
            const auto system = rolling_system(cosine_mesh(n), NodeDifference{expected.nodes}, kernel).with_spin();
            const MatrixX<double> c = solve_steady(system).coefficients;
            c11.push_back(c(0, 0) / steady_c11(0.28) - 1);
            spin_force.push_back(c(0, 1) * 4 * c1 / std::numbers::pi - 1);
            moment.push_back(-c(1, 0) * 4 * c1 / std::numbers::pi - 1);
        }
        CAPTURE(expected.nodes == Nodes::centres);
        check_errors(c11, expected.c11, 2, 0.05);
        check_errors(spin_force, expected.spin_force, 2, 0.1);
        check_errors(moment, expected.moment, expected.moment_order, 0.1);
        CHECK(std::abs(4 * c11[1] - c11[0]) / 3 < 2e-5);  // clean enough for Richardson's extrapolation
    }
    // on uniform meshes of first order, at a fifth of the error of differences over each element's own width
    std::vector<double> uniform;
    for (const Eigen::Index n : {10, 20, 40, 80}) {
        uniform.push_back(solve_steady(uniform_mesh(n), NodeDifference{}, kernel).c11() / steady_c11(0.28) - 1);
    }
    check_errors(uniform, {3.652e-3, 1.554e-3, 7.129e-4, 3.409e-4}, 1.14, 0.05);
}

TEMPLATE_TEST_CASE("A steady solution satisfies its equations and carries its force", "[steady]", SCALARS) {
    using Scalar = TestType;
    const Scalar eps = std::numeric_limits<Scalar>::epsilon();
    for (const auto& [name, mesh] : brute_force::every_mesh<Scalar>(30)) {
        for (const Collocation& scheme :
             {Collocation{0, 0.63}, Collocation{0.5, 0.5}, Collocation{0.5, 0.5, analytic}}) {
            for (const Scalar b : {Scalar(0.5), Scalar(4), Scalar(1000)}) {
                const StripKernel<Scalar> kernel(b, Scalar(0.75), Scalar(0.25));
                const auto solution = solve_steady(mesh, scheme, kernel);
                CAPTURE(name, scheme.alpha_T, b, static_cast<double>(solution.residual),
                        static_cast<double>(solution.rcond));
                CHECK(solution.status == Status::ok);
                CHECK(solution.residual < 30 * eps);
                CHECK(solution.rcond > Scalar(1e-4));
                CHECK(solution.rcond <= 1);
                const MatrixX<Scalar> G_prime = assemble_G_prime(mesh, scheme, kernel);
                const VectorX<Scalar> slope = G_prime * solution.unknowns;
                CHECK((slope.array() - 1).abs().maxCoeff() < 3000 * eps);
                CHECK(std::abs(solution.c11() + (mesh.widths() * solution.unknowns.col(0).array()).sum()) <=
                      30 * eps * solution.c11());
            }
        }
    }
}

TEMPLATE_TEST_CASE("The status reports that alpha = 0 is singular or carries no force", "[steady]", SCALARS) {
    using Scalar = TestType;
    const PlaneKernel<Scalar> kernel(Scalar(1000), Scalar(0.75), Scalar(0.25));
    for (Eigen::Index n = 1; n < 60; ++n) {
        const auto solution = solve_steady(uniform_mesh<Scalar>(n), Collocation{0, 0}, kernel);
        CAPTURE(n, static_cast<double>(solution.rcond), static_cast<double>(solution.c11()));
        if (n % 2 == 1) {
            CHECK(solution.status != Status::ok);  // antisymmetric of odd size
        } else {
            CHECK(solution.status == Status::assists_creepage);
            CHECK(std::abs(solution.c11()) <
                  1000 * std::numeric_limits<Scalar>::epsilon() / solution.rcond);  // no force
        }
    }
}

TEST_CASE("At most a twentieth of the traction may assist the creepage", "[steady]") {
    const ArrayX<double> widths = ArrayX<double>::Constant(10, 0.2);
    for (const Eigen::Index wrong : {0, 4, 9}) {
        const auto status = [&](double assisting) {  // traction of one element; the other nine have -1
            VectorX<double> diagonal = VectorX<double>::Constant(10, -1);
            diagonal[wrong] = 1 / assisting;
            return solve_steady<double>(diagonal.asDiagonal().toDenseMatrix(), widths).status;
        };
        CHECK(status(0.46) == Status::ok);                // 0.0486
        CHECK(status(0.49) == Status::assists_creepage);  // 0.0516
    }
}

TEST_CASE("Dissipation is proved on uniform meshes exactly for the schemes that converge", "[steady]") {
    const PlaneKernel<double> kernel(1000, 0.75, 0.25);
    const auto proved = [&](const Mesh<double>& mesh, const Collocation& scheme) {
        return is_dissipative(assemble_G_prime(mesh, scheme, kernel), mesh.widths());
    };
    for (const Eigen::Index n : {10, 40}) {
        for (const double alpha : {-0.05, 0.0, 0.05, 0.25, 0.63, 0.95, 1.05, 1.25}) {
            CAPTURE(n, alpha);
            CHECK(proved(uniform_mesh(n), {alpha, alpha}) == (alpha > 0 && alpha < 1));
        }
    }
    for (const Eigen::Index n : {2, 10, 40, 160}) CHECK(proved(cosine_mesh(n), {0.5, 0.5}));
}

TEST_CASE("Lateral creepage gives c22 in the units of the contact", "[steady]") {
    const Contact contact({.half_length = 0.006, .half_width = 0.012, .shear_modulus = 8.2e10, .poisson_ratio = 0.28});
    for (const auto& [name, mesh] : brute_force::every_mesh<double>(15)) {
        const auto solution = solve_steady(mesh, Collocation{}, StripKernel<double>::lateral(contact));
        const double force = creep_force(contact, solution, 1e-4);
        const auto unit = solve_steady(mesh, Collocation{}, StripKernel<double>(2, 1, -0.28));
        CAPTURE(name);
        CHECK(solution.status == Status::ok);
        CHECK((solution.unknowns - unit.unknowns).norm() < 1e-13 * unit.unknowns.norm());
        CHECK(solution.unknowns.maxCoeff() < 0);
        CHECK(std::abs(force / (-0.024 * 0.006 * 8.2e10 * solution.c11() * 1e-4) - 1) < 1e-14);
    }
}

TEST_CASE("A scheme that does not converge to full adhesion has a status of its own", "[steady]") {
    const PlaneKernel<double> kernel(1000, 0.75, 0.25);
    struct Case {
        Collocation scheme;
        double ratio;  // c11 over the exact one
    };
    for (const Case& wrong : {Case{{-0.5, -0.5}, -1}, Case{{0, -0.5}, -1}, Case{{1.5, 1.5}, 3}}) {
        for (const Eigen::Index n : {20, 21, 80, 160}) {
            const auto solution = solve_steady(uniform_mesh(n), wrong.scheme, kernel);
            CAPTURE(n, wrong.scheme.alpha_L, wrong.scheme.alpha_T, solution.c11());
            // residual and condition number alone do not show it
            CHECK(solution.residual < 1e-15);
            CHECK(solution.rcond > 1e-6);
            CHECK(std::abs(solution.c11() / steady_c11(0.25) - wrong.ratio) < 0.05);
            CHECK(solution.status == Status::assists_creepage);
        }
    }
    for (const double alpha : {0.1, 0.2, 0.5, 0.63, 1.0}) {
        for (const double alpha_L : {0.0, alpha}) {
            for (const Eigen::Index n : {20, 21, 80}) {
                const auto solution = solve_steady(uniform_mesh(n), Collocation{alpha_L, alpha}, kernel);
                CAPTURE(n, alpha, alpha_L, solution.c11());
                CHECK(std::abs(solution.c11() / steady_c11(0.25) - 1) < 0.5 / static_cast<double>(n));
                CHECK(solution.status == Status::ok);
            }
        }
    }
}

TEST_CASE("Input that is not finite is reported, and matrices that are not square are rejected",
          "[steady][not_finite]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    MatrixX<double> broken = MatrixX<double>::Identity(3, 3);
    broken(1, 2) = nan;
    const ArrayX<double> three = ArrayX<double>::Ones(3);
    CHECK(solve_steady<double>(broken, three).status == Status::not_finite);
    CHECK(solve_steady<double>(-2 * MatrixX<double>::Identity(3, 3), three).c11() == 1.5);
    CHECK(solve_steady<double>(MatrixX<double>::Ones(3, 3), three).status != Status::ok);
    CHECK_THROWS_WITH(solve_steady<double>(MatrixX<double>::Ones(3, 2), three),
                      "solve_steady: number of columns of G_prime = 2 must be positive and equal the number of rows");
    CHECK_THROWS_WITH(solve_steady<double>(MatrixX<double>(0, 0), three),
                      "solve_steady: number of columns of G_prime = 0 must be positive and equal the number of rows");
    CHECK_THROWS_WITH(solve_steady<double>(MatrixX<double>::Identity(2, 2), three),
                      "solve_steady: number of widths = 3 must equal the number of columns of G_prime");
}

TEST_CASE("Two collocation points in one place are reported as ill-conditioned", "[steady]") {
    ArrayX<double> edges(6);
    edges << -1, -0.17594030825560192, 0.005631806488683111, 0.079234900637084937, 0.0825571296575629, 1;
    const double alpha = 0.55507984072057392;
    const Response<double> solution =
        solve_steady(mesh_from_edges<double>(edges),
                     Collocation{.alpha_L = alpha, .alpha_T = alpha, .derivative = Derivative::analytic},
                     StripKernel<double>(18713779409.996429, 1 - 0.33151985305346909, 0.33151985305346909));
    CAPTURE(solution.rcond, solution.c11());
    CHECK(solution.status == Status::ill_conditioned);
}

TEST_CASE("The status of a steady solution changes at the documented thresholds", "[steady]") {
    const double eps = std::numeric_limits<double>::epsilon();
    const ArrayX<double> two = ArrayX<double>::Ones(2);
    const auto diagonal = [&](double first, double second) {
        return solve_steady<double>(Eigen::Vector2d(first, second).asDiagonal().toDenseMatrix(), two);
    };
    // rcond = d; trusted above 100 n eps
    CHECK(diagonal(-1, -190 * eps).status == Status::ill_conditioned);
    CHECK(diagonal(-1, -210 * eps).status == Status::ok);
    CHECK(diagonal(-1, -210 * eps).rcond == Approx(210 * eps));
    // tractions that assist the creepage count only where they can be trusted
    CHECK(diagonal(1, 0.5).status == Status::assists_creepage);
    CHECK(diagonal(1, 190 * eps).status == Status::ill_conditioned);
    // a residual of 0.5e-13 or 0.4e-13; trusted up to 100 n eps = 0.444e-13
    const auto with_error = [&](double error) {
        MatrixX<double> G_prime = -MatrixX<double>::Identity(2, 2);
        const MatrixX<double> ones = MatrixX<double>::Ones(2, 1);
        auto factorised = detail::factorise(G_prime, ones, ones);
        const MatrixX<double> product = -(1 + error) * factorised.response.unknowns;
        return detail::judge(factorised, product, ones);
    };
    CHECK(with_error(1e-10).status == Status::ill_conditioned);
    CHECK(with_error(1e-13).status == Status::ill_conditioned);
    CHECK(with_error(0.8e-13).status == Status::ok);
}

TEST_CASE("A system is solved for steady rolling as its mesh and scheme are", "[steady]") {
    const PlaneKernel<double> kernel(100, 0.75, 0.25);
    const Collocation halves{.alpha_L = 0.5, .alpha_T = 0.5}, behind{.alpha_L = -0.5, .alpha_T = -0.5};
    const Response<double> elements = solve_steady(rolling_system(cosine_mesh(20), halves, kernel));
    CHECK(elements.status == Status::ok);
    CHECK(elements.c11() == solve_steady(cosine_mesh(20), halves, kernel).c11());
    CHECK(solve_steady(rolling_system(cosine_mesh(20), behind, kernel)).status == Status::assists_creepage);

    // unknowns other than tractions may have either sign
    const MatrixX<double> identity = MatrixX<double>::Identity(2, 2);
    CHECK(solve_steady<double>(identity, ArrayX<double>::Ones(2)).status == Status::assists_creepage);
    CHECK(solve_steady(RollingSystem<double>(identity, identity, ArrayX<double>::Ones(2))).status == Status::ok);

    const Response<double> solution = solve_steady(rolling_system(Chebyshev{12}, kernel));
    CHECK(solution.status == Status::ok);
    CHECK(std::abs(solution.c11() / steady_c11(0.25) - 1) < 1e-13);
}

TEST_CASE("The product for the residual of a large problem agrees with the assembled G'", "[steady]") {
    const StripKernel<double> kernel(20, 0.72, 0.28);
    const Mesh<double> uniform = uniform_mesh(70);
    for (const auto& [mesh, scheme] : {
             std::pair<Mesh<double>, AnyScheme>{uniform, Collocation{.alpha_L = 0.5, .alpha_T = 0.5}},
             {uniform, Collocation{0, 0.63}},
             {cosine_mesh(70), Collocation{0.5, 0.5, Derivative::analytic}},
             {uniform, KnotheBoundary{}},
             {uniform, NodeDifference{}},  // Toeplitz but for the last row, which belongs to a block of its own kind
         }) {
        const VectorX<double> p = VectorX<double>::Random(unknown_count(scheme, mesh));
        const VectorX<double> product = detail::influence_product<double>(
            mesh, scheme_rows(scheme, Quantity::slope, mesh), detail::KernelView<double>(kernel), Quantity::slope, p);
        CHECK((product - assemble_G_prime(mesh, scheme, kernel) * p).cwiseAbs().maxCoeff() < 1e-12);
    }
}

}  // namespace
}  // namespace steady_tests
