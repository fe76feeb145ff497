// Friction that depends on the velocity of slip on the elements of a mesh: the law, the state, the workspace.
#pragma once

#include "../detail/language.hpp"

#include <utility>

#include <Eigen/Core>

#include "../detail/finite.hpp"
#include "../types.hpp"
#include "detail/active_set_slip.hpp"
#include "detail/falling_scratch.hpp"
#include "law.hpp"
#include "slip_law.hpp"
#include "state.hpp"
#include "workspace.hpp"

namespace rollbem {

/// The law |p| <= mu p_n, where mu = mu_s(v) follows the slip velocity at once or, with a memory, gradually.
template <class Law, class Scalar = double>
struct FallingFriction {
    Law law;                         ///< mu_s(v) [-] of v [m/s]: a SlipLaw
    SlipMemory<Scalar> memory;       ///< {} for none
    ArrayX<Scalar> normal_pressure;  ///< p_n [Pa] as in CoulombFriction
    /// Whether results include tangents. Each stage then factorises a matrix of the slipping elements, at a cost of
    /// order n^3, unless the slip velocities are those of the stage before. Without tangents they are NaN.
    bool with_tangents = true;
};

/// Everything that the next step needs to know about the past: FrictionState and the coefficients of friction.
template <class Scalar_ = double>
struct FallingFrictionState : FrictionState<Scalar_> {
    using Scalar = Scalar_;

    /// mu [-] of each unknown element, finite and not negative. Without memory it is mu_s(v), and only the starting
    /// point of the next solution. After StepStatus::no_solution these are not coefficients to go on with.
    ArrayX<Scalar> friction_coefficient;
    /// mu [-] in the first stage of a step of sdirk2, from which the search for that of the next one starts; otherwise
    /// as friction_coefficient. Changes results by round-off only, unless there are several solutions.
    ArrayX<Scalar> stage_coefficient;
};

namespace detail {

/// The pressures with a coefficient of 1. Throws std::invalid_argument if law or memory is out of range.
template <class Law, class Scalar>
CoulombFriction<Scalar> checked_pressure(const char* who, const FallingFriction<Law, Scalar>& friction) {
    check_slip_law<Scalar>(who, friction.law, friction.memory);
    return {1, friction.normal_pressure};
}

/// The same without the pressures, which are part of the state.
template <class Law, class Scalar>
FallingFriction<Law, Scalar> without_pressure(const FallingFriction<Law, Scalar>& friction) {
    return {friction.law, friction.memory, {}, friction.with_tangents};
}

/// Adds the coefficients of elements at rest, mu_s(0), to a state.
template <class State, class FrictionState>
State with_coefficients(FrictionState state, typename State::Scalar at_rest) {
    const ArrayX<typename State::Scalar> coefficients =
        ArrayX<typename State::Scalar>::Constant(state.normal_pressure.size(), at_rest);
    return {std::move(state), coefficients, coefficients};
}

/// Whether there is one coefficient per element, finite and not negative.
template <class State>
bool fits_friction(const State& from, const State& to, Eigen::Index size) noexcept {
    const auto sized = [size](const State& state) {
        return state.friction_coefficient.size() == size && state.stage_coefficient.size() == size;
    };
    return sized(from) && sized(to) && all_finite(from.friction_coefficient) && all_finite(from.stage_coefficient) &&
           !(from.stage_coefficient.minCoeff() < 0) && !(from.friction_coefficient.minCoeff() < 0);
}

/// Writes the coefficients at the end of a step; those of its start if the step failed.
template <class Step, class State, class Stages>
void hand_over(const Step& step, const State& from, const Stages& stages, State& to) noexcept {
    if (step.status == StepStatus::not_finite) {
        to.friction_coefficient = from.friction_coefficient;
        to.stage_coefficient = from.stage_coefficient;
    } else {
        to.friction_coefficient = stages.friction().array();
        to.stage_coefficient = stages.stage_friction().array();
    }
}

}  // namespace detail

/// Factors and scratch memory, as FrictionWorkspace. Its slip() and slip_work() are those of what was solved last.
template <class Scalar_ = double>
class FallingFrictionWorkspace : public FrictionWorkspace<Scalar_> {
public:
    using Scalar = Scalar_;

    /// For n unknown elements.
    explicit FallingFrictionWorkspace(Eigen::Index n) : FrictionWorkspace<Scalar>(n), scratch_(n) {}

private:
    template <class, class>
    friend class SteadyFallingModel;
    template <class, class>
    friend class FallingFrictionModel;

    detail::FallingScratch<detail::ActiveSetSlip<Scalar>> scratch_;
};

}  // namespace rollbem
