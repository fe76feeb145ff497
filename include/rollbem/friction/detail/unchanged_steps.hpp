// The number of consecutive steps in which no element changed its zone, and what the next step may omit because of it.
#pragma once

#include <Eigen/Core>

#include "../state.hpp"
#include "active_set.hpp"
#include "rolling_stage.hpp"

namespace rollbem::detail {

/// The count is kept in the states (SolverRecord), so that a step depends on nothing else. It refers to one matrix,
/// which is determined by the distance rolled in a stage and the half-length.
template <class Scalar>
class UnchangedSteps {
public:
    /// For n elements; `unit` is a_0 [m].
    UnchangedSteps(Eigen::Index n, Scalar unit) : enough_(1 + static_cast<int>(n / 2)), unit_(unit) {}

    /// For a step whose stages roll by `distance` in a_0 at constant half-length.
    Effort effort(const SolverRecord<Scalar>& from, Scalar distance) const {
        const int steps = counted(from, distance);
        if (steps < enough_) return Effort::equations;
        return steps == enough_ ? Effort::transform_check : Effort::transform;
    }

    /// Updates the count at the end of a step; `unchanged` if no element changed its zone.
    void count(const SolverRecord<Scalar>& from, const RollingStage<Scalar>& last, bool unchanged,
               SolverRecord<Scalar>& to) const {
        to.unchanged_steps = 0;
        to.unchanged_distance = 0;
        if (!unchanged || last.growth != 0) return;
        const int steps = counted(from, last.distance) + 1;
        to.unchanged_steps = steps < enough_ + period ? steps : enough_;
        to.unchanged_distance = unit_ * last.distance;
    }

private:
    // Checks need not be frequent, as only round-off can differ.
    static constexpr int period = 64;

    // The count of `from`; 0 if it is out of range (an edited state) or belongs to another matrix.
    int counted(const SolverRecord<Scalar>& from, Scalar distance) const {
        const bool possible = from.unchanged_steps > 0 && from.unchanged_steps < enough_ + period;
        return possible && from.unchanged_distance == unit_ * distance ? from.unchanged_steps : 0;
    }

    int enough_;  // computing the transform costs about n/2 matrix-vector products and saves one or two per step
    Scalar unit_;
};

}  // namespace rollbem::detail
