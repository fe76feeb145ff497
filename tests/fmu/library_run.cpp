// library_run KIND VARIANT START: results of the library's steps, bit for bit, for steps read as lines of duration [s]
// and inputs in SI units. KIND is patch, with slip velocities, spin, rolling speed, load and factor of friction
// as inputs and a mesh that VARIANT says, follows (the load) or fixed; or wheelset, with the folder of its tables as
// VARIANT and the inputs of its FMU. Where START is steady, the first line is that state. Prints forces and moments,
// slip work and the number of elements that stick. Exits with 1 at a step that is not ok.
#include <array>
#include <cstdio>
#include <string>

#include <rollbem/vehicle/contact_table.hpp>

#include "library.hpp"

namespace {

using rollbem::Status;

template <std::size_t Count>
bool read(std::array<double, Count>& numbers) {
    for (double& one : numbers) {
        if (std::scanf("%la", &one) != 1) return false;
    }
    return true;
}

bool roll(library::Friction contact, bool steady) {
    double work = 0;
    for (std::array<double, 7> line{}; read(line); steady = false) {
        const auto& [duration, longitudinal, lateral, spin, speed, load, factor] = line;
        const rollbem::Creepage<double> slip{longitudinal, lateral, spin};
        const auto step =
            steady ? contact.steady(slip, speed, load, factor) : contact.step(duration, slip, speed, load, factor);
        if (step.status != Status::ok) return false;
        if (!steady) work += step.slip_work;
        std::printf("%a %a %a %a %a\n", step.force.longitudinal, step.force.lateral, step.force.moment, work,
                    static_cast<double>(step.stick_count));
    }
    return true;
}

bool roll_wheelset(const std::string& folder) {
    const auto creep = rollbem::CreepForceTable::read(folder + "/steel.creep");
    const auto contacts = rollbem::ContactTable::read(folder + "/s1002_60e1.contact");
    double work = 0, before = 0;
    bool first = true;
    for (std::array<double, 11> x{}; read(x); first = false) {
        std::array<rollbem::WheelForces, 2> wheels;
        for (std::size_t k = 0; k < 2; ++k) {
            wheels[k] = contacts.look_up(creep, k == 0 ? rollbem::WheelsetSide::left : rollbem::WheelsetSide::right,
                                         {.lateral = x[1], .yaw = x[2]}, {x[3], x[4], x[5], x[6], x[7], x[8]}, x[9 + k],
                                         library::friction_coefficient);
            if (wheels[k].status != Status::ok) return false;
        }
        const double heat = wheels[0].heat + wheels[1].heat;
        if (!first) work += x[0] * (before + heat) / 2;
        before = heat;
        using Forces = Eigen::Matrix<double, 6, 1>;
        const Forces both = wheels[0].force + wheels[1].force;
        for (const auto& forces : {both, Forces(wheels[0].force), Forces(wheels[1].force)}) {
            for (const double one : forces) std::printf("%a ", one);
        }
        std::printf("%a\n", work);
    }
    return true;
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 4) return 2;
    const std::string kind = arguments[1], variant = arguments[2];
    const bool fixed = variant == "fixed", steady = std::string(arguments[3]) == "steady";
    return !(kind == "wheelset" ? roll_wheelset(variant) : roll(library::patch(fixed), steady));
}
