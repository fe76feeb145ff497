// The derivative of a step's force with respect to the distance rolled, which the models do not give: by differences.
#pragma once

#include "../detail/language.hpp"

#include <algorithm>

namespace rollbem {

/// d force / d dq [N/m] of a step over the distance dq [m] >= 0 in a contact of half-length a [m]. `force_at(dq)` is
/// the force, a number or a TangentialForce, of a step from the same state under the same rigid shift and the same load
/// at its end. Differences are central, over 1e-5 of dq or a, whichever is longer; near zero, where the contact cannot
/// roll less, they are one-sided and also of second order.
///
///     const auto tangent = tangent_by_distance(dq, contact.half_length(), [&](double distance) {
///         return model.advance(now, {distance, Motion::shift(shift), load}, next, workspace).force;
///     });
///
/// d force / dV at constant slip velocities is this times the duration of the step.
template <class Step>
auto tangent_by_distance(double dq, double a, const Step& force_at) {
    const double change = 1e-5 * (std::max)(dq, a);
    const double weight = 1 / (2 * change);
    if (dq >= change) return weight * force_at(dq + change) + -weight * force_at(dq - change);
    return 4 * weight * force_at(dq + change) + -3 * weight * force_at(dq) + -weight * force_at(dq + 2 * change);
}

}  // namespace rollbem
