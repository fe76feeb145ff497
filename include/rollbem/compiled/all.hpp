// All of rollbem::compiled but what belongs to studies/ and to wheels on rails, in addition to or in place of
// rollbem.hpp.
#pragma once

#include "adhesion.hpp"
#include "creep_force_table.hpp"
#include "friction.hpp"
#include "patch.hpp"
#include "stability.hpp"
#include "steady.hpp"
