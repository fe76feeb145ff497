// StabilityVerdict: what a time integrator needs to know about the eigenvalues of G' p = nu G p. A small value type,
// separate from the headers that compute it.
#pragma once

#include <algorithm>

#include <Eigen/Core>

#include "../status.hpp"

namespace rollbem {

/// Signs of the real parts of the n eigenvalues nu a of G' p = nu G p; a mode grows like e^{nu V t}.
///
/// An eigenvalue is uncertain if rounding of G and G' alone could change the sign of its real part, to first order;
/// otherwise its sign is settled. Infinite eigenvalues are uncertain. Where eigenvalues are too ill-conditioned for
/// that, all of them together may be proved to decay.
struct StabilityVerdict {
    Eigen::Index n = 0;
    Eigen::Index unstable_count = 0;          ///< real part > 0 as computed
    Eigen::Index settled_unstable_count = 0;  ///< those of them whose sign is settled
    Eigen::Index uncertain_count = 0;         ///< of either sign
    double spectral_abscissa = 0;             ///< largest real part of the finite eigenvalues, times a [-]
    bool decay_proved = false;                ///< of all modes, although some signs are uncertain one by one
    Status status = Status::not_finite;       ///< unless ok, the eigenvalues were not found
    bool checked = true;                      ///< when a model is made, see `unchecked`

    /// No mode grows, whatever rounding does.
    bool stable() const {
        return status == Status::ok && unstable_count == 0 && (uncertain_count == 0 || decay_proved);
    }
    /// At least one mode certainly grows.
    bool certainly_unstable() const { return status == Status::ok && settled_unstable_count > 0; }

    /// The verdict on two systems that do not couple, which together have the eigenvalues of both.
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

/// In place of a verdict: builds a model whatever its eigenvalues, and whether or not the scheme converges.
inline constexpr StabilityVerdict unchecked{.checked = false};

}  // namespace rollbem
