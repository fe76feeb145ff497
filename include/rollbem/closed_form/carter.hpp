// Steady rolling in full adhesion, in elementary functions: Carter's traction, its exact mean over an element, and the
// creep coefficients. Dimensionless: a = G = V = 1.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>

#include "../detail/angle_minus_sine.hpp"
#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "plane_lambda.hpp"

namespace rollbem {

/// Steady creep coefficient c11 = pi/(2(1-nu)) of Eq. (30), per unit width of a rectangle (or of an infinitely long
/// contact). Throws std::invalid_argument unless 0 <= poisson_ratio <= 0.5.
template <std::floating_point Scalar>
Scalar steady_c11(Scalar poisson_ratio) {
    detail::require_poisson_ratio("steady_c11", poisson_ratio);
    return std::numbers::pi_v<Scalar> / (2 * (1 - poisson_ratio));
}

/// Steady creep coefficient c22 = -F_y/(a G xi_y) = pi/2 for lateral creepage, per unit width like steady_c11. It is
/// independent of Poisson's ratio.
template <std::floating_point Scalar = double>
constexpr Scalar steady_c22() {
    return std::numbers::pi_v<Scalar> / 2;
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
    Scalar trailing;
    Scalar leading;
};

/// An interval of the contact: `trailing` is the distance of its trailing end from the trailing edge of the contact,
/// `leading` that of its leading end from the leading edge, all over a. Invariant: trailing >= 0, leading >= 0,
/// width > 0, trailing + width + leading = 2.
template <std::floating_point Scalar>
struct ContactInterval {
    Scalar trailing;
    Scalar width;
    Scalar leading;
};

/// Carter's traction p/(G xi) = -sqrt((a-x)/(a+x))/(2(1-nu)) (negative; minus infinity at the trailing edge). Throws
/// std::invalid_argument for negative distances, distances whose sum is not 2, or a Poisson's ratio outside [0, 0.5].
template <std::floating_point Scalar>
Scalar carter_traction(const EdgeDistances<Scalar>& position, Scalar poisson_ratio) {
    using std::abs, std::sqrt;
    detail::require_poisson_ratio("carter_traction", poisson_ratio);
    detail::require(detail::is_finite(position.trailing) && position.trailing >= Scalar(0), "carter_traction",
                    "trailing", position.trailing, "be at least 0");
    detail::require(detail::is_finite(position.leading) && position.leading >= Scalar(0), "carter_traction", "leading",
                    position.leading, "be at least 0");
    const Scalar sum = position.trailing + position.leading;
    detail::require(abs(sum - 2) <= sqrt(std::numeric_limits<Scalar>::epsilon()), "carter_traction",
                    "trailing + leading", sum, "be 2");
    return -sqrt(position.leading / position.trailing) / (2 * (1 - poisson_ratio));
}

/// Carter's traction p/(G xi) at x/a. Throws std::invalid_argument unless -1 <= x/a <= 1 and 0 <= poisson_ratio <= 0.5.
template <std::floating_point Scalar>
Scalar carter_traction(Scalar x_over_a, Scalar poisson_ratio) {
    detail::require(detail::is_finite(x_over_a) && x_over_a >= Scalar(-1) && x_over_a <= Scalar(1), "carter_traction",
                    "x/a", x_over_a, "lie in [-1, 1]");
    return carter_traction(EdgeDistances<Scalar>{1 + x_over_a, 1 - x_over_a}, poisson_ratio);
}

/// Exact mean of Carter's traction p/(G xi) over an interval, to a few units in the last place of the given distances,
/// however short the interval and however close to an edge. Throws std::invalid_argument if the interval breaks its
/// invariant or Poisson's ratio lies outside [0, 0.5].
template <std::floating_point Scalar>
Scalar carter_mean_traction(const ContactInterval<Scalar>& interval, Scalar poisson_ratio) {
    using std::abs, std::atan2, std::sqrt;
    detail::require_poisson_ratio("carter_mean_traction", poisson_ratio);
    detail::require(detail::is_finite(interval.trailing) && interval.trailing >= Scalar(0), "carter_mean_traction",
                    "trailing", interval.trailing, "be at least 0");
    detail::require(detail::is_finite(interval.leading) && interval.leading >= Scalar(0), "carter_mean_traction",
                    "leading", interval.leading, "be at least 0");
    detail::require(detail::is_finite(interval.width) && interval.width > Scalar(0), "carter_mean_traction", "width",
                    interval.width, "be positive");
    const Scalar sum = interval.trailing + interval.width + interval.leading;
    detail::require(abs(sum - 2) <= sqrt(std::numeric_limits<Scalar>::epsilon()), "carter_mean_traction",
                    "trailing + width + leading", sum, "be 2");

    // With x = -cos(theta) the integral of sqrt((1-x)/(1+x)) is theta + sin(theta). Between theta_1 and theta_2, with
    // mean m and half the difference h, that is 2 (h - sin h) + 2 sin(h) (1 + cos m): a sum of positive terms. All
    // functions of m and h follow from sines and cosines of theta/2, which are square roots of half the edge distances.
    const Scalar sine_1 = sqrt(interval.trailing / 2);
    const Scalar cosine_1 = sqrt((interval.leading + interval.width) / 2);
    const Scalar sine_2 = sqrt((interval.trailing + interval.width) / 2);
    const Scalar cosine_2 = sqrt(interval.leading / 2);
    const Scalar sine_mean = sine_2 * cosine_1 + cosine_2 * sine_1;
    const Scalar cosine_mean = cosine_1 * cosine_2 - sine_1 * sine_2;
    const Scalar sine_half = interval.width / (2 * sine_mean);
    const Scalar half = atan2(sine_half, cosine_1 * cosine_2 + sine_1 * sine_2);
    const Scalar one_plus_cosine_mean = cosine_mean >= 0 ? 1 + cosine_mean : sine_mean * sine_mean / (1 - cosine_mean);

    const Scalar half_minus_sine = detail::angle_minus_sine(half, sine_half);
    const Scalar integral = 2 * (half_minus_sine + sine_half * one_plus_cosine_mean);
    return -integral / (interval.width * 2 * (1 - poisson_ratio));
}

/// Exact mean of Carter's traction p/(G xi) over [x1, x2], both over a. Throws std::invalid_argument unless
/// -1 <= x1 < x2 <= 1 and 0 <= poisson_ratio <= 0.5.
template <std::floating_point Scalar>
Scalar carter_mean_traction(Scalar x1_over_a, Scalar x2_over_a, Scalar poisson_ratio) {
    detail::require(detail::is_finite(x1_over_a) && x1_over_a >= Scalar(-1) && x1_over_a < x2_over_a,
                    "carter_mean_traction", "x1/a", x1_over_a, "lie in [-1, x2/a)");
    detail::require(detail::is_finite(x2_over_a) && x2_over_a <= Scalar(1), "carter_mean_traction", "x2/a", x2_over_a,
                    "lie in (x1/a, 1]");
    return carter_mean_traction(ContactInterval<Scalar>{1 + x1_over_a, x2_over_a - x1_over_a, 1 - x2_over_a},
                                poisson_ratio);
}

/// Exact means of Carter's traction p/(G xi) over the n elements of a Mesh, trailing to leading, to which the tractions
/// of steady rolling converge. Throws std::invalid_argument unless 0 <= poisson_ratio <= 0.5.
template <class AnyMesh>
typename AnyMesh::Array carter_mean_tractions(const AnyMesh& mesh, typename AnyMesh::Scalar poisson_ratio) {
    using Scalar = typename AnyMesh::Scalar;
    typename AnyMesh::Array means(mesh.size());
    for (decltype(mesh.size()) i = 0; i < mesh.size(); ++i) {
        const ContactInterval<Scalar> element{mesh.edges_from_trailing()[i], mesh.widths()[i],
                                              mesh.edges_from_leading()[i + 1]};
        means[i] = carter_mean_traction(element, poisson_ratio);
    }
    return means;
}

}  // namespace rollbem
