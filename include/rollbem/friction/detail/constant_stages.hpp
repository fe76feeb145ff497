// The bounds of a stage for a constant coefficient of friction.
#pragma once

#include "../../detail/language.hpp"

#include <cstddef>
#include <vector>

#include "../../types.hpp"
#include "../state.hpp"
#include "active_set.hpp"
#include "load_tangents.hpp"
#include "rolling_stage.hpp"

namespace rollbem::detail {

/// The bounds are given by the pressures and the coefficient. FallingStages is the counterpart for falling friction.
template <class Scalar>
struct ConstantStages {
    static constexpr bool bounds_are_given = true;

    /// Called before each stage is solved.
    void enter(const StagePlace<Scalar>&, const RollingStage<Scalar>&) noexcept {}
    typename ActiveSet<Scalar>::Outcome solve(ActiveSet<Scalar>& solver, const VectorX<Scalar>& bound,
                                              const std::vector<Zone>& zones) noexcept {
        return solver.solve(bound, zones);
    }
    /// dp in the stage solved last caused by a change dc and by a change of the bounds, `share` times bound_change.
    void respond(ActiveSet<Scalar>& solver, const VectorX<Scalar>& change, Scalar, VectorX<Scalar>& traction_change,
                 std::size_t, const VectorX<Scalar>* bound_change, Scalar share) noexcept {
        solver.respond(change, *bound_change, traction_change, share);
    }
    /// dp caused by the half-length, which changes the constants by `change`.
    void respond_to_half_length(ActiveSet<Scalar>& solver, const VectorX<Scalar>& change,
                                VectorX<Scalar>& traction_change, std::size_t) noexcept {
        solver.respond(change, traction_change);
    }
    void carry_response(std::size_t) noexcept {}
};

}  // namespace rollbem::detail
