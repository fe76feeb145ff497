// Schemes, numbers of elements and patches for a required accuracy, extrapolation to small elements, and the derivative
// of a step's force by the distance rolled.
#pragma once

#include "../detail/language.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>

#include <Eigen/Core>

#include "../detail/finite.hpp"
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
    auto evaluate(const Solve& solve) const {
        if constexpr (std::is_same_v<Scheme, Chebyshev>) {
            return solve(scheme);
        } else {
            auto fine = solve(mesh<Scalar>(n), scheme);
            return order > 0 ? richardson(solve(mesh<Scalar>(n / 2), scheme), fine, static_cast<Scalar>(order)) : fine;
        }
    }
};

namespace detail {

/// The elements for a purpose, with the smallest number measured. In a time loop differences between centres have
/// smaller errors where b/a is large, but at b/a = 10 their errors are not cleanly of second order.
inline Recommendation<AnyScheme> elements_for(Purpose::Adhesion purpose) {
    switch (purpose) {
        case Purpose::steady: return {.scheme = NodeDifference{}, .n = 6, .order = 2};
        case Purpose::frequency: return {.scheme = NodeDifference{}, .n = 4, .order = 2};
        case Purpose::time_loop: break;
    }
    return {.scheme = Collocation{}, .n = 4};
}
inline Recommendation<AnyScheme> elements_for(Purpose::Friction) {
    return {.scheme = NodeDifference{Nodes::chebyshev}, .n = 4};
}

/// An upper bound of the relative errors of n of these elements, n up to 640, for the plane kernel and strips of b/a >=
/// 10, nu from 0 to 0.5.
///
/// - Steady rolling: the plane kernel gives the fourth order, the smooth part of a strip's kernel the third.
/// - Time loop: the second order holds away from q/a = 2. There the front of the step leaves the contact, which makes
///   the second derivative of the exact force infinite; elements spread the front, and the error next to it decreases
///   like 1/n.
/// - Friction: the error jumps with the element that contains the border of slip.
inline double elements_error(Purpose::Adhesion purpose, Eigen::Index elements) {
    const double n = static_cast<double>(elements);
    switch (purpose) {
        case Purpose::steady: return (0.785 / n + 0.0075) / (n * n * n);  // 1e-4 -> 10, 1e-6 -> 32, 1e-8 -> 114
        case Purpose::frequency: return 33.3 / (n * n * n);               // 1e-2 -> 16, 1e-4 -> 70
        case Purpose::time_loop: break;
    }
    return (std::max)(0.18, 0.088 + 0.002 * n) / (n * n);  // 1e-2 -> 5, 1e-4 -> 43, 1e-5 -> 238
}
inline double elements_error(Purpose::Friction, Eigen::Index elements) {
    const double n = static_cast<double>(elements);
    return 1.32 / (n * n);  // 1e-2 -> 12, 1e-3 -> 37, 1e-4 -> 115
}

/// An upper bound of the relative errors of m Chebyshev states at b/a, the sum of two parts (docs/measured.md):
///
/// - the error of the plane kernel, which vanishes in steady rolling: the error at b/a = 10 and nu = 0, as it decreases
///   with b/a and nu, and three times as much in narrower strips;
/// - the error of the smooth part of a strip's kernel, which decreases like rho^-m with rho = b + sqrt(1 + b^2) because
///   of the singularities at a distance b, and faster for b < a.
inline double states_error(Purpose::Adhesion purpose, Eigen::Index m, double aspect) {
    constexpr std::array frequency{0.14,    0.096,   0.068,  0.051,  0.0275,  0.0099,  2.4e-3, 3.6e-4,
                                   3.95e-5, 3.25e-6, 2.1e-7, 1.1e-8, 4.8e-10, 1.8e-11, 5.7e-13};
    constexpr std::array step{0.096, 0.016, 4.4e-3, 1.8e-3, 1.18e-3, 6.9e-4};  // then second order
    const auto entry = [m](const auto& errors, double beyond) {
        const auto at = static_cast<std::size_t>(m - 1);
        return at < errors.size() ? errors[at] : beyond;
    };
    const double count = static_cast<double>(m);
    const double strip = 0.6 * std::exp(-count * std::asinh((std::max)(aspect, std::sqrt(aspect))));
    const double narrow = aspect < 10 ? 3 : 1;
    switch (purpose) {
        case Purpose::steady: break;
        case Purpose::frequency: return narrow * entry(frequency, 0) + strip;
        case Purpose::time_loop: return narrow * entry(step, 0.022 / (count * count)) + strip;
    }
    return strip;
}

/// Throws std::invalid_argument unless smallest <= tolerance < 1.
inline void require_measured(const char* who, double tolerance, double smallest) {
    if (is_finite(tolerance) && tolerance >= smallest && tolerance < 1) return;
    const std::string rule = "lie in [" + to_text(smallest) + ", 1): smaller ones were not measured";
    require(false, who, "tolerance", tolerance, rule.c_str());
}

template <class AnyPurpose>
Recommendation<AnyScheme> recommended_elements(double tolerance, AnyPurpose purpose) {
    require_measured("recommended_elements", tolerance, elements_error(purpose, 640));
    Recommendation<AnyScheme> result = elements_for(purpose);
    while (elements_error(purpose, result.n) > tolerance) result.n += result.order > 0 ? 2 : 1;
    result.error_bound = elements_error(purpose, result.n);
    return result;
}

}  // namespace detail

/// An element scheme that is stable and among the cheapest of elements, whose relative error stays below the tolerance
/// by the measured bounds above; an error that happens to change sign does not count as accuracy. In full adhesion it
/// serves two needs that states do not meet: tractions of elements, and kernels without a logarithm; otherwise
/// recommended_scheme() is cheaper. With the strip kernel, b/a >= 10, the bounds limit the error against the strip's
/// exact solution; narrower strips need more elements (docs/measured.md). With friction, errors jump with the element
/// that contains the border of slip; extrapolation, which helps at some creepages, is not used. Throws
/// std::invalid_argument unless tolerance < 1 and large enough for n <= 640.
inline Recommendation<AnyScheme> recommended_elements(double tolerance, Purpose::Adhesion purpose) {
    return detail::recommended_elements(tolerance, purpose);
}
inline Recommendation<AnyScheme> recommended_elements(double tolerance, Purpose::Friction purpose) {
    return detail::recommended_elements(tolerance, purpose);
}

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
inline Recommendation<Chebyshev> recommended_scheme(double tolerance, Purpose::Adhesion purpose, double aspect = 10) {
    constexpr Eigen::Index largest = 400;
    detail::require(!detail::is_nan(aspect) && aspect >= 0.01, "recommended_scheme", "aspect", aspect,
                    "be at least 0.01: narrower strips were not measured");
    detail::require_measured("recommended_scheme", tolerance,
                             (std::max)(1e-11, detail::states_error(purpose, largest, aspect)));
    Recommendation<Chebyshev> result{.scheme = {.states = 1}};
    Eigen::Index& m = result.scheme.states;
    while (detail::states_error(purpose, m, aspect) > tolerance) ++m;
    // rounding dominates once the other errors are gone
    const double rounding = static_cast<double>(10 * m) * std::numeric_limits<double>::epsilon();
    result.error_bound = (std::min)(tolerance, detail::states_error(purpose, m, aspect) + rounding);
    return result;
}

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
struct RecommendedPatch {
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
inline Eigen::Index recommended_strips(Eigen::Index n, double a_over_b) {
    detail::require(n >= 1, "recommended_strips", "n", n, "be at least 1");
    detail::require(!detail::is_nan(a_over_b) && a_over_b >= 0.1 && a_over_b <= 25, "recommended_strips", "a_over_b",
                    a_over_b, "lie in [0.1, 25]: other ratios were not measured");
    const double half = static_cast<double>(n) / 4 * (std::max)(1.0, std::pow(a_over_b, -2.0 / 3));
    return 2 * static_cast<Eigen::Index>(half) + 1;
}

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
///     const RecommendedPatch best = recommended_patch(0.02, contact.a_over_b());  // a/b = 1: 16 x 9
///     const PatchMesh<double> mesh = best.mesh(contact);
///
/// Throws std::invalid_argument unless 0.1 <= a_over_b <= 25, spin >= 0 and tolerance < 1 is large enough for n = 32.
inline RecommendedPatch recommended_patch(double tolerance, double a_over_b,
                                          double spin = std::numeric_limits<double>::infinity()) {
    constexpr Eigen::Index least_n = 6, largest_n = 32;
    RecommendedPatch result{.n = least_n, .strips = recommended_strips(least_n, a_over_b)};
    detail::require(!detail::is_nan(spin) && spin >= 0, "recommended_patch", "spin", spin, "not be negative");
    const double factor = (std::max)(1.6, spin < 1.25 ? 4 * spin : 5) * std::sqrt((std::min)(1.0, a_over_b)) *
                          std::sqrt((std::max)(1.0, a_over_b / 10));
    const auto bound = [&](Eigen::Index n) { return factor / static_cast<double>(n * n); };
    if (!detail::is_finite(tolerance) || !(tolerance >= bound(largest_n) && tolerance < 1)) {
        const std::string rule =
            "lie in [" + detail::to_text(bound(largest_n)) + ", 1): finer patches were not measured";
        detail::require(false, "recommended_patch", "tolerance", tolerance, rule.c_str());
    }
    while (bound(result.n) > tolerance) result.n += 2;
    result.strips = recommended_strips(result.n, a_over_b);
    result.error_bound = bound(result.n);
    const double moment_factor = 1.5 * (spin > 0 ? std::sqrt((std::max)(1.0, a_over_b)) : 1);
    result.moment_bound = moment_factor / static_cast<double>(result.n * result.n);
    return result;
}

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
auto tangent_by_distance(double dq, double a, const Step& force_at) {
    const double change = 1e-5 * (std::max)(dq, a);
    const double weight = 1 / (2 * change);
    if (dq >= change) return weight * force_at(dq + change) + -weight * force_at(dq - change);
    return 4 * weight * force_at(dq + change) + -3 * weight * force_at(dq) + -weight * force_at(dq + 2 * change);
}

}  // namespace rollbem
