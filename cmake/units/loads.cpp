// Outlines, Hertz's contacts, loads and pressures, and full sliding.
#include <rollbem/compiled/friction.hpp>
#include <rollbem/closed_form/impl/full_sliding.ipp>
#include <rollbem/normal/impl/hertz.ipp>
#include <rollbem/normal/impl/hertz_ellipse.ipp>
#include <rollbem/normal/impl/hertz_load.ipp>
#include <rollbem/normal/impl/hertz_patch_load.ipp>
#include <rollbem/normal/impl/pressure_grid.ipp>
#include <rollbem/normal/impl/pressure_table.ipp>
#include <rollbem/scene/impl/outline.ipp>
