// Friction that depends on the velocity of slip under longitudinal and lateral creepage. Umbrella of its headers.
#pragma once

#include "../detail/language.hpp"

#include "combined_falling_steady.hpp"
#include "combined_falling_transient.hpp"
#include "slip_law.hpp"
