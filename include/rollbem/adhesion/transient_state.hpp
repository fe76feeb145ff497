// Arguments and results of steps of rolling in full adhesion: the state, a prepared step, and the result of one.
#pragma once

#include "../detail/language.hpp"

#include <cstdint>
#include <limits>

#include "../status.hpp"
#include "../types.hpp"

namespace rollbem {

/// Everything that the next step needs from the past. A copy is a checkpoint; written to a file and read back, it
/// continues with identical results to the last bit.
template <class Scalar>
struct TransientState {
    VectorX<Scalar> traction;  ///< the system's unknowns times G: for elements p on body 1 [Pa], trailing to leading
    std::uint64_t system = 0;  ///< fingerprint() of the model that the state belongs to
    Scalar half_length = 0;    ///< a of the contact that the tractions act on [m], positive and finite
};

/// Result of one step. NaN unless the status is ok.
template <class Scalar>
struct TransientStep {
    Scalar force = std::numeric_limits<Scalar>::quiet_NaN();            ///< 2b F_bar on body 1 [N]
    Scalar force_per_width = std::numeric_limits<Scalar>::quiet_NaN();  ///< F_bar [N/m]
    /// d force / d creepage at the end of the step [N]; for a rigid shift d force / d shift [N/m].
    Scalar tangent = std::numeric_limits<Scalar>::quiet_NaN();
    StepStatus status = StepStatus::not_finite;
};

/// Result of one step to a given half-length.
template <class Scalar>
struct BreathingTransientStep : TransientStep<Scalar> {
    /// d force / d half-length at the end of the step [N/m] with motion, dq and initial state fixed. NaN if the model
    /// cannot breathe.
    Scalar tangent_by_half_length = std::numeric_limits<Scalar>::quiet_NaN();
};

/// Everything that a step of a given dq needs, computed once: n^2 numbers. Const use is safe from several threads.
template <class Scalar>
class PreparedStep {
public:
    Scalar dq() const { return dq_; }  ///< distance rolled in the step [m]

private:
    std::uint64_t made_for_ = 0;  // the model that prepared it: its fingerprint, and its integrator
    Scalar dq_ = 0;
    // Columns [change, per_shift, per_ramp]: p_new - p = change p + per_shift (xi dq) + per_ramp (change of xi) dq.
    MatrixX<Scalar> map_;                              // n x (n+2) [-], [Pa/m], [Pa/m]
    Scalar force_per_shift_ = 0, force_per_ramp_ = 0;  // [N/m]

    template <class>
    friend class TransientModel;
};

}  // namespace rollbem
