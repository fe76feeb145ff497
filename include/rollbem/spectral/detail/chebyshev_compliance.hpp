// Displacements due to Chebyshev tractions: the logarithm in closed form, the kernel's smooth part by quadrature.
// Internal.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Core>
#include <Eigen/LU>

#include "../../detail/circle_table.hpp"
#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../../elasticity/line_kernel.hpp"
#include "../../types.hpp"

namespace rollbem::detail {

/// Checks the number of states and the kernel; returns the kernel's split. The number of points for its smooth part
/// grows like a/b, and their cost like (a/b)^2; at the smallest b/a some hundred states are also needed.
template <LineKernel Kernel>
SmoothSplit<typename Kernel::Scalar> chebyshev_split(Eigen::Index states, const Kernel& kernel) {
    using Scalar = typename Kernel::Scalar;
    require(states >= 1, "Chebyshev", "states", states, "be at least 1");
    require(states <= 10000, "Chebyshev", "states", states, "be at most 10000");
    const SmoothSplit<Scalar> split = kernel.smooth_split();
    require_positive("Chebyshev", "strength of the kernel's logarithm", split.strength);
    require(!is_nan(split.distance) && split.distance >= Scalar(0.001), "Chebyshev",
            "b/a of the kernel (distance of its smooth part's singularity)", split.distance,
            "be at least 0.001: use elements for so narrow a strip");
    require(split.compliance == 0, "Chebyshev", "compliance of the kernel's delta", split.compliance,
            "be 0: use elements for a layer");
    return split;
}

/// The number of Gauss-Chebyshev points that integrate the smooth part against T_0 ... T_m to rounding.
///
/// For x in [-1, 1], e(x - y) as a function of y is analytic except on the lines from x +-ib outwards. The ellipse with
/// foci +-1 and the minor half-axis b, the Bernstein ellipse of rho = b + sqrt(1 + b^2), has all of them outside or on
/// it, so that the coefficient of T_n(y) decreases like rho^-n (the singularities are integrable). N points do not
/// distinguish T_n with n >= 2N - k from T_k: the integral against T_k, k <= m, has an error of about rho^-(2N - m).
/// The same holds for the coefficient of T_j(x), j <= m. It is below rounding for 2N - m >= ln(1/eps)/ln(rho), where
/// ln(rho) = asinh(b); N > m distinguishes the T_k. Ten more points account for the factor before rho^-n.
template <class Scalar>
Eigen::Index smooth_quadrature_points(Eigen::Index m, Scalar b) {
    if (!is_finite(b)) return m + 1;
    const Scalar extra = -std::log(std::numeric_limits<Scalar>::epsilon()) / std::asinh(b) + 10;
    return (std::max)(m + 1, (m + static_cast<Eigen::Index>(std::ceil(extra)) + 1) / 2);
}

/// Entry (j, k), 0 <= j, k <= m: the coefficient of T_j(x) in the integral of e(x - y) T_k(y)/sqrt(1 - y^2), where e is
/// the smooth part, from `points` Gauss-Chebyshev points in x and y. As e is even, entries with odd j + k vanish, and
/// half of the points x suffice.
template <LineKernel Kernel>
MatrixX<typename Kernel::Scalar> smooth_compliance(const Kernel& kernel, Eigen::Index m, Eigen::Index points) {
    using Scalar = typename Kernel::Scalar;
    const CircleTable<Scalar> circle(points);
    const auto angle = [&](Eigen::Index k, Eigen::Index point) { return k * (2 * point + 1) % circle.size(); };
    MatrixX<Scalar> polynomials(points, m + 1);  // T_k at the points
    for (Eigen::Index k = 0; k <= m; ++k) {
        for (Eigen::Index q = 0; q < points; ++q) polynomials(q, k) = circle.cosine(angle(k, q));
    }
    MatrixX<Scalar> compliance = MatrixX<Scalar>::Zero(m + 1, m + 1);
    VectorX<Scalar> smooth(points), displacement(m + 1);
    for (Eigen::Index p = 0; 2 * p < points; ++p) {
        for (Eigen::Index q = 0; q < points; ++q) smooth[q] = kernel.smooth_part(polynomials(p, 1) - polynomials(q, 1));
        displacement.noalias() = polynomials.transpose() * smooth;
        const Scalar share = 2 * p + 1 == points ? Scalar(1) : Scalar(2);  // -x counts as well
        for (Eigen::Index k = 0; k <= m; ++k) {
            for (Eigen::Index j = k % 2; j <= m; j += 2) {
                compliance(j, k) += share * polynomials(p, j) * displacement[k];
            }
        }
    }
    const Scalar count = static_cast<Scalar>(points);
    compliance *= 2 * std::numbers::pi_v<Scalar> / count / count;
    compliance.row(0) /= 2;
    return compliance;
}

/// K of u = K a, row j >= 1 times j/(pi S), row 0 over pi S, where S is the strength: for j >= 1 the identity plus a
/// smooth remainder.
template <LineKernel Kernel>
MatrixX<typename Kernel::Scalar> scaled_compliance(const Kernel& kernel,
                                                   const SmoothSplit<typename Kernel::Scalar>& split, Eigen::Index m) {
    using Scalar = typename Kernel::Scalar;
    MatrixX<Scalar> K;
    if (is_finite(split.distance)) {
        K = smooth_compliance(kernel, m, smooth_quadrature_points(m, split.distance));
        const Scalar scale = std::numbers::pi_v<Scalar> * split.strength;
        for (Eigen::Index j = 0; j <= m; ++j) K.row(j) *= static_cast<Scalar>(std::max<Eigen::Index>(j, 1)) / scale;
    } else {
        K.setZero(m + 1, m + 1);
    }
    K(0, 0) += split.constant / split.strength + std::numbers::ln2_v<Scalar>;
    for (Eigen::Index j = 1; j <= m; ++j) K(j, j) += 1;
    return K;
}

/// The inverse of K.
template <LineKernel Kernel>
MatrixX<typename Kernel::Scalar> chebyshev_stiffness(const Kernel& kernel,
                                                     const SmoothSplit<typename Kernel::Scalar>& split,
                                                     Eigen::Index m) {
    using Scalar = typename Kernel::Scalar;
    const Scalar scale = std::numbers::pi_v<Scalar> * split.strength;
    MatrixX<Scalar> stiffness;
    if (is_finite(split.distance)) {
        stiffness = Eigen::PartialPivLU<MatrixX<Scalar>>(scaled_compliance(kernel, split, m)).inverse();
    } else {
        stiffness.setZero(m + 1, m + 1);
        stiffness(0, 0) = 1 / (split.constant / split.strength + std::numbers::ln2_v<Scalar>);
        for (Eigen::Index j = 1; j <= m; ++j) stiffness(j, j) = 1;
    }
    for (Eigen::Index j = 0; j <= m; ++j) {
        const Scalar factor = static_cast<Scalar>(std::max<Eigen::Index>(j, 1)) / scale;
        for (Eigen::Index i = 0; i <= m; ++i) stiffness(i, j) *= factor;
    }
    return stiffness;
}

}  // namespace rollbem::detail
