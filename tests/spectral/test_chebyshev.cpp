// rollbem/spectral/chebyshev.hpp
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <tuple>
#include <vector>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/line.hpp>
#include <rollbem/reference/bessel.hpp>

#include "extremes/drawn.hpp"
#include "support/catch.hpp"
#include "support/dense.hpp"
#include "support/exact_traction.hpp"
#include "support/observed_order.hpp"
#include "support/strip_instances.hpp"

namespace chebyshev_tests {
namespace {

using namespace rollbem;
using Complex = std::complex<double>;
using Catch::Matchers::ContainsSubstring;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double infinity = std::numeric_limits<double>::infinity();

const PlaneKernel<double> plane(100, 0.75, 0.25);

StripKernel<double> strip(double aspect, double nu = 0.28) { return {aspect, 1 - nu, nu}; }

double relative_error(Complex value, Complex exact) { return std::abs(value / exact - 1.0); }

Chebyshev::Traction<double> traction_of(const Response<double>& steady) { return {steady.unknowns.col(0)}; }

// agreement with the result of other code within 40 %
auto about(double found) { return Catch::Matchers::WithinRel(found, 0.4); }

// largest relative error of c11(z), 0 <= z <= z_max, plane kernel
double plane_error(Eigen::Index m, double z_max) {
    const FrequencySweep sweep(rolling_system(Chebyshev{m}, plane));
    double largest = 0;
    const int count = m > 100 ? 10 : 100;  // many states take long
    for (int k = 0; k <= count; ++k) {
        const double z = z_max * k / count;
        const Response<Complex> point = sweep(z);
        CHECK(point.status == Status::ok);
        largest = std::max(largest, relative_error(point.c11(), reference::plane_c11({0, z}, 0.25, 100)));
    }
    return largest;
}

TEST_CASE("Steady rolling of the plane is exact with any number of states", "[chebyshev]") {
    for (const Eigen::Index m : {1, 2, 3, 12, 200}) {
        for (const double aspect : {0.01, 1.0, 100.0, 1e12, infinity}) {
            for (const auto& [c1, c2, exact] :
                 {std::tuple(0.75, 0.25, steady_c11(0.25)), std::tuple(1.0, -0.3, std::numbers::pi / 2)}) {
                const Response<double> solution = solve_steady(Chebyshev{m}, PlaneKernel<double>(aspect, c1, c2));
                CAPTURE(m, aspect, c1);
                CHECK(solution.status == Status::ok);
                CHECK(std::abs(solution.c11() / exact - 1) <= 4 * eps);
                CHECK(solution.error_estimate() <= 1000 * eps);
                CHECK(solution.rcond > 0.2);  // for any number of states
            }
        }
        const Response<double> solution = solve_steady(Chebyshev{m}, PlaneKernel<double>(infinity, 0.75, 0.25));
        for (const double d : {1e-300, 1e-12, 0.1, 1.0, 1.9}) {
            for (const EdgeDistances<double> x : {EdgeDistances<double>{d, 2 - d}, EdgeDistances<double>{2 - d, d}}) {
                CHECK(std::abs(traction_of(solution)(x) / carter_traction(x, 0.25) - 1) < 1e-14);
            }
        }
        CHECK(traction_of(solution)(1) == 0);
        CHECK(traction_of(solution)(-1) == -infinity);
    }
}

TEST_CASE("The frequency response of the plane has the known errors", "[chebyshev]") {
    CHECK_THAT(plane_error(4, 1), about(1.0e-5));
    CHECK_THAT(plane_error(6, 1), about(1.1e-9));
    CHECK(plane_error(8, 1) < 6e-14);
    CHECK_THAT(plane_error(6, 5), about(5.3e-3));
    CHECK_THAT(plane_error(8, 5), about(1.9e-4));
    CHECK_THAT(plane_error(10, 5), about(1.7e-6));
    CHECK_THAT(plane_error(12, 5), about(5.9e-9));
    CHECK(plane_error(16, 5) < 2e-14);
    for (const Eigen::Index m : {24, 200}) CHECK(plane_error(m, 5) < 4e-15);
    CHECK(relative_error(solve_response(rolling_system(Chebyshev{400}, plane), {0, 5}).c11(),
                         reference::plane_c11({0, 5}, 0.25, 100)) < 1e-14);
    // 1/rcond of G' grows with the square of half the number of states
    CHECK(FrequencySweep(rolling_system(Chebyshev{96}, plane)).reduced());
    CHECK_FALSE(FrequencySweep(rolling_system(Chebyshev{200}, plane)).reduced());
}

double nearest(const VectorX<Complex>& values, Complex exact) { return (values.array() - exact).abs().minCoeff(); }

TEST_CASE("Eigenvalues of Chebyshev states converge to the exact ones and are stable", "[chebyshev]") {
    const std::vector<Complex> exact = reference::eigenvalues(3, 0.25, 100);
    const auto error = [&](Eigen::Index m, std::size_t k) {
        return nearest(solve_stability(rolling_system(Chebyshev{m}, plane)).eigenvalues(), exact[k]);
    };
    CHECK_THAT(error(4, 0) / std::abs(exact[0]), about(3e-10));
    CHECK(error(6, 0) < 1e-14);
    CHECK_THAT(error(12, 1), about(2.5e-11));
    CHECK(error(16, 1) < 1e-12);
    CHECK_THAT(error(16, 2), about(6.7e-10));
    CHECK(error(24, 2) < 1e-11);
    CHECK(error(200, 0) < 1e-11);
    CHECK(judge_stability(rolling_system(Chebyshev{200}, plane)).stable());
    for (Eigen::Index m = 1; m <= 96; m += m < 24 ? 1 : 12) {
        for (const bool wide : {true, false}) {
            const StabilityVerdict found =
                judge_stability(wide ? rolling_system(Chebyshev{m}, plane) : rolling_system(Chebyshev{m}, strip(0.5)));
            CAPTURE(m, wide, found.spectral_abscissa, found.uncertain_count);
            CHECK(found.stable());
        }
    }
}

TEST_CASE("The system of states is well-conditioned, and its slopes are the displacements of its rates",
          "[chebyshev]") {
    for (const Eigen::Index m : {1, 2, 12, 64}) {
        const Chebyshev::System<double> system = rolling_system(Chebyshev{m}, plane);
        const MatrixX<double> inverse = dense::solve(system.G(), MatrixX<double>::Identity(m, m));
        const double condition = dense::largest_singular_value(system.G()) * dense::largest_singular_value(inverse);
        CHECK(condition == Approx(m == 1 ? 1 : std::numbers::sqrt2).epsilon(1e-12));
        CHECK((dense::product(system.G(), system.rates()) - system.G_prime()).cwiseAbs().maxCoeff() <
              1e-13 * system.G_prime().cwiseAbs().maxCoeff());
    }
}

TEST_CASE("The error estimate of steady rolling bounds the error on narrow strips", "[chebyshev]") {
    const double exact = solve_steady(Chebyshev{400}, strip(0.02)).c11();
    CHECK(std::abs(exact / reference::strip_c11(0, 0.28, 0.02).c11.real() - 1) < 1e-11);
    for (const Eigen::Index m : {1, 2, 3, 5, 8, 12, 20, 40, 80, 160}) {
        const Response<double> solution = solve_steady(Chebyshev{m}, strip(0.02));
        const double error = std::abs(solution.c11() / exact - 1);
        CAPTURE(m, error, solution.error_estimate());
        CHECK(error <= solution.error_estimate());
        CHECK(solution.error_estimate() < 30 * error);
        CHECK(solution.status == (m < 20 ? Status::not_converged : Status::ok));
    }
}

TEST_CASE("Tractions of harmonic creepage follow from the states", "[chebyshev]") {
    const Chebyshev::System<double> system = rolling_system(Chebyshev{24}, plane);
    for (const double z : {0.0, 0.5, 5.0}) {
        const Chebyshev::Traction<Complex> traction =
            system.traction<Complex>(solve_response(system, {0, z}).unknowns.col(0));
        const reference::ExactTraction exact(Complex(0, z), 0.25, 100);
        CHECK(std::abs(traction.coefficients.sum()) < 1e-13);
        for (const double x : {-1 + 1e-9, -0.9, -0.3, 0.0, 0.2, 0.99, 1 - 1e-9}) {
            CAPTURE(z, x);
            CHECK(relative_error(traction(x), exact(x)) < 1e-12);
        }
        CHECK(traction(1.0) == Complex(0));
    }
}

double quadrature_error(const StripKernel<double>& kernel, Eigen::Index m, Eigen::Index points) {
    const MatrixX<double> fine = detail::smooth_compliance(kernel, m, 3 * points + 50);
    return (detail::smooth_compliance(kernel, m, points) - fine).cwiseAbs().maxCoeff() / fine.cwiseAbs().maxCoeff();
}

TEST_CASE("The number of quadrature points is just enough for round-off in the smooth part", "[chebyshev]") {
    for (const double aspect : {0.05, 0.3, 1.0, 10.0, 1000.0}) {
        for (const Eigen::Index m : {1, 2, 12, 60}) {
            const Eigen::Index points = detail::smooth_quadrature_points(m, aspect);
            CAPTURE(aspect, m, points);
            CHECK(quadrature_error(strip(aspect), m, points) < 50 * eps);
            const Eigen::Index less = (m + points) / 3;
            if (less > m) CHECK(quadrature_error(strip(aspect), m, less) > 50 * eps);
        }
    }
    CHECK(detail::smooth_quadrature_points<double>(12, infinity) == 13);
}

#ifdef ROLLBEM_SLOW_CHECKS
TEST_CASE("Steady states in long double have its digits", "[chebyshev]") {
    const auto c11 = [](Eigen::Index m, const auto& kernel) {
        const Response<long double> steady = solve_steady(Chebyshev{m}, kernel);
        CHECK(steady.status == Status::ok);
        return steady.c11();
    };
    constexpr long double rounding = std::numeric_limits<long double>::epsilon();
    for (const Eigen::Index m : {1, 2, 3, 200}) {
        CHECK(std::abs(c11(m, PlaneKernel<long double>(100, 0.75L, 0.25L)) / steady_c11(0.25L) - 1) <= 4 * rounding);
    }
    const double narrow = solve_steady(Chebyshev{64}, StripKernel<double>(0.5, 0.75, 0.25)).c11();
    CHECK(static_cast<double>(c11(64, StripKernel<long double>(0.5L, 0.75L, 0.25L)) / narrow - 1) ==
          Approx(0).margin(30 * eps));
}
#endif

TEST_CASE("Chebyshev states of random contacts are stable and within their error estimate", "[chebyshev]") {
    drawn::Draw draw(20181);
    for (int scene = 0; scene < 100; ++scene) {
        const double nu = draw.uniform(0, 1) / 2, aspect = std::pow(10.0, -1 + 4 * draw.uniform(0, 1));
        const Eigen::Index m = 1 + static_cast<Eigen::Index>(40 * draw.uniform(0, 1) * draw.uniform(0, 1));
        const bool lateral = draw.uniform(0, 1) < 0.3;
        const StripKernel<double> kernel = lateral ? StripKernel<double>(aspect, 1, -nu) : strip(aspect, nu);
        const double z = 3 * draw.uniform(0, 1);
        const Chebyshev::System<double> system = rolling_system(Chebyshev{m}, kernel);
        CAPTURE(scene, nu, aspect, m, lateral, z);
        CHECK(judge_stability(system).stable());
        CHECK(relative_error(solve_response(system, {0, -z}).c11(), std::conj(solve_response(system, {0, z}).c11())) <
              1e-13);
        const Response<double> steady = solve_steady(Chebyshev{m}, kernel);
        const Response<Complex> slow = solve_response(system, {0, 0});
        CHECK(relative_error(slow.c11(), steady.c11()) < 1e-11);
        CHECK((system.traction<Complex>(slow.unknowns.col(0)).coefficients - steady.unknowns.col(0).cast<Complex>())
                  .cwiseAbs()
                  .maxCoeff() < 1e-10);
        CHECK(traction_of(steady)(1) == 0);
        const double exact =
            lateral ? solve_steady(Chebyshev{250}, kernel).c11() : reference::strip_c11(0, nu, aspect).c11.real();
        CHECK(std::abs(steady.c11() / exact - 1) <= steady.error_estimate() + 1e-12);
        CHECK((steady.status == Status::ok) == (steady.error_estimate() <= 1e-2));
        if (lateral) continue;
        const Complex fine = solve_response(rolling_system(Chebyshev{m + 40}, kernel), {0, z}).c11();
        CHECK(relative_error(fine, reference::strip_c11(Complex(0, z), nu, aspect).c11) < (aspect > 1 ? 1e-11 : 1e-4));
    }
}

const PlaneKernel<double> lateral_plane(100, 1, -0.28);

TEST_CASE("States under spin have the closed form of steady rolling", "[chebyshev]") {
    const double pi = std::numbers::pi;
    for (const Eigen::Index m : {2, 3, 12, 60}) {
        const auto system = rolling_system(Chebyshev{m}, lateral_plane);
        const Response<double> steady = solve_steady(system.with_spin());
        CAPTURE(m, steady.coefficients);
        REQUIRE(steady.status == Status::ok);
        CHECK(std::abs(steady.coefficients(0, 0) - pi / 2) < 1e-13);  // by lateral creepage
        CHECK(std::abs(steady.coefficients(1, 0) + pi / 4) < 1e-13);
        CHECK(std::abs(steady.coefficients(0, 1) - pi / 4) < 1e-13);  // by spin
        CHECK(std::abs(steady.coefficients(1, 1)) < 1e-13);
        for (const double x : {-0.9, 0.0, 0.7}) {
            const double traction = system.traction(VectorX<double>(steady.unknowns.col(1)))(x);
            CHECK(std::abs(traction + std::sqrt(1 - x * x) / 2) < 1e-13);
        }
        const StateSpace states = state_space(system.with_spin());
        CHECK((states.B.col(0) + VectorX<double>::Unit(m, 0)).cwiseAbs().maxCoeff() < 1e-14);
        CHECK((states.B.col(1) + VectorX<double>::Unit(m, 1)).cwiseAbs().maxCoeff() < 1e-14);
    }
}

TEST_CASE("Under harmonic spin elements tend to states, and force and moment are reciprocal", "[chebyshev]") {
    const StripKernel<double> kernel(10.0, 1.0, -0.28);
    const RollingSystem<double> states = rolling_system(Chebyshev{24}, kernel).with_spin();
    for (const double z : {0.0, 1.0}) {
        const auto exact = solve_response(states, {0, z}).coefficients;
        CHECK(std::abs(exact(0, 1) + exact(1, 0)) < 1e-13);
        for (const Nodes nodes : {Nodes::centres, Nodes::chebyshev}) {
            const std::vector<double> sizes{20, 40, 80};
            std::vector<double> errors;
            for (const double n : sizes) {
                const Mesh<double> mesh = cosine_mesh(static_cast<Eigen::Index>(n));
                const auto system = rolling_system(mesh, NodeDifference{nodes}, kernel).with_spin();
                errors.push_back((solve_response(system, {0, z}).coefficients - exact).cwiseAbs().maxCoeff());
            }
            CAPTURE(z, nodes == Nodes::centres, errors);
            CHECK(std::abs(support::observed_order(sizes, errors) - 2) < 0.15);
        }
    }
}

TEST_CASE("Spin needs two states, known points and kernels of one width", "[chebyshev]") {
    CHECK_THROWS_WITH(rolling_system(Chebyshev{1}, lateral_plane).with_spin(),
                      ContainsSubstring("number of states = 1 must be at least 2"));
    const auto elements = rolling_system(cosine_mesh(4), NodeDifference{}, lateral_plane);
    CHECK_THROWS_WITH(ElementSystem<double>(elements.G(), elements.G_prime(), elements.weights()).with_spin(),
                      ContainsSubstring("spin needs them"));
    const auto wider = rolling_system(Chebyshev{4}, PlaneKernel<double>(200, 0.72, 0.28));
    CHECK_THROWS_WITH(both_directions<double>(wider, rolling_system(Chebyshev{4}, lateral_plane).with_spin()),
                      ContainsSubstring("b/a of the lateral kernel = 100 must be b/a of the longitudinal kernel"));
}

TEST_CASE("Chebyshev states reject kernels and arguments out of their domain", "[chebyshev]") {
    const PlaneKernel<double> endless(infinity, 0.75, 0.25);
    CHECK_THROWS_WITH(rolling_system(Chebyshev{0}, plane), ContainsSubstring("states = 0 must be at least 1"));
    CHECK_THROWS_WITH(solve_steady(Chebyshev{-3}, plane), ContainsSubstring("states = -3 must be at least 1"));
    CHECK_THROWS_WITH(rolling_system(Chebyshev{100000}, plane), ContainsSubstring("states = 100000 must be at most"));
    CHECK_THROWS_WITH(rolling_system(Chebyshev{}, endless),
                      ContainsSubstring("an infinite half-width is for steady problems only"));
    CHECK_THROWS_WITH(rolling_system(Chebyshev{}, strip(infinity)),
                      ContainsSubstring("an infinite half-width is for steady problems only"));
    CHECK_THROWS_WITH(rolling_system(Chebyshev{}, PlaneKernel<double>(0.1, 0.75, 0.25)),
                      ContainsSubstring("use the strip kernel"));
    CHECK_THROWS_WITH(rolling_system(Chebyshev{}, strip(5e-4)),
                      ContainsSubstring("use elements for so narrow a strip"));
    CHECK_THROWS_WITH(solve_steady(Chebyshev{}, StripKernel<double>(1, -0.5, 0.2)), ContainsSubstring("strength"));
    const Chebyshev::System<double> system = rolling_system(Chebyshev{8}, plane);
    CHECK_THROWS_WITH(system.traction(VectorX<double>::Zero(7).eval()),
                      ContainsSubstring("number of unknowns = 7 must equal"));
    const Chebyshev::Traction<double> traction = system.traction(VectorX<double>::Ones(8).eval());
    for (const double x : {-1.1, 1 + 1e-15, infinity, std::numeric_limits<double>::quiet_NaN()}) {
        CHECK_THROWS_WITH(traction(x), ContainsSubstring("must lie in [-1, 1]"));
    }
    CHECK_THROWS_WITH(traction({-0.5, 2.5}), ContainsSubstring("trailing = -0.5 must be at least 0"));
    CHECK_THROWS_WITH(traction({1, 1.5}), ContainsSubstring("must be 2"));
    CHECK(system.aspect() == 100);
    CHECK_FALSE(system.unknowns_are_tractions());
    CHECK_THROWS_WITH(AdhesionModel<>(Contact::dimensionless(50, 0.25), system, unchecked),
                      ContainsSubstring("b/a of the kernel"));
}

}  // namespace
}  // namespace chebyshev_tests
