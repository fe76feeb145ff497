// Closed forms of lines: Carter's traction and creep coefficients in full adhesion, Carter's steady rolling with
// friction, Cattaneo's shift from rest, in elementary functions and dimensionless, a = G = V = 1; and full sliding of
// an ellipse.
#pragma once

#include "../detail/decl.hpp"

#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>
#include <type_traits>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../scene/creepage.hpp"

namespace rollbem {

/// Steady creep coefficient c11 = pi/(2(1-nu)) of Eq. (30), per unit width of a rectangle (or of an infinitely long
/// contact). For lateral creepage, c22 is pi/2 = steady_c11(0.0), whatever nu is. Throws std::invalid_argument unless 0
/// <= poisson_ratio <= 0.5.
template <std::floating_point Scalar>
Scalar steady_c11(Scalar poisson_ratio);

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
    EdgeDistances(Scalar from_trailing, Scalar from_leading);
    /// The position x/a. Throws std::invalid_argument unless -1 <= x/a <= 1.
    static EdgeDistances at(Scalar x_over_a);
};

/// Carter's traction p/(G xi) = -sqrt((a-x)/(a+x))/(2(1-nu)) (negative; minus infinity at the trailing edge). Throws
/// std::invalid_argument unless 0 <= poisson_ratio <= 0.5.
template <std::floating_point Scalar>
Scalar carter_traction(const EdgeDistances<Scalar>& position, Scalar poisson_ratio);

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
                            const EdgeDistances<Scalar>& ahead, std::type_identity_t<Scalar> poisson_ratio);

/// Exact means of Carter's traction p/(G xi) over the n elements of a Mesh, trailing to leading, to which the tractions
/// of steady rolling converge. Throws std::invalid_argument unless 0 <= poisson_ratio <= 0.5.
template <class AnyMesh>
typename AnyMesh::Array carter_mean_tractions(const AnyMesh& mesh, typename AnyMesh::Scalar poisson_ratio);

/// Carter's steady creep-force law: force_ratio = -F/(mu N) = 2 delta - delta^2 up to full sliding at delta = 1, and 1
/// for larger delta; odd in delta. delta = xi G/(2 (1-nu) mu p0) is the creepage ratio. Throws std::invalid_argument if
/// it is NaN.
template <std::floating_point Scalar>
Scalar carter_force_ratio(Scalar creepage_ratio);

/// x/a at which stick begins in Carter's steady solution: min(2 |delta|, 2) - 1. The stick zone extends from there to
/// the leading edge; slip lies behind it. Throws std::invalid_argument if the ratio is NaN.
template <std::floating_point Scalar>
Scalar carter_stick_border(Scalar creepage_ratio);

/// Traction p/(mu p0) of Carter's steady solution with slip, at x/a; its sign is opposite to the sign of
/// creepage_ratio. Throws std::invalid_argument unless -1 <= x/a <= 1, or if the ratio is NaN.
template <std::floating_point Scalar>
Scalar carter_friction_traction(Scalar x_over_a, Scalar creepage_ratio);

/// Cattaneo: half-length c/a of the stick zone |x| < c under a force F without rolling, |F|/(mu N) = 1 - c^2/a^2.
/// Throws std::invalid_argument unless |force_ratio| <= 1.
template <std::floating_point Scalar>
Scalar cattaneo_stick_half_length(Scalar force_ratio);

/// Traction p/(mu p0) of Cattaneo's solution at x/a for force_ratio = -F/(mu N); its sign is opposite to force_ratio.
/// Throws std::invalid_argument unless -1 <= x/a <= 1 and |force_ratio| <= 1.
template <std::floating_point Scalar>
Scalar cattaneo_traction(Scalar x_over_a, Scalar force_ratio);

/// Cattaneo's rigid shift W in units of mu p0 a/G for force_ratio = -F/(mu N) (W and force_ratio have the same sign),
/// plane kernel: W = (a^2 B(a) - c^2 B(c)) mu p0/(a G), B(c) = (1-nu)(ln(4b/c) + 1/2) + nu. Throws
/// std::invalid_argument unless |force_ratio| <= 1, 0 <= poisson_ratio <= 0.5 and `aspect` b/a is positive and finite.
template <std::floating_point Scalar>
Scalar cattaneo_shift(Scalar force_ratio, Scalar poisson_ratio, Scalar aspect);

/// The force ratio -F/(mu N) after a rigid shift W (in mu p0 a/G) from rest: the inverse of cattaneo_shift; its
/// absolute value is 1 if the shift exceeds the shift of full sliding. Throws std::invalid_argument if the shift is
/// NaN, and unless 0 <= poisson_ratio <= 0.5, 0 < aspect < inf and Lambda > 0 (for Lambda <= 0 the plane model's shift
/// is not monotonic).
template <std::floating_point Scalar>
Scalar cattaneo_force_ratio(Scalar shift, Scalar poisson_ratio, Scalar aspect);

/// -F_x/(mu N), -F_y/(mu N), -M_z/(mu N c), c = sqrt(a b), of an ellipse that slips everywhere, by its rigid slip
/// (longitudinal - spin y, lateral + spin x): creepages in any common unit, spin times c in the same unit. Zero without
/// creepage and spin. a_over_b must be positive and finite.
///
/// Along a line through the pole, where the rigid slip vanishes, the direction of slip is constant, and moments of the
/// pressure over the whole chord have a closed form. The remaining integral over the direction of the line has a smooth
/// integrand and is taken to 1e-6 for a/b = 0.1 ... 10. Spin alone on a circle: 3 pi/16.
TangentialForce full_sliding(double a_over_b, double longitudinal, double lateral, double spin);

}  // namespace rollbem

#include "impl/carter.tpp"

#ifndef ROLLBEM_COMPILED
#include "impl/carter.ipp"
#endif
