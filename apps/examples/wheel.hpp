// A driven wheel on a rail, with the contact as its force element, integrated implicitly in steps of equal distance
// rolled, in SI units. For any model whose advance() takes a RigidMotion: without friction in driven_wheel.cpp, with it
// in slipping_wheel.cpp, and under a load that varies in corrugated_rail.cpp.
#pragma once

#include <cmath>
#include <cstdio>

#include <Eigen/LU>

#include <rollbem/adhesion/transient.hpp>

/// What stays the same. The rail force F on the wheel drives the vehicle: m dV/dt = F - D, J d(omega)/dt = T - R F.
struct Wheel {
    double mass = 6000;        // m, the wheel's share of the vehicle [kg]
    double inertia = 80;       // J [kg m^2]
    double radius = 0.46;      // R [m]
    double resistance = 2000;  // D [N]
};

/// What changes in time.
template <class Model>
struct State {
    double speed, rotation;  // V [m/s], omega [rad/s]
    double force;            // F [N]
    typename Model::State contact;
};

template <class Model>
double kinetic_energy(const Wheel& wheel, const State<Model>& state) {
    return (wheel.mass * state.speed * state.speed + wheel.inertia * state.rotation * state.rotation) / 2;
}

/// Creepage xi = (V - R omega)/V is negative while the wheel drives, F then positive.
inline double creepage(const Wheel& wheel, double speed, double rotation) {
    return (speed - wheel.radius * rotation) / speed;
}

/// One step of the trapezoidal rule under a torque T [N m] while the wheel rolls on by dq [m], solved by Newton's
/// method. Each trial advances the contact from the same state; the next one overwrites what it leaves in `next`.
/// If the contact refuses the step, its status says why; if Newton's method does not converge, the status is
/// not_finite. `load` is the NormalLoad at the end of the step if it varies.
template <class Model, class... Load>
typename Model::Step advance(const Wheel& wheel, const Model& model, double torque, double dq, const State<Model>& now,
                             State<Model>& next, typename Model::Workspace& workspace, const Load&... load) {
    next.speed = now.speed;
    next.rotation = now.rotation;
    const double start = creepage(wheel, now.speed, now.rotation);
    for (int trial = 0; trial < 20; ++trial) {
        const double end = creepage(wheel, next.speed, next.rotation);
        const auto motion = rollbem::RigidMotion<double>::linear(start, end);
        const typename Model::Step step = model.advance(now.contact, dq, motion, load..., next.contact, workspace);
        if (step.status != rollbem::StepStatus::ok) {
            std::fprintf(stderr, "the contact refuses a step: %s\n", rollbem::name(step.status));
            return step;
        }
        next.force = step.force;

        const double per_time = (now.speed + next.speed) / 2 / dq;  // 1/dt
        const double mean_force = (now.force + next.force) / 2;
        const double spin_up = wheel.inertia * (next.rotation - now.rotation);
        const Eigen::Vector2d residual(wheel.mass * (next.speed - now.speed) * per_time - mean_force + wheel.resistance,
                                       spin_up * per_time - torque + wheel.radius * mean_force);
        const double by_speed = step.tangent * wheel.radius * next.rotation / (next.speed * next.speed) / 2;
        const double by_rotation = -step.tangent * wheel.radius / next.speed / 2;
        Eigen::Matrix2d jacobian;
        jacobian << wheel.mass * next.speed / dq - by_speed, -by_rotation, spin_up / 2 / dq + wheel.radius * by_speed,
            wheel.inertia * per_time + wheel.radius * by_rotation;
        const Eigen::Vector2d change = -jacobian.inverse() * residual;
        next.speed += change[0];
        next.rotation += change[1];
        if (std::abs(change[0]) + wheel.radius * std::abs(change[1]) < 1e-13 * now.speed) return step;
    }
    return {};
}
