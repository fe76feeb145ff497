// Length of a plane vector.
#pragma once

#include "language.hpp"

#include <cmath>
#include <limits>

namespace rollbem::detail {

/// Like std::hypot, but several times faster where squares neither overflow nor lose digits; to 2 roundings.
template <class Scalar>
Scalar length(Scalar x, Scalar y) {
    const Scalar square = x * x + y * y;
    constexpr Scalar least = (std::numeric_limits<Scalar>::min)() / std::numeric_limits<Scalar>::epsilon();
    return square >= least && square <= (std::numeric_limits<Scalar>::max)() ? std::sqrt(square) : std::hypot(x, y);
}

}  // namespace rollbem::detail
