// Friction: steady and non-steady rolling with stick and slip, rigid shifts, Hertz's pressure and others.
// Umbrella of the friction headers.
#pragma once

#include "../normal/hertz.hpp"
#include "../normal/hertz_load.hpp"
#include "../normal/load.hpp"
#include "../normal/patch_pressure.hpp"
#include "../normal/pressure_grid.hpp"
#include "../normal/pressure_table.hpp"
#include "law.hpp"
#include "steady.hpp"
#include "transient.hpp"
