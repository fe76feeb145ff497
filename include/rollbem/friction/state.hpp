// What a friction problem carries from step to step, and what a step returns: plain data.
#pragma once

#include "../detail/language.hpp"

#include <cstdint>
#include <limits>
#include <vector>

#include "../status.hpp"
#include "../types.hpp"

namespace rollbem {

/// Whether an element sticks or slips. The value is the sign of the slip s; the traction of a slipping element is
/// -sign(s) mu p_n.
enum class Zone : signed char { slip_negative = -1, stick = 0, slip_positive = 1 };

/// Everything that the next step or solution needs to know about the past. A copy is a checkpoint; a state written to a
/// file and read back continues identically to the last bit.
template <class Scalar_>
struct FrictionState {
    using Scalar = Scalar_;

    VectorX<Scalar> traction;  ///< p on body 1 of each unknown element [Pa], trailing to leading
    std::vector<Zone> zones;   ///< stick or slip of each element, at the end of the step
    /// The present load: p_n [Pa] of each unknown element and the half-length a [m]. A step without a load keeps it.
    ArrayX<Scalar> normal_pressure;
    Scalar half_length = 0;
    std::uint64_t system = 0;  ///< fingerprint() of the model that the state belongs to
    /// Number of consecutive steps in which no element changed its zone, and the distance [m] rolled in each of their
    /// stages. After about n/2 of them a step becomes cheaper, and its slip is checked against the equations only once
    /// in 64 steps, after which the count starts again from there. Set both to 0 to have the next step checked;
    /// other numbers than a step has left cost time or skip checks, which ill-conditioned schemes need.
    int unchanged_steps = 0;
    Scalar unchanged_distance = 0;
};

/// Result of a steady solution, a step or a rigid shift. "Per width" refers to the centre line, y = 0. Forces and work
/// are NaN unless the status is ok or no_solution.
template <class Scalar>
struct FrictionStep {
    Scalar force_per_width = std::numeric_limits<Scalar>::quiet_NaN();  ///< F_bar on body 1 [N/m]
    Scalar force = std::numeric_limits<Scalar>::quiet_NaN();            ///< 2b F_bar [N]; infinite for infinite b
    /// d force_per_width / d creepage at the end of the step [N/m]; for a rigid shift, d force_per_width / d shift
    /// [N/m^2]. NaN if the matrix of the sticking elements is singular.
    Scalar tangent_per_width = std::numeric_limits<Scalar>::quiet_NaN();
    Scalar tangent = std::numeric_limits<Scalar>::quiet_NaN();  ///< 2b tangent_per_width; infinite for infinite b
    /// Frictional heat, never negative: per unit width [J/m] for a step or a shift; per unit width and unit distance
    /// rolled [J/m^2] for a steady solution. It is the sum over the elements of traction times slip at the centre, of
    /// second order in 1/n at alpha = 0.5 (steady rolling, cosine mesh, n = 40, against -F_bar xi: 1.5e-3 at a creepage
    /// ratio of 0.5). For user-supplied matrices the slip is that of each element's own equation: first order.
    Scalar slip_work_per_width = std::numeric_limits<Scalar>::quiet_NaN();
    /// Elastic energy that jumps of the tractions release in a step [J/m], as friction that falls with slip lets them:
    ///
    ///     work of the rigid bodies = slip work + jump work + change of elastic energy
    ///
    /// It turns into heat during a slip that is too short for the step to resolve (see detail::JumpWork for the
    /// expression). Without jumps it tends to 0 with dq, from either side; with constant friction, where rolling has
    /// none, it is 0. For a rigid shift it is what the slip work would gain if the tractions were the means of those at
    /// both ends, with the work of the rigid bodies from the mean force. 0 for a steady solution.
    Scalar jump_work_per_width = std::numeric_limits<Scalar>::quiet_NaN();
    /// Largest violation of |p| <= mu p_n (relative to the largest mu p_n) and of the conditions on the slip (relative
    /// to the largest slip that would occur without traction). It is 0 in a step whose slip is not checked (see
    /// FrictionState::unchanged_steps): tractions and slip satisfy the law exactly there, and the equations up to a
    /// round-off error that is not measured.
    Scalar complementarity_residual = std::numeric_limits<Scalar>::quiet_NaN();
    Eigen::Index stick_count = 0;  ///< elements that stick
    int rounds = 0;                ///< rounds of the active set
    int pivots = 0;                ///< pivots of the fallback; 0 if the rounds converged
    StepStatus status = StepStatus::not_finite;
};

/// Result of a step under a given load, with the derivatives of the force at the end of the step with respect to that
/// load. tangent_by_load holds the half-length constant; if the half-length depends on the load, the total derivative
/// is tangent_by_load + tangent_by_half_length da/d load. Both are NaN if the matrix of the sticking elements is
/// singular; tangent_by_load also if NormalLoad has no pressure_rate, tangent_by_half_length also if the system cannot
/// breathe and for a rigid shift.
template <class Scalar>
struct LoadedFrictionStep : FrictionStep<Scalar> {
    Scalar tangent_by_load_per_width = std::numeric_limits<Scalar>::quiet_NaN();         ///< [N/m per unit of the load]
    Scalar tangent_by_load = std::numeric_limits<Scalar>::quiet_NaN();                   ///< 2b times it
    Scalar tangent_by_half_length_per_width = std::numeric_limits<Scalar>::quiet_NaN();  ///< [N/m^2]
    Scalar tangent_by_half_length = std::numeric_limits<Scalar>::quiet_NaN();            ///< 2b times it [N/m]
};

}  // namespace rollbem
