// Coulomb friction under Hertz pressure p0 sqrt(1 - x^2/a^2), in elementary functions: Carter's steady rolling with
// partial slip and Cattaneo's shift from rest. Dimensionless: x in a, tractions in mu p0, forces in mu N.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "carter.hpp"

namespace rollbem {

/// Carter's steady creep-force law: force_ratio = -F/(mu N) = 2 delta - delta^2 up to full sliding at delta = 1, and 1
/// for larger delta; odd in delta. delta = xi G/(2 (1-nu) mu p0) is the creepage ratio. Throws std::invalid_argument if
/// it is NaN.
template <std::floating_point Scalar>
Scalar carter_force_ratio(Scalar creepage_ratio) {
    detail::require(!detail::is_nan(creepage_ratio), "carter_force_ratio", "creepage_ratio", creepage_ratio,
                    "be a number");
    const Scalar delta = (std::min)(std::abs(creepage_ratio), Scalar(1));
    return std::copysign(delta * (2 - delta), creepage_ratio);
}

/// x/a at which stick begins in Carter's steady solution: min(2 |delta|, 2) - 1. The stick zone extends from there to
/// the leading edge; slip lies behind it. Throws std::invalid_argument if the ratio is NaN.
template <std::floating_point Scalar>
Scalar carter_stick_border(Scalar creepage_ratio) {
    detail::require(!detail::is_nan(creepage_ratio), "carter_stick_border", "creepage_ratio", creepage_ratio,
                    "be a number");
    return (std::min)(2 * std::abs(creepage_ratio), Scalar(2)) - 1;
}

/// Traction p/(mu p0) of Carter's steady solution with slip, at x/a; its sign is opposite to the sign of
/// creepage_ratio. Throws std::invalid_argument unless -1 <= x/a <= 1, or if the ratio is NaN.
template <std::floating_point Scalar>
Scalar carter_friction_traction(Scalar x_over_a, Scalar creepage_ratio) {
    using std::sqrt;
    detail::require(detail::is_finite(x_over_a) && x_over_a >= Scalar(-1) && x_over_a <= Scalar(1),
                    "carter_friction_traction", "x/a", x_over_a, "lie in [-1, 1]");
    const Scalar border = carter_stick_border(creepage_ratio);
    const Scalar trailing = sqrt(1 + x_over_a);
    const Scalar leading = sqrt(1 - x_over_a);
    if (x_over_a <= border) {
        return -std::copysign(leading * trailing, creepage_ratio);
    }
    // difference of two half ellipses, rewritten without cancellation; for small delta it is Carter's full adhesion
    return -2 * creepage_ratio * leading / (trailing + sqrt(x_over_a - border));
}

/// Cattaneo: half-length c/a of the stick zone |x| < c under a force F without rolling, |F|/(mu N) = 1 - c^2/a^2.
/// Throws std::invalid_argument unless |force_ratio| <= 1.
template <std::floating_point Scalar>
Scalar cattaneo_stick_half_length(Scalar force_ratio) {
    detail::require(detail::is_finite(force_ratio) && std::abs(force_ratio) <= Scalar(1), "cattaneo_stick_half_length",
                    "force_ratio", force_ratio, "lie in [-1, 1]");
    return std::sqrt(1 - std::abs(force_ratio));
}

/// Traction p/(mu p0) of Cattaneo's solution at x/a for force_ratio = -F/(mu N); its sign is opposite to force_ratio.
/// Throws std::invalid_argument unless -1 <= x/a <= 1 and |force_ratio| <= 1.
template <std::floating_point Scalar>
Scalar cattaneo_traction(Scalar x_over_a, Scalar force_ratio) {
    using std::abs, std::sqrt;
    detail::require(abs(x_over_a) <= Scalar(1), "cattaneo_traction", "x/a", x_over_a, "lie in [-1, 1]");
    const Scalar stick = cattaneo_stick_half_length(force_ratio);
    const Scalar bound = sqrt((1 - x_over_a) * (1 + x_over_a));
    if (abs(x_over_a) >= stick) {
        return -std::copysign(bound, force_ratio);
    }
    return -force_ratio / (bound + sqrt((stick - x_over_a) * (stick + x_over_a)));
}

/// Cattaneo's rigid shift W in units of mu p0 a/G for force_ratio = -F/(mu N) (W and force_ratio have the same sign),
/// plane kernel: W = (a^2 B(a) - c^2 B(c)) mu p0/(a G), B(c) = (1-nu)(ln(4b/c) + 1/2) + nu. Throws
/// std::invalid_argument unless |force_ratio| <= 1, 0 <= poisson_ratio <= 0.5 and `aspect` b/a is positive and finite.
template <std::floating_point Scalar>
Scalar cattaneo_shift(Scalar force_ratio, Scalar poisson_ratio, Scalar aspect) {
    const Scalar lambda = plane_lambda(poisson_ratio, aspect);
    detail::require(detail::is_finite(force_ratio) && std::abs(force_ratio) <= Scalar(1), "cattaneo_shift",
                    "force_ratio", force_ratio, "lie in [-1, 1]");
    // c^2 = 1 - f; written in f so that a small force keeps its digits. The last term vanishes at c = 0.
    const Scalar f = std::abs(force_ratio);
    const Scalar logarithm = f < 1 ? (1 - f) / 2 * std::log1p(-f) : Scalar(0);
    return std::copysign((1 - poisson_ratio) * ((lambda + Scalar(0.5)) * f + logarithm), force_ratio);
}

/// The force ratio -F/(mu N) after a rigid shift W (in mu p0 a/G) from rest: the inverse of cattaneo_shift; its
/// absolute value is 1 if the shift exceeds the shift of full sliding. Throws std::invalid_argument if the shift is
/// NaN, and unless 0 <= poisson_ratio <= 0.5, 0 < aspect < inf and Lambda > 0 (for Lambda <= 0 the plane model's shift
/// is not monotonic).
template <std::floating_point Scalar>
Scalar cattaneo_force_ratio(Scalar shift, Scalar poisson_ratio, Scalar aspect) {
    const Scalar lambda = detail::stable_plane_lambda("cattaneo_force_ratio", poisson_ratio, aspect);
    detail::require(!detail::is_nan(shift), "cattaneo_force_ratio", "shift", shift, "be a number");
    const Scalar target = std::abs(shift);
    if (target >= cattaneo_shift(Scalar(1), poisson_ratio, aspect)) {
        return std::copysign(Scalar(1), shift);
    }
    // The shift is convex and increasing in f: Newton's method from above decreases monotonically to the root. Rounding
    // ends it: the first step that does not decrease.
    Scalar f = (std::min)(target / ((1 - poisson_ratio) * lambda), 1 - std::numeric_limits<Scalar>::epsilon());
    while (true) {
        const Scalar residual = cattaneo_shift(f, poisson_ratio, aspect) - target;
        const Scalar slope = (1 - poisson_ratio) * (lambda - std::log1p(-f) / 2);
        const Scalar next = f - residual / slope;
        if (!(next < f)) {
            return std::copysign(f, shift);
        }
        f = next;
    }
}

}  // namespace rollbem
