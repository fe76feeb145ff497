// Hertz's contacts, loads and pressures, and outlines.
#include <rollbem/normal/impl/hertz.ipp>
#include <rollbem/normal/impl/pressure.ipp>
#include <rollbem/scene/impl/patch_contact.ipp>
