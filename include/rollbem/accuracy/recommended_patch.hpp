// How to mesh a contact patch with friction for a required accuracy. Based on measured errors; independent of matrices.
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
/// about a point inside the contact: cosine strips are widest there, and an edge through the middle (an even number)
/// doubles the error of spin alone. Full adhesion is another matter: there cosine strips are better, c33 four times.
struct RecommendedPatch {
    Eigen::Index n = 0;  ///< elements in each strip
    Eigen::Index strips = 0;
    double error_bound = 0;   ///< of |F_x| and |F_y| over mu N, at most the required tolerance
    double moment_bound = 0;  ///< of |M_z| over mu N c, c = sqrt(a b)

    template <class Scalar>
    PatchMesh<Scalar> mesh(const PatchContact<Scalar>& contact) const {
        return patch_mesh(contact, cosine_mesh<Scalar>(n), uniform_mesh<Scalar>(strips));
    }
};

/// The number of strips that goes with n elements in each: n/2 for a/b >= 1, (b/a)^(2/3) times as many below, odd. More
/// elements a strip gain more than more strips, until elements are as long as strips are wide. Throws
/// std::invalid_argument unless n >= 1 and 0.1 <= a_over_b <= 25.
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
/// By default spin is not limited; 0 says that there is none.
///
/// The bound is k/n^2, k = 4 spin, at least 1.6 and at most 5, times sqrt(a/b) if that is below 1. The largest errors
/// found, n^2 times: 1.4 without spin, 1.2 to spin = 0.5, 3.6 to 1, 4.5 beyond; at a/b = 0.2 0.5, 0.4, 1.3 and 1.6.
/// Means are a quarter of that. Above a/b = 10 the bound is
/// sqrt(a/b/10) times larger: at 25 0.9 without spin, 1.0 to spin = 0.5, 5.7 beyond, under 24 creepages, n = 8 to 20,
/// nu = 0.28 and 0.5. Measured under 75 creepages (27 of xi, eta and phi alone and together, 48 random, of
/// 0.1 to 6 times what full sliding takes without slip) for even n = 6 to 32 (28, 20, 14 at a/b = 0.5, 0.2, 0.1; 24 and
/// 20 with more strips), a/b = 0.1, 0.2, 0.5, 1, 2, 5, 10 with nu = 0.28 and 0.2, 1, 5 with nu = 0.5, 1 with nu = 0.
/// Among 3000 further creepages, spin with lateral creepage, F_x exceeded the bound in a few, by 3 % at most (n = 10).
/// The bound of the moment is 1.5/n^2, with spin sqrt(a/b) times that if a/b > 1; the largest errors found under 24
/// creepages, n = 8 to 20 against n = 32, n^2 times: 1.2 at a/b = 1, 2.1 at 10, 4.5 at 20, without spin 1.2.
/// Richardson extrapolation is not used: it lowers the mean error, 3 to 5 times at a/b >= 2, but with spin not the
/// largest one, as the border of slip jumps from element to element.
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
