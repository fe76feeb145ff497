// The state of a contact in full adhesion between steps, and the result of a step: plain data.
#pragma once

#include <cstdint>

#include "../scene/directions.hpp"
#include "../status.hpp"
#include "../types.hpp"

namespace rollbem {

/// Everything that the next step needs to know about the past. A copy is a checkpoint; a state written to a file and
/// read back continues identically to the last bit.
struct AdhesionState {
    VectorX<double> traction;  ///< the system's unknowns times G: for elements p on body 1 [Pa], trailing to leading
    std::uint64_t system = 0;  ///< fingerprint() of the model that the state belongs to
    double half_length = 0;    ///< a of the contact that the tractions act on [m], positive and finite
    /// Distance rolled in the step that led here [m]. It makes a next step of the same distance cheaper, and changes
    /// results by round-off only.
    double distance = 0;
    double half_width = 0;  ///< b of a patch [m], positive and finite; on a line it does not vary and is not read
};

/// Result of a step or of steady rolling. NaN unless the status is ok. With one direction forces and their derivatives
/// are numbers, with two TangentialForce and CreepageTangent.
template <int directions = 1>
struct AdhesionStep {
    using Force = detail::ForceAlong<directions>;
    using Tangent = detail::TangentAlong<directions>;

    Force force = detail::nothing<Force>();            ///< 2b F_bar on body 1 [N]
    Force force_per_width = detail::nothing<Force>();  ///< F_bar [N/m], moment [N]; NaN for a patch
    /// d force / d creepage at the end of the step [N]; for a rigid shift d force / d shift [N/m].
    Tangent tangent = detail::nothing<Tangent>();
    /// d force / d half-length at the end of the step [N/m] with motion, dq and initial state fixed. NaN for steady
    /// rolling, for steps without a given half-length, and if the model cannot breathe.
    Force tangent_by_half_length = detail::nothing<Force>();
    /// d force / d half-width of a patch, likewise [N/m]. For a patch of constant a/b see
    /// FrictionStep::tangent_by_load.
    Force tangent_by_half_width = detail::nothing<Force>();
    Status status = Status::not_finite;
};

}  // namespace rollbem
