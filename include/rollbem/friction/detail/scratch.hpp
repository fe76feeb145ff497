// The memory behind a workspace: matrix factors and all vectors that a solution needs besides the states.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "../../rolling/stage.hpp"
#include "../../rolling/step_frame.hpp"
#include "../../scene/directions.hpp"
#include "../../scene/semi_axes.hpp"
#include "../../types.hpp"
#include "../state.hpp"
#include "slip_dependent_set.hpp"
#include "stick_slip.hpp"

namespace rollbem::detail {

/// Memory for a coefficient that depends on slip. All memory is allocated by the constructor.
template <int directions>
struct SlipDependentScratch {
    using Vector = VectorX<double>;

    explicit SlipDependentScratch(Eigen::Index n) : set(n) {
        for (Vector* vector :
             {&friction, &duration, &before, &rise, &first_friction, &change, &bound, &path_change, &before_change}) {
            vector->setZero(n);
        }
        carried_change.fill(change);
    }

    SlipDependentSet<directions> set;
    Vector friction;  // mu in the present stage
    Vector duration, before;
    Vector rise;            // change of mu in the first stage along the paths of the particles
    Vector first_friction;  // mu in the first of two stages
    Vector change;          // d mu of the last tangent
    Vector bound;           // d bound of the last tangent at constant mu
    Vector path_change;     // d before by the half-length, on which the paths of the particles depend
    Vector before_change;   // d before of the last tangent
    std::array<Vector, TangentBy<directions>::count> carried_change;  // d rise of each tangent
};

/// The last response to the creepage, with one direction. In rolling the next response is often the same; its tangent
/// or its contribution to the second stage is then known.
template <int directions>
struct KeptResponse {
    std::optional<std::uint64_t> revision;  // revision of the linear equations; none if nothing is kept
    double per_end = 0;                     // StepFrame::per_end() of the response
    SemiAxes<double> axes = contact_axes<double>;
    ForceAlong<directions, double> tangent{};  // tangent of the force, if the stage was the last
};

/// The memory of all stages of a step. Dimensionless: tractions in G, lengths in a_0, the contact's half-length. All
/// memory is allocated by the constructor, for a coefficient that depends on slip only if `slip_dependent`, and for
/// directions that couple only if `coupled`.
template <int directions>
struct FrictionScratch {
    using Vector = VectorX<double>;
    using Vectors = ElementVectors<directions>;
    /// One array for each solution that has constants of its own (StickSlip).
    using OfEach = std::array<Vectors, directions>;

    FrictionScratch(Eigen::Index n, bool slip_dependent, bool coupled)
        : solver(n, coupled), falling(slip_dependent ? n : 0) {
        slip.setZero(n, directions);
        first = change = slip;
        for (OfEach* each : {&start, &displacement, &right}) each->fill(slip);
        for (auto& each : carried) each.fill(slip);
        for (Vector* vector : {&work, &bound, &bound_rate, &stage_bound_rate}) vector->setZero(n);
    }

    StickSlip<directions> solver;
    SlipDependentScratch<directions> falling;
    std::uint64_t system = 0;  // system and stage to which the solver's matrices belong
    std::optional<RollingStage<double>> stage;
    Vectors slip;         // sum over all stages so far
    OfEach start;         // tractions from which the search for the present stage starts
    OfEach displacement;  // displacements from which the present stage starts
    OfEach right;
    Vectors first;  // tractions after the first of two stages
    Vectors change;
    Vector work;                          // sum over all stages so far
    Vector bound;                         // mu p_n/G of the present stage; p_n/G if mu depends on slip
    Vector bound_rate, stage_bound_rate;  // d bound / d load at the end of the step; in the present stage
    // dc of the second stage caused by the first
    std::array<std::array<Vectors, TangentBy<directions>::count>, directions> carried;

    std::array<KeptResponse<directions>, 3>
        kept;  // responses of the first of two stages, of a single stage, and of the second stage
};

}  // namespace rollbem::detail
