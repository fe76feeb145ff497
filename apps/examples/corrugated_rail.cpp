// A driven wheel (wheel.hpp) on a corrugated rail, in SI units: the normal load varies by 50 % over each wave, and with
// it the length of the contact and the force it can transfer. Integrated implicitly; the slip work of the elements maps
// the wear of the rail over the wave. Every joule is accounted for; the varying load does no work on the contact.
//
//     ./examples/corrugated_rail
//
//      n    least F N  largest F N     heat J  elastic J   gap/heat, slip sum  gap/heat, by energy
//     40      7316.00     14468.03    10.1226    0.03188             1.93e-03             8.51e-10
//     wear of the rail over a wave, relative to its mean; the load peaks between the second and third:
//         1.217    1.316    1.220    1.038    0.855    0.725    0.709    0.922
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <utility>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/friction/friction.hpp>

#include "wheel.hpp"

namespace {

using Model = rollbem::FrictionModel<>;

// 1. The wheel, what it carries, and the rail.
constexpr Wheel wheel{.resistance = 11000};
constexpr double torque = wheel.radius * wheel.resistance;        // [N m], keeps the mean speed
constexpr double friction_coefficient = 0.3, half_width = 12e-3;  // mu, b [m]
constexpr double mean_load = 60e3, variation = 0.5;               // [N], [-]
constexpr double wave = 50e-3;                                    // length of the corrugation [m]
constexpr rollbem::ElasticBody<double> steel{2.1e11, 0.28};

// Load per width [N/m] after a distance rolled [m]: largest a quarter of a wave after the start.
double load_per_width(double distance) {
    return mean_load / (2 * half_width) * (1 + variation * std::sin(2 * std::numbers::pi * distance / wave));
}

// 2. The ride over 20 waves and a quarter, after 10 that let it settle, and its energies [J].
struct Account {
    double driven = 0, resisted = 0, kinetic = 0, elastic = 0;
    double heat = 0;   // slip times traction, summed over elements and steps
    double spent = 0;  // work of the wheel on the contact, from its force
    double least_force = 1e300, largest_force = -1e300;
    std::array<double, 8> wear{};  // share of the heat by the eighth of the wave where the rail takes it
    bool complete = false;

    /// What the balance lacks with the heat by slip and traction, or with that by `spent` and the elastic energy.
    double gap() const { return driven - resisted - kinetic - elastic - heat; }
    double gap_by_energy() const { return driven - resisted - kinetic - spent; }
};

Account ride(Eigen::Index n, int steps_per_wave) {
    const rollbem::HertzLine<double> line(
        {.load_per_width = load_per_width(0), .combined_radius = wheel.radius, .body_1 = steel, .body_2 = steel});
    const rollbem::Contact<double> contact = line.contact(half_width);
    const rollbem::Mesh<double> mesh = rollbem::cosine_mesh(n);
    const auto system = rollbem::rolling_system(mesh, rollbem::NodeDifference{rollbem::Nodes::chebyshev},
                                                rollbem::PlaneKernel<double>::longitudinal(contact));
    const Model model(contact, system, rollbem::judge_stability(system),
                      {friction_coefficient, line.mean_pressure(mesh)});
    const auto hertz = rollbem::HertzLoad<double>::breathing(line, mesh);
    rollbem::NormalLoad<double> load = hertz.at(line.load_per_width());

    State<Model> now{20, 20 / wheel.radius, 0, model.at_rest()}, next = now;
    Model::Workspace workspace = model.workspace();
    const double dq = wave / steps_per_wave;
    Account account;
    for (int k = 1; k <= 30 * steps_per_wave + steps_per_wave / 4; ++k) {
        if (k == 10 * steps_per_wave + 1) {
            account.kinetic = -kinetic_energy(wheel, now);
            account.elastic = -model.elastic_energy(now.contact);
        }
        if (hertz.set(load_per_width(k * dq), load) != rollbem::StepStatus::ok) return {};
        const rollbem::FrictionStep<> step = advance(wheel, model, torque, dq, now, next, workspace, load);
        if (step.status != rollbem::StepStatus::ok) return {};
        if (k > 10 * steps_per_wave) {
            const double dt = 2 * dq / (now.speed + next.speed), angle = (now.rotation + next.rotation) / 2 * dt;
            account.driven += torque * angle;
            account.resisted += wheel.resistance * dq;
            account.spent -= (now.force + next.force) / 2 * (dq - wheel.radius * angle);
            account.heat += step.slip_work;
            account.least_force = std::min(account.least_force, next.force);
            account.largest_force = std::max(account.largest_force, next.force);
            for (Eigen::Index i = 0; i < n; ++i) {
                const double place = ((k - 0.5) * dq + load.half_length * mesh.centres()[i]) / wave;
                account.wear[std::size_t(8 * (place - std::floor(place)))] += workspace.slip_work()[i];
            }
        }
        std::swap(now, next);
    }
    account.kinetic += kinetic_energy(wheel, now);
    account.elastic += model.elastic_energy(now.contact);
    account.complete = true;
    return account;
}

}  // namespace

int main() {
    std::printf("%3s %12s %12s %10s %10s %20s %20s\n", "n", "least F N", "largest F N", "heat J", "elastic J",
                "gap/heat, slip sum", "gap/heat, by energy");
    bool balanced = true;
    double before = 0;
    Account account;
    for (const Eigen::Index n : {20, 40, 80}) {
        account = ride(n, 200);
        const double gap = std::abs(account.gap() / account.heat);
        const double by_energy = std::abs(account.gap_by_energy() / account.heat);
        std::printf("%3d %12.2f %12.2f %10.4f %10.5f %20.2e %20.2e\n", int(n), account.least_force,
                    account.largest_force, account.heat, account.elastic, gap, by_energy);
        // 3. Slip times traction, summed over the elements, balances to second order in 1/n; with the elastic energy
        // the heat balances to the round-off of the wheel's energies, which are a million times as large.
        balanced = balanced && account.complete && (n != 40 || gap < 3e-3) && (before == 0 || gap < before / 3) &&
                   by_energy < 1e-7;
        before = gap;
    }
    std::printf("wear of the rail over a wave, relative to its mean; the load peaks between the second and third:\n");
    for (const double wear : account.wear) std::printf("%9.3f", 8 * wear / account.heat);
    std::printf("\n");
    return balanced ? EXIT_SUCCESS : EXIT_FAILURE;
}
