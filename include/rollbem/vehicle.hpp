// Wheelsets on their track: contacts, friction forces, look-up tables, wear and heat. Tables are made by
// vehicle/make_contact_table.hpp and vehicle/make_creep_force_table.hpp.
#pragma once

#include "scene/wheelset.hpp"
#include "status.hpp"
#include "vehicle/contact_table.hpp"
#include "vehicle/creep_force_table.hpp"
#include "vehicle/patch_stress.hpp"
#include "vehicle/simplified_theory.hpp"
#include "vehicle/wear.hpp"
#include "vehicle/wheelset_forces.hpp"
#include "vehicle/wheelset_on_track.hpp"
