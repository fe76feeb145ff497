// Outlines, Hertz's contacts, loads and pressures, and full sliding.
#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/closed_form/impl/carter.ipp>
#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/normal/impl/hertz.ipp>
#include <rollbem/normal/impl/pressure.ipp>
#include <rollbem/normal/load.hpp>
#include <rollbem/normal/pressure.hpp>
#include <rollbem/scene/impl/patch_contact.ipp>
#include <rollbem/steady/steady.hpp>
