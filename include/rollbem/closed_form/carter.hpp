// Closed forms of lines: Carter's traction and creep coefficients in full adhesion, Carter's steady rolling with friction,
// Cattaneo's shift from rest, in elementary functions and dimensionless, a = G = V = 1; and full sliding of an ellipse.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>
#include <type_traits>

#include "../detail/angle_minus_sine.hpp"
#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../scene/creepage.hpp"
#include "detail/plane_lambda.hpp"

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

/// -F_x/(mu N), -F_y/(mu N), -M_z/(mu N c), c = sqrt(a b), of an ellipse that slips everywhere, by its rigid slip
/// (longitudinal - spin y, lateral + spin x): creepages in any common unit, spin times c in the same unit. Zero without
/// creepage and spin. a_over_b must be positive and finite.
///
/// Along a line through the pole, where the rigid slip vanishes, the direction of slip is constant, and moments of the
/// pressure over the whole chord have a closed form. The remaining integral over the direction of the line has a smooth
/// integrand and is taken to 1e-6 for a/b = 0.1 ... 10. Spin alone on a circle: 3 pi/16.
inline TangentialForce full_sliding(double a_over_b, double longitudinal, double lateral, double spin) {
    using std::abs, std::cos, std::sin, std::sqrt;
    const double pi = std::numbers::pi;
    const double largest = (std::max)({abs(longitudinal), abs(lateral), abs(spin)});
    if (largest == 0) return {0, 0, 0};
    int exponent = 0;
    std::frexp(largest, &exponent);
    // exact, and none overflows
    for (double* one : {&longitudinal, &lateral, &spin}) *one = std::ldexp(*one, -exponent);
    const double a = sqrt(a_over_b), b = 1 / a;  // c = 1
    const double sign = spin < 0 ? -1 : 1, rate = abs(spin);
    // the pole times the spin, where the ellipse is the unit circle
    const double pole_x = -sign * lateral / a, pole_y = sign * longitudinal / b, pole = std::hypot(pole_x, pole_y);
    TangentialForce sum{0, 0, 0};
    const int count = 48 + static_cast<int>(6 * std::clamp((std::max)(a_over_b, 1 / a_over_b), 1.0, 1000.0));
    const bool overflows = a_over_b < (std::numeric_limits<double>::min)();  // b^2 does, and a is nothing beside b
    // a chord in the direction e at the distance `offset` from the middle; `lever`: its middle seen from the pole
    const auto add = [&](double e_x, double e_y, double offset, double force, double moment) {
        const double length = std::hypot(a * e_x, b * e_y);
        sum.longitudinal -= sign * force * b * e_y / length;
        sum.lateral += sign * force * a * e_x / length;
        const double skew = overflows ? force * offset * (b * e_x) * (b * e_y / length)
                                      : force * offset * e_x * e_y * (b * b - a * a) / length;
        sum.moment += sign * (skew + moment * length / 4);
    };
    if (pole < rate) {  // the pole lies inside
        const double x = pole_x / rate, y = pole_y / rate;
        for (int i = 0; i < count; ++i) {
            const double angle = pi * static_cast<double>(i) / static_cast<double>(count);
            const double e_x = cos(angle), e_y = sin(angle);
            const double offset = e_x * y - e_y * x, square = (1 - offset) * (1 + offset);
            const double weight = 3 * pi / (4 * static_cast<double>(count)) * square;
            add(e_x, e_y, offset, -weight * (x * e_x + y * e_y), weight * square);
        }
    } else {  // outside, or at infinity without spin
        double total = 0;
        for (int i = 0; i < count; ++i) {
            const double angle = pi * ((static_cast<double>(i) + 0.5) / static_cast<double>(count) - 0.5);
            const double offset = sin(angle), chord = cos(angle), square = chord * chord;
            const double sine = offset * (rate / pole), cosine = sqrt((1 - sine) * (1 + sine));
            const double weight = 3 * pi / (4 * static_cast<double>(count)) * square * chord;
            add((sine * pole_y - cosine * pole_x) / pole, -(cosine * pole_y + sine * pole_x) / pole, offset, weight,
                weight * square * (rate / pole) / cosine);
            total += weight;
        }
        sum.longitudinal /= total;  // 1 except for the error of the sum: without spin the force is exactly mu N
        sum.lateral /= total;
        sum.moment /= total;
    }
    return sum;
}

}  // namespace rollbem
