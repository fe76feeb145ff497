// Responses of subsystems as one, and whether a solution can be used. Internal.
#pragma once

#include <limits>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../status.hpp"
#include "../../types.hpp"
#include "../response.hpp"

namespace rollbem::detail {

/// Whether a solution of n equations can be used; `allowed` is the least rcond in units of n eps.
template <class Scalar>
Status trust(Eigen::Index n, Scalar rcond, Scalar residual, int allowed) {
    const Scalar rounding = static_cast<Scalar>(n) * std::numeric_limits<Scalar>::epsilon();
    const bool trusted = is_finite(rcond) && rcond > static_cast<Scalar>(allowed) * rounding && is_finite(residual) &&
                         residual <= 100 * rounding;
    return trusted ? Status::ok : Status::ill_conditioned;
}

/// The empty response of a system to which its subsystems will be added.
template <class Value>
Response<Value> response_without_parts(Eigen::Index inputs) {
    Response<Value> whole;
    whole.coefficients = MatrixX<Value>::Zero(inputs, inputs);
    whole.rcond = 1;
    whole.status = Status::ok;
    return whole;
}

/// Adds all of a subsystem's response but the unknowns. Its first creepage is number `first` of the system; the worse
/// of both residuals and conditions is kept.
template <class Value>
void add_part(const Response<Value>& part, Eigen::Index first, Response<Value>& whole) {
    const Eigen::Index count = part.coefficients.cols();
    whole.coefficients.block(first, first, count, count) = part.coefficients;
    if (!(part.residual <= whole.residual)) whole.residual = part.residual;
    if (!(part.rcond >= whole.rcond)) whole.rcond = part.rcond;
    if (whole.status == Status::ok) whole.status = part.status;
}

}  // namespace rollbem::detail
