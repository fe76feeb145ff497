// ContactTable: the contacts of a wheelset on real rails, over lateral shift, yaw and load, as a table; and with a
// table of creep forces, all contact forces of a wheel by look-up, with tangents.
#pragma once

#include "../detail/language.hpp"

#include "detail/contact_table.hpp"
#include "detail/wheel_look_up.hpp"
