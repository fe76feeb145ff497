// rollbem/adhesion/frequency.hpp
#include <algorithm>
#include <complex>
#include <limits>
#include <vector>

#include <rollbem/line.hpp>
#include <rollbem/reference/bessel.hpp>

#include "support/catch.hpp"
#include "support/observed_order.hpp"

namespace frequency_tests {
namespace {

using namespace rollbem;
using Complex = std::complex<double>;

constexpr double nu = 0.25;

PlaneKernel<double> plane(double aspect) {
    return PlaneKernel<double>::longitudinal(Contact::dimensionless(aspect, nu));
}

double largest_error(const RollingSystem<double>& system) {
    const FrequencySweep sweep(system);
    double error = 0;
    for (double z = 5; z > 1e-3; z /= 1.15) {
        const Response<Complex> point = sweep(z);
        CHECK(point.status == Status::ok);
        error = std::max(error, std::abs(point.c11() / reference::plane_c11({0, z}, nu, 1000) - 1.0));
    }
    return error;
}

TEST_CASE("The cosine mesh is of second order at every frequency", "[frequency]") {
    const Collocation scheme{.alpha_L = 0.5, .alpha_T = 0.5};
    const auto error = [&](double n) {
        return largest_error(rolling_system(cosine_mesh(static_cast<Eigen::Index>(n)), scheme, plane(1000)));
    };
    CHECK(error(60) < 3e-4);
    const std::vector<double> sizes{80, 160, 320};
    std::vector<double> errors;
    for (const double n : sizes) errors.push_back(error(n));
    const double order = support::observed_order(sizes, errors);
    CAPTURE(order);
    CHECK(order > 1.85);
    CHECK(order < 2.15);
}

TEST_CASE("A sweep reports a scheme that does not converge to full adhesion", "[frequency]") {
    for (const double alpha : {-0.5, 0.0, 1.5}) {
        for (const Eigen::Index n : {20, 21}) {  // G' is singular for alpha = 0 and n = 21
            const auto system = rolling_system(uniform_mesh(n), Collocation{alpha, alpha}, plane(1000));
            const FrequencySweep sweep(system);
            CAPTURE(alpha, n);
            for (const double z : {1e-3, 1.0}) {
                CHECK(sweep(z).status == Status::assists_creepage);
                CHECK(solve_response(system, {0, z}).status == Status::assists_creepage);
            }
        }
    }
}

TEST_CASE("The sweep and the direct solution agree at real frequencies and at complex growth rates", "[frequency]") {
    const auto check = [](const auto& mesh, const auto& scheme, const auto& kernel) {
        const RollingSystem<double> system = rolling_system(mesh, scheme, kernel);
        const FrequencySweep sweep(system);
        REQUIRE(sweep.reduced());
        for (const Complex s :
             {Complex(0, 0), Complex(0, 1e-3), Complex(0, 1), Complex(0, -1), Complex(0, 7.3), Complex(0, 60),
              Complex(0, 1e5), Complex(0, 1e300), Complex(0.3, 2), Complex(2, 0), Complex(-0.5, 1)}) {
            const Response<Complex> full = solve_response(system, s);
            const Response<Complex> point = sweep.at(s);
            CAPTURE(mesh.size(), s, std::abs(point.c11() / full.coefficients(0, 0) - 1.0), point.residual,
                    full.residual);
            CHECK(full.status == Status::ok);
            CHECK(point.status == Status::ok);
            // at frequencies that the mesh cannot resolve the matrix tends to G, which is nearly singular for both
            const double rounding = std::abs(s) > 100 ? 10 * std::numeric_limits<double>::epsilon() / full.rcond : 0;
            CHECK(std::abs(point.c11() / full.coefficients(0, 0) - 1.0) < std::max(1e-12, rounding));
            // both condition numbers, of different matrices, bound the difference and stay close to each other
            CHECK(std::abs(point.c11() / full.coefficients(0, 0) - 1.0) <
                  100 * std::numeric_limits<double>::epsilon() / point.rcond);
            CHECK(point.rcond < 300 * full.rcond);
            CHECK(point.rcond > full.rcond / 300);
            // the residual of Eq. (16), independent of the header under test
            const VectorX<Complex> left =
                system.G_prime() * full.unknowns.col(0) - s * (system.G() * full.unknowns.col(0)).eval();
            const double size = (system.G_prime().cwiseAbs() * full.unknowns.col(0).cwiseAbs() +
                                 std::abs(s) * (system.G().cwiseAbs() * full.unknowns.col(0).cwiseAbs()))
                                    .maxCoeff();
            CHECK((left.array() - 1.0).abs().maxCoeff() < 1e-13 * (size + 1));
        }
    };
    for (const int n : {2, 3, 20, 60, 200}) check(uniform_mesh(n), Collocation{0, 0.63}, plane(1000));
    check(uniform_mesh(1), Collocation{.alpha_L = 0.5, .alpha_T = 0.5}, plane(1000));
    check(cosine_mesh(60), Collocation{.alpha_L = 0.5, .alpha_T = 0.5}, plane(1000));
    check(geometric_mesh(40, 2.0), Galerkin{0, 0.63}, StripKernel<double>(1, 1 - nu, nu));
    check(uniform_mesh(40), KnotheBoundary{}, plane(100));
}

TEST_CASE("A sweep solves by LU where G' is nearly singular", "[frequency]") {
    const auto mesh = uniform_mesh(40);
    const Collocation scheme{.alpha_L = 0, .alpha_T = 1.35};
    const RollingSystem<double> system = rolling_system(mesh, scheme, plane(1000));
    const FrequencySweep sweep(system);
    CHECK_FALSE(sweep.reduced());
    CHECK(sweep(1.0).c11() == solve_response(system, {0, 1.0}).c11());
    MatrixX<double> singular = system.G_prime();
    singular.row(1) = singular.row(0);
    CHECK(FrequencySweep(ElementSystem<double>(system.G(), singular, mesh.widths()))(0.0).status != Status::ok);
}

TEST_CASE("The sweep and the direct solution report a frequency at which the equations are singular", "[frequency]") {
    // (G' - s G) has the entries eps and 2, in either order
    const ArrayX<double> two = ArrayX<double>::Ones(2);
    const Complex s = 1 + std::numeric_limits<double>::epsilon();
    for (const Eigen::Vector2d& entries : {Eigen::Vector2d(-1, -3), Eigen::Vector2d(-3, -1)}) {
        const RollingSystem<double> system(entries.asDiagonal(), -MatrixX<double>::Identity(2, 2), two);
        const FrequencySweep sweep(system);
        REQUIRE(sweep.reduced());
        CHECK(sweep.at(s).status == Status::ill_conditioned);
        CHECK(solve_response(system, s).status == Status::ill_conditioned);
        CHECK(sweep.at(1.5).status == Status::ok);
        CHECK(solve_response(system, 1.5).status == Status::ok);
    }
}

TEST_CASE("A sweep handles a zero pivot", "[frequency]") {
    // I - s H = [.5 -.25; -.25 0]
    const ArrayX<double> two = ArrayX<double>::Ones(2);
    const RollingSystem<double> system(-Eigen::Matrix2d{{0.5, 0.25}, {0.25, 1}}, -MatrixX<double>::Identity(2, 2), two);
    const FrequencySweep sweep(system);
    REQUIRE(sweep.reduced());
    const Response<Complex> point = sweep.at(1.0);
    const Response<Complex> full = solve_response(system, 1.0);
    REQUIRE(full.status == Status::ok);
    CHECK(point.status == Status::ok);
    CHECK(std::abs(point.c11() / full.coefficients(0, 0) - 1.0) < 1e-14);
}

TEST_CASE("Two equal equations are detected at any frequency", "[frequency]") {
    // an estimate of the inverse from a few vectors would give a condition number of 4
    const ArrayX<double> three = ArrayX<double>::Ones(3);
    const RollingSystem<double> system(Eigen::Matrix3d{{2, 1, 1}, {1, 2, 1}, {1, 2, 1}},
                                       Eigen::Matrix3d{{-7, 14, 7}, {20, 10, 0}, {20, 10, 0}} / 80, three);
    const FrequencySweep sweep(system);
    CHECK_FALSE(sweep.reduced());
    CHECK(sweep(0).status == Status::ill_conditioned);
    CHECK(solve_response(system, {0, 0}).status == Status::ill_conditioned);
    CHECK(solve_response(system, {0, 0}).rcond == 0);
    CHECK(solve_steady<double>(system.G_prime(), three).status == Status::ill_conditioned);
}

}  // namespace
}  // namespace frequency_tests
