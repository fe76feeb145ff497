// Friction that depends on the velocity of slip, with or without memory, in one direction and in two. Umbrella of its
// headers.
#pragma once

#include "../detail/language.hpp"

#include "combined_falling.hpp"
#include "falling_steady.hpp"
#include "falling_transient.hpp"
#include "slip_law.hpp"
