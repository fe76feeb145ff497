// What a friction problem with longitudinal and lateral creepage carries from step to step, and what a step returns:
// plain data.
#pragma once

#include "../detail/language.hpp"

#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "../status.hpp"
#include "../types.hpp"

namespace rollbem {

/// What an element does. Where it slips, |p| = mu p_n and p opposes the slip.
enum class CombinedZone : signed char { stick, slip };

/// One vector per element: longitudinal in column 0, lateral in column 1.
template <class Scalar>
using ElementVectors = Eigen::Matrix<Scalar, Eigen::Dynamic, 2>;

/// Everything that the next step or solution needs to know of the past. A copy is a checkpoint: written to a file and
/// read back, it continues with the same results to the last bit.
template <class Scalar_>
struct CombinedFrictionState {
    using Scalar = Scalar_;

    ElementVectors<Scalar> traction;  ///< p on body 1 of each unknown element [Pa], trailing to leading
    std::vector<CombinedZone> zones;  ///< what each element does; after a step, at its end
    /// The present load: p_n [Pa] of each unknown element and a [m] of the contact. A step without a load keeps it.
    ArrayX<Scalar> normal_pressure;
    Scalar half_length = 0;
    std::uint64_t system = 0;  ///< fingerprint() of the model that the state belongs to
};

/// A force in the plane of contact, or its derivative. Not a number until something is known.
template <class Scalar>
struct TangentialForce {
    Scalar longitudinal = std::numeric_limits<Scalar>::quiet_NaN();
    Scalar lateral = std::numeric_limits<Scalar>::quiet_NaN();
};

/// Derivatives of a force by both creepages.
template <class Scalar>
struct CreepageTangent {
    TangentialForce<Scalar> by_longitudinal, by_lateral;
};

/// Result of a steady solution, a step or a rigid shift, at y = 0 of a contact that is uniform across its width. Forces
/// and work are not a number if the status is neither ok nor no_solution.
template <class Scalar>
struct CombinedFrictionStep {
    TangentialForce<Scalar> force_per_width;  ///< F_bar on body 1 [N/m]
    TangentialForce<Scalar> force;            ///< 2b F_bar [N]; infinite for infinite b
    /// d force_per_width / d creepage at the end of the step [N/m]; for a rigid shift, by the shift [N/m^2]. Not a
    /// number if the equations of the elements are singular.
    CreepageTangent<Scalar> tangent_per_width;
    CreepageTangent<Scalar> tangent;  ///< the same of the force: 2b times it; infinite with b
    /// Work that slip turns into heat, never negative: of a step or a shift per unit width [J/m]; of a steady solution
    /// per unit width and unit distance rolled [J/m^2]. Computed as in FrictionStep, over both directions.
    Scalar slip_work_per_width = std::numeric_limits<Scalar>::quiet_NaN();
    /// As in FrictionStep, over both directions.
    Scalar jump_work_per_width = std::numeric_limits<Scalar>::quiet_NaN();
    /// Largest violation of the law. Of the traction, relative to the largest mu p_n: |p| above mu p_n, or below it
    /// where an element slips. Of the slip, relative to the largest slip without traction: slip of an element that
    /// sticks, or across the traction, or along it.
    Scalar complementarity_residual = std::numeric_limits<Scalar>::quiet_NaN();
    Eigen::Index stick_count = 0;  ///< elements that stick
    int rounds = 0;                ///< Newton steps of the solver
    StepStatus status = StepStatus::not_finite;
};

/// Result of a step under a load of its own, with the derivatives by that load as in LoadedFrictionStep.
template <class Scalar>
struct LoadedCombinedStep : CombinedFrictionStep<Scalar> {
    TangentialForce<Scalar> tangent_by_load_per_width;         ///< [N/m per unit of the load]
    TangentialForce<Scalar> tangent_by_load;                   ///< 2b times it
    TangentialForce<Scalar> tangent_by_half_length_per_width;  ///< [N/m^2]
    TangentialForce<Scalar> tangent_by_half_length;            ///< 2b times it [N/m]
};

}  // namespace rollbem
