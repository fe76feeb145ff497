// rollbem/adhesion/state_space.hpp
#include <cmath>
#include <complex>
#include <limits>

#include <rollbem/line.hpp>

#include "support/catch.hpp"
#include "support/dense.hpp"

namespace state_space_tests {
namespace {

using namespace rollbem;
using Complex = std::complex<double>;
using Catch::Matchers::ContainsSubstring;

const PlaneKernel<double> plane(100, 0.75, 0.25);

// C (s I - A)^-1 B + D
Complex response(const StateSpace& space, Complex s) { return dense::transfer(space, s)(0, 0); }

double relative_error(Complex value, Complex exact) { return std::abs(value / exact - 1.0); }

TEST_CASE("A state space has the frequency response of its system", "[state_space]") {
    const auto check = [](const RollingSystem<double>& system, double tolerance) {
        const StateSpace space = state_space(system);
        for (const double z : {0.0, 0.3, 4.0}) {
            CAPTURE(system.size(), z);
            CHECK(relative_error(response(space, Complex(0, z)), solve_response(system, {0, z}).c11()) < tolerance);
        }
    };
    check(rolling_system(cosine_mesh(1), Collocation{}, plane), 1e-14);
    check(rolling_system(cosine_mesh(40), Collocation{}, plane), 1e-12);
    check(rolling_system(uniform_mesh(20), Collocation{0, 0.63}, StripKernel<double>(0.5, 0.75, 0.25)), 1e-10);
    check(rolling_system(Chebyshev{24}, plane), 1e-13);
}

// C x(q) under constant creepage from rest, by the classical Runge-Kutta method
double stepped(const StateSpace& space, double end, int steps) {
    const double h = end / steps;
    Eigen::VectorXd x = Eigen::VectorXd::Zero(space.A.rows());
    const auto rate = [&](const Eigen::VectorXd& at) -> Eigen::VectorXd { return space.A * at + space.B; };
    for (int k = 0; k < steps; ++k) {
        const Eigen::VectorXd k1 = rate(x), k2 = rate(x + h / 2 * k1), k3 = rate(x + h / 2 * k2), k4 = rate(x + h * k3);
        x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return (space.C * x)(0, 0);
}

TEST_CASE("A state space in SI units gives the force of the time loop", "[state_space]") {
    const Contact contact({.half_length = 6e-3, .half_width = 60e-3, .shear_modulus = 8e10, .poisson_ratio = 0.28});
    const double speed = 30, creepage = 1e-4;
    const auto kernel = StripKernel<double>::longitudinal(contact);
    const Chebyshev::System<double> system = rolling_system(Chebyshev{12}, kernel);
    const StateSpace space = in_si(state_space(system), contact, speed);
    // steady: 2b times -a G c11 xi
    const double c11 = solve_steady(Chebyshev{12}, kernel).c11();
    const Complex steady = response(space, 0.0) * creepage;
    CHECK(relative_error(steady, -2 * 60e-3 * 6e-3 * 8e10 * c11 * creepage) < 1e-12);
    // at 50 Hz
    const Complex s(0, 2 * 3.14159 * 50);
    CHECK(relative_error(response(space, s) / steady * creepage,
                         solve_response(system, {0, s.imag() * 6e-3 / speed}).c11() / c11) < 1e-12);
    // after 0.4 ms
    const AdhesionModel<> model(contact, system, unchecked, Integrator::matrix_exponential);
    const double force = Run(model).advance({speed * 4e-4, creepage}).force;
    CHECK(std::abs(stepped(space, 4e-4, 2000) * creepage / force - 1) < 1e-9);
    CHECK(force < 0);
}

TEST_CASE("A state space rejects singular systems, infinite widths and invalid speeds", "[state_space]") {
    MatrixX<double> G = MatrixX<double>::Identity(3, 3);
    G(1, 1) = 0;
    const RollingSystem<double> singular(G, MatrixX<double>::Identity(3, 3), ArrayX<double>::Ones(3));
    CHECK_THROWS_WITH(state_space(singular), ContainsSubstring("rcond of G = 0 must exceed") &&
                                                 ContainsSubstring("singular to working precision"));
    const Contact contact = Contact::dimensionless(100, 0.25);
    // many elements with their points ahead of the centres
    const RollingSystem<double> nearly =
        rolling_system(uniform_mesh(400), Collocation{.alpha_L = 0, .alpha_T = 0.63}, plane);
    CHECK_THROWS_WITH(state_space(nearly), ContainsSubstring("rcond of G"));
    const StateSpace space = state_space(Chebyshev{4}, plane);
    for (const double speed :
         {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
        CHECK_THROWS_WITH(in_si(space, contact, speed), ContainsSubstring("must be positive and finite"));
    }
    const Contact endless = Contact::dimensionless(std::numeric_limits<double>::infinity(), 0.25);
    CHECK_THROWS_WITH(in_si(space, endless, 1), ContainsSubstring("half_width = inf must be finite"));
}

TEST_CASE("What answers without delay has the units of what settles", "[state_space]") {
    StateSpace space = state_space(Chebyshev{4}, plane);
    space.D = space.C * space.A.lu().solve(space.B);  // so that nothing settles
    const StateSpace si = in_si(space, Contact({5e-3, 0.5, 8e10, 0.25}), 20);
    const double settles = (si.C * si.A.lu().solve(si.B))(0, 0);
    CHECK(si.D(0, 0) == Approx(settles).epsilon(1e-12));
    CHECK(std::abs(settles) > 1e6);
}

}  // namespace
}  // namespace state_space_tests
