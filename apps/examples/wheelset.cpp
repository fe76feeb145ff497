// Two wheels on an elastic axle, each on a contact in full adhesion that is eight linear differential equations, in SI
// units. The eigenvalues of the whole and its response to a torque, against the closed loop with the exact c11(s).
//
//     ./examples/wheelset
//
//     eigenvalue   -721.8996   +783.6460i 1/s, off the exact one by 7.1e-13
//     eigenvalue   -721.8996   -783.6460i 1/s, off the exact one by 7.1e-13
//     eigenvalue  -1539.6561     +0.0000i 1/s, off the exact one by 9.6e-14
//     eigenvalue  -4837.0969     +0.0000i 1/s, off the exact one by 6.3e-16
//     eigenvalue  -4934.7033     +0.0000i 1/s, off the exact one by 2.4e-14
//     rotation after 0.004 s: 0.00755786998 rad/s, off the exact one by 1.7e-14
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>

#include <Eigen/Eigenvalues>

#include <rollbem/adhesion/state_space.hpp>
#include <rollbem/reference/bessel.hpp>
#include <rollbem/reference/step_response.hpp>

namespace {

using Complex = std::complex<long double>;

// Each wheel: J d(omega)/dt = T - R F -+ k psi, d(psi)/dt = omega_1 - omega_2, about steady rolling at V; creepage
// xi = -R omega/V gives the rail force F.
struct Wheelset {
    double inertia = 60;       // J [kg m^2]
    double radius = 0.46;      // R [m]
    double stiffness = 2.5e7;  // k [N m/rad]
    double speed = 40;         // V [m/s]
};

/// States: omega_1, omega_2, psi, then those of both contacts.
Eigen::MatrixXd closed_loop(const Wheelset& w, const rollbem::StateSpaceSI<double>& contact) {
    const Eigen::Index m = contact.A.rows();
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(3 + 2 * m, 3 + 2 * m);
    for (Eigen::Index side = 0; side < 2; ++side) {
        const Eigen::Index first = 3 + side * m;
        A.block(first, first, m, m) = contact.A;
        A.block(first, side, m, 1) = -w.radius / w.speed * contact.B;
        A.block(side, first, 1, m) = -w.radius / w.inertia * contact.C;
        A(side, 2) = (side == 0 ? -w.stiffness : w.stiffness) / w.inertia;
    }
    A(2, 0) = 1;
    A(2, 1) = -1;
    return A;
}

/// T/omega at s [1/s] from the exact c11, for both wheels turning alike (axle = 0) or against each other (1).
Complex exact_loop(const Wheelset& w, const rollbem::Contact<double>& c, int axle, Complex s) {
    const long double a = c.half_length();
    const long double force = 2 * c.half_width() * a * c.shear_modulus();
    const std::complex<double> z(s * (a / w.speed));
    const Complex c11(rollbem::reference::plane_c11(z, c.poisson_ratio(), c.aspect()));
    const Complex twist = static_cast<long double>(2 * axle * w.stiffness) / s;
    return static_cast<long double>(w.inertia) * s +
           force * static_cast<long double>(w.radius * w.radius / w.speed) * c11 + twist;
}

/// The root of exact_loop near s, by the secant method.
Complex exact_eigenvalue(const Wheelset& w, const rollbem::Contact<double>& contact, int axle, Complex s) {
    Complex before = s * 1.0001L, value_before = exact_loop(w, contact, axle, before);
    for (int k = 0; k < 30; ++k) {
        const Complex value = exact_loop(w, contact, axle, s);
        if (value == value_before || std::abs(s - before) < 1e-15L * std::abs(s)) break;
        const Complex next = s - value * (s - before) / (value - value_before);
        before = s;
        value_before = value;
        s = next;
    }
    return s;
}

}  // namespace

int main() {
    // 1. The contact as dx/dt = A x + B xi, F = C x.
    const Wheelset wheelset;
    const rollbem::Contact<double> contact(
        {.half_length = 6e-3, .half_width = 6e-3, .shear_modulus = 8e10, .poisson_ratio = 0.28});
    const auto kernel = rollbem::PlaneKernel<double>::longitudinal(contact);
    const rollbem::StateSpaceSI<double> equations =
        rollbem::in_si(rollbem::state_space(rollbem::Chebyshev{.states = 8}, kernel), contact, wheelset.speed);
    const Eigen::MatrixXd A = closed_loop(wheelset, equations);

    // 2. The eigenvalues of all 19 equations that are slow compared with the passage through the contact.
    const double unit = wheelset.speed / contact.half_length();  // [1/s]
    int slow = 0;
    double largest = 0;
    const Eigen::VectorXcd eigenvalues = Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues();
    for (const std::complex<double>& s : eigenvalues) {
        if (std::abs(s) > unit || std::abs(s) < 1e-9 * unit) continue;
        double nearest = 1;
        for (const int axle : {0, 1}) {
            const Complex exact = exact_eigenvalue(wheelset, contact, axle, Complex(s));
            nearest = std::min(nearest, static_cast<double>(std::abs(Complex(s) / exact - 1.0L)));
        }
        std::printf("eigenvalue %11.4f %+11.4fi 1/s, off the exact one by %.1e\n", s.real(), s.imag(), nearest);
        largest = std::max(largest, nearest);
        ++slow;
    }

    // 3. In time: a torque on the first wheel, by the classic Runge-Kutta method.
    const double torque = 1000, end = 4e-3;  // [N m], [s]
    const int steps = 4000;
    Eigen::VectorXd x = Eigen::VectorXd::Zero(A.rows()), load = x;
    load[0] = torque / wheelset.inertia;
    const double dt = end / steps;
    const auto rate = [&](const Eigen::VectorXd& at) -> Eigen::VectorXd { return A * at + load; };
    for (int k = 0; k < steps; ++k) {
        const Eigen::VectorXd k1 = rate(x), k2 = rate(x + dt / 2 * k1), k3 = rate(x + dt / 2 * k2),
                              k4 = rate(x + dt * k3);
        x += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    const auto transform = [&](Complex s) {
        return static_cast<long double>(torque / 2) / s *
               (1.0L / exact_loop(wheelset, contact, 0, s) + 1.0L / exact_loop(wheelset, contact, 1, s));
    };
    const double exact = rollbem::reference::invert_laplace(transform, end);
    const double error = std::abs(x[0] / exact - 1);
    std::printf("rotation after %g s: %.9g rad/s, off the exact one by %.1e\n", end, x[0], error);
    return slow >= 3 && largest < 1e-8 && error < 1e-8 ? 0 : 1;
}
