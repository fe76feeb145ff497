// rollbem: the two-dimensional tangential rolling contact problem by boundary elements.
// Umbrella of all that needs Eigen alone, but for adhesion/stability.hpp and adhesion/critical_alpha.hpp, whose eigenvalue
// solver takes some 20 s to compile; rollbem/reference/ is apart because it needs GSL.
#pragma once

#include "detail/language.hpp"

#include "accuracy/recommendation.hpp"
#include "accuracy/richardson.hpp"
#include "adhesion/frequency.hpp"
#include "adhesion/stability_count.hpp"
#include "adhesion/steady.hpp"
#include "adhesion/transient.hpp"
#include "assembly/influence.hpp"
#include "closed_form/carter.hpp"
#include "closed_form/friction.hpp"
#include "discretisation/mesh.hpp"
#include "discretisation/scheme.hpp"
#include "elasticity/line_kernel.hpp"
#include "friction/friction.hpp"
#include "scene/contact.hpp"
#include "spectral/polynomial.hpp"
#include "status.hpp"
#include "types.hpp"
