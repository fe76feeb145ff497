// Coulomb friction: steady and non-steady rolling with stick and slip, rigid shifts, Hertz's pressure and others.
// Umbrella of the friction headers.
#pragma once

#include "../detail/language.hpp"

#include "friction_border.hpp"
#include "friction_steady.hpp"
#include "friction_transient.hpp"
#include "hertz.hpp"
#include "pressure_table.hpp"
