// EstimatedC11: a creep coefficient and its estimated accuracy. Internal.
#pragma once

#include <complex>
#include <concepts>

#include "../../status.hpp"

namespace rollbem {

/// A creep coefficient under creepage xi e^{s V t/a} with its estimated accuracy. Closed forms, which are exact to
/// rounding, return the number itself.
template <std::floating_point Scalar>
struct EstimatedC11 {
    std::complex<Scalar> c11;  ///< Eq. (30): force per unit width over -a G xi
    Scalar error_estimate;     ///< relative error by truncation and rounding together; an upper estimate, not a bound
    Status status = Status::not_finite;
};

}  // namespace rollbem
