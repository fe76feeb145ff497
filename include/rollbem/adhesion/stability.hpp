// Stability of the discrete rolling contact equations: all eigenvalues of G' p = nu G p, Eq. (33), by the QZ algorithm,
// which signs of their real parts are certain, and a fast count of growing modes.
#pragma once

#include "../detail/decl.hpp"

#include <algorithm>
#include <complex>
#include <cstddef>
#include <limits>
#include <vector>

#include "../status.hpp"
#include "../system/rolling_system.hpp"

namespace rollbem {

/// Eigenvalues of G' p = nu G p, Eq. (12) without creepage and p ~ e^{nu V t}; times a, hence dimensionless. The base
/// class holds the verdict of judge_stability; solve_stability settles no sign, and all are uncertain.
struct StabilityResult : StabilityVerdict {
    /// Result of count_unstable.
    struct Count {
        Eigen::Index n = 0;
        Eigen::Index unstable_count = 0;     ///< eigenvalues with real part > 0 as computed
        double flattest_cosine = -1;         ///< largest Re(nu)/|nu|; negative if stable: the distance to instability
        double rcond = 0;                    ///< estimate of 1 / (|G'| |G'^-1|) in the 1-norm
        Status status = Status::not_finite;  ///< ill_conditioned: no count, as rcond is too small; use QZ
    };

    /// nu_k = alpha_k / beta_k; beta_k >= 0, and 0 for an infinite eigenvalue. Unordered, except that conjugate pairs
    /// are adjacent.
    VectorX<std::complex<double>> alpha;
    VectorX<double> beta;
    /// n eps (|G'|_2 + |nu| |G|_2) / |y^H G x| with unit right and left vectors x and y: the effect that rounding of G
    /// and G' can have on each eigenvalue, to first order. Empty from solve_stability; infinite for infinite
    /// eigenvalues.
    VectorX<double> uncertainty;
    double spectral_radius = 0;  ///< largest |nu|; infinite if an eigenvalue is
    double stiffness_ratio = 0;  ///< largest |Re(nu)| over smallest

    double unstable_fraction() const;

    /// The eigenvalues as numbers; infinite ones are (inf, 0).
    VectorX<std::complex<double>> eigenvalues() const;
};

/// Counts the eigenvalues nu = 1/mu in the right half-plane, where mu are the eigenvalues of M = G'^-1 G: Re(nu) and
/// Re(mu) have the same sign.
StabilityResult::Count count_unstable(const RollingSystem<double>& system);

/// Finds all eigenvalues of G' p = nu G p, Eq. (33), by the QZ algorithm (Eigen::RealQZ), without vectors. If it does
/// not converge, the status is ill_conditioned.
StabilityResult solve_stability(const RollingSystem<double>& system);

/// The condition number |A| |A^-1| in the 2-norm, infinite for a singular A. It is found from the inverse, because the
/// small eigenvalues of A^T A would lose condition numbers beyond 1/sqrt(eps).
double condition_number(const MatrixX<double>& A);

/// The verdict on a system: its eigenvalues, how far rounding can move each of them, and which signs are settled. Costs
/// more than solve_stability.
StabilityResult judge_stability(const RollingSystem<double>& system);

/// The verdict on all 2n eigenvalues; directions that do not couple are judged one by one.
StabilityVerdict judge_stability(const ElementSystem<double, 2>& system);

/// The verdict on all eigenvalues of uncoupled subsystems; the two of a symmetric patch cost a quarter of the coupled
/// system.
StabilityVerdict judge_stability(const std::vector<RollingSystem<double>>& subsystems);

/// The worst verdict on the nodes of PatchShapes, each judged by its uncoupled subsystems: the largest of each number.
/// Shapes between two nodes are assumed to behave like the nodes.
template <class Shapes>
requires requires(const Shapes& shapes) { shapes.subsystems(shapes.node_count()); }
StabilityVerdict judge_stability(const Shapes& shapes);

}  // namespace rollbem

#include "impl/stability.tpp"

#ifndef ROLLBEM_COMPILED
#include "impl/stability.ipp"
#endif
