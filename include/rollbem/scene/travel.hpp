// How far the contact rolls in a step, and how long that takes.
#pragma once

#include "../detail/language.hpp"

namespace rollbem {

/// Distance and duration of one step. Only friction that depends on the velocity of slip needs the duration; everything
/// else takes a plain dq.
template <class Scalar = double>
struct Travel {
    Scalar dq;        ///< distance rolled [m], positive; 0 for a rigid shift without rolling
    Scalar duration;  ///< [s], positive
};

namespace detail {

/// A Travel whose duration does not matter: a plain dq will do.
template <class Scalar>
struct UntimedTravel : rollbem::Travel<Scalar> {
    UntimedTravel(rollbem::Travel<Scalar> travel) : rollbem::Travel<Scalar>(travel) {}  // NOLINT: implicit on purpose
    UntimedTravel(Scalar distance) : rollbem::Travel<Scalar>{distance, 0} {}            // NOLINT: implicit on purpose
};

}  // namespace detail

}  // namespace rollbem
