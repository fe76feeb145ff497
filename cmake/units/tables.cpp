// Look-ups: CreepForceTable, ReducedFriction, ContactTable.
#include <rollbem/vehicle/impl/contact_table.ipp>
#include <rollbem/vehicle/impl/contact_zones.ipp>
#include <rollbem/vehicle/impl/creep_force_grid.ipp>
#include <rollbem/vehicle/impl/creep_force_table.ipp>
#include <rollbem/vehicle/impl/reduced_friction.ipp>

namespace rollbem {
template TangentialForce<double> CreepForceTable::force<double>(const PatchContact<double>::Parameters&, double, double,
                                                                const Creepage<double>&) const noexcept;
template TangentialForce<double> CreepForceTable::force<float>(const PatchContact<double>::Parameters&, double, double,
                                                               const Creepage<double>&) const noexcept;
}  // namespace rollbem
