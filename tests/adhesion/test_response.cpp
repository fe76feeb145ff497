// Tests of adhesion/response.hpp, and of several inputs through the sweep, the state space and element_blocks.hpp.
#include <algorithm>
#include <complex>

#include <rollbem/adhesion/state_space.hpp>
#include <rollbem/line.hpp>

#include "support/catch.hpp"
#include "support/dense.hpp"
#include "support/refusal.hpp"

namespace response_tests {

namespace {

using namespace rollbem;
using Complex = std::complex<double>;

struct Both {
    Contact contact = Contact::dimensionless(20, 0.28);
    Mesh<double> mesh = cosine_mesh<double>(16);
    ElementSystem<double> longitudinal =
        rolling_system(mesh, Collocation{}, StripKernel<double>::longitudinal(contact));
    ElementSystem<double> lateral = rolling_system(mesh, Collocation{}, StripKernel<double>::lateral(contact));
    RollingSystem<double> whole = ElementSystem(longitudinal, lateral).joined();
};

}  // namespace

TEST_CASE("both directions of a line as one system have the coefficients of each") {
    const Both both;
    const Response<double> steady = solve_steady(both.whole);
    REQUIRE(steady.status == Status::ok);
    REQUIRE(steady.coefficients.rows() == 3);
    CHECK(steady.coefficients(0, 0) == Approx(solve_steady(both.longitudinal).c11()).epsilon(1e-13));
    CHECK(steady.coefficients(1, 1) == Approx(solve_steady(both.lateral).c11()).epsilon(1e-13));
    CHECK(steady.coefficients(0, 1) == 0);
    CHECK(steady.coefficients(2, 0) == 0);
    // by spin the rigid slip is x: of Carter's problem c23 = pi/4, and by lateral creepage the moment is -pi/4 (plane)
    CHECK(steady.coefficients(1, 2) == Approx(std::acos(-1.0) / 4).epsilon(0.03));
    CHECK(steady.coefficients(2, 1) == Approx(-std::acos(-1.0) / 4).epsilon(0.03));
}

TEST_CASE("a sweep, the response and the state space agree for three inputs") {
    const Both both;
    const FrequencySweep sweep(both.whole);
    REQUIRE(sweep.reduced());
    const StateSpace states = state_space(both.whole);
    for (const double z : {0.0, 0.3, 2.0, 30.0}) {
        const Response<Complex> point = sweep(z);
        const Response<Complex> response = solve_response(both.whole, {0, z});
        REQUIRE(point.status == Status::ok);
        REQUIRE(response.status == Status::ok);
        const double scale = response.coefficients.cwiseAbs().maxCoeff();
        CHECK((point.coefficients - response.coefficients).cwiseAbs().maxCoeff() < 1e-12 * scale);
        CHECK(std::abs(point.c11() - solve_response(both.longitudinal, {0, z}).c11()) < 1e-12 * scale);
        const MatrixX<Complex> by_states = dense::transfer(states, {0, z});
        CHECK((by_states - response.coefficients).cwiseAbs().maxCoeff() < 1e-11 * scale);
    }
}

TEST_CASE("a sweep of independent parts has the coefficients of the whole and the worse of both numbers") {
    const Both both;
    const FrequencySweep whole(both.whole);
    const FrequencySweep parts({both.longitudinal, both.lateral.with_spin()});
    const FrequencySweep along(both.longitudinal), across(both.lateral.with_spin());
    for (const double z : {0.0, 0.3, 30.0}) {
        const Response<Complex> point = parts(z);
        REQUIRE(point.status == Status::ok);
        CHECK((point.coefficients - whole(z).coefficients).cwiseAbs().maxCoeff() < 1e-12);
        CHECK((z == 0 || point.residual > 0));  // the reduced equations of steady rolling are solved as they stand
        CHECK(point.rcond == std::min(along(z).rcond, across(z).rcond));
        CHECK(point.residual == std::max(along(z).residual, across(z).residual));
    }
    // one part that cannot be trusted spoils the whole
    const auto singular = rolling_system(cosine_mesh<double>(16), Collocation{.alpha_L = -0.5, .alpha_T = -0.5},
                                         PlaneKernel<double>::longitudinal(both.contact));
    CHECK(FrequencySweep({singular, both.lateral})(1).status == Status::assists_creepage);
}

TEST_CASE("systems of both directions are checked") {
    const Both both;
    const auto shorter =
        rolling_system(cosine_mesh<double>(15), Collocation{}, PlaneKernel<double>::lateral(both.contact));
    CHECK(refusal([&] { ElementSystem(both.longitudinal, shorter); }) ==
          "ElementSystem: number of lateral elements = 15 must equal the number of longitudinal ones");
    ElementSystem<double, 2>::Blocks G, G_prime;
    for (std::size_t d = 0; d < 2; ++d) {
        G[d][d] = both.longitudinal.G();
        G_prime[d][d] = both.longitudinal.G_prime();
    }
    CHECK_NOTHROW(ElementSystem<double, 2>(G, G_prime, both.longitudinal.elements()));
    G[0][1] = G[1][0] = both.longitudinal.G();
    CHECK(refusal([&] { ElementSystem<double, 2>(G, G_prime, both.longitudinal.elements()); }) ==
          "ElementSystem: number of rows of G_xy = 16 must be the number of rows of G_prime_xy");
    Elements<double> odd = both.longitudinal.elements();
    odd.behind[3] = 16;
    G[0][1] = G[1][0] = {};
    CHECK(refusal([&] { ElementSystem<double, 2>(G, G_prime, odd); }) ==
          "ElementSystem: equation behind = 16 must be the index of another element, or -1");
}

}  // namespace response_tests
