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

namespace detail {

/// Throws std::invalid_argument unless lengths over a are finite and not negative and together that of the contact.
template <std::floating_point Scalar>
void require_parts_of_contact(const char* who, Scalar trailing, Scalar width, Scalar leading) {
    require(is_finite(trailing) && trailing >= 0, who, "trailing", trailing, "be at least 0");
    require(is_finite(width) && width >= 0, who, "width", width, "be positive");
    require(is_finite(leading) && leading >= 0, who, "leading", leading, "be at least 0");
    const Scalar sum = trailing + width + leading;
    require(std::abs(sum - 2) <= std::sqrt(std::numeric_limits<Scalar>::epsilon()), who, "length of all parts", sum,
            "be 2");
}

}  // namespace detail

/// A position in the contact by its distances from both edges, over a: trailing = 1 + x/a, leading = 1 - x/a. Near an
/// edge these keep the digits that x/a loses. Invariant: trailing >= 0, leading >= 0, trailing + leading = 2.
template <std::floating_point Scalar>
struct EdgeDistances {
    Scalar trailing, leading;

    /// Throws std::invalid_argument if the distances break the invariant.
    EdgeDistances(Scalar from_trailing, Scalar from_leading) : trailing(from_trailing), leading(from_leading) {
        detail::require_parts_of_contact("EdgeDistances", trailing, Scalar(0), leading);
    }
    /// At x/a. Throws std::invalid_argument unless -1 <= x/a <= 1.
    static EdgeDistances at(Scalar x_over_a) {
        detail::require(detail::is_finite(x_over_a) && std::abs(x_over_a) <= 1, "EdgeDistances", "x/a", x_over_a,
                        "lie in [-1, 1]");
        return {1 + x_over_a, 1 - x_over_a};
    }
};

/// An interval of the contact: `trailing` is the distance of its trailing end from the trailing edge of the contact,
/// `leading` that of its leading end from the leading edge, all over a. Invariant: trailing >= 0, leading >= 0,
/// width > 0, trailing + width + leading = 2.
template <std::floating_point Scalar>
struct ContactInterval {
    Scalar trailing, width, leading;

    /// Throws std::invalid_argument if the lengths break the invariant.
    ContactInterval(Scalar behind, Scalar length, Scalar ahead) : trailing(behind), width(length), leading(ahead) {
        detail::require(width > 0, "ContactInterval", "width", width, "be positive");
        detail::require_parts_of_contact("ContactInterval", trailing, width, leading);
    }
};

/// Carter's traction p/(G xi) = -sqrt((a-x)/(a+x))/(2(1-nu)) (negative; minus infinity at the trailing edge). Throws
/// std::invalid_argument unless 0 <= poisson_ratio <= 0.5.
template <std::floating_point Scalar>
Scalar carter_traction(const EdgeDistances<Scalar>& position, Scalar poisson_ratio) {
    detail::require_poisson_ratio("carter_traction", poisson_ratio);
    return -std::sqrt(position.leading / position.trailing) / (2 * (1 - poisson_ratio));
}

/// The same at x/a. Throws std::invalid_argument also unless -1 <= x/a <= 1.
template <std::floating_point Scalar>
Scalar carter_traction(Scalar x_over_a, Scalar poisson_ratio) {
    return carter_traction(EdgeDistances<Scalar>::at(x_over_a), poisson_ratio);
}

/// Exact mean of Carter's traction p/(G xi) over an interval, to a few units in the last place of the given distances,
/// however short the interval and however close to an edge. Throws std::invalid_argument unless
/// 0 <= poisson_ratio <= 0.5.
template <std::floating_point Scalar>
Scalar carter_mean_traction(const ContactInterval<Scalar>& interval, Scalar poisson_ratio) {
    using std::atan2, std::sqrt;
    detail::require_poisson_ratio("carter_mean_traction", poisson_ratio);
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
