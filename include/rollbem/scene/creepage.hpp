// Longitudinal and lateral creepage together, with spin.
#pragma once

#include "../detail/finite.hpp"

namespace rollbem {

/// Creepage of body 1 relative to body 2 as a vector, and spin. The rigid slip over the rolling velocity at (x, y) is
/// (longitudinal - spin y, lateral + spin x), with x and y from the middle of the contact or the origin of an outline.
/// A rigid shift has the same components as lengths and an angle. Positive components give negative forces and a
/// negative moment.
struct Creepage {
    double longitudinal = 0;  ///< along the rolling direction x [-]; of a shift [m]
    double lateral = 0;       ///< along y [-]; of a shift [m]
    double spin = 0;          ///< about the normal to the contact [1/m]; of a shift an angle [rad]

    friend bool operator==(const Creepage&, const Creepage&) = default;
};

namespace detail {

inline bool is_finite(const Creepage& creepage) {
    return is_finite(creepage.longitudinal) && is_finite(creepage.lateral) && is_finite(creepage.spin);
}

}  // namespace detail

}  // namespace rollbem
