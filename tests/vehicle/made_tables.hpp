// The tables that the apps ship: creep forces of steel, and contacts of S1002 on 60E1, whose wheelset is here, too.
#pragma once

#include <rollbem/normal/profile.hpp>
#include <rollbem/vehicle/contact_table.hpp>
#include <rollbem/vehicle/creep_force_table.hpp>
#include <rollbem/vehicle/wheelset_on_track.hpp>

namespace rollbem::testing {

inline const CreepForceTable& steel() {
    static const auto table = CreepForceTable::read(ROLLBEM_STEEL_CREEP);
    return table;
}
inline const ContactTable& s1002_60e1() {
    static const auto table = ContactTable::read(ROLLBEM_S1002_CONTACT);
    return table;
}

inline const WheelsetOnTrack& s1002_on_60e1() {
    static const WheelsetOnTrack wheelset(WheelOnRail(s1002(), rail_60e1()));
    return wheelset;
}

}  // namespace rollbem::testing
