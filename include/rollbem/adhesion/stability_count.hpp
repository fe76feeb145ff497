// The number of growing modes of G' p = nu G p, by the standard eigenvalue problem of M = G'^-1 G: faster than the QZ
// algorithm of stability.hpp, but without an analysis of rounding.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "../detail/finite.hpp"
#include "../detail/reciprocal_condition.hpp"
#include "../status.hpp"
#include "../system/rolling_system.hpp"

namespace rollbem {

/// Result of count_unstable.
struct UnstableCount {
    Eigen::Index n = 0;
    Eigen::Index unstable_count = 0;     ///< eigenvalues with real part > 0 as computed
    double flattest_cosine = -1;         ///< largest Re(nu)/|nu|; negative if stable: the distance to instability
    double rcond = 0;                    ///< estimate of 1 / (|G'| |G'^-1|) in the 1-norm
    Status status = Status::not_finite;  ///< ill_conditioned: no count, as rcond is too small; use QZ
};

/// Counts the eigenvalues nu = 1/mu in the right half-plane, where mu are the eigenvalues of M = G'^-1 G: Re(nu) and
/// Re(mu) have the same sign.
inline UnstableCount count_unstable(const RollingSystem<double>& system) {
    UnstableCount result;
    result.n = system.size();
    const Eigen::PartialPivLU<MatrixX<double>> lu(system.G_prime());
    result.rcond = detail::reciprocal_condition(lu, detail::one_norm(system.G_prime()));
    result.status = Status::ill_conditioned;
    if (!detail::is_finite(result.rcond) || !(result.rcond > double(detail::least_rcond_of_G_prime))) return result;
    const MatrixX<double> M = lu.solve(system.G());
    if (!detail::all_finite(M)) return result;
    const Eigen::EigenSolver<MatrixX<double>> solver(M, false);
    if (solver.info() != Eigen::Success || !detail::all_finite(solver.eigenvalues())) return result;
    for (const std::complex<double>& mu : solver.eigenvalues()) {
        if (mu.real() > 0) ++result.unstable_count;
        const double size = std::abs(mu);
        result.flattest_cosine = (std::max)(result.flattest_cosine, size > 0 ? mu.real() / size : 0.0);
    }
    result.status = Status::ok;
    return result;
}

}  // namespace rollbem
