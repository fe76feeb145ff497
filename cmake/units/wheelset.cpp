// Friction, forces and wear of wheelsets.
#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/elasticity/patch_kernel.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/normal/load.hpp>
#include <rollbem/normal/pressure.hpp>
#include <rollbem/steady/creep_coefficients.hpp>
#include <rollbem/steady/steady.hpp>
#include <rollbem/vehicle/impl/patch_stress.ipp>
#include <rollbem/vehicle/impl/wear.ipp>
#include <rollbem/vehicle/impl/wheelset_forces.ipp>
#include <rollbem/vehicle/impl/wheelset_on_track.ipp>
