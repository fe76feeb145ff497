// Whether the numbers of a look-up are finite.
#pragma once

#include "../../detail/finite.hpp"
#include "../creep_force_table.hpp"

namespace rollbem::detail {

/// Whether all numbers of a look-up are finite; false also if their sum overflows.
inline bool is_finite(const CreepForceTable::Force& of) {
    const TangentialForce sum = of.force + of.tangent.by_longitudinal + of.tangent.by_lateral + of.tangent.by_spin +
                                of.tangent_by_load + of.tangent_by_friction_coefficient + of.tangent_by_half_length +
                                of.tangent_by_half_width;
    return is_finite(sum.longitudinal + sum.lateral + sum.moment);
}

}  // namespace rollbem::detail
