// Logarithms of whole arrays where the plain one is not finite or loses digits.
// Internal.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Core>

#include "array_functions.hpp"

namespace rollbem::detail {

/// ln|x|, with ln 0 replaced by a finite number so that x ln|x| is 0 at x = 0.
template <class Scalar>
Eigen::Array<Scalar, Eigen::Dynamic, 1> finite_log(const Eigen::Array<Scalar, Eigen::Dynamic, 1>& x) {
    Eigen::Array<Scalar, Eigen::Dynamic, 1> result(x.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        result[i] = std::max(std::abs(x[i]), std::numeric_limits<Scalar>::min());
    }
    log_in_place(result);
    return result;
}

/// ln(1 + u) for u >= 0 to full relative accuracy: in ln(w) u / (w - 1) with w = 1 + u rounded, the rounding of w
/// cancels; if w = 1, the result is u.
template <class Scalar>
Eigen::Array<Scalar, Eigen::Dynamic, 1> log1p_array(const Eigen::Array<Scalar, Eigen::Dynamic, 1>& u) {
    Eigen::Array<Scalar, Eigen::Dynamic, 1> result(u.size());
    for (Eigen::Index i = 0; i < u.size(); ++i) {
        const Scalar w = u[i] + 1;
        result[i] = w == 1 ? u[i] : std::log(w) * (u[i] / (w - 1));
    }
    return result;
}

}  // namespace rollbem::detail
