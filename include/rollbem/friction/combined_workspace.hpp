// Factors and scratch memory of a friction problem with both creepages: they make steps fast and change no result.
#pragma once

#include "../detail/language.hpp"

#include <Eigen/Core>

#include "../types.hpp"
#include "combined_state.hpp"
#include "detail/combined_memory.hpp"

namespace rollbem {

namespace detail {
template <class Scalar>
class CombinedCore;
}

/// Made by a model, and usable with any model of as many elements. Factors are reused as long as the model and the
/// distance rolled stay the same: contacts stepped in turn should each have their own. Not to be shared by threads.
template <class Scalar_>
class CombinedFrictionWorkspace {
public:
    using Scalar = Scalar_;

    /// For n unknown elements.
    explicit CombinedFrictionWorkspace(Eigen::Index n) : memory_(n) {}

    Eigen::Index size() const { return memory_.work.size(); }

    /// Slip of body 1 on body 2 at the point of each element's equation, in the last solution: for a step or a rigid
    /// shift the distance slid in it [m]; for a steady solution the slip velocity over the rolling velocity, s/V [-].
    const ElementVectors<Scalar>& slip() const { return memory_.slip; }

    /// Contribution of each element to slip_work_per_width, never negative: per unit width [J/m]; of a steady solution
    /// per unit width and unit distance rolled [J/m^2].
    const VectorX<Scalar>& slip_work() const { return memory_.work; }

private:
    friend class detail::CombinedCore<Scalar>;

    detail::CombinedMemory<Scalar> memory_;
};

}  // namespace rollbem
