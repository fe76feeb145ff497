// Meshes of a contact patch with friction for a required accuracy. Based on measured errors; independent of matrices.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <Eigen/Core>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../discretisation/mesh.hpp"
#include "../discretisation/patch_mesh.hpp"
#include "../scene/patch_contact.hpp"

namespace rollbem {

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

}  // namespace rollbem
