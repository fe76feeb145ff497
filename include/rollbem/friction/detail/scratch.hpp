// The memory behind a workspace: factors and everything that a solution needs besides the states.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include <Eigen/Core>

#include "../../rolling/stage.hpp"
#include "../../types.hpp"
#include "../state.hpp"
#include "slip_dependent_set.hpp"
#include "slip_work.hpp"
#include "stick_slip.hpp"

namespace rollbem::detail {

/// Parameters of the tangents, as indices of what the first stage passes to the second: the creepages come first.
template <int directions>
struct TangentBy {
    static constexpr std::size_t creepages = directions == 1 ? 1 : 3;
    static constexpr std::size_t load = creepages, half_length = creepages + 1, half_width = creepages + 2;
    static constexpr std::size_t count = directions == 1 ? half_width : half_width + 1;
};

/// For a coefficient that depends on slip. All memory is allocated by the constructor.
template <int directions, class Scalar>
struct SlipDependentScratch {
    using Vector = VectorX<Scalar>;

    explicit SlipDependentScratch(Eigen::Index n) : set(n) {
        for (Vector* vector : {&friction, &duration, &before, &rise, &first_friction, &change, &bound, &path_change,
                               &before_change}) {
            vector->setZero(n);
        }
        carried_change.fill(change);
    }

    SlipDependentSet<directions, Scalar> set;
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

/// Dimensionless: tractions in G, lengths in a_0, the contact's half-length. All memory is allocated by the
/// constructor; that for a coefficient that depends on slip only if `slip_dependent`, that for directions that
/// couple only if `coupled`.
template <int directions, class Scalar>
struct FrictionScratch {
    using Vector = VectorX<Scalar>;
    using Vectors = ElementVectors<Scalar, directions>;
    /// One of each solution that has constants of its own (StickSlip).
    using OfEach = std::array<Vectors, directions>;

    FrictionScratch(Eigen::Index n, bool slip_dependent, bool coupled)
        : solver(n, coupled), falling(slip_dependent ? n : 0), jump_work(n) {
        slip.setZero(n, directions);
        change = slip;
        for (OfEach* each : {&start, &displacement, &right}) each->fill(slip);
        for (auto& each : carried) each.fill(slip);
        for (Vector* vector : {&work, &bound, &bound_rate, &stage_bound_rate}) vector->setZero(n);
    }

    StickSlip<directions, Scalar> solver;
    SlipDependentScratch<directions, Scalar> falling;
    std::uint64_t system = 0;  // the solver's matrices are those of this system and stage
    std::optional<RollingStage<Scalar>> stage;
    Vectors slip;         // of all stages so far
    OfEach start;         // tractions from which the search for the present stage starts
    OfEach displacement;  // from which the present stage starts
    OfEach right;
    Vectors change;
    Vector work;                          // of all stages so far
    Vector bound;                         // mu p_n/G of the present stage; p_n/G if mu depends on slip
    Vector bound_rate, stage_bound_rate;  // its derivative with respect to the load; in the present stage
    JumpWork<directions, Scalar> jump_work;
    // dc of the second stage, from the first
    std::array<std::array<Vectors, TangentBy<directions>::count>, directions> carried;

    // One direction with a constant coefficient: what follows depends on M and the sticking elements alone. `carried`
    // then belongs to a unit dc of the first stage.
    static constexpr std::uint64_t never = (std::numeric_limits<std::uint64_t>::max)();
    std::uint64_t tangent_revision = never, carried_revision = never;
    Scalar unit_tangent = 0, carried_tangent = 0;  // sum of areas times dp, by dc of the last stage and of the first
};

}  // namespace rollbem::detail
