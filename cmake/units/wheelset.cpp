// Friction and forces of wheelsets.
#include <rollbem/compiled/friction.hpp>
#include <rollbem/compiled/patch.hpp>
#include <rollbem/vehicle/impl/flash_temperature.ipp>
#include <rollbem/vehicle/impl/patch_elements.ipp>
#include <rollbem/vehicle/impl/patch_force.ipp>
#include <rollbem/vehicle/impl/rail_friction.ipp>
#include <rollbem/vehicle/impl/wheelset_forces.ipp>
#include <rollbem/vehicle/impl/wheelset_on_track.ipp>
