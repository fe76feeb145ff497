// rollbem/adhesion/transient.hpp on contact patches: the response to a step of creepage and spin.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <rollbem/adhesion/balanced_reduction.hpp>
#include <rollbem/adhesion/stability.hpp>
#include <rollbem/adhesion/state_space.hpp>
#include <rollbem/line.hpp>
#include <rollbem/patch.hpp>

#include "support/catch.hpp"
#include "support/dense.hpp"

namespace patch_transient_tests {

using namespace rollbem;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr NodeDifference chebyshev{Nodes::chebyshev};
constexpr double a = 5e-3, G = 8e10, nu = 0.28;

struct Patch {
    PatchContact contact;
    PatchMesh<double> mesh;
    ElementSystem<double, 2> system;
    StabilityVerdict verdict;  ///< by halves
};

Patch ellipse(double b, Eigen::Index n) {
    const PatchContact contact({.half_length = a, .half_width = b, .shear_modulus = G, .poisson_ratio = nu});
    const PatchMesh<double> mesh = patch_mesh(contact, n, n);
    const HalfSpace<double> kernel(nu);
    return {contact, mesh, rolling_system(mesh, chebyshev, kernel),
            judge_stability(patch_subsystems(mesh, chebyshev, kernel))};
}

/// The force at each distance, in steps of dq after a step of creepage from rest.
std::vector<TangentialForce> step_response(const AdhesionModel<2>& model, const Creepage& creepage, double dq,
                                           const std::vector<double>& distances) {
    Run run(model);
    std::vector<TangentialForce> forces;
    int done = 0;
    for (const double distance : distances) {
        AdhesionModel<2>::Step step;
        for (; done < std::lround(distance / dq); ++done) {
            step = run.advance({dq, creepage});
            REQUIRE(step.status == Status::ok);
        }
        forces.push_back(step.force);
    }
    return forces;
}

}  // namespace

TEST_CASE("patch_transient: a step of each creepage and of spin, up to steady rolling") {
    const Patch circle = ellipse(a, 12);
    const AdhesionModel model(circle.contact, circle.system, circle.verdict);
    const std::vector<double> distances{0.5 * a, a, 2 * a, 4 * a, 20 * a};
    // limits of small elements and steps, extrapolated
    constexpr std::array limits{std::array{1.073, 1.961, 3.162, 3.981}, std::array{1.062, 1.921, 3.006, 3.588},
                                std::array{1.021, 1.472, 1.383, 1.223}};
    constexpr double xi = 1e-3, eta = -2e-3, phi = 0.4;  // each causes forces of its own sign
    const auto by_xi = step_response(model, {xi, 0, 0}, 0.05 * a, distances);
    const auto by_eta = step_response(model, {0, eta, 0}, 0.05 * a, distances);
    const auto by_phi = step_response(model, {0, 0, phi}, 0.05 * a, distances);
    const auto all = step_response(model, {xi, eta, phi}, 0.05 * a, distances);
    const auto c11 = [](const auto& force) { return -force.longitudinal / (G * a * a * xi); };
    const auto c22 = [](const auto& force) { return -force.lateral / (G * a * a * eta); };
    const auto c33 = [](const auto& force) { return -force.moment / (G * a * a * a * a * phi); };
    for (std::size_t k = 0; k < 4; ++k) {
        INFO("q/a " << distances[k] / a);
        CHECK_THAT(c11(by_xi[k]), WithinRel(limits[0][k], 1.5e-2));
        CHECK_THAT(c22(by_eta[k]), WithinRel(limits[1][k], 1.5e-2));
        CHECK_THAT(c33(by_phi[k]), WithinRel(limits[2][k], 1.5e-2));
        CHECK_THAT(all[k].longitudinal, WithinRel(by_xi[k].longitudinal, 1e-10));
        CHECK_THAT(all[k].lateral, WithinRel(by_eta[k].lateral + by_phi[k].lateral, 1e-10));
        CHECK_THAT(all[k].moment, WithinRel(by_eta[k].moment + by_phi[k].moment, 1e-10));
    }
    const auto steady = solve_steady(circle.contact, circle.mesh, chebyshev);
    const TangentialForce reached = creep_force(circle.contact, steady, {xi, eta, phi});
    CHECK_THAT(all.back().longitudinal, WithinRel(reached.longitudinal, 1e-6));
    CHECK_THAT(all.back().lateral, WithinRel(reached.lateral, 1e-6));
    CHECK_THAT(all.back().moment, WithinRel(reached.moment, 1e-6));
    const TangentialForce at_once = model.force(model.steady({xi, eta, phi}));
    CHECK_THAT(at_once.longitudinal, WithinRel(reached.longitudinal, 1e-10));
    CHECK_THAT(at_once.moment, WithinRel(reached.moment, 1e-10));
}

TEST_CASE("patch_transient: the state space in SI units settles at the steady forces") {
    const Patch longer = ellipse(a / 2, 6);
    const StateSpace space = in_si(state_space(longer.system.joined()), longer.contact, 30);
    const MatrixX<double> gains = space.D - space.C * space.A.lu().solve(space.B);
    const auto steady = solve_steady(longer.contact, longer.mesh, chebyshev);
    for (const auto& [xi, eta, phi] : {Creepage{1e-3, 0, 0}, {0, -2e-3, 0}, {0, 0, 0.4}, {1e-3, -2e-3, 0.4}}) {
        const VectorX<double> settled = gains * Eigen::Vector3d(xi, eta, phi);
        const TangentialForce expected = creep_force(longer.contact, steady, {xi, eta, phi});
        CHECK_THAT(settled[0], WithinRel(expected.longitudinal, 1e-9) || WithinAbs(0, 1e-9));
        CHECK_THAT(settled[1], WithinRel(expected.lateral, 1e-9) || WithinAbs(0, 1e-9));
        CHECK_THAT(settled[2], WithinRel(expected.moment, 1e-9) || WithinAbs(0, 1e-12));
    }
    // in the time domain: the first millimetre after a step of spin, by the series of exp(A t)
    const Creepage turned{0, 0, 0.4};
    const AdhesionModel model(longer.contact, longer.system, unchecked, Integrator::matrix_exponential);
    const TangentialForce rolled = step_response(model, turned, 1e-3, {1e-3}).back();
    VectorX<double> term = space.B.col(2) * turned.spin * (1e-3 / 30), x = term;
    for (int k = 2; k < 200; ++k) x += term = space.A * term * (1e-3 / 30 / k);
    CHECK_THAT((space.C * x)[2], WithinRel(rolled.moment, 1e-8));
    CHECK_THROWS_WITH(in_si(StateSpace{space.A, space.B.leftCols(2), space.C, space.D}, longer.contact, 30),
                      Catch::Matchers::ContainsSubstring("number of inputs = 2 must be 1, or 3 with spin"));
}

TEST_CASE("patch_transient: 14 balanced states are the patch") {
    // 0.14, 0.12, 0.16 % of 12 x 12 elements at a/b = 0.5, 1, 2
    for (const double b : {2 * a, a, a / 2}) {
        const RollingSystem<double> whole = ellipse(b, 8).system.joined();
        const BalancedReduction reduced = balanced_reduction(state_space(whole), 14);
        REQUIRE(reduced.status == Status::ok);
        const FrequencySweep sweep(whole);
        const double steady = sweep(0).coefficients.cwiseAbs().maxCoeff();
        const auto difference = [&](double z) {
            return (dense::transfer(reduced.space, {0, z}) - sweep(z).coefficients).cwiseAbs().maxCoeff();
        };
        CHECK(difference(0) < 1e-10 * steady);
        double largest = 0;
        for (double z = 0.1; z <= 10; z += 0.3) largest = std::max(largest, difference(z));
        INFO("b/a " << b / a << ", largest " << largest / steady);
        CHECK(largest < 2e-3 * steady);
        CHECK(largest > 2e-4 * steady);
        CHECK(largest < reduced.error_bound);
    }
}

}  // namespace patch_transient_tests
