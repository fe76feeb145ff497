// rollbem: the two-dimensional tangential rolling contact problem by boundary elements. Includes every header that
// needs Eigen alone; what a program does not use costs next to nothing to compile. Not included are rollbem/reference/,
// which needs GSL, and rollbem/compiled/, which needs the library rollbem::compiled.
#pragma once

#include "detail/language.hpp"

#include "accuracy/recommendation.hpp"
#include "accuracy/richardson.hpp"
#include "adhesion/critical_alpha.hpp"
#include "adhesion/frequency.hpp"
#include "adhesion/response.hpp"
#include "adhesion/stability.hpp"
#include "adhesion/stability_count.hpp"
#include "adhesion/state_space.hpp"
#include "adhesion/steady.hpp"
#include "adhesion/transient.hpp"
#include "assembly/element_blocks.hpp"
#include "assembly/influence.hpp"
#include "assembly/rolling_system.hpp"
#include "closed_form/carter.hpp"
#include "closed_form/friction.hpp"
#include "discretisation/mesh.hpp"
#include "discretisation/scheme.hpp"
#include "elasticity/layered_kernel.hpp"
#include "elasticity/line_kernel.hpp"
#include "friction/friction.hpp"
#include "scene/contact.hpp"
#include "scene/creepage.hpp"
#include "scene/rigid_motion.hpp"
#include "spectral/chebyshev.hpp"
#include "spectral/polynomial.hpp"
#include "status.hpp"
#include "types.hpp"
