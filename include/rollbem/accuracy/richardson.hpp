// Richardson extrapolation of any result of a scheme whose order of convergence is known: c11, real or complex, or a
// force. Independent of meshes and matrices.
#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../status.hpp"

namespace rollbem {

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

/// (2^p fine - coarse) / (2^p - 1): cancels the term C n^-p in the error of values at n (coarse) and 2n (fine)
/// elements. Whether p is the order of convergence is not checked. Throws std::invalid_argument unless `order` p is
/// positive and finite.
template <class Value>
Value richardson(const Value& coarse, const Value& fine, std::type_identity_t<decltype(std::abs(Value()))> order) {
    detail::require_positive("richardson", "order", order);
    return fine + (fine - coarse) / (std::exp2(order) - 1);
}

/// Values of solve(n), solve(2n) and solve(4n), extrapolated with the given order if they confirm it: the observed
/// order must lie within `band` of it. Otherwise the status is order_differs, as on meshes that are too coarse, for
/// schemes whose error changes sign (the uniform mesh with 0/0.63), or for frequencies that the mesh does not resolve.
/// Values that agree to rounding count as converged. `solve` takes a number of elements and returns a real or complex
/// number. Throws std::invalid_argument unless n >= 1 and order and band are positive and finite, and passes on
/// exceptions of solve.
template <class Solve>
auto extrapolate(const Solve& solve, std::ptrdiff_t n, double order, double band = 0.25)
    -> Extrapolation<std::decay_t<decltype(solve(n))>> {
    using Value = std::decay_t<decltype(solve(n))>;
    using Real = typename Extrapolation<Value>::Real;
    detail::require(n >= 1, "extrapolate", "n", n, "be at least 1");
    detail::require_positive("extrapolate", "order", order);
    detail::require_positive("extrapolate", "band", band);
    const Value coarse = solve(n), middle = solve(2 * n), fine = solve(4 * n);
    Extrapolation<Value> result;
    result.value = fine;
    const Real before = std::abs(coarse - middle), last = std::abs(middle - fine);
    if (!detail::is_finite(before) || !detail::is_finite(last) || !detail::is_finite(fine)) return result;
    const Real rounding = static_cast<Real>(64 * n) * std::numeric_limits<Real>::epsilon() * std::abs(fine);
    if (before <= rounding && last <= rounding) {
        result.error_estimate = rounding;
        result.status = Status::ok;
        return result;
    }
    result.observed_order = std::log2(before / last);
    result.status = Status::order_differs;
    const Value extrapolated = richardson(middle, fine, static_cast<Real>(order));
    result.error_estimate = std::abs(extrapolated - richardson(coarse, middle, static_cast<Real>(order)));
    const Real difference = std::abs(result.observed_order - static_cast<Real>(order));
    if (!detail::is_finite(difference) || !(difference <= static_cast<Real>(band))) return result;
    result.value = extrapolated;
    result.status = Status::ok;
    return result;
}

}  // namespace rollbem
