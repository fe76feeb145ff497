// The tables that the apps ship: creep forces of steel, and contacts of S1002 on 60E1.
#pragma once

#include <rollbem/vehicle/contact_table.hpp>
#include <rollbem/vehicle/creep_force_table.hpp>

namespace rollbem::testing {

inline const CreepForceTable& steel() {
    static const auto table = CreepForceTable::read(ROLLBEM_STEEL_CREEP);
    return table;
}
inline const ContactTable& s1002_60e1() {
    static const auto table = ContactTable::read(ROLLBEM_S1002_CONTACT);
    return table;
}

}  // namespace rollbem::testing
