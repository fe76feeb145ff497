// Matrix factors and scratch memory of friction. They make steps fast and never change a result.
#pragma once

#include <Eigen/Core>

#include "../types.hpp"
#include "detail/rolling_friction.hpp"
#include "state.hpp"

namespace rollbem {

/// A workspace is made by a model and fits any model with the same number of elements and directions, the same coupling
/// of directions and the same kind of coefficient (constant, or dependent on slip). The factors are kept as long as the
/// model and the distance rolled stay the same, so contacts that are stepped in turn should each have their own
/// workspace. Two threads must not use one workspace at the same time.
template <int directions = 1>
class FrictionWorkspace {
public:
    using Scratch = detail::StepScratch<directions>;

    /// A workspace for n unknown elements.
    explicit FrictionWorkspace(Eigen::Index n, bool slip_dependent = false, bool coupled = false)
        : scratch_(n, coupled, slip_dependent) {}

    Eigen::Index size() const { return scratch_.slip.rows(); }
    bool fits(Eigen::Index n, bool slip_dependent, bool coupled) const {
        if constexpr (directions == 2) {
            if (scratch_.solver.matrix.coupled() != coupled) return false;
        }
        return size() == n && scratch_.mu.iteration.size() == (slip_dependent ? n : 0);
    }

    /// Slip of body 1 on body 2 in the last solution, at the collocation point of each element's equation: the distance
    /// slid [m] in a step or a rigid shift, the slip velocity over the rolling velocity, s/V [-], in a steady solution.
    const ElementVectors<directions>& slip() const { return scratch_.slip; }

    /// Contribution of each element to FrictionStep::slip_work, whose comment says when a contribution may be negative:
    /// [J], or [J/m] for a steady solution. Divided by the element's area (on a line its width times Contact::width())
    /// it is the work per area of contact, on which wear depends.
    const VectorX<double>& slip_work() const { return scratch_.work; }

    Scratch& scratch() { return scratch_; }  ///< for the models
    const Scratch& scratch() const { return scratch_; }

private:
    Scratch scratch_;
};

}  // namespace rollbem
