// Length of a plane vector.
#pragma once

#include "language.hpp"

#include <cmath>
#include <limits>

#include "finite.hpp"

namespace rollbem::detail {

/// The length by a square root where squares neither overflow nor lose digits, else by std::hypot; accurate to 2
/// roundings.
template <class Scalar>
Scalar length(Scalar x, Scalar y) {
    const Scalar square = x * x + y * y;
    return square >= negligible<Scalar> && square <= (std::numeric_limits<Scalar>::max)() ? std::sqrt(square)
                                                                                          : std::hypot(x, y);
}

}  // namespace rollbem::detail
