// Bodies of closed_form/carter.hpp. Internal.
#pragma once

#include "../carter.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>
#include <type_traits>

#include "../../detail/angle_minus_sine.hpp"
#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../../scene/creepage.hpp"
#include "../detail/plane_lambda.hpp"

namespace rollbem {

template <std::floating_point Scalar>
Scalar steady_c11(Scalar poisson_ratio) {
    detail::require_poisson_ratio("steady_c11", poisson_ratio);
    return std::numbers::pi_v<Scalar> / (2 * (1 - poisson_ratio));
}

template <std::floating_point Scalar>
Scalar carter_traction(const EdgeDistances<Scalar>& position, Scalar poisson_ratio) {
    detail::require_poisson_ratio("carter_traction", poisson_ratio);
    return -std::sqrt(position.leading / position.trailing) / (2 * (1 - poisson_ratio));
}

template <std::floating_point Scalar>
Scalar carter_mean_traction(const EdgeDistances<Scalar>& behind, std::type_identity_t<Scalar> width,
                            const EdgeDistances<Scalar>& ahead, std::type_identity_t<Scalar> poisson_ratio) {
    using std::atan2, std::sqrt;
    detail::require_poisson_ratio("carter_mean_traction", poisson_ratio);
    detail::require_positive("carter_mean_traction", "width", width);
    // With x = -cos(theta) the integral of sqrt((1-x)/(1+x)) is theta + sin(theta). Between theta_1 and theta_2, with
    // mean m and half the difference h, it is 2 (h - sin h) + 2 sin(h) (1 + cos m): a sum of positive terms. All
    // functions of m and h follow from sines and cosines of theta/2, which are square roots of half the edge distances.
    const Scalar sine_1 = sqrt(behind.trailing / 2), cosine_1 = sqrt(behind.leading / 2);
    const Scalar sine_2 = sqrt(ahead.trailing / 2), cosine_2 = sqrt(ahead.leading / 2);
    const Scalar sine_mean = sine_2 * cosine_1 + cosine_2 * sine_1;
    const Scalar cosine_mean = cosine_1 * cosine_2 - sine_1 * sine_2;
    const Scalar sine_half = width / (2 * sine_mean);
    const Scalar half = atan2(sine_half, cosine_1 * cosine_2 + sine_1 * sine_2);
    const Scalar one_plus_cosine_mean = cosine_mean >= 0 ? 1 + cosine_mean : sine_mean * sine_mean / (1 - cosine_mean);

    const Scalar half_minus_sine = detail::angle_minus_sine(half, sine_half);
    const Scalar integral = 2 * (half_minus_sine + sine_half * one_plus_cosine_mean);
    return -integral / (width * 2 * (1 - poisson_ratio));
}

template <class AnyMesh>
typename AnyMesh::Array carter_mean_tractions(const AnyMesh& mesh, typename AnyMesh::Scalar poisson_ratio) {
    using Scalar = typename AnyMesh::Scalar;
    typename AnyMesh::Array means(mesh.size());
    for (decltype(mesh.size()) i = 0; i < mesh.size(); ++i) {
        const auto edge = [&](auto j) {
            return EdgeDistances<Scalar>{mesh.edges_from_trailing()[j], mesh.edges_from_leading()[j]};
        };
        means[i] = carter_mean_traction(edge(i), mesh.widths()[i], edge(i + 1), poisson_ratio);
    }
    return means;
}

template <std::floating_point Scalar>
Scalar carter_force_ratio(Scalar creepage_ratio) {
    detail::require(!detail::is_nan(creepage_ratio), "carter_force_ratio", "creepage_ratio", creepage_ratio,
                    "be a number");
    const Scalar delta = (std::min)(std::abs(creepage_ratio), Scalar(1));
    return std::copysign(delta * (2 - delta), creepage_ratio);
}

template <std::floating_point Scalar>
Scalar carter_stick_border(Scalar creepage_ratio) {
    detail::require(!detail::is_nan(creepage_ratio), "carter_stick_border", "creepage_ratio", creepage_ratio,
                    "be a number");
    return (std::min)(2 * std::abs(creepage_ratio), Scalar(2)) - 1;
}

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

template <std::floating_point Scalar>
Scalar cattaneo_stick_half_length(Scalar force_ratio) {
    detail::require(detail::is_finite(force_ratio) && std::abs(force_ratio) <= Scalar(1), "cattaneo_stick_half_length",
                    "force_ratio", force_ratio, "lie in [-1, 1]");
    return std::sqrt(1 - std::abs(force_ratio));
}

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

template <std::floating_point Scalar>
EdgeDistances<Scalar>::EdgeDistances(Scalar from_trailing, Scalar from_leading)
    : trailing(from_trailing), leading(from_leading) {
    const char* const who = "EdgeDistances";
    detail::require(detail::is_finite(trailing) && trailing >= 0, who, "trailing", trailing, "be at least 0");
    detail::require(detail::is_finite(leading) && leading >= 0, who, "leading", leading, "be at least 0");
    const Scalar sum = trailing + leading;
    detail::require(std::abs(sum - 2) <= std::sqrt(std::numeric_limits<Scalar>::epsilon()), who, "trailing + leading",
                    sum, "be 2");
}

template <std::floating_point Scalar>
auto EdgeDistances<Scalar>::at(Scalar x_over_a) -> EdgeDistances {
    detail::require(detail::is_finite(x_over_a) && std::abs(x_over_a) <= 1, "EdgeDistances", "x/a", x_over_a,
                    "lie in [-1, 1]");
    return {1 + x_over_a, 1 - x_over_a};
}

}  // namespace rollbem
