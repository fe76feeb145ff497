// Patches of a wheelset from the profiles of wheel and rail, and the forces of friction on them.
#include <cstdio>

#include <rollbem/vehicle/wheelset_forces.hpp>

int main() {
    using namespace rollbem;
    const WheelsetOnTrack wheelset(WheelOnRail(s1002(), rail_60e1()));
    WheelsetOnTrack::Workspace workspace;
    const WheelsetRolling rolling{.position = {.lateral = 2e-3, .yaw = 1e-3}, .loads = {80e3, 80e3}};
    const auto now = rolling_forces(wheelset, rolling, {.coefficient = 0.3}, workspace);
    if (!has_numbers(now.contacts.status)) return 1;
    const auto& patch = now.contacts.wheels[1].patches[0];  // the right wheel's
    std::printf("peak %.0f MPa, F_y = %.0f N\n", 1e-6 * patch.peak_pressure, now.on_wheel[1].force[1]);
}
