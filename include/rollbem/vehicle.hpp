// Forces in the time loop of a vehicle model: of wheelsets and of single contacts, by tables made once.
#pragma once

#include "vehicle/contact_table.hpp"
#include "vehicle/creep_force_table.hpp"
#include "vehicle/reduced_friction.hpp"
#include "vehicle/wear.hpp"
