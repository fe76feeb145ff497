// Look-ups: CreepForceTable, ReducedFriction, ContactTable.
#include <rollbem/vehicle/impl/contact_table.ipp>
#include <rollbem/vehicle/impl/creep_force_table.ipp>

namespace rollbem {
template TangentialForce CreepForceTable::force<double>(const PatchContact::Parameters&, double, double,
                                                        const Creepage&) const noexcept;
template TangentialForce CreepForceTable::force<float>(const PatchContact::Parameters&, double, double,
                                                       const Creepage&) const noexcept;
}  // namespace rollbem
