// wheelset_reference CREEP_TABLE CONTACT_TABLE: reads lines of the ten inputs of rollbem_wheelset and prints forces and
// moments of the left and the right wheel, and the heat of both [W], bit for bit. Exits with 1 if there are none.
#include <array>
#include <cstdio>
#include <fstream>

#include <rollbem/vehicle/contact_table.hpp>

int main(int count, char** arguments) {
    using namespace rollbem;
    if (count != 3) return 2;
    std::ifstream forces(arguments[1], std::ios::binary), places(arguments[2], std::ios::binary);
    const CreepForceTable creep = CreepForceTable::read(forces);
    const ContactTable table = ContactTable::read(places);
    std::array<double, 10> x{};
    const auto read = [&] {
        for (double& one : x) {
            if (std::scanf("%la", &one) != 1) return false;
        }
        return true;
    };
    while (read()) {
        double heat = 0;
        for (const WheelsetSide side : {WheelsetSide::left, WheelsetSide::right}) {
            const WheelForces wheel =
                table.look_up(creep, side, {.lateral = x[0], .yaw = x[1]}, {x[2], x[3], x[4], x[5], x[6], x[7]},
                              side == WheelsetSide::left ? x[8] : x[9], 0.3);
            if (wheel.status != StepStatus::ok) return 1;
            for (const double one : wheel.force) std::printf("%a ", one);
            heat += wheel.heat;
        }
        std::printf("%a\n", heat);
    }
}
