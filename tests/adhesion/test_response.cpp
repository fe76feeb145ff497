// Tests of adhesion/response.hpp, and of several inputs through the sweep, the state space and element_blocks.hpp.
#include <complex>
#include <stdexcept>

#include <Eigen/LU>

#include <rollbem/adhesion/response.hpp>
#include <rollbem/adhesion/state_space.hpp>
#include <rollbem/adhesion/steady.hpp>
#include <rollbem/compiled/frequency.hpp>
#include <rollbem/system/element_blocks.hpp>

#include "support/catch.hpp"
#include "support/dense.hpp"
#include "support/refusal.hpp"

namespace response_tests {

namespace {

using namespace rollbem;
using Complex = std::complex<double>;

struct Both {
    Contact<double> contact = Contact<double>::dimensionless(20, 0.28);
    Mesh<double> mesh = cosine_mesh<double>(16);
    ElementSystem<double> longitudinal =
        rolling_system(mesh, Collocation{}, StripKernel<double>::longitudinal(contact));
    ElementSystem<double> lateral = rolling_system(mesh, Collocation{}, StripKernel<double>::lateral(contact));
    RollingSystem<double> whole = ElementSystem(longitudinal, lateral).whole();
};

}  // namespace

TEST_CASE("both directions of a line as one system have the coefficients of each") {
    const Both both;
    const Response<double> steady = solve_steady_response(both.whole);
    REQUIRE(steady.status == Status::ok);
    REQUIRE(steady.coefficients.rows() == 3);
    CHECK(steady.coefficients(0, 0) == Approx(solve_steady(both.longitudinal).c11).epsilon(1e-13));
    CHECK(steady.coefficients(1, 1) == Approx(solve_steady(both.lateral).c11).epsilon(1e-13));
    CHECK(steady.coefficients(0, 1) == 0);
    CHECK(steady.coefficients(2, 0) == 0);
    // by spin the rigid slip is x: of Carter's problem c23 = pi/4, and by lateral creepage the moment is -pi/4 (plane)
    CHECK(steady.coefficients(1, 2) == Approx(std::acos(-1.0) / 4).epsilon(0.03));
    CHECK(steady.coefficients(2, 1) == Approx(-std::acos(-1.0) / 4).epsilon(0.03));
}

TEST_CASE("a sweep, the response and the state space agree for three inputs") {
    const Both both;
    const FrequencySweep<double> sweep(both.whole);
    REQUIRE(sweep.reduced());
    const StateSpace<double> states = state_space(both.whole);
    for (const double z : {0.0, 0.3, 2.0, 30.0}) {
        const SweepPoint<double> point = sweep(z);
        const Response<Complex> response = solve_response(both.whole, {0, z});
        REQUIRE(point.status == Status::ok);
        REQUIRE(response.status == Status::ok);
        const double scale = response.coefficients.cwiseAbs().maxCoeff();
        CHECK((point.coefficients - response.coefficients).cwiseAbs().maxCoeff() < 1e-12 * scale);
        CHECK(point.c11 == point.coefficients(0, 0));
        CHECK(std::abs(point.c11 - solve_harmonic(both.longitudinal, z).c11) < 1e-12 * scale);
        const MatrixX<Complex> by_states = dense::transfer(states, {0, z});
        CHECK((by_states - response.coefficients).cwiseAbs().maxCoeff() < 1e-11 * scale);
    }
}

TEST_CASE("what takes one creepage refuses a system of three") {
    const Both both;
    CHECK(refusal([&] { solve_steady(both.whole); }) == "solve_steady: number of inputs = 3 must be 1");
    CHECK(refusal([&] { solve_harmonic(both.whole, 0); }) == "solve_harmonic: number of inputs = 3 must be 1");
}

TEST_CASE("systems of both directions are checked") {
    const Both both;
    const auto shorter =
        rolling_system(cosine_mesh<double>(15), Collocation{}, PlaneKernel<double>::lateral(both.contact));
    CHECK(refusal([&] { ElementSystem(both.longitudinal, shorter); }) ==
          "ElementSystem: number of lateral elements = 15 must equal the number of longitudinal ones");
    DirectionBlocks<double> G, G_prime;
    for (std::size_t d = 0; d < 2; ++d) {
        G[d][d] = both.longitudinal.G();
        G_prime[d][d] = both.longitudinal.G_prime();
    }
    CHECK_NOTHROW(ElementSystem<double, 2>(G, G_prime, both.longitudinal.elements()));
    G[0][1] = G[1][0] = both.longitudinal.G();
    CHECK(refusal([&] { ElementSystem<double, 2>(G, G_prime, both.longitudinal.elements()); }) ==
          "ElementSystem: number of rows of G_xy = 16 must be that of G_prime_xy");
    Elements<double> odd = both.longitudinal.elements();
    odd.behind[3] = 16;
    G[0][1] = G[1][0] = {};
    CHECK(refusal([&] { ElementSystem<double, 2>(G, G_prime, odd); }) ==
          "ElementSystem: equation behind = 16 must be that of another element, or -1");
}

}  // namespace response_tests
