// Everything in rollbem::compiled, in addition to or in place of rollbem.hpp.
#pragma once

#include "assembly.hpp"
#include "balanced_reduction.hpp"
#include "chebyshev.hpp"
#include "creep_force_table.hpp"
#include "decompositions.hpp"
#include "frequency.hpp"
#include "friction.hpp"
#include "lu.hpp"
#include "monomial.hpp"
#include "patch.hpp"
#include "rolling_system.hpp"
#include "stability.hpp"
#include "steady.hpp"
#include "stick_border.hpp"
#include "transient.hpp"
