// Friction that depends on the velocity of slip, with or without memory. Umbrella of its headers.
#pragma once

#include "../detail/language.hpp"

#include "falling_steady.hpp"
#include "falling_transient.hpp"
#include "slip_law.hpp"
