// Wheels on rails from their profiles: contacts, pressures, forces on them, wear, conicity, stresses below the surface.
#pragma once

#include "normal/profile_file.hpp"
#include "normal/sections.hpp"
#include "normal/standard_profiles.hpp"
#include "normal/surface_file.hpp"
#include "normal/virtual_penetration.hpp"
#include "normal/wheel_on_rail.hpp"
#include "vehicle/equivalent_conicity.hpp"
#include "vehicle/patch_stress.hpp"
#include "vehicle/wear.hpp"
#include "vehicle/wheelset_forces.hpp"
