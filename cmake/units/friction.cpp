// Friction: FrictionModel and its workspace.
#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/friction/impl/model.ipp>
#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/normal/load.hpp>
#include <rollbem/normal/pressure.hpp>
#include <rollbem/steady/steady.hpp>
