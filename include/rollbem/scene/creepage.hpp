// Longitudinal and lateral creepage, and spin.
#pragma once

#include "../detail/language.hpp"

#include "../detail/finite.hpp"

namespace rollbem {

/// Creepage of body 1 relative to body 2 as a vector [-], and spin [1/m]; for a rigid shift the components are in [m],
/// spin is an angle. The rigid slip at (x, y) is (longitudinal - spin y, lateral + spin x). Positive components give
/// negative forces.
template <class Scalar_ = double>
struct Creepage {
    using Scalar = Scalar_;

    Scalar longitudinal = 0;  ///< along the rolling direction x
    Scalar lateral = 0;       ///< along y
    Scalar spin = 0;          ///< about the normal z, per distance rolled; friction knows none, and refuses it

    friend bool operator==(const Creepage&, const Creepage&) = default;
};

namespace detail {

template <class Scalar>
bool is_finite(const Creepage<Scalar>& creepage) {
    return is_finite(creepage.longitudinal) && is_finite(creepage.lateral) && is_finite(creepage.spin);
}

}  // namespace detail

}  // namespace rollbem
