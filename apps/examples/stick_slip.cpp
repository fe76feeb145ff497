// A driven wheel whose friction falls with slip, in SI units: a motor turns it through a shaft that twists. Beyond the
// peak of the creep curve the falling friction feeds a torsional vibration, which grows until the wheel sticks and
// slips by turns. A small vibration grows or decays as the slope of the steady creep curve predicts, so that the least
// damping that prevents it is known beforehand.
//
//     ./examples/stick_slip
//
//     at a slip velocity of 0.3 m/s: F/N = 0.2907, dF/d(slip velocity) = -15869 N s/m; least damping 2592.0
//     the simulated vibration neither grows nor decays at 2601.1, +0.35 % off the linear limit
#include <array>
#include <cmath>
#include <complex>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/friction/law.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/rolling/run.hpp>

namespace {

using Law = rollbem::ExponentialFall;
using Model = rollbem::FrictionModel;

// 1. Motor, shaft and wheel of a train so heavy that its speed V does not change. The shaft transmits the moment
// M = k twist + c (w_m - w): J_m d(w_m)/dt = T - M, J dw/dt = M - R F. The torque T = T_d - K (w_m - V/R) falls with
// the speed of the motor, so that the wheel does not run away on the falling branch.
constexpr double speed = 10, radius = 0.5, load = 100e3, half_width = 8e-3;  // V [m/s], R [m], N [N], b [m]
constexpr double wheel_inertia = 100, motor_inertia = 500;                   // J, J_m [kg m^2]
constexpr double stiffness = 2.5e6, droop = 6000;                            // k [N m/rad], K [N m s/rad]
constexpr Law friction_law{.mu_0 = 0.35, .mu_k = 0.2, .half_velocity = 0.4};
constexpr rollbem::Friction::Memory memory{.distance = 10e-6, .least_velocity = 1e-3};
constexpr rollbem::ElasticBody steel{2.1e11, 0.28};

double creepage(double rotation) { return 1 - radius * rotation / speed; }

Model contact_model(Eigen::Index n) {
    const rollbem::HertzLine hertz(
        {.load_per_width = load / (2 * half_width), .combined_radius = radius, .body_1 = steel, .body_2 = steel});
    const rollbem::Contact contact = hertz.contact(half_width);
    const rollbem::Mesh<double> mesh = rollbem::cosine_mesh(n);
    const auto system = rollbem::rolling_system(mesh, rollbem::NodeDifference{rollbem::Nodes::chebyshev},
                                                rollbem::PlaneKernel<double>::longitudinal(contact));
    return {contact, system, rollbem::judge_stability(system), {friction_law, hertz.mean_pressure(mesh), memory}};
}

struct State {
    double motor, wheel;  // w_m, w [rad/s]
    double twist = 0;     // [rad]
    double force = 0;     // F [N]
};

// 2. One step of the trapezoidal rule while the wheel rolls on by dq [m], by Newton's method with the tangent of the
// contact. False if the contact refuses the step or Newton's method does not converge.
bool advance(rollbem::Run<Model>& contact, double demand, double damping, double dq, State& state) {
    const State now = state;
    State& next = state;
    const double dt = dq / speed;
    for (int trial = 0; trial < 30; ++trial) {
        const auto motion = Model::Motion::linear({creepage(now.wheel)}, {creepage(next.wheel)});
        const Model::Step step = contact.try_advance({{dq, dt}, motion});
        if (step.status != rollbem::Status::ok) return false;
        next.force = step.force.longitudinal;

        const double motor = (now.motor + next.motor) / 2, wheel = (now.wheel + next.wheel) / 2;
        next.twist = now.twist + dt * (motor - wheel);
        const double moment = stiffness * (now.twist + next.twist) / 2 + damping * (motor - wheel);
        const double moment_by_motor = stiffness / 4 * dt + damping / 2;  // by the wheel: with a minus
        const double torque = demand - droop * (motor - speed / radius);
        const Eigen::Vector2d residual(
            motor_inertia * (next.motor - now.motor) - dt * (torque - moment),
            wheel_inertia * (next.wheel - now.wheel) - dt * (moment - radius * (now.force + next.force) / 2));
        const double force_by_wheel = -step.tangent.by_longitudinal.longitudinal * radius / speed;
        Eigen::Matrix2d jacobian;
        jacobian << motor_inertia + dt * (droop / 2 + moment_by_motor), -dt * moment_by_motor, -dt * moment_by_motor,
            wheel_inertia + dt * (moment_by_motor + radius * force_by_wheel / 2);
        const Eigen::Vector2d change = -jacobian.inverse() * residual;
        next.motor += change[0];
        next.wheel += change[1];
        if (change.cwiseAbs().maxCoeff() > 1e-12 * now.motor) continue;
        contact.accept();
        return true;
    }
    return false;
}

// 3. The linear limit. About steady rolling at a slip velocity the contact is the slope of its creep curve, as long as
// the vibration is slow compared with the passage of the contact, a omega/V << 1. States twist, w_m, w.
struct Mode {
    std::complex<double> rate;  // growth [1/s] and frequency [rad/s]
    Eigen::Vector3d shape;
};

Mode torsion(double slope, double damping) {  // slope: dF/d(slip velocity) [N s/m]
    const double c = damping, of_wheel = c + radius * radius * slope;
    Eigen::Matrix3d A{{0, 1, -1}, {-stiffness, -(droop + c), c}, {stiffness, c, -of_wheel}};
    A.row(1) /= motor_inertia;
    A.row(2) /= wheel_inertia;
    const Eigen::EigenSolver<Eigen::MatrixXd> solver{Eigen::MatrixXd(A)};
    Eigen::Index k = 0;
    solver.eigenvalues().imag().maxCoeff(&k);
    return {solver.eigenvalues()[k], solver.eigenvectors().col(k).real()};
}

/// The damping [N m s/rad] at which the torsional vibration neither grows nor decays; by bisection.
double least_damping(double slope) {
    double low = 0, high = 2e4;
    for (int k = 0; k < 60; ++k) {
        const double middle = (low + high) / 2;
        (torsion(slope, middle).rate.real() > 0 ? low : high) = middle;
    }
    return low;
}

// 4. The simulated contact: growth and frequency of a small vibration about steady rolling, over eight periods.
std::complex<double> simulated(rollbem::Run<Model> contact, double force, double slip_velocity, double damping,
                               const Mode& mode, double dq) {
    const double w = (speed + slip_velocity) / radius, demand = radius * force + droop * (w - speed / radius);
    const Eigen::Vector3d kick = mode.shape * (1e-5 * w / mode.shape.norm());
    State state{w + kick[1], w + kick[2], radius * force / stiffness + kick[0], force};
    const double dt = dq / speed;
    const int period = int(2 * std::numbers::pi / mode.rate.imag() / dt), steps = 8 * period;
    Eigen::VectorXd turning(steps);
    for (int k = 0; k < steps; ++k) {
        if (!advance(contact, demand, damping, dq, state)) return NAN;
        turning[k] = state.motor - state.wheel;
    }
    // x_{k+2h} = t x_{k+h} - d x_k + constant by least squares, e^{2 growth h dt} = d
    const int h = period / 6, first = period, count = steps - first - 2 * h;
    Eigen::MatrixX3d samples(count, 3);
    samples << turning.segment(first + h, count), -turning.segment(first, count), Eigen::VectorXd::Ones(count);
    const Eigen::Vector3d td = samples.transpose().lazyProduct(samples).inverse() *
                               (samples.transpose() * turning.segment(first + 2 * h, count));
    return std::log(td[0] / 2 + std::sqrt(std::complex<double>(td[0] * td[0] / 4 - td[1]))) / (h * dt);
}

}  // namespace

int main() {
    const Model model = contact_model(20);
    rollbem::Run contact(model);
    const double slip = 0.3, a = contact.now().half_length, dq = 0.1 * a;
    const rollbem::Creepage creeping{-slip / speed};
    Model::Step step = contact.steady({rollbem::Travel::at_speed(speed), creeping});
    const double slope = -step.tangent.by_longitudinal.longitudinal / speed, limit = least_damping(slope);
    for (int k = 0; k < 200 && step.status == rollbem::Status::ok; ++k) {  // steady rolling in steps of this length
        step = contact.advance({{dq, dq / speed}, creeping});
    }
    std::printf("at a slip velocity of %.1f m/s: F/N = %.4f, dF/d(slip velocity) = %.0f N s/m; least damping %.1f\n",
                slip, step.force.longitudinal / load, slope, limit);
    std::printf("%16s %22s %22s %10s\n", "damping N m s/rad", "growth 1/s, linear", "frequency Hz, linear",
                "a omega/V");
    bool agree = true;
    std::array<double, 4> growth{0, 0.8, 1.2, 2};  // at these parts of the limit [1/s]
    for (double& part : growth) {
        const double damping = part * limit, hertz = 1 / (2 * std::numbers::pi);
        const Mode mode = torsion(slope, damping);
        const std::complex<double> rate = simulated(contact, step.force.longitudinal, slip, damping, mode, dq);
        std::printf("%17.1f %10.3f %11.3f %10.3f %11.3f %10.2f\n", damping, rate.real(), mode.rate.real(),
                    std::abs(rate.imag()) * hertz, mode.rate.imag() * hertz, a * mode.rate.imag() / speed);
        agree = agree && std::abs(rate.real() / mode.rate.real() - 1) < 0.03 &&
                std::abs(std::abs(rate.imag()) / mode.rate.imag() - 1) < 0.003;
        part = rate.real();
    }
    const double found = limit * (0.8 + 0.4 * growth[1] / (growth[1] - growth[2]));
    std::printf("the simulated vibration neither grows nor decays at %.1f, %+.2f %% off the linear limit\n", found,
                100 * (found / limit - 1));
    return agree && std::abs(found / limit - 1) < 0.01 ? EXIT_SUCCESS : EXIT_FAILURE;
}
