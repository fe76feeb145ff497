// Friction: steady and non-steady rolling with stick and slip, rigid shifts, Hertz's pressure and others.
// Umbrella of the friction headers, with what makes systems and pressures.
#pragma once

#include "../assembly/patch_system.hpp"
#include "../assembly/rolling_system.hpp"
#include "../normal/hertz.hpp"
#include "../normal/hertz_ellipse.hpp"
#include "../normal/hertz_load.hpp"
#include "../normal/load.hpp"
#include "../normal/pressure_grid.hpp"
#include "../normal/pressure_table.hpp"
#include "law.hpp"
#include "model.hpp"
