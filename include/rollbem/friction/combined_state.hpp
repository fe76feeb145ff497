#pragma once
#include "../detail/language.hpp"

#include "state.hpp"
namespace rollbem {
using CombinedZone = Zone;
}
