// Profiles and contacts of wheels on rails.
#include <rollbem/normal/impl/contact_geometry.ipp>
#include <rollbem/normal/impl/normal_contact.ipp>
#include <rollbem/normal/impl/profile.ipp>
#include <rollbem/normal/impl/profile_alignment.ipp>
#include <rollbem/normal/impl/profile_check.ipp>
#include <rollbem/normal/impl/profile_file.ipp>
#include <rollbem/normal/impl/profile_wear.ipp>
#include <rollbem/normal/impl/rail_patch.ipp>
#include <rollbem/normal/impl/rigid_contact.ipp>
#include <rollbem/normal/impl/sections.ipp>
#include <rollbem/normal/impl/standard_profiles.ipp>
#include <rollbem/normal/impl/surface.ipp>
#include <rollbem/normal/impl/surface_file.ipp>
#include <rollbem/normal/impl/virtual_penetration.ipp>
#include <rollbem/normal/impl/wheel_on_rail.ipp>
