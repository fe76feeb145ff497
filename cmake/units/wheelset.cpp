// Friction, forces and wear of wheelsets.
#include <rollbem/vehicle/impl/patch_stress.ipp>
#include <rollbem/vehicle/impl/wear.ipp>
#include <rollbem/vehicle/impl/wheelset_forces.ipp>
#include <rollbem/vehicle/impl/wheelset_on_track.ipp>
