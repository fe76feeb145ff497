// A user's program: a wheel that slips under too much torque and recovers, with Coulomb friction in the contact.
// The work of the torque is found again as kinetic energy, work against the resistance, heat and elastic energy.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <utility>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/friction/friction.hpp>

#include "wheel.hpp"

namespace {

constexpr double friction_coefficient = 0.3;  // mu
const rollbem::Mesh<double> mesh = rollbem::cosine_mesh(20);

using Model = rollbem::FrictionModel<double>;

/// The contact as a force element, and what is needed to tell its elastic energy.
struct FrictionContact {
    rollbem::Contact<double> contact;
    rollbem::ElementSystem<double> system;
    Model model;

    /// `promise`: what is known about the eigenvalues of the system, a verdict or rollbem::unchecked.
    template <class Promise>
    FrictionContact(const rollbem::Contact<double>& c, const rollbem::ElementSystem<double>& s, const Promise& promise,
                    double load)
        : contact(c),
          system(s),
          model(c, system, promise,
                {.friction_coefficient = friction_coefficient,
                 .normal_pressure = load / (std::numbers::pi * c.half_length() * c.half_width()) *
                                    rollbem::mean_hertz_pressure(mesh)}) {}

    /// Half the traction times the displacement G p [J]. G is in units of a/G, weights are widths in a.
    double elastic_energy(const Model::State& state) const {
        const double a = contact.half_length();
        const Eigen::VectorXd displacement = a / contact.shear_modulus() * (system.G() * state.traction);
        return contact.half_width() * a * system.weights().matrix().cwiseProduct(state.traction).dot(displacement);
    }
};

/// Energies [J] since the start, and how it went.
struct Ride {
    double torque = 0, resistance = 0, heat = 0, kinetic = 0, elastic = 0;
    double largest_creepage = 0;          // while driving [-]
    double largest_force = 0, force = 0;  // of all and the last [N]
    bool complete = false;

    double gap() const { return torque - resistance - heat - kinetic - elastic; }
};

double kinetic_energy(const Wheel& wheel, const State<Model>& state) {
    return (wheel.mass * state.speed * state.speed + wheel.inertia * state.rotation * state.rotation) / 2;
}

/// T [N m] at a time [s]: what keeps the speed, then too much, then none until the wheel grips, then as at first.
double torque(const Wheel& wheel, double time) {
    const double steady = wheel.radius * wheel.resistance;
    return time < 0.02 ? steady : time < 0.12 ? 13 * steady : time < 0.17 ? 0 : steady;
}

Ride ride(const Wheel& wheel, const FrictionContact& friction, double dq) {
    State<Model> now{20, 20 / wheel.radius, 0, friction.model.at_rest()};
    State<Model> next = now;
    Model::Workspace workspace = friction.model.workspace();
    Ride ride;
    ride.kinetic = -kinetic_energy(wheel, now);
    for (double time = 0; time < 0.25;) {
        const double applied = torque(wheel, time);
        const Model::Step step = advance(wheel, friction.model, applied, dq, now, next, workspace);
        if (!std::isfinite(step.force)) return ride;
        const double dt = 2 * dq / (now.speed + next.speed);
        time += dt;
        ride.torque += applied * (now.rotation + next.rotation) / 2 * dt;
        ride.resistance += wheel.resistance * dq;
        ride.heat += 2 * friction.contact.half_width() * step.slip_work_per_width;
        ride.largest_creepage = std::max(ride.largest_creepage, -creepage(wheel, next.speed, next.rotation));
        ride.largest_force = std::max(ride.largest_force, next.force);
        std::swap(now, next);
    }
    ride.kinetic += kinetic_energy(wheel, now);
    ride.elastic = friction.elastic_energy(now.contact);
    ride.force = now.force;
    ride.complete = true;
    return ride;
}

}  // namespace

int main() {
    const Wheel wheel;
    const rollbem::Contact<double> contact(
        {.half_length = 6e-3, .half_width = 12e-3, .shear_modulus = 8e10, .poisson_ratio = 0.28});
    const auto kernel = rollbem::PlaneKernel<double>::longitudinal(contact);
    const double load = 9.81 * wheel.mass, limit = friction_coefficient * load;  // N, mu N [N]

    // 1. The usual scheme. While it slips the wheel pulls with mu N; afterwards it carries the resistance again. The
    // scheme takes the slip half an element ahead of the traction, so its heat has an error of first order in 1/n.
    const auto collocation =
        rollbem::rolling_system(mesh, rollbem::Collocation{.alpha_L = 0.5, .alpha_T = 0.5}, kernel);
    const Ride usual = ride(wheel, {contact, collocation, rollbem::verdict(collocation), load}, 4e-4);
    std::printf("collocation: creepage up to %.3f, force %.1f N of %.1f N, at the end %.4f N\n", usual.largest_creepage,
                usual.largest_force, limit, usual.force);
    std::printf("  torque %.3f J = kinetic %.3f J + resistance %.3f J + heat %.3f J + elastic %.5f J + %.5f J\n",
                usual.torque, usual.kinetic, usual.resistance, usual.heat, usual.elastic, usual.gap());
    const bool slips = usual.largest_creepage > 0.05 && std::abs(usual.largest_force / limit - 1) < 1e-12;
    const bool recovers = usual.complete && std::abs(usual.force / wheel.resistance - 1) < 1e-9;
    bool balanced = std::abs(usual.gap()) < 3e-3 * usual.heat;

    // 2. Galerkin's method tests with the tractions' own elements: G comes out symmetric and G' antisymmetric, so that
    // no energy is made or lost in space. What is left is the integration in time, of second order. The price: its
    // modes neither decay nor grow, which no verdict lets pass.
    const auto galerkin = rollbem::rolling_system(mesh, rollbem::Galerkin{.alpha_L = 0, .alpha_T = 0}, kernel);
    const FrictionContact conservative(contact, galerkin, rollbem::unchecked, load);
    double coarse = 0, fine = 0;
    for (const double dq : {8e-4, 4e-4, 2e-4}) {
        const Ride one = ride(wheel, conservative, dq);
        fine = std::abs(one.gap());
        if (coarse == 0) coarse = fine;
        balanced = balanced && one.complete && fine < 2e-7 * one.heat;
        std::printf("Galerkin, steps of %.1f mm: heat %.3f J, elastic %.5f J, gap %+.1e J\n", dq * 1e3, one.heat,
                    one.elastic, one.gap());
    }
    return slips && recovers && balanced && fine < coarse / 8 ? EXIT_SUCCESS : EXIT_FAILURE;
}
