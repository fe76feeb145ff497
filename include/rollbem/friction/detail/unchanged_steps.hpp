// How many steps in a row have left every element in its zone, and what the next step need not do for that reason.
#pragma once

#include "../../detail/language.hpp"

#include <Eigen/Core>

#include "../state.hpp"
#include "active_set.hpp"
#include "rolling_stage.hpp"

namespace rollbem::detail {

/// Counts in the states themselves, so that a step depends on nothing else. A count holds for one matrix, which the
/// distance rolled in a stage and the half-length determine.
template <class Scalar>
class UnchangedSteps {
public:
    /// For n elements; `unit` is a_0 [m].
    UnchangedSteps(Eigen::Index n, Scalar unit) : enough_(1 + static_cast<int>(n / 2)), unit_(unit) {}

    /// Of a step whose stages roll by `distance` in a_0 at constant half-length.
    Effort effort(const FrictionState<Scalar>& from, Scalar distance) const {
        const int steps = claimed(from, distance);
        if (steps < enough_) return Effort::equations;
        return steps == enough_ ? Effort::transform_check : Effort::transform;
    }

    /// After the last stage of a step, in which every element has kept its zone or not.
    void count(const FrictionState<Scalar>& from, const RollingStage<Scalar>& last, bool unchanged,
               FrictionState<Scalar>& to) const {
        to.unchanged_steps = 0;
        to.unchanged_distance = 0;
        if (!unchanged || last.growth != 0) return;
        const int steps = claimed(from, last.distance) + 1;
        to.unchanged_steps = steps < enough_ + period ? steps : enough_;
        to.unchanged_distance = unit_ * last.distance;
    }

private:
    // Checks are cheap, but need not be frequent: nothing but rounding can differ.
    static constexpr int period = 64;

    // 0 for what no step leaves, or for another matrix.
    int claimed(const FrictionState<Scalar>& from, Scalar distance) const {
        const bool possible = from.unchanged_steps > 0 && from.unchanged_steps < enough_ + period;
        return possible && from.unchanged_distance == unit_ * distance ? from.unchanged_steps : 0;
    }

    int enough_;  // the transform costs about n/2 products of matrix and vector, and saves one or two a step
    Scalar unit_;
};

}  // namespace rollbem::detail
