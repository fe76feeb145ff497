// StabilityVerdict: the facts that a time integrator needs about the eigenvalues of G' p = nu G p. A small value type,
// separate from the headers that compute it.
#pragma once

#include <algorithm>

#include <Eigen/Core>

#include "../status.hpp"

namespace rollbem {

/// Signs of the real parts of the n eigenvalues nu a of G' p = nu G p; a mode grows like e^{nu V t}.
///
/// An eigenvalue is uncertain if rounding of G and G' alone could change the sign of its real part, to first order;
/// otherwise its sign is settled. Infinite eigenvalues are uncertain. Eigenvalues too ill-conditioned for this may be
/// proved to decay all together.
struct StabilityVerdict {
    Eigen::Index n = 0;
    Eigen::Index unstable_count = 0;          ///< real part > 0 as computed
    Eigen::Index settled_unstable_count = 0;  ///< eigenvalues among these whose sign is settled
    Eigen::Index uncertain_count = 0;         ///< with either sign
    double spectral_abscissa = 0;             ///< largest real part of the finite eigenvalues, times a [-]
    bool decay_proved = false;                ///< whether all modes are proved to decay, although some signs are
                                              ///< uncertain one by one
    Status status = Status::not_finite;       ///< unless ok, the eigenvalues were not found
    bool checked = true;                      ///< when a model is made, see `unchecked`

    /// No mode grows, whatever the rounding.
    bool stable() const {
        return status == Status::ok && unstable_count == 0 && (uncertain_count == 0 || decay_proved);
    }
    /// At least one mode certainly grows.
    bool certainly_unstable() const { return status == Status::ok && settled_unstable_count > 0; }

    /// The verdict on two uncoupled systems, which together have the eigenvalues of both.
    friend StabilityVerdict operator+(const StabilityVerdict& one, const StabilityVerdict& other) {
        return {.n = one.n + other.n,
                .unstable_count = one.unstable_count + other.unstable_count,
                .settled_unstable_count = one.settled_unstable_count + other.settled_unstable_count,
                .uncertain_count = one.uncertain_count + other.uncertain_count,
                .spectral_abscissa = (std::max)(one.spectral_abscissa, other.spectral_abscissa),
                .decay_proved = one.stable() && other.stable(),
                .status = one.status == Status::ok ? other.status : one.status};
    }
};

/// Replaces a verdict: builds a model for any eigenvalues, and whether or not the scheme converges.
inline constexpr StabilityVerdict unchecked{.checked = false};

}  // namespace rollbem
