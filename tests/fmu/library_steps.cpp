// Look-ups of the library, timed by cost.c.
#include "library_steps.h"

#include <string>

#include <rollbem/vehicle/contact_table.hpp>

#include "library.hpp"

namespace {

std::string folder;

}  // namespace

void library_resources(const char* name) { folder = name; }

double library_table(int count) {
    static const auto table = rollbem::CreepForceTable::read(folder + "/steel.creep");
    static const rollbem::HertzEllipse<double> ellipse = library::ellipse().under(1e5);
    double force = 0;
    for (int i = 0; i < count; ++i) {
        const rollbem::PatchContact<double> contact = ellipse.contact();
        force = table.look_up(contact, library::friction_coefficient, 1e5, {1e-3 / 20, 0, 0}).force.longitudinal;
    }
    return force;
}

double library_wheelset(int count) {
    static const auto creep = rollbem::CreepForceTable::read(folder + "/steel.creep");
    static const auto contacts = rollbem::ContactTable::read(folder + "/s1002_60e1.contact");
    double force = 0;
    for (int i = 0; i < count; ++i) {
        force = 0;
        for (const auto side : {rollbem::WheelsetSide::left, rollbem::WheelsetSide::right}) {
            force +=
                contacts.look_up(creep, side, {}, {20, -20 / 0.46, 1e-3}, 1e5, library::friction_coefficient).force[0];
        }
    }
    return force;
}
