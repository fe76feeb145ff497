// All of rollbem::compiled except studies/ and wheels on rails, in addition to or in place of rollbem.hpp.
#pragma once

#include "adhesion.hpp"
#include "creep_force_table.hpp"
#include "friction.hpp"
#include "patch.hpp"
#include "stability.hpp"
#include "steady.hpp"
