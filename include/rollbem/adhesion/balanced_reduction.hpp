// Fewer differential equations for a contact in full adhesion: balanced reduction of a StateSpace, with the exact
// steady state and a bound of the error at every frequency.
#pragma once

#include "../detail/decl.hpp"

#include "../status.hpp"
#include "../types.hpp"
#include "state_space.hpp"

namespace rollbem {

/// A StateSpace reduced to K states. Invariant if status is ok: its A is stable, and its steady state c(0) equals the
/// original's; otherwise all of its matrices are empty.
struct BalancedReduction {
    StateSpace space;  ///< K states, and D != 0
    /// Hankel singular values of the original, decreasing, in the unit of c; values below rounding, n eps times the
    /// largest, are left out. They depend neither on K nor on the choice of states.
    ArrayX<double> hankel_singular_values;
    /// |c(s) - c_K(s)| <= error_bound in the 2-norm where Re s >= 0, but for rounding: twice the sum of the singular
    /// values from the (K+1)-th on (Glover, Int. J. Control 39 (1984) 1115-1193).
    double error_bound = 0;
    /// unstable: a mode of the original grows; ill_conditioned: rounding of A could make one grow, or no input reaches
    /// an output, or the reduced system does not decay.
    Status status = Status::not_finite;
};

/// Reduces a stable StateSpace of n states, any number of inputs and outputs, to K = `states` of a balanced one, or to
/// as many as there are Hankel singular values above rounding, if these are fewer. The other states are taken to follow
/// without delay (singular perturbation), not to be zero: thus c_K(0) = c(0), while c_K(infinity) = D.
///
/// The truncated system is the one with the matrices A^-1, A^-1 B, -C A^-1, D - C A^-1 B, a function of 1/s with the
/// same Gramians (Liu & Anderson, Int. J. Control 50 (1989) 1379-1405). These are factorised on the complex Schur form
/// of A, and balanced by the square-root method (Tombs & Postlethwaite, Int. J. Control 46 (1987) 1319-1330). Costs
/// O(n^3).
///
/// Throws std::invalid_argument unless 1 <= states <= n, the matrices fit together, and their entries are finite.
BalancedReduction balanced_reduction(const StateSpace& space, Eigen::Index states);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/balanced_reduction.ipp"
#endif
