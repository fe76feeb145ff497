// rollbem: the two-dimensional tangential rolling contact problem by boundary elements.
// Umbrella of the library proper; rollbem/reference/ is apart because it needs GSL.
#pragma once

#include "assembly/influence.hpp"
#include "closed_form/carter.hpp"
#include "closed_form/friction.hpp"
#include "discretisation/mesh.hpp"
#include "discretisation/scheme.hpp"
#include "elasticity/line_kernel.hpp"
#include "problem/steady.hpp"
#include "scene/contact.hpp"
#include "spectral/polynomial.hpp"
