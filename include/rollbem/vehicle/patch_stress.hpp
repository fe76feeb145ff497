// Stresses in the rail below a patch that rubs.
#pragma once

#include "../detail/decl.hpp"

#include <vector>

#include <Eigen/Core>

#include "../elasticity/subsurface_stress.hpp"
#include "wheelset_forces.hpp"

namespace rollbem {

/// Below each strip the largest of the stresses under the middles of its elements, down to the length of the patch, by
/// tractions and pressures of all patches of the plane; in the rail, which is as stiff as the wheel: stresses in the
/// wheel are mirror images under opposite tractions. Empty for friction without a result. Throws as
/// subsurface_stress(). The point of a strip is its middle y = s and the place x where von Mises' measure is largest.
std::vector<Yield::Peak> stresses_below(const PatchForce& friction, double poisson_ratio);

/// The point of a patch in the map of shakedown; `shear_yield` is k, the yield stress in shear [Pa].
Yield::Shakedown shakedown_point(const RailPatch& patch, const PatchForce& friction, double shear_yield);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/patch_stress.ipp"
#endif
