// A driven wheel (wheel.hpp) that slips under too much torque and grips again, with Coulomb friction, in SI units. The
// work of the torque becomes kinetic energy, work against the resistance, heat and elastic energy. The heat is found
// twice: as the sum of slip times traction, and as the work done on the contact less what it stores.
//
//     ./examples/slipping_wheel
//
//     nodes, n = 40: creepage up to 0.097, force 17658.0 N of 17658.0 N, at the end 2000.0000 N
//       torque 58983.880 J = kinetic 46421.475 J + resistance 10116.000 J + heat 2446.411 J + elastic 0.00141 J
//       gap -0.00788 J, over heat -3.2e-06; with the heat by elastic energy -3.2e-12
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

using Model = rollbem::FrictionModel<>;

/// The contact as a force element. `promise` is the verdict on the eigenvalues of the system, or rollbem::unchecked.
template <class Promise>
Model make_model(const rollbem::Contact<double>& contact, const rollbem::Mesh<double>& mesh,
                 const rollbem::ElementSystem<double>& system, const Promise& promise, double load) {
    return {contact,
            system,
            promise,
            {.law = {friction_coefficient},
             .normal_pressure = load / (std::numbers::pi * contact.half_length() * contact.half_width()) *
                                rollbem::mean_hertz_pressure(mesh)}};
}

/// Energies [J] since the start, and how it went.
struct Ride {
    double torque = 0, resistance = 0, kinetic = 0, elastic = 0;
    double heat = 0;                      // slip times traction, summed over elements and steps
    double spent = 0;                     // work of the rigid bodies on the contact: heat and elastic energy
    double largest_creepage = 0;          // while driving [-]
    double largest_force = 0, force = 0;  // force: at the end [N]
    bool complete = false;

    double gap() const { return gap(heat); }
    double gap_by_energy() const { return gap(spent - elastic); }

private:
    double gap(double heat_by_either) const { return torque - resistance - kinetic - elastic - heat_by_either; }
};

/// T [N m] at a time [s]: enough to keep the speed, then too much, none until the wheel grips, then enough again.
double torque(const Wheel& wheel, double time) {
    const double steady = wheel.radius * wheel.resistance;
    return time < 0.02 ? steady : time < 0.12 ? 13 * steady : time < 0.17 ? 0 : steady;
}

Ride ride(const Wheel& wheel, const Model& model, double dq) {
    State<Model> now{20, 20 / wheel.radius, 0, model.at_rest()};
    State<Model> next = now;
    Model::Workspace workspace = model.workspace();
    Ride ride;
    ride.kinetic = -kinetic_energy(wheel, now);
    for (double time = 0; time < 0.25;) {
        const double applied = torque(wheel, time);
        const Model::Step step = advance(wheel, model, applied, dq, now, next, workspace);
        if (step.status != rollbem::StepStatus::ok) return ride;
        const double dt = 2 * dq / (now.speed + next.speed);
        time += dt;
        const double rotation = (now.rotation + next.rotation) / 2;
        ride.torque += applied * rotation * dt;
        ride.resistance += wheel.resistance * dq;
        ride.heat += step.slip_work;
        ride.spent -= (now.force + next.force) / 2 * (dq - wheel.radius * rotation * dt);
        ride.largest_creepage = std::max(ride.largest_creepage, -creepage(wheel, next.speed, next.rotation));
        ride.largest_force = std::max(ride.largest_force, next.force);
        std::swap(now, next);
    }
    ride.kinetic += kinetic_energy(wheel, now);
    ride.elastic = model.elastic_energy(now.contact);
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

    // 1. Differences between nodes. While the wheel slips, the rail pulls with mu N; afterwards with the resistance
    // again. Slip times traction balances to second order in 1/n; with the elastic energy, the balance holds to
    // round-off on any mesh.
    bool slips = true, recovers = true, balanced = true;
    double before = 0;
    for (const Eigen::Index n : {20, 40, 80}) {
        const rollbem::Mesh<double> mesh = rollbem::cosine_mesh(n);
        const auto nodes = rollbem::rolling_system(mesh, rollbem::NodeDifference{rollbem::Nodes::chebyshev}, kernel);
        const Model model = make_model(contact, mesh, nodes, rollbem::judge_stability(nodes), load);
        const Ride usual = ride(wheel, model, 4e-4);
        std::printf("nodes, n = %d: creepage up to %.3f, force %.1f N of %.1f N, at the end %.4f N\n", int(n),
                    usual.largest_creepage, usual.largest_force, limit, usual.force);
        std::printf("  torque %.3f J = kinetic %.3f J + resistance %.3f J + heat %.3f J + elastic %.5f J\n",
                    usual.torque, usual.kinetic, usual.resistance, usual.heat, usual.elastic);
        std::printf("  gap %+.5f J, over heat %+.1e; with the heat by elastic energy %+.1e\n", usual.gap(),
                    usual.gap() / usual.heat, usual.gap_by_energy() / usual.heat);
        slips = slips && usual.largest_creepage > 0.05 && std::abs(usual.largest_force / limit - 1) < 1e-12;
        recovers = recovers && usual.complete && std::abs(usual.force / wheel.resistance - 1) < 1e-9;
        const double gap = std::abs(usual.gap() / usual.heat);
        balanced = balanced && gap < (n == 20 ? 6e-5 : before / 3.5);
        balanced = balanced && std::abs(usual.gap_by_energy()) < 1e-9 * usual.heat;
        before = gap;
    }

    // 2. Galerkin's method tests the equations with the elements of the tractions: G is symmetric and G' antisymmetric,
    // so that discretisation in space neither makes nor loses energy, and slip times traction balances on any mesh, up
    // to the integration in time, of second order. The price: the modes neither decay nor grow, so that the model has
    // to be built unchecked. In full adhesion there is no steady force either, because the singular traction at the
    // trailing edge costs energy all the time; solve_steady says that its tractions assist the creepage. Friction bounds
    // the tractions, slip is the only loss, and the forces converge, to first order, once several elements slip.
    const rollbem::Mesh<double> mesh = rollbem::cosine_mesh(20);
    const auto galerkin = rollbem::rolling_system(mesh, rollbem::Galerkin{.alpha_L = 0, .alpha_T = 0}, kernel);
    const Model conservative = make_model(contact, mesh, galerkin, rollbem::unchecked, load);
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
