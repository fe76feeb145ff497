// All of these headers except studies.hpp, in addition to or in place of rollbem.hpp.
#pragma once

#include "adhesion.hpp"
#include "friction.hpp"
#include "patch.hpp"
#include "stability.hpp"
#include "steady.hpp"
