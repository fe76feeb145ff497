// Coulomb friction under longitudinal and lateral creepage together. Umbrella of the headers for both directions.
#pragma once

#include "../detail/language.hpp"

#include "combined_steady.hpp"
#include "combined_transient.hpp"
