// The making of tables.
#include <rollbem/vehicle/impl/make_contact_table.ipp>
#include <rollbem/vehicle/impl/make_creep_force_table.ipp>
