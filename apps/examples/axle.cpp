// Two wheels of different load and radius on one axle that twists, driven at one end, in SI units. The lighter wheel
// slips under a burst of torque, and the axle keeps oscillating; because of the radii, the wheels always creep against
// each other. Integrated implicitly: Newton's method with the tangents of both contacts. Every joule is accounted for.
//
//     ./examples/axle
//
//      n  most trials  heat heavy J  heat light J  damping J  elastic J   gap/heat, slip sum  gap/heat, by energy
//     40            3      190.1001       93.6842     1.1840    0.06977             2.62e-04             1.90e-11
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include <Eigen/LU>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz.hpp>

namespace {

using Model = rollbem::FrictionModel;

// 1. The axle and its load. The rail forces drive the vehicle: m dV/dt = sum F - D. Wheel i turns by
// J d(omega_i)/dt = T_i - R_i F_i -+ M, with the moment M = k twist + c d(twist)/dt in the axle.
struct Axle {
    double mass = 13000;                           // m [kg]
    double resistance = 14000;                     // D [N]
    double inertia = 60;                           // J of each wheel [kg m^2]
    std::array<double, 2> radius{0.4600, 0.4596};  // R [m]
    std::array<double, 2> load{80e3, 50e3};        // [N]
    double stiffness = 3.4e6;                      // k [N m/rad]
    double damping = 200;                          // c [N m s/rad]
    double friction = 0.3;                         // mu
    double half_width = 12e-3;                     // b [m]
    rollbem::ElasticBody steel{2.1e11, 0.28};

    double creepage(std::size_t i, double speed, double rotation) const { return 1 - radius[i] * rotation / speed; }

    Model contact(std::size_t i, Eigen::Index n) const {
        const rollbem::HertzLine hertz({.load_per_width = load[i] / (2 * half_width),
                                        .combined_radius = radius[i],
                                        .body_1 = steel,
                                        .body_2 = steel});
        const rollbem::Contact contact = hertz.contact(half_width);
        const rollbem::Mesh<double> mesh = rollbem::cosine_mesh(n);
        const auto system = rollbem::rolling_system(mesh, rollbem::NodeDifference{rollbem::Nodes::chebyshev},
                                                    rollbem::PlaneKernel<double>::longitudinal(contact));
        return {contact, system, rollbem::judge_stability(system), {friction, hertz.mean_pressure(mesh)}};
    }
};

struct State {
    double speed;                    // V [m/s]
    std::array<double, 2> rotation;  // omega [rad/s]
    double twist = 0;                // of wheel 0 against wheel 1 [rad]
    std::array<double, 2> force{};   // F [N]
    std::array<Model::State, 2> contact;
};

// 2. One step of the trapezoidal rule while both wheels roll on by dq [m], under a torque T [N m] on wheel 0. Returns
// the number of trials, 0 if a contact refuses the step or Newton's method does not converge. The slip work of both
// contacts goes to `heat` [J].
int advance(const Axle& axle, const std::array<Model, 2>& models, double torque, double dq, const State& now,
            State& next, std::array<Model::Workspace, 2>& workspaces, std::array<double, 2>& heat) {
    next.speed = now.speed;
    next.rotation = now.rotation;
    for (int trial = 1; trial <= 20; ++trial) {
        const double dt = 2 * dq / (now.speed + next.speed), dt_by_speed = -dt / (now.speed + next.speed);
        const double turning = (now.rotation[0] + next.rotation[0] - now.rotation[1] - next.rotation[1]) / 2;
        next.twist = now.twist + dt * turning;
        const double moment = axle.stiffness * (now.twist + next.twist) / 2 + axle.damping * turning;
        const double moment_by_speed = axle.stiffness / 2 * dt_by_speed * turning;
        const double moment_by_rotation = axle.stiffness / 4 * dt + axle.damping / 2;  // wheel 1: with a minus

        // unknowns V, omega_0, omega_1; residual: gain of momentum less the impulse of the forces over dt
        const double mass_gain = axle.mass * (next.speed - now.speed);
        Eigen::Vector3d residual(mass_gain + dt * axle.resistance, 0, 0);
        Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
        jacobian(0, 0) = axle.mass + dt_by_speed * axle.resistance;
        for (std::size_t i = 0; i < 2; ++i) {
            const auto motion = Model::Motion::linear({axle.creepage(i, now.speed, now.rotation[i])},
                                                      {axle.creepage(i, next.speed, next.rotation[i])});
            const Model::Step step = models[i].advance(now.contact[i], {dq, motion}, next.contact[i], workspaces[i]);
            if (step.status != rollbem::Status::ok) return 0;
            next.force[i] = step.force.longitudinal;
            heat[i] = step.slip_work;

            const double tangent = step.tangent.by_longitudinal.longitudinal;
            const double sign = i == 0 ? 1 : -1, radius = axle.radius[i];
            const Eigen::Index row = i == 0 ? 1 : 2;
            const double force = (now.force[i] + next.force[i]) / 2;
            const double by_speed = tangent / 2 * radius * next.rotation[i] / (next.speed * next.speed);
            const double by_rotation = -tangent / 2 * radius / next.speed;
            const double drive = (i == 0 ? torque : 0) - sign * moment - radius * force;
            residual[0] -= dt * force;
            residual[row] = axle.inertia * (next.rotation[i] - now.rotation[i]) - dt * drive;
            jacobian(0, 0) -= dt_by_speed * force + dt * by_speed;
            jacobian(0, row) = -dt * by_rotation;
            jacobian(row, 0) = -dt_by_speed * drive + dt * (sign * moment_by_speed + radius * by_speed);
            jacobian(row, row) = axle.inertia + dt * (moment_by_rotation + radius * by_rotation);
            jacobian(row, 3 - row) = -dt * moment_by_rotation;
        }
        const Eigen::Vector3d change = -jacobian.inverse() * residual;
        next.speed += change[0];
        next.rotation[0] += change[1];
        next.rotation[1] += change[2];
        if (change.cwiseAbs().maxCoeff() < 1e-12 * now.speed) return trial;
    }
    return 0;
}

// T [N m]: enough to keep the speed, with a burst that is too much for the lighter wheel.
double torque(const Axle& axle, double time) {
    const double steady = axle.resistance * axle.radius[0];
    return time > 0.03 && time < 0.06 ? 3 * steady : steady;
}

// 3. The ride, and its energies [J] since the start.
struct Account {
    double torque = 0, resistance = 0, damping = 0, kinetic = 0, twist = 0, elastic = 0;
    double spent = 0;  // work of the wheels on the contacts, from their forces
    std::array<double, 2> heat{};
    int most_trials = 0;

    double total_heat() const { return heat[0] + heat[1]; }
    /// Error of the balance with the heat by slip and traction, or with the heat by `spent` and the elastic energy.
    double gap() const { return torque - resistance - damping - kinetic - twist - elastic - total_heat(); }
    double gap_by_energy() const { return gap() + total_heat() - (spent - elastic); }
};

double kinetic_energy(const Axle& axle, const State& state) {
    return (axle.mass * state.speed * state.speed +
            axle.inertia * (state.rotation[0] * state.rotation[0] + state.rotation[1] * state.rotation[1])) /
           2;
}

Account ride(const Axle& axle, Eigen::Index n, double dq) {
    const std::array<Model, 2> models{axle.contact(0, n), axle.contact(1, n)};
    std::array<Model::Workspace, 2> workspaces{models[0].workspace(), models[1].workspace()};
    State now{20, {20 / axle.radius[0], 20 / axle.radius[1]}, 0, {}, {models[0].at_rest(), models[1].at_rest()}};
    State next = now;
    Account account;
    account.kinetic = -kinetic_energy(axle, now);
    for (double time = 0; time < 0.15;) {
        const double applied = torque(axle, time);
        std::array<double, 2> heat{};
        const int trials = advance(axle, models, applied, dq, now, next, workspaces, heat);
        if (trials == 0) return {};
        account.most_trials = std::max(account.most_trials, trials);
        const double dt = 2 * dq / (now.speed + next.speed);
        const double turning = (next.twist - now.twist) / dt;
        time += dt;
        account.resistance += axle.resistance * dq;
        account.damping += axle.damping * turning * turning * dt;
        account.torque += applied * (now.rotation[0] + next.rotation[0]) / 2 * dt;
        for (std::size_t i = 0; i < 2; ++i) {
            const double slip = dq - axle.radius[i] * (now.rotation[i] + next.rotation[i]) / 2 * dt;
            account.spent -= (now.force[i] + next.force[i]) / 2 * slip;
            account.heat[i] += heat[i];
        }
        std::swap(now, next);
    }
    account.kinetic += kinetic_energy(axle, now);
    account.twist = axle.stiffness * now.twist * now.twist / 2;
    account.elastic = models[0].elastic_energy(now.contact[0]) + models[1].elastic_energy(now.contact[1]);
    return account;
}

}  // namespace

int main() {
    std::printf("%3s %12s %13s %13s %10s %10s %20s %20s\n", "n", "most trials", "heat heavy J", "heat light J",
                "damping J", "elastic J", "gap/heat, slip sum", "gap/heat, by energy");
    bool balanced = true;
    double before = 0;
    for (const Eigen::Index n : {20, 40, 80}) {
        const Account account = ride(Axle{}, n, 1e-3);
        const double gap = std::abs(account.gap()) / account.total_heat();
        const double by_energy = std::abs(account.gap_by_energy()) / account.total_heat();
        std::printf("%3d %12d %13.4f %13.4f %10.4f %10.5f %20.2e %20.2e\n", int(n), account.most_trials,
                    account.heat[0], account.heat[1], account.damping, account.elastic, gap, by_energy);
        // 4. Slip times traction, summed over the elements, balances to second order in 1/n; with the elastic energy
        // the heat balances to round-off.
        balanced = balanced && (n != 40 || gap < 3e-3) && (before == 0 || gap < before / 3) && by_energy < 1e-9;
        before = gap;
    }
    return balanced ? EXIT_SUCCESS : EXIT_FAILURE;
}
