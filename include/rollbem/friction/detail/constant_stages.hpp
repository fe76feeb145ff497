// How the bounds of a stage come about where the coefficient of friction is constant.
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

/// The bounds are given: what the pressures and the coefficient say. FallingStages is the other way.
template <class Scalar>
struct ConstantStages {
    static constexpr bool bounds_are_given = true;

    /// Called before each stage is solved: where it lies in its step, and what it does to the contact.
    void enter(const StagePlace<Scalar>&, const RollingStage<Scalar>&) noexcept {}
    typename ActiveSet<Scalar>::Outcome solve(ActiveSet<Scalar>& solver, const VectorX<Scalar>& bound,
                                              const std::vector<Zone>& zones) noexcept {
        return solver.solve(bound, zones);
    }
    /// dp by a change dc of the stage solved last, and by `share` of one of its bounds;
    void respond(ActiveSet<Scalar>& solver, const VectorX<Scalar>& change, Scalar, VectorX<Scalar>& traction_change,
                 std::size_t, const VectorX<Scalar>* bound_change, Scalar share) noexcept {
        solver.respond(change, *bound_change, traction_change, share);
    }
    /// and by the half-length, which changes the constants by `change`.
    void respond_to_half_length(ActiveSet<Scalar>& solver, const VectorX<Scalar>& change,
                                VectorX<Scalar>& traction_change, std::size_t) noexcept {
        solver.respond(change, traction_change);
    }
    void carry_response(std::size_t) noexcept {}
};

}  // namespace rollbem::detail
