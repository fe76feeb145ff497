// Friction: FrictionModel and its workspace.
#include <rollbem/compiled/friction.hpp>
#include <rollbem/friction/impl/model.ipp>
