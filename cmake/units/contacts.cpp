// Profiles and contacts of wheels on rails.
#include <rollbem/normal/impl/normal_contact.ipp>
#include <rollbem/normal/impl/profile.ipp>
#include <rollbem/normal/impl/profile_file.ipp>
#include <rollbem/normal/impl/profile_wear.ipp>
#include <rollbem/normal/impl/surface.ipp>
#include <rollbem/normal/impl/virtual_penetration.ipp>
#include <rollbem/normal/impl/wheel_on_rail.ipp>
