// Longitudinal and lateral creepage together.
#pragma once

#include "../detail/language.hpp"

#include "../detail/finite.hpp"

namespace rollbem {

/// Creepage of body 1 relative to body 2 as a vector [-]; for a rigid shift its components are in [m]. Positive
/// components give negative forces.
template <class Scalar_ = double>
struct Creepage {
    using Scalar = Scalar_;

    Scalar longitudinal = 0;  ///< along the rolling direction x
    Scalar lateral = 0;       ///< along y

    friend bool operator==(const Creepage&, const Creepage&) = default;
};

namespace detail {

template <class Scalar>
bool is_finite(const Creepage<Scalar>& creepage) {
    return is_finite(creepage.longitudinal) && is_finite(creepage.lateral);
}

}  // namespace detail

}  // namespace rollbem
