// Bodies of accuracy/recommendation.hpp. Internal.
#pragma once

#include "../recommendation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../../spectral/chebyshev.hpp"
#include "../../status.hpp"

namespace rollbem {

template <class Solve>
auto extrapolate(const Solve& solve, std::ptrdiff_t n, double order, double band)
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

template <class Scheme>
template <class Scalar, class Solve>
auto Recommendation<Scheme>::evaluate(const Solve& solve) const {
    if constexpr (std::is_same_v<Scheme, Chebyshev>) {
        return solve(scheme);
    } else {
        auto fine = solve(mesh<Scalar>(n), scheme);
        return order > 0 ? richardson(solve(mesh<Scalar>(n / 2), scheme), fine, static_cast<Scalar>(order)) : fine;
    }
}

template <class Step>
auto tangent_by_distance(double dq, double a, const Step& force_at) {
    const double change = 1e-5 * (std::max)(dq, a);
    const double weight = 1 / (2 * change);
    if (dq >= change) return weight * force_at(dq + change) + -weight * force_at(dq - change);
    return 4 * weight * force_at(dq + change) + -3 * weight * force_at(dq) + -weight * force_at(dq + 2 * change);
}

}  // namespace rollbem
