// Rolling in time under longitudinal and lateral creepage with friction that depends on the velocity of slip, with or
// without memory.
#pragma once

#include "../detail/language.hpp"

#include <cstdint>
#include <utility>

#include "../adhesion/integrator.hpp"
#include "../assembly/rolling_system.hpp"
#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../normal/load.hpp"
#include "../scene/contact.hpp"
#include "../scene/creepage.hpp"
#include "../scene/rigid_motion.hpp"
#include "../status.hpp"
#include "combined_falling_state.hpp"
#include "combined_state.hpp"
#include "combined_transient.hpp"
#include "detail/falling_stages.hpp"
#include "falling_state.hpp"
#include "slip_law.hpp"

namespace rollbem {

/// CombinedFrictionModel with mu of the slip velocity, v = |slip of the step| / duration with the slip as a vector.
/// Const and free of caches: threads may share it if they may share the law. Memory, the choice among several
/// solutions, and steps within which the force jumps are as in FallingFrictionModel, which is for one direction and
/// costs less.
template <class Law_, class Scalar_ = double>
class CombinedFallingModel {
public:
    using Law = Law_;
    using Scalar = Scalar_;
    using State = CombinedFallingState<Scalar>;
    using Step = CombinedFrictionStep<Scalar>;
    using LoadedStep = LoadedCombinedStep<Scalar>;
    using Workspace = CombinedFallingWorkspace<Scalar>;
    using Motion = RigidMotion<Creepage<Scalar>>;
    static_assert(SlipLaw<Law, Scalar>);

    /// Throws std::invalid_argument as CombinedFrictionModel does, if mu_s(0) or the memory is negative or not finite,
    /// and if there is a memory but the longitudinal system does not know the points of its equations.
    CombinedFallingModel(const Contact<Scalar>& contact, ElementSystem<Scalar> longitudinal,
                         const StabilityVerdict& longitudinal_verdict, ElementSystem<Scalar> lateral,
                         const StabilityVerdict& lateral_verdict, const FallingFriction<Law, Scalar>& friction,
                         Integrator integrator = Integrator::sdirk2)
        : model_(contact, std::move(longitudinal), longitudinal_verdict, std::move(lateral), lateral_verdict,
                 detail::checked_pressure(name, friction), integrator),
          friction_(detail::without_pressure(friction)) {
        require_points();
    }

    /// The same whatever the eigenvalues, and whether the scheme converges or not.
    CombinedFallingModel(const Contact<Scalar>& contact, ElementSystem<Scalar> longitudinal,
                         ElementSystem<Scalar> lateral, Unchecked, const FallingFriction<Law, Scalar>& friction,
                         Integrator integrator = Integrator::sdirk2)
        : model_(contact, std::move(longitudinal), std::move(lateral), unchecked,
                 detail::checked_pressure(name, friction), integrator),
          friction_(detail::without_pressure(friction)) {
        require_points();
    }

    Eigen::Index size() const { return model_.size(); }                 ///< number of unknown elements
    std::uint64_t fingerprint() const { return model_.fingerprint(); }  ///< as of CombinedFrictionModel: not of the law
    Integrator integrator() const { return model_.integrator(); }

    /// No traction anywhere, everything sticks at mu_s(0).
    State at_rest() const {
        return detail::with_coefficients<State>(model_.at_rest(), static_cast<Scalar>(friction_.law(Scalar(0))));
    }
    Workspace workspace() const { return Workspace(size()); }

    /// As of CombinedFrictionModel.
    TangentialForce<Scalar> force(const State& state) const { return model_.force(state); }
    Scalar elastic_energy_per_width(const State& state) const { return model_.elastic_energy_per_width(state); }
    Scalar elastic_energy(const State& state) const { return model_.elastic_energy(state); }

    /// Steady rolling at a creepage and a speed V > 0 [m/s] under the load of `from`: what
    /// SteadyCombinedFallingModel::solve does, with states of this model,
    Step steady(const State& from, const Creepage<Scalar>& creepage, Scalar speed, State& to,
                Workspace& workspace) const noexcept {
        return settle(from, creepage, speed, {from.normal_pressure, from.half_length}, to, workspace);
    }
    /// or under another load. If the half-length is not the contact's, both systems must be able to breathe.
    Step steady(const State& from, const Creepage<Scalar>& creepage, Scalar speed, const NormalLoad<Scalar>& load,
                State& to, Workspace& workspace) const noexcept {
        const StepStatus possible = load.check(model_.systems_[0].element_count());
        if (possible != StepStatus::ok) return Core::failed(possible);
        return settle(from, creepage, speed, {load.normal_pressure, load.half_length}, to, workspace);
    }

    /// Rolls on by dq [m] in `duration` [s], positive and finite; dq = 0 is a rigid shift, which has a duration too. As
    /// CombinedFrictionModel::advance; in addition, the status is invalid_step if the duration is not positive and
    /// finite, wrong_state if a coefficient of `from` is negative or not finite, and no_solution if coefficients and
    /// slip do not come to agree: complementarity_residual is then at least the error of a coefficient. Tangents are by
    /// both creepages at this dq and duration.
    Step advance(const State& from, Scalar dq, Scalar duration, const Motion& motion, State& to,
                 Workspace& workspace) const noexcept {
        return roll(from, dq, duration, motion, {from.normal_pressure, from.half_length}, {}, to, workspace);
    }

    /// The same under a load that goes evenly from that of `from` to this one, with the tangent by it if it has a
    /// pressure_rate; that by the half-length is not a number.
    LoadedStep advance(const State& from, Scalar dq, Scalar duration, const Motion& motion,
                       const NormalLoad<Scalar>& load, State& to, Workspace& workspace) const noexcept {
        const StepStatus possible = load.check(model_.systems_[0].element_count());
        if (possible != StepStatus::ok) return Core::template failed<LoadedStep>(possible);
        return roll(from, dq, duration, motion, {load.normal_pressure, load.half_length}, load.pressure_rate, to,
                    workspace);
    }

    /// A rigid shift [m] of body 1 on body 2, positive like creepage, without rolling, in `duration` [s].
    Step shift(const State& from, const Creepage<Scalar>& shift, Scalar duration, State& to,
               Workspace& workspace) const noexcept {
        return advance(from, 0, duration, Motion::shift(shift), to, workspace);
    }

private:
    using Core = detail::CombinedCore<Scalar>;
    using Load = typename Core::Load;
    using Stages = detail::FallingStages<Law, detail::CombinedSlip<Scalar>>;

    static constexpr const char* name = "CombinedFallingModel";

    void require_points() const {
        detail::require(friction_.memory.distance == 0 || model_.systems_[0].points().has_value(), name,
                        "distance of the memory", friction_.memory.distance,
                        "be 0 for a system that does not know the points of its equations");
    }

    LoadedStep roll(const State& from, Scalar dq, Scalar duration, const Motion& motion, const Load& load,
                    const ArrayX<Scalar>& pressure_rate, State& to, Workspace& workspace) const noexcept {
        LoadedStep step;
        step.status = model_.check(from, dq, motion, load, to, workspace);
        if (step.status == StepStatus::ok) step.status = check(from, duration, to);
        if (step.status != StepStatus::ok) return step;
        const Scalar unit = model_.core_.half_length();
        Stages stages(friction_.law, friction_.memory,
                      friction_.memory.distance > 0 ? &*model_.systems_[0].points() : nullptr,
                      from.friction_coefficient, unit, dq / unit, duration, from.half_length / unit,
                      friction_.with_tangents, workspace.scratch_);
        stages.start_first_stage_from(from.stage_coefficient);
        auto& memory = Core::memory(workspace);
        const bool by_load = pressure_rate.size() > 0;
        if (by_load) model_.core_.set_bound_rate(pressure_rate, memory);
        model_.roll(stages, from, dq / unit, motion, load, {by_load, false}, to, memory, step);
        detail::hand_over(step, from, stages, to);
        return step;
    }

    Step settle(const State& from, const Creepage<Scalar>& creepage, Scalar speed, const Load& load, State& to,
                Workspace& workspace) const noexcept {
        StepStatus possible = model_.check_steady(from, load, to, workspace);
        if (possible == StepStatus::ok && !detail::is_finite(creepage)) possible = StepStatus::not_finite;
        if (possible == StepStatus::ok) possible = check(from, speed, to);
        if (possible != StepStatus::ok) return Core::failed(possible);
        Stages stages(friction_.law, friction_.memory, from.friction_coefficient, speed, model_.core_.widths(),
                      load.half_length, friction_.with_tangents, workspace.scratch_);
        const Step step = model_.core_.solve_steady(stages, from, creepage, model_.systems_[0].G_prime(),
                                                    model_.systems_[1].G_prime(), load, to, workspace);
        detail::hand_over(step, from, stages, to);
        return step;
    }

    // A duration or a speed, and the coefficients.
    StepStatus check(const State& from, Scalar positive, const State& to) const noexcept {
        if (!detail::fits_friction(from, to, size())) return StepStatus::wrong_state;
        return detail::is_finite(positive) && positive > 0 ? StepStatus::ok : StepStatus::invalid_step;
    }

    CombinedFrictionModel<Scalar> model_;
    FallingFriction<Law, Scalar> friction_;  // without pressures
};

}  // namespace rollbem
