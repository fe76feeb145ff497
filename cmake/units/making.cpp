// The making of tables.
#include <rollbem/compiled/friction.hpp>
#include <rollbem/compiled/patch.hpp>
#include <rollbem/vehicle/impl/make_contact_table.ipp>
#include <rollbem/vehicle/impl/make_creep_force_table.ipp>
