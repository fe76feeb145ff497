// Schemes, numbers of elements and patches for a required accuracy, extrapolation to small elements, and the derivative
// of a step's force by the distance rolled.
#pragma once

#include "../detail/decl.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

#include <Eigen/Core>

#include "../detail/require.hpp"
#include "../discretisation/mesh.hpp"
#include "../discretisation/patch_mesh.hpp"
#include "../discretisation/scheme.hpp"
#include "../scene/patch_contact.hpp"
#include "../spectral/chebyshev.hpp"
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
    -> Extrapolation<std::decay_t<decltype(solve(n))>>;

/// The purpose of a scheme, and the relative error that its tolerance limits: Purpose::steady, Purpose::frequency,
/// Purpose::time_loop, Purpose::friction. Full adhesion and friction have different types because different kinds of
/// schemes are recommended for them.
struct Purpose {
    enum class Adhesion {
        steady,     ///< c11 of steady rolling
        frequency,  ///< |c11| at frequencies omega a/V from 0 to 5
        time_loop,  ///< the force for q/a >= 1 after a step of creepage, without the error of the integrator
    };
    enum class Friction {
        friction,  ///< the steady force with Coulomb friction under Hertz pressure, at creepage ratios >= 0.05
    };
    using enum Adhesion;
    using enum Friction;
};

/// A method and the bound of its relative error. Chebyshev states are for full adhesion, stable for any number.
/// AnyScheme is n elements on a cosine mesh, stable at every n tried, with
///
/// - differences between centres in steady rolling and in frequency;
/// - differences between Chebyshev nodes with friction;
/// - collocation at alpha_L = alpha_T = 0.5 in a time loop.
template <class Scheme>
struct Recommendation {
    Scheme scheme;
    double error_bound = 0;  ///< bound of the relative error, at most the required tolerance
    Eigen::Index n = 0;      ///< elements; if results are extrapolated, elements of the finer mesh, an even number
    double order = 0;        ///< order of Richardson's extrapolation from n/2 and n elements; 0: no extrapolation

    /// The cosine mesh with some number of elements. Throws std::invalid_argument if count < 1.
    template <class Scalar = double>
    Mesh<Scalar> mesh(Eigen::Index count) const {
        return cosine_mesh<Scalar>(count);
    }

    /// Calls solve(states), or solve(mesh, scheme), extrapolated if this is recommended; `solve` returns a real or
    /// complex number. One function can serve both:
    ///
    ///     const auto c11 = [&](const auto&... method) { return solve_steady(method..., kernel).c11(); };
    ///     const double by_states = recommended_scheme(1e-6, Purpose::steady).evaluate(c11);
    ///     const double by_elements = recommended_elements(1e-6, Purpose::steady).evaluate(c11);
    template <class Scalar = double, class Solve>
    auto evaluate(const Solve& solve) const;
};

/// An element scheme that is stable and among the cheapest of elements, whose relative error stays below the tolerance
/// by the measured bounds above; an error that happens to change sign does not count as accuracy. In full adhesion it
/// serves two needs that states do not meet: tractions of elements, and kernels without a logarithm; otherwise
/// recommended_scheme() is cheaper. With the strip kernel, b/a >= 10, the bounds limit the error against the strip's
/// exact solution; narrower strips need more elements (docs/measured.md). With friction, errors jump with the element
/// that contains the border of slip; extrapolation, which helps at some creepages, is not used. Throws
/// std::invalid_argument unless tolerance < 1 and large enough for n <= 640.
Recommendation<AnyScheme> recommended_elements(double tolerance, Purpose::Adhesion purpose);
Recommendation<AnyScheme> recommended_elements(double tolerance, Purpose::Friction purpose);

/// For full adhesion: the fewest Chebyshev states whose relative error stays below the tolerance by the measured bounds
/// above. `aspect` is b/a of a strip; the default covers all strips with b/a >= 10 and plane kernels.
///
///     const auto best = recommended_scheme(1e-6, Purpose::frequency);  // 11 states
///     const auto system = rolling_system(best.scheme, kernel);
///     const std::complex<double> c11 = solve_response(system, {0, 5}).c11();
///
/// The difference between strip and plane, of order (a/b)^2, is a difference of models and not part of the error. For
/// c11 of the plane kernel alone, steady_c11 and polynomial_c11 are exact to rounding at less cost. Throws
/// std::invalid_argument unless aspect >= 0.01 and tolerance < 1 is large enough for 400 states: 1e-11, for a time loop
/// 1.4e-7 (4.2e-7 for b/a < 10).
Recommendation<Chebyshev> recommended_scheme(double tolerance, Purpose::Adhesion purpose, double aspect = 10);

/// The elements recommended for friction.
///
///     const auto best = recommended_scheme(1e-3, Purpose::friction);
///     const Mesh<double> mesh = best.mesh(best.n);
///     const FrictionModel model(contact, steady_system(mesh, best.scheme, kernel), friction);
inline Recommendation<AnyScheme> recommended_scheme(double tolerance, Purpose::Friction purpose) {
    return recommended_elements(tolerance, purpose);
}

/// Strips of equal width, an odd number of them, and the cosine mesh along each. With spin the direction of slip turns
/// about a point inside the contact: cosine strips are widest there, and an even number of strips has an edge through
/// the middle, which makes the error of spin alone larger. In full adhesion, by contrast, cosine strips are better.
template <>
struct Recommendation<PatchMesh<double>> {
    Eigen::Index n = 0;  ///< elements in each strip
    Eigen::Index strips = 0;
    double error_bound = 0;   ///< bound of the errors of |F_x| and |F_y| over mu N, at most the required tolerance
    double moment_bound = 0;  ///< bound of the error of |M_z| over mu N c, c = sqrt(a b)

    PatchMesh<double> mesh(const PatchContact& contact) const {
        return patch_mesh(contact, cosine_mesh<double>(n), uniform_mesh<double>(strips));
    }
};

/// The number of strips for n elements in each: n/2 for a/b >= 1, (b/a)^(2/3) times as many below, odd. Additional
/// elements in a strip improve accuracy more than additional strips, until elements are as long as strips are wide.
/// Throws std::invalid_argument unless n >= 1 and 0.1 <= a_over_b <= 25.
Eigen::Index recommended_strips(Eigen::Index n, double a_over_b);

/// The coarsest patch of node differences between Chebyshev nodes, slip turned, whose steady forces under Hertz's
/// pressure stay within `tolerance` times mu N of the limit of small elements, for all creepages together with spin up
/// to |phi| <= spin mu N/(c23 G a b c): `spin` is the lateral force, over mu N, that the spin would make without slip.
/// By default spin is not limited; 0 means no spin.
///
/// The bounds, which docs/measured.md compares with the largest errors found:
///
/// - forces: k/n^2, k = 4 spin, at least 1.6 and at most 5, times sqrt(a/b) below a/b = 1 and times sqrt(a/b/10) above
///   10;
/// - moment: 1.5/n^2, with spin times sqrt(a/b) above a/b = 1.
///
/// Richardson extrapolation is not used: it lowers the mean error, but with spin not the largest one, as the border of
/// slip jumps from element to element.
///
///     const auto best = recommended_patch(0.02, contact.a_over_b());  // a/b = 1: 16 x 9
///     const PatchMesh<double> mesh = best.mesh(contact);
///
/// Throws std::invalid_argument unless 0.1 <= a_over_b <= 25, spin >= 0 and tolerance < 1 is large enough for n = 32.
Recommendation<PatchMesh<double>> recommended_patch(double tolerance, double a_over_b,
                                                    double spin = std::numeric_limits<double>::infinity());

/// d force / d dq [N/m] of a step over the distance dq [m] >= 0 in a contact of half-length a [m]. `force_at(dq)` is
/// the force, a number or a TangentialForce, of a step from the same state under the same rigid shift and the same load
/// at its end. Differences are central, over 1e-5 of dq or a, whichever is longer; near zero, where the contact cannot
/// roll less, they are one-sided and also of second order.
///
///     const auto tangent = tangent_by_distance(dq, contact.half_length(), [&](double distance) {
///         return model.advance(now, {distance, Motion::shift(shift), load}, next, workspace).force;
///     });
///
/// d force / dV at constant slip velocities is this times the duration of the step.
template <class Step>
auto tangent_by_distance(double dq, double a, const Step& force_at);

}  // namespace rollbem

#include "impl/recommendation.tpp"

#ifndef ROLLBEM_COMPILED
#include "impl/recommendation.ipp"
#endif
