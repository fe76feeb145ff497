// Matrix factors and scratch memory of a friction problem. They make steps fast and never change a result.
#pragma once

#include "../detail/language.hpp"

#include <cstdint>
#include <limits>

#include <Eigen/Core>

#include "../types.hpp"
#include "detail/active_set.hpp"
#include "detail/jump_work.hpp"
#include "detail/load_tangents.hpp"
#include "detail/rolling_stage.hpp"
#include "detail/stage_memory.hpp"

namespace rollbem {

namespace detail {
template <class Scalar>
class FrictionCore;
}

/// Made by a model; works with any model of the same number of elements. The factors are kept as long as the model and
/// the distance rolled stay the same, so contacts that are stepped in turn should each have their own workspace. Two
/// threads must not use one workspace at the same time.
template <class Scalar_>
class FrictionWorkspace {
public:
    using Scalar = Scalar_;

    /// For n unknown elements.
    explicit FrictionWorkspace(Eigen::Index n)
        : solver_(n),
          slip_(VectorX<Scalar>::Zero(n)),
          work_(VectorX<Scalar>::Zero(n)),
          bound_(VectorX<Scalar>::Zero(n)),
          memory_(n),
          jump_work_(n),
          load_tangents_(n),
          carried_(VectorX<Scalar>::Zero(n)),
          response_(VectorX<Scalar>::Zero(n)),
          slip_change_(VectorX<Scalar>::Zero(n)) {}

    Eigen::Index size() const { return slip_.size(); }

    /// Slip of body 1 on body 2 in the last solution, at the collocation point of each element's equation: the distance
    /// slid [m] in a step or a rigid shift, the slip velocity over the rolling velocity, s/V [-], in a steady solution.
    const VectorX<Scalar>& slip() const { return slip_; }

    /// Contribution of each element to slip_work_per_width, never negative: [J/m], or [J/m^2] for a steady solution.
    /// Divided by the element's width it is the work per area of contact, on which wear depends.
    const VectorX<Scalar>& slip_work() const { return work_; }

private:
    friend class detail::FrictionCore<Scalar>;

    detail::ActiveSet<Scalar> solver_;
    std::uint64_t system_ = 0;  // the solver holds the matrix of this model and this stage
    detail::RollingStage<Scalar> stage_{.distance = std::numeric_limits<Scalar>::quiet_NaN()};
    VectorX<Scalar> slip_, work_;
    VectorX<Scalar> bound_;  // mu p_n / G of the present stage
    detail::StageMemory<Scalar> memory_;
    detail::JumpWork<Scalar> jump_work_;
    detail::LoadTangents<Scalar> load_tangents_;
    VectorX<Scalar> carried_;  // dc of the last stage by dc of the first
    VectorX<Scalar> response_, slip_change_;
    Scalar unit_tangent_ = 0, carried_tangent_ = 0;  // sum of areas times dp, by dc of the last stage and of the first
    static constexpr unsigned long never = std::numeric_limits<unsigned long>::max();
    unsigned long tangent_revision_ = never, carried_revision_ = never;
};

}  // namespace rollbem
