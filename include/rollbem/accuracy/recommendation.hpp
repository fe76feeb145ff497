// Which mesh, how many elements, and whether to extrapolate: a stable and cheap element scheme for a required
// precision. Stands on measured errors, a table below; knows no matrices.
#pragma once

#include "../detail/language.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Core>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../discretisation/mesh.hpp"
#include "../discretisation/scheme.hpp"
#include "richardson.hpp"

namespace rollbem {

/// What a scheme is wanted for, and which relative error its tolerance limits.
enum class Purpose {
    steady,     ///< c11 of steady rolling
    frequency,  ///< |c11| at frequencies omega a/V from 0 to 5
    time_loop,  ///< the force from q/a = 1 on after a step of creepage; what the integrator adds comes on top
    friction,   ///< the steady force with Coulomb friction under Hertz pressure, at creepage ratios from 0.05 on
};

/// A scheme that recommended_scheme() returns: always collocation with finite differences at alpha_L = alpha_T = 0.5,
/// which no mesh tried made unstable.
struct RecommendedScheme {
    Topology topology = Topology::cosine;  ///< uniform or cosine
    Eigen::Index n = 0;      ///< elements; of the finer mesh where results are extrapolated, and even then
    double order = 0;        ///< of Richardson's extrapolation from n/2 and n elements; 0: none
    double error_bound = 0;  ///< of the relative error, at most the tolerance asked for
    Collocation scheme{.alpha_L = 0.5, .alpha_T = 0.5};

    /// The recommended mesh with another number of elements. Throws for count < 1.
    template <class Scalar = double>
    Mesh<Scalar> mesh(Eigen::Index count) const {
        return make_mesh<Scalar>({.topology = topology, .n = count});
    }

    /// solve(mesh), extrapolated where that is recommended; `solve` returns a real or complex number.
    ///
    ///     const RecommendedScheme best = recommended_scheme(1e-4, Purpose::steady);
    ///     const double c11 = best.evaluate(
    ///         [&](const Mesh<double>& mesh) { return solve_steady(mesh, best.scheme, kernel).c11; });
    template <class Scalar = double, class Solve>
    auto evaluate(const Solve& solve) const {
        auto fine = solve(mesh<Scalar>(n));
        return order > 0 ? richardson(solve(mesh<Scalar>(n / 2)), fine, static_cast<Scalar>(order)) : fine;
    }
};

namespace detail {

/// A measured bound of relative errors: below factor n^-exponent for n from least_n on.
struct MeasuredError {
    Purpose purpose;
    Topology topology;
    double order;  ///< of Richardson's extrapolation; 0: none
    double factor, exponent;
    Eigen::Index least_n;
    double smallest_tolerance;  ///< for which it is the cheapest
};

/// For each purpose, the first that is not too coarse for the tolerance. Measured against the closed forms of the plane
/// kernel for n up to 640, nu from 0 to 0.5 and (where it matters) b/a from 10 on. For steady rolling at a coarse
/// tolerance, the Toeplitz assembly on the uniform mesh counts for more than the finer mesh.
inline constexpr MeasuredError measured_errors[] = {
    {Purpose::steady, Topology::uniform, 1, 0.19, 2.8, 6, 1e-5},  // 1e-3 -> 8, 1e-4 -> 16, 1e-5 -> 34 elements
    {Purpose::steady, Topology::cosine, 2, 0.9, 3.4, 6, 0},       // 1e-6 -> 58, 1e-8 -> 220
    {Purpose::frequency, Topology::cosine, 2, 33, 3, 4, 0},       // 1e-2 -> 16, 1e-4 -> 70, 1e-6 -> 322
    {Purpose::time_loop, Topology::cosine, 0, 0.18, 2, 4, 0},     // 1e-2 -> 5, 1e-4 -> 43, 1e-6 -> 425
    {Purpose::friction, Topology::cosine, 0, 1.4, 1.85, 4, 0},    // 1e-2 -> 15, 1e-3 -> 51, 1e-4 -> 175
};

inline const MeasuredError& measured_error(double tolerance, Purpose purpose) {
    const MeasuredError* last = measured_errors;
    for (const MeasuredError& measured : measured_errors) {
        if (measured.purpose != purpose) continue;
        last = &measured;
        if (!(tolerance < measured.smallest_tolerance)) break;
    }
    return *last;
}

}  // namespace detail

/// An element scheme, stable and among the cheapest, whose relative error stays below the tolerance, by the measured
/// errors above: so that no change of sign of an error counts as precision. With the strip kernel the error against the
/// strip's own solution is the same from b/a = 10 on; narrower strips need more elements (steady: up to 5 times the
/// error at b/a = 1, 150 times at 0.1). A strip's distance from the plane, of order (a/b)^2, is the model's. With
/// friction, errors jump with the element at the border of slip; extrapolation, which helps at some creepages, is not
/// relied on. Where only c11 for the plane kernel is wanted, steady_c11 and polynomial_c11 are exact to rounding at
/// less cost. Throws std::invalid_argument unless tolerance < 1 and large enough for n <= 640.
inline RecommendedScheme recommended_scheme(double tolerance, Purpose purpose) {
    constexpr Eigen::Index largest = 640;
    const detail::MeasuredError& measured = detail::measured_error(tolerance, purpose);
    const double factor = measured.factor, exponent = measured.exponent;
    RecommendedScheme result;
    result.topology = measured.topology;
    result.order = measured.order;
    const double smallest = factor * std::pow(static_cast<double>(largest), -exponent);
    if (!detail::is_finite(tolerance) || !(tolerance >= smallest && tolerance < 1)) {
        const std::string rule = "lie in [" + detail::to_text(smallest) + ", 1): no more was measured";
        detail::require(false, "recommended_scheme", "tolerance", tolerance, rule.c_str());
    }
    result.n =
        std::max(measured.least_n, static_cast<Eigen::Index>(std::ceil(std::pow(factor / tolerance, 1 / exponent))));
    if (result.order > 0) result.n += result.n % 2;
    result.n = std::min(result.n, largest);  // the rounding of pow
    result.error_bound = std::min(tolerance, factor * std::pow(static_cast<double>(result.n), -exponent));
    return result;
}

}  // namespace rollbem
