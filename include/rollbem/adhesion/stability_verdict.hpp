// StabilityVerdict: what a time integrator needs to know about the eigenvalues of G' p = nu G p.
// A small value type, apart from the headers that compute it.
#pragma once

#include "../detail/language.hpp"

#include <Eigen/Core>

#include "../status.hpp"

namespace rollbem {

/// Signs of the real parts of the n eigenvalues nu a of G' p = nu G p; a mode grows like e^{nu V t}.
///
/// An eigenvalue is uncertain when rounding of G and G' alone could change its sign, to first order; the sign of any
/// other is settled. Infinite eigenvalues are uncertain.
struct StabilityVerdict {
    Eigen::Index n = 0;
    Eigen::Index unstable_count = 0;          ///< real part > 0 as computed
    Eigen::Index settled_unstable_count = 0;  ///< those of them whose sign is settled
    Eigen::Index uncertain_count = 0;         ///< of either sign
    double spectral_abscissa = 0;             ///< largest real part of the finite eigenvalues, times a [-]
    Status status = Status::not_finite;       ///< anything but ok: the eigenvalues were not found

    /// No mode grows, and no sign is open.
    bool stable() const { return status == Status::ok && unstable_count == 0 && uncertain_count == 0; }
    /// At least one mode grows beyond doubt.
    bool certainly_unstable() const { return status == Status::ok && settled_unstable_count > 0; }
};

}  // namespace rollbem
