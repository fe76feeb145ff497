// Full sliding of an elliptic contact under Hertz's pressure: the limit of steady rolling for large creepages and spin.
#pragma once

#include "../detail/decl.hpp"

#include "../scene/force.hpp"

namespace rollbem {

/// -F_x/(mu N), -F_y/(mu N), -M_z/(mu N c), c = sqrt(a b), of an ellipse that slips everywhere, by its rigid slip
/// (longitudinal - spin y, lateral + spin x): creepages in any common unit, spin times c in the same unit. Zero without
/// creepage and spin. a_over_b must be positive and finite.
///
/// Along a line through the pole, where the rigid slip vanishes, the direction of slip is constant, and moments of the
/// pressure over the whole chord have a closed form. The remaining integral over the direction of the line has a smooth
/// integrand and is taken to 1e-6 for a/b = 0.1 ... 10. Spin alone on a circle: 3 pi/16.
TangentialForce full_sliding(double a_over_b, double longitudinal, double lateral, double spin);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/full_sliding.ipp"
#endif
