// Bodies of accuracy/recommendation.hpp. Internal.
#pragma once

#include "../recommendation.hpp"

#include <cmath>
#include <limits>
#include <string>

namespace rollbem::detail {

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

}  // namespace rollbem::detail

namespace rollbem {

ROLLBEM_DECL Recommendation<AnyScheme> recommended_elements(double tolerance, Purpose::Adhesion purpose) {
    return detail::recommended_elements(tolerance, purpose);
}

ROLLBEM_DECL Recommendation<AnyScheme> recommended_elements(double tolerance, Purpose::Friction purpose) {
    return detail::recommended_elements(tolerance, purpose);
}

ROLLBEM_DECL Recommendation<Chebyshev> recommended_scheme(double tolerance, Purpose::Adhesion purpose, double aspect) {
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

ROLLBEM_DECL Eigen::Index recommended_strips(Eigen::Index n, double a_over_b) {
    detail::require(n >= 1, "recommended_strips", "n", n, "be at least 1");
    detail::require(!detail::is_nan(a_over_b) && a_over_b >= 0.1 && a_over_b <= 25, "recommended_strips", "a_over_b",
                    a_over_b, "lie in [0.1, 25]: other ratios were not measured");
    const double half = static_cast<double>(n) / 4 * (std::max)(1.0, std::pow(a_over_b, -2.0 / 3));
    return 2 * static_cast<Eigen::Index>(half) + 1;
}

ROLLBEM_DECL Recommendation<PatchMesh<double>> recommended_patch(double tolerance, double a_over_b, double spin) {
    constexpr Eigen::Index least_n = 6, largest_n = 32;
    Recommendation<PatchMesh<double>> result{.n = least_n, .strips = recommended_strips(least_n, a_over_b)};
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

}  // namespace rollbem
