// Steady rolling in full adhesion, in elementary functions: Carter's traction, its exact mean over an element, and the
// creep coefficients. Dimensionless: a = G = V = 1.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>
#include <type_traits>

#include "../detail/angle_minus_sine.hpp"
#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "plane_lambda.hpp"

namespace rollbem {

/// Steady creep coefficient c11 = pi/(2(1-nu)) of Eq. (30), per unit width of a rectangle (or of an infinitely long
/// contact). For lateral creepage, c22 is pi/2 = steady_c11(0.0), whatever nu is. Throws std::invalid_argument unless 0
/// <= poisson_ratio <= 0.5.
template <std::floating_point Scalar>
Scalar steady_c11(Scalar poisson_ratio) {
    detail::require_poisson_ratio("steady_c11", poisson_ratio);
    return std::numbers::pi_v<Scalar> / (2 * (1 - poisson_ratio));
}

/// The value pi^2/(4(1-nu)) of Eq. (31). It is the limit b >> a of Kalker's coefficient of an *ellipse*, defined by
/// F = -a b G C11 xi; an ellipse has the area pi a b where the rectangle has 4 a b, and chords that shorten towards its
/// tips, hence the factor pi/2 relative to steady_c11. Throws std::invalid_argument unless 0 <= poisson_ratio <= 0.5.
template <std::floating_point Scalar>
Scalar ellipse_limit_c11(Scalar poisson_ratio) {
    return std::numbers::pi_v<Scalar> / 2 * steady_c11(poisson_ratio);
}

/// A position in the contact by its distances from both edges, over a: trailing = 1 + x/a, leading = 1 - x/a. Near an
/// edge these keep the digits that x/a loses. Invariant: trailing >= 0, leading >= 0, trailing + leading = 2.
template <std::floating_point Scalar>
struct EdgeDistances {
    Scalar trailing, leading;

    /// Throws std::invalid_argument if the distances break the invariant.
    EdgeDistances(Scalar from_trailing, Scalar from_leading) : trailing(from_trailing), leading(from_leading) {
        const char* const who = "EdgeDistances";
        detail::require(detail::is_finite(trailing) && trailing >= 0, who, "trailing", trailing, "be at least 0");
        detail::require(detail::is_finite(leading) && leading >= 0, who, "leading", leading, "be at least 0");
        const Scalar sum = trailing + leading;
        detail::require(std::abs(sum - 2) <= std::sqrt(std::numeric_limits<Scalar>::epsilon()), who,
                        "trailing + leading", sum, "be 2");
    }
    /// The position x/a. Throws std::invalid_argument unless -1 <= x/a <= 1.
    static EdgeDistances at(Scalar x_over_a) {
        detail::require(detail::is_finite(x_over_a) && std::abs(x_over_a) <= 1, "EdgeDistances", "x/a", x_over_a,
                        "lie in [-1, 1]");
        return {1 + x_over_a, 1 - x_over_a};
    }
};

/// Carter's traction p/(G xi) = -sqrt((a-x)/(a+x))/(2(1-nu)) (negative; minus infinity at the trailing edge). Throws
/// std::invalid_argument unless 0 <= poisson_ratio <= 0.5.
template <std::floating_point Scalar>
Scalar carter_traction(const EdgeDistances<Scalar>& position, Scalar poisson_ratio) {
    detail::require_poisson_ratio("carter_traction", poisson_ratio);
    return -std::sqrt(position.leading / position.trailing) / (2 * (1 - poisson_ratio));
}

/// Carter's traction at x/a. Throws std::invalid_argument also unless -1 <= x/a <= 1.
template <std::floating_point Scalar>
Scalar carter_traction(Scalar x_over_a, Scalar poisson_ratio) {
    return carter_traction(EdgeDistances<Scalar>::at(x_over_a), poisson_ratio);
}

/// Exact mean of Carter's traction p/(G xi) over an interval between two positions of the contact, `width` apart: to a
/// few units in the last place of the given distances, however short the interval and however close to an edge. Throws
/// std::invalid_argument unless 0 < width and 0 <= poisson_ratio <= 0.5.
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

/// Exact means of Carter's traction p/(G xi) over the n elements of a Mesh, trailing to leading, to which the tractions
/// of steady rolling converge. Throws std::invalid_argument unless 0 <= poisson_ratio <= 0.5.
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

}  // namespace rollbem
