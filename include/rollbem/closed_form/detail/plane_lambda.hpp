// Lambda, the compliance number of the plane model: unless it is positive, this model is unstable in the time domain,
// before any discretisation. Dimensionless: a = G = V = 1. Internal.
#pragma once

#include <cmath>
#include <concepts>
#include <numbers>
#include <string>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"

namespace rollbem {

namespace detail {

/// Lambda = ln(4b/a) + c2/c1, with c2/c1 = nu/(1-nu) for longitudinal creepage and -nu for lateral; not checked.
template <std::floating_point Scalar>
Scalar plane_lambda_of(Scalar aspect, Scalar c2_over_c1) {
    return std::log(aspect) + 2 * std::numbers::ln2_v<Scalar> + c2_over_c1;  // 4 aspect could overflow
}

}  // namespace detail

/// Lambda = ln(4b/a) + nu/(1-nu): the mean compliance of the plane model over its compliance for the first harmonics.
/// Non-steady plane problems are stable only while Lambda > 0. `aspect` is b/a. Throws std::invalid_argument unless
/// aspect is positive and finite and 0 <= poisson_ratio <= 0.5.
template <std::floating_point Scalar>
Scalar plane_lambda(Scalar poisson_ratio, Scalar aspect) {
    detail::require_poisson_ratio("plane_lambda", poisson_ratio);
    detail::require(detail::is_finite(aspect) && aspect > Scalar(0), "plane_lambda", "aspect", aspect,
                    "be positive and finite (only steady problems have a limit for an infinite aspect)");
    return detail::plane_lambda_of(aspect, poisson_ratio / (1 - poisson_ratio));
}

namespace detail {

/// The plane_lambda of a non-steady problem. Throws std::invalid_argument, naming `who`, also if Lambda <= 0: there the
/// plane model itself is unstable (its kernel becomes negative inside the contact).
template <std::floating_point Scalar>
Scalar stable_plane_lambda(const char* who, Scalar poisson_ratio, Scalar aspect) {
    const Scalar lambda = plane_lambda(poisson_ratio, aspect);
    if (!(lambda > Scalar(0))) {
        const std::string rule = "be positive: at aspect b/a = " + to_text(aspect) +
                                 " the plane model is unstable in time; use the strip kernel";
        require(false, who, "Lambda = ln(4b/a) + nu/(1-nu)", lambda, rule.c_str());
    }
    return lambda;
}

}  // namespace detail

}  // namespace rollbem

#ifdef ROLLBEM_COMPILED
namespace rollbem {
extern template double detail::stable_plane_lambda<double>(const char*, double, double);
}  // namespace rollbem
#endif
