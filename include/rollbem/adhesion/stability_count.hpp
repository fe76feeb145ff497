// The number of growing modes of G' p = nu G p, by the standard eigenvalue problem of M = G'^-1 G: faster than the QZ
// algorithm of stability.hpp, but without an analysis of rounding.
#pragma once

#include "../detail/decl.hpp"

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
UnstableCount count_unstable(const RollingSystem<double>& system);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/stability_count.ipp"
#endif
