// rollbem: the two-dimensional tangential rolling contact problem by boundary elements.
// Umbrella of all that needs Eigen alone; what a program does not use costs next to nothing to compile. Apart are
// rollbem/reference/, which needs GSL, and rollbem/compiled/, which needs the library rollbem::compiled.
#pragma once

#include "detail/language.hpp"

#include "assembly/influence.hpp"
#include "closed_form/carter.hpp"
#include "closed_form/friction.hpp"
#include "discretisation/mesh.hpp"
#include "discretisation/scheme.hpp"
#include "elasticity/line_kernel.hpp"
#include "problem/critical_alpha.hpp"
#include "problem/frequency.hpp"
#include "problem/friction.hpp"
#include "problem/recommendation.hpp"
#include "problem/richardson.hpp"
#include "problem/stability.hpp"
#include "problem/stability_count.hpp"
#include "problem/steady.hpp"
#include "problem/transient.hpp"
#include "scene/contact.hpp"
#include "spectral/polynomial.hpp"
