// A driven wheel in full adhesion (wheel.hpp) after a small kick to its rotation, in SI units: frequency and decay of
// the oscillation about steady rolling, against the roots of the closed loop with the exact creep coefficient c11(s).
//
//     ./examples/driven_wheel
//
//     frequency 380.27 Hz, exact 380.28 Hz (-2.21e-05)
//     decay 746.40 1/s, exact 746.65 1/s (-3.37e-04)
#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>
#include <utility>

#include <Eigen/LU>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/rollbem.hpp>

#include "wheel.hpp"

namespace {

using Complex = std::complex<double>;
using Contact = rollbem::Contact<double>;
using Model = rollbem::AdhesionModel<>;

/// The creep coefficient of the plane at s = (rate) a/V, exact to rounding.
Complex exact_c11(Complex s, const Contact& contact) {
    return rollbem::polynomial_c11<double>(s, contact.poisson_ratio(), contact.aspect()).c11;
}

/// Root of s + kappa c11(s) = 0, kappa = 2 a^2 b G (1/m + R^2/J) / V^2: the sliding speed V - R omega under the
/// contact's force; by the secant method from the root that c11 = C/(1 + (Lambda - 1/2) s) would give.
Complex closed_loop(const Wheel& wheel, const Contact& contact, double speed) {
    const double a = contact.half_length();
    const double mobility = 1 / wheel.mass + wheel.radius * wheel.radius / wheel.inertia;
    const double kappa = 2 * a * a * contact.half_width() * contact.shear_modulus() * mobility / (speed * speed);
    const auto loop = [&](Complex s) { return s + kappa * exact_c11(s, contact); };
    const double lag = rollbem::plane_lambda(contact.poisson_ratio(), contact.aspect()) - 0.5;
    const double steady = kappa * rollbem::steady_c11(contact.poisson_ratio());
    Complex old = (-1.0 + std::sqrt(Complex(1 - 4 * lag * steady))) / (2 * lag), s = old * 1.01;
    for (int k = 0; k < 50 && std::abs(s - old) > 1e-13; ++k) {
        const Complex slope = (loop(s) - loop(old)) / (s - old);
        old = s;
        s -= loop(s) / slope;
    }
    return s * speed / a;  // [1/s]
}

}  // namespace

int main() {
    // 1. The contact, with a scheme of second order that is stable on every mesh tried; the model asks for the verdict.
    const Wheel wheel;
    const Contact contact({.half_length = 6e-3, .half_width = 12e-3, .shear_modulus = 8e10, .poisson_ratio = 0.28});
    const auto system =
        rollbem::rolling_system(rollbem::cosine_mesh(40), rollbem::Collocation{.alpha_L = 0.5, .alpha_T = 0.5},
                                rollbem::PlaneKernel<double>::longitudinal(contact));
    const Model model(contact, system, rollbem::judge_stability(system));

    // 2. Steady rolling at 20 m/s: the force of the rail balances the resistance.
    const double speed = 20;
    const double slope = model.force(model.steady(1.0));  // dF/dxi
    const double steady = wheel.resistance / slope;
    const double torque = wheel.radius * wheel.resistance;  // keeps the speed
    State<Model> now{speed, speed * (1 - steady) / wheel.radius, wheel.resistance, model.steady(steady)};
    State<Model> next = now;
    Model::Workspace workspace = model.workspace();

    // 3. A kick to the rotation, and the sliding speed after it.
    const Complex expected = closed_loop(wheel, contact, speed);
    const double dt = 2 * std::numbers::pi / std::abs(expected.imag()) / 200;
    const int steps = 500;
    now.rotation *= 1 - 1e-6;
    Eigen::VectorXd sliding(steps);
    for (int k = 0; k < steps; ++k) {
        if (advance(wheel, model, torque, speed * dt, now, next, workspace).status != rollbem::StepStatus::ok) return 1;
        std::swap(now, next);
        sliding[k] = now.speed - wheel.radius * now.rotation - steady * speed;
    }

    // 4. Frequency and damping: x_{k+2h} = t x_{k+h} - d x_k by least squares, e^{2 Re(s) h dt} = d.
    const int h = 20, first = 150, count = steps - first - 2 * h;
    Eigen::MatrixX2d samples(count, 2);
    samples << sliding.segment(first + h, count), -sliding.segment(first, count);
    const Eigen::Vector2d td = samples.transpose().lazyProduct(samples).inverse() *
                               (samples.transpose() * sliding.segment(first + 2 * h, count));
    const Complex measured = std::log(td[0] / 2 + std::sqrt(Complex(td[0] * td[0] / 4 - td[1]))) / (h * dt);

    const double frequency = std::abs(measured.imag()) / std::abs(expected.imag()) - 1;
    const double damping = measured.real() / expected.real() - 1;
    std::printf("frequency %.2f Hz, exact %.2f Hz (%+.2e)\n", std::abs(measured.imag()) / (2 * std::numbers::pi),
                std::abs(expected.imag()) / (2 * std::numbers::pi), frequency);
    std::printf("decay %.2f 1/s, exact %.2f 1/s (%+.2e)\n", -measured.real(), -expected.real(), damping);
    return std::abs(frequency) < 0.01 && std::abs(damping) < 0.01 ? 0 : 1;
}
