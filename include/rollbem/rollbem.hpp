// rollbem: tangential rolling contact by boundary elements, on lines and on contact patches. Includes every header that
// needs Eigen alone; unused parts cost next to nothing to compile. Not included:
//
// - rollbem/reference/, which needs GSL;
// - rollbem/compiled/, which needs the library rollbem::compiled;
// - rollbem/studies/;
// - vehicle/make_creep_force_table.hpp, which makes tables;
// - vehicle/wear.hpp and the making of patches from profiles, which it includes.
#pragma once

#include "accuracy/recommendation.hpp"
#include "adhesion/balanced_reduction.hpp"
#include "adhesion/frequency.hpp"
#include "adhesion/response.hpp"
#include "adhesion/stability.hpp"
#include "adhesion/transient.hpp"
#include "assembly/patch_system.hpp"
#include "assembly/rolling_system.hpp"
#include "closed_form/carter.hpp"
#include "discretisation/mesh.hpp"
#include "discretisation/patch_mesh.hpp"
#include "discretisation/scheme.hpp"
#include "elasticity/line_kernel.hpp"
#include "elasticity/patch_kernel.hpp"
#include "elasticity/subsurface_stress.hpp"
#include "friction/model.hpp"
#include "normal/hertz.hpp"
#include "normal/pressure.hpp"
#include "normal/profile.hpp"
#include "normal/profile_file.hpp"
#include "rolling/run.hpp"
#include "scene/contact.hpp"
#include "scene/creepage.hpp"
#include "scene/patch_contact.hpp"
#include "scene/rigid_motion.hpp"
#include "spectral/chebyshev.hpp"
#include "spectral/polynomial.hpp"
#include "status.hpp"
#include "steady/creep_coefficients.hpp"
#include "steady/steady.hpp"
#include "system/detail/dissipation.hpp"
#include "system/rolling_system.hpp"
#include "types.hpp"
#include "vehicle/creep_force_table.hpp"
#include "vehicle/simplified_theory.hpp"
