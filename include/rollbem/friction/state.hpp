// What a friction problem carries from step to step, and what a step returns: plain data.
#pragma once

#include "../detail/language.hpp"

#include <cstdint>
#include <limits>
#include <vector>

#include "../status.hpp"
#include "../types.hpp"

namespace rollbem {

/// What an element does. The value is the sign of the slip s; the traction of a slipping element is -sign(s) mu p_n.
enum class Zone : signed char { slip_negative = -1, stick = 0, slip_positive = 1 };

/// All that the next step or solution needs of the past. A copy is a checkpoint; written to a file and read back, it
/// goes on to the last bit as if nothing had happened.
template <class Scalar_>
struct FrictionState {
    using Scalar = Scalar_;

    VectorX<Scalar> traction;  ///< p on body 1 of each unknown element [Pa], trailing to leading
    std::vector<Zone> zones;   ///< what each element does; after a step, at its end
    /// p_n [Pa] of each unknown element and a [m] of the contact that it lives under: what a step without a load keeps.
    ArrayX<Scalar> normal_pressure;
    Scalar half_length = 0;
    std::uint64_t system = 0;  ///< fingerprint() of the model that the state belongs to
    /// Steps in a row in which no element has changed its zone, and the distance [m] that each rolled for one solution.
    /// After many of them a step is cheaper, and the equations check its slip in every 64th only; the count then goes
    /// round. Any other numbers cost time or a check, not the solution.
    int unchanged_steps = 0;
    Scalar unchanged_distance = 0;
};

/// Result of a steady solution, a step or a rigid shift. Per unit width of a contact that is plane across, y = 0.
/// Forces and work are not a number where the status is neither ok nor no_solution.
template <class Scalar>
struct FrictionStep {
    Scalar force_per_width = std::numeric_limits<Scalar>::quiet_NaN();  ///< F_bar on body 1 [N/m]
    Scalar force = std::numeric_limits<Scalar>::quiet_NaN();            ///< 2b F_bar [N]; infinite for infinite b
    /// d force_per_width / d creepage at the end of the step [N/m]; for a rigid shift by the shift [N/m^2]. Not a
    /// number where the matrix of the stick elements is singular.
    Scalar tangent_per_width = std::numeric_limits<Scalar>::quiet_NaN();
    Scalar tangent = std::numeric_limits<Scalar>::quiet_NaN();  ///< the same of the force: 2b times it; infinite with b
    /// Work that slip turns into heat, never negative: of a step or a shift per unit width [J/m]; of a steady solution
    /// per unit width and unit distance rolled [J/m^2]. The sum over the elements of tractions times the slip at their
    /// centres, of second order in 1/n at alpha = 0.5 (steady rolling, cosine mesh, n = 40, against -F_bar xi: 1.5e-3
    /// at a creepage ratio of 0.5); for ready matrices times the slip of their own equation, of first order.
    Scalar slip_work_per_width = std::numeric_limits<Scalar>::quiet_NaN();
    /// Largest violation of |p| <= mu p_n (over the largest mu p_n) and of s (over the largest slip there would be
    /// without traction). 0 in a step whose slip is not checked (see FrictionState::unchanged_steps): its tractions and
    /// its slip keep the law exactly, and the equations but for rounding that is not known.
    Scalar complementarity_residual = std::numeric_limits<Scalar>::quiet_NaN();
    Eigen::Index stick_count = 0;  ///< elements that stick
    int rounds = 0;                ///< rounds of the active set
    int pivots = 0;                ///< pivots of the fallback; 0 where the rounds settled
    StepStatus status = StepStatus::not_finite;
};

/// Result of a step under a load of its own, with the tangents by it: derivatives of the force at the end of the step.
/// By the load, d force / d load is that at constant half-length, and not a number where NormalLoad has no
/// pressure_rate; where the half-length depends on the load too, the whole is by_load + by_half_length da/d load. Not a
/// number where the matrix of the stick elements is singular; by the half-length neither where the system knows one
/// half-length only.
template <class Scalar>
struct LoadedFrictionStep : FrictionStep<Scalar> {
    Scalar tangent_by_load_per_width = std::numeric_limits<Scalar>::quiet_NaN();         ///< [N/m per unit of the load]
    Scalar tangent_by_load = std::numeric_limits<Scalar>::quiet_NaN();                   ///< 2b times it
    Scalar tangent_by_half_length_per_width = std::numeric_limits<Scalar>::quiet_NaN();  ///< [N/m^2]
    Scalar tangent_by_half_length = std::numeric_limits<Scalar>::quiet_NaN();            ///< 2b times it [N/m]
};

}  // namespace rollbem
