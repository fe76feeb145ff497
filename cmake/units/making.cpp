// The making of tables.
#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/elasticity/patch_kernel.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/normal/load.hpp>
#include <rollbem/normal/pressure.hpp>
#include <rollbem/steady/creep_coefficients.hpp>
#include <rollbem/steady/steady.hpp>
#include <rollbem/vehicle/impl/make_contact_table.ipp>
#include <rollbem/vehicle/impl/make_creep_force_table.ipp>
