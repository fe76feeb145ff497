// The result of an extrapolation to small elements.
#pragma once

#include "../../detail/language.hpp"

#include <cmath>
#include <complex>
#include <limits>

#include "../../status.hpp"

namespace rollbem::detail {

/// Result of extrapolate().
template <class Value>
struct Extrapolation {
    using Real = decltype(std::abs(Value()));

    Value value{};  ///< extrapolated from the two finer values; the finest value unless the status is ok
    /// |value minus the extrapolation from the two coarser values|: an upper estimate of the absolute error in value.
    Real error_estimate = std::numeric_limits<Real>::quiet_NaN();
    /// log2 |(coarse - middle) / (middle - fine)|; NaN if the values agree to rounding.
    Real observed_order = std::numeric_limits<Real>::quiet_NaN();
    Status status = Status::not_finite;  ///< order_differs: the finest value is returned unchanged
};

}  // namespace rollbem::detail
