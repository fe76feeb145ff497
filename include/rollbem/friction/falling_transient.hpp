// Rolling in time with friction that depends on the velocity of slip, with or without memory.
#pragma once

#include "../detail/language.hpp"

#include <cstdint>
#include <type_traits>
#include <utility>

#include "../adhesion/integrator.hpp"
#include "../assembly/rolling_system.hpp"
#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../normal/load.hpp"
#include "../scene/contact.hpp"
#include "../scene/rigid_motion.hpp"
#include "../status.hpp"
#include "detail/falling_stages.hpp"
#include "falling_state.hpp"
#include "slip_law.hpp"
#include "state.hpp"
#include "transient.hpp"

namespace rollbem {

/// FrictionModel with a coefficient of friction that depends on the slip velocity, v = |slip in a stage| / its
/// duration. Immutable: threads may share it if they may share the law.
///
/// With a memory, mu belongs to the particles of the surfaces, which roll through the contact: each element starts from
/// the coefficient of the particle that arrives there. A particle enters with mu_s(0), and its memory is reset where
/// there is no pressure.
///
/// A step may have several solutions, and the nearest one may vanish; the force then jumps within the step, however
/// short it is. Without memory, or with a short one, such jumps are a property of the equations, not of the steps. The
/// solution found is one to which the coefficients of `from` lead. Steps must resolve the memory: the slip in a step
/// should be shorter than the memory's distance.
template <class Law_, class Scalar_ = double>
class FallingFrictionModel {
public:
    using Law = Law_;
    using Scalar = Scalar_;
    using State = FallingFrictionState<Scalar>;
    using Step = FrictionStep<Scalar>;
    using LoadedStep = LoadedFrictionStep<Scalar>;
    using Workspace = FallingFrictionWorkspace<Scalar>;
    static_assert(SlipLaw<Law, Scalar>);

    /// Throws std::invalid_argument if FrictionModel does, if mu_s(0) or the memory is negative or not finite, or if
    /// there is a memory but the system does not know its collocation points.
    FallingFrictionModel(const Contact<Scalar>& contact, ElementSystem<Scalar> system, const StabilityVerdict& verdict,
                         const FallingFriction<Law, Scalar>& friction, Integrator integrator = Integrator::sdirk2)
        : model_(contact, std::move(system), verdict, detail::checked_pressure("FallingFrictionModel", friction),
                 integrator),
          friction_(detail::without_pressure(friction)) {
        require_points();
    }

    /// The same without checks of the eigenvalues and of convergence.
    FallingFrictionModel(const Contact<Scalar>& contact, ElementSystem<Scalar> system, Unchecked,
                         const FallingFriction<Law, Scalar>& friction, Integrator integrator = Integrator::sdirk2)
        : model_(contact, std::move(system), unchecked, detail::checked_pressure("FallingFrictionModel", friction),
                 integrator),
          friction_(detail::without_pressure(friction)) {
        require_points();
    }

    Eigen::Index size() const { return model_.size(); }                 ///< number of unknown elements
    std::uint64_t fingerprint() const { return model_.fingerprint(); }  ///< as of FrictionModel: not of the law
    Integrator integrator() const { return model_.integrator(); }

    /// No traction, all elements stick, mu = mu_s(0).
    State at_rest() const {
        return detail::with_coefficients<State>(model_.at_rest(), static_cast<Scalar>(friction_.law(Scalar(0))));
    }
    Workspace workspace() const { return Workspace(size()); }

    /// As in FrictionModel.
    Scalar force(const State& state) const { return model_.force(state); }
    Scalar elastic_energy_per_width(const State& state) const { return model_.elastic_energy_per_width(state); }
    Scalar elastic_energy(const State& state) const { return model_.elastic_energy(state); }

    /// Steady rolling at a creepage [-] and a speed V > 0 [m/s] under the load of `from`: SteadyFallingModel::solve for
    /// states of this model.
    Step steady(const State& from, Scalar creepage, Scalar speed, State& to, Workspace& workspace) const noexcept {
        return settle(from, creepage, speed, {from.normal_pressure, from.half_length}, to, workspace);
    }
    /// The same under another load. If its half-length is not the contact's, the system must be able to breathe.
    Step steady(const State& from, Scalar creepage, Scalar speed, const NormalLoad<Scalar>& load, State& to,
                Workspace& workspace) const noexcept {
        const StepStatus possible = load.check(model_.system_.element_count());
        if (possible != StepStatus::ok) return Core::failed(possible);
        return settle(from, creepage, speed, {load.normal_pressure, load.half_length}, to, workspace);
    }

    /// Rolls by dq [m] in `duration` [s], positive and finite; dq = 0 is a rigid shift, which has a duration too. As
    /// FrictionModel::advance; in addition, the status is invalid_step if the duration is not positive and finite,
    /// wrong_state if a coefficient of `from` is negative or not finite, and no_solution if coefficients and slip do
    /// not come to agree: complementarity_residual is then at least the error of a coefficient. The tangent holds dq
    /// and the duration constant.
    Step advance(const State& from, Scalar dq, Scalar duration, const RigidMotion<Scalar>& motion, State& to,
                 Workspace& workspace) const noexcept {
        return roll<false>(from, dq, duration, motion, {from.normal_pressure, from.half_length}, nullptr, to,
                           workspace);
    }

    /// The same under a load that varies linearly from that of `from` to this one at the end of the step, as in
    /// FrictionModel::advance. With a memory, the tangent by the half-length is one-sided if a particle arrives exactly
    /// from a collocation point.
    LoadedStep advance(const State& from, Scalar dq, Scalar duration, const RigidMotion<Scalar>& motion,
                       const NormalLoad<Scalar>& load, State& to, Workspace& workspace) const noexcept {
        const StepStatus possible = load.check(model_.system_.element_count());
        if (possible != StepStatus::ok) return {Core::failed(possible)};
        return roll<true>(from, dq, duration, motion, {load.normal_pressure, load.half_length}, &load.pressure_rate, to,
                          workspace);
    }

    /// A rigid shift [m] of body 1 on body 2, positive like creepage, without rolling, in `duration` [s].
    Step shift(const State& from, Scalar shift, Scalar duration, State& to, Workspace& workspace) const noexcept {
        return advance(from, 0, duration, RigidMotion<Scalar>::shift(shift), to, workspace);
    }

private:
    using Core = detail::FrictionCore<Scalar>;
    using Load = typename Core::Load;
    using Stages = detail::FallingStages<Law, detail::ActiveSetSlip<Scalar>>;

    void require_points() const {
        detail::require(friction_.memory.distance == 0 || model_.system_.points().has_value(), "FallingFrictionModel",
                        "distance of the memory", friction_.memory.distance,
                        "be 0 for a system that does not know the points of its equations");
    }

    // If the step is loaded, the result includes the tangents by the load.
    template <bool loaded>
    auto roll(const State& from, Scalar dq, Scalar duration, const RigidMotion<Scalar>& motion, const Load& load,
              const ArrayX<Scalar>* pressure_rate, State& to, Workspace& workspace) const noexcept {
        StepStatus possible = model_.check(from, dq, motion, load, to, workspace);
        if (possible == StepStatus::ok && !detail::fits_friction(from, to, size())) possible = StepStatus::wrong_state;
        if (possible == StepStatus::ok && !positive(duration)) possible = StepStatus::invalid_step;
        using Result = std::conditional_t<loaded, LoadedStep, Step>;
        if (possible != StepStatus::ok) return Result{Core::failed(possible)};
        const Scalar unit = model_.core_.half_length();
        Stages stages(friction_.law, friction_.memory,
                      friction_.memory.distance > 0 ? &*model_.system_.points() : nullptr, from.friction_coefficient,
                      unit, dq / unit, duration, from.half_length / unit, friction_.with_tangents, workspace.scratch_);
        stages.start_first_stage_from(from.stage_coefficient);
        if constexpr (loaded) {
            model_.core_.begin_tangents(*pressure_rate, model_.system_.log_strength() && dq > 0, workspace);
        }
        const Result step = model_.template roll<loaded>(stages, from, dq / unit, motion, load, to, workspace);
        detail::hand_over(step, from, stages, to);
        return step;
    }

    Step settle(const State& from, Scalar creepage, Scalar speed, const Load& load, State& to,
                Workspace& workspace) const noexcept {
        StepStatus possible = model_.check_steady(from, load, to, workspace);
        if (possible == StepStatus::ok && !detail::fits_friction(from, to, size())) possible = StepStatus::wrong_state;
        if (possible == StepStatus::ok && !detail::is_finite(creepage)) possible = StepStatus::not_finite;
        if (possible == StepStatus::ok && !positive(speed)) possible = StepStatus::invalid_step;
        if (possible != StepStatus::ok) return Core::failed(possible);
        Stages stages(friction_.law, friction_.memory, from.friction_coefficient, speed, model_.core_.widths(),
                      load.half_length, friction_.with_tangents, workspace.scratch_);
        const Step step =
            model_.core_.solve_steady(stages, from, creepage, model_.system_.G_prime(), load, to, workspace);
        detail::hand_over(step, from, stages, to);
        return step;
    }

    static bool positive(Scalar value) { return detail::is_finite(value) && value > 0; }

    FrictionModel<Scalar> model_;
    FallingFriction<Law, Scalar> friction_;  // without pressures
};

}  // namespace rollbem
