// Non-steady rolling with Coulomb friction, step by step, and rigid shifts without rolling.
// s/V = xi - G' p + G dp/dq, Eq. (1), with q = V t the distance rolled.
#pragma once

#include "../detail/language.hpp"

#include <cstdint>
#include <utility>

#include "../adhesion/integrator.hpp"
#include "../assembly/rolling_system.hpp"
#include "../scene/contact.hpp"
#include "../scene/rigid_motion.hpp"
#include "detail/core.hpp"
#include "law.hpp"
#include "state.hpp"
#include "workspace.hpp"

namespace rollbem {

/// The contact as a force element with friction, stepped like TransientModel. Immutable: threads may share it.
///
/// Integrator::sdirk2 solves for stick and slip twice per step and is of second order in dq, for forces and slip work
/// alike; implicit_euler solves once and is of first order. Each of these solutions satisfies Coulomb's law, and slip
/// never gains energy. Transitions between stick and slip within a step do not reduce the order.
///
/// The scheme must meet the requirements of TransientModel: a verdict that its eigenvalues decay, and convergence in
/// full adhesion. With any other scheme friction bounds the tractions, but they are wrong, unless alpha = 0 and several
/// elements slip at the trailing edge (see SteadyFrictionModel).
///
///     const auto system = rolling_system(mesh, scheme, kernel);
///     const FrictionModel<double> model(contact, system, judge_stability(system), friction);
///     FrictionWorkspace<double> workspace = model.workspace();
///     FrictionState<double> now = model.at_rest(), next = now;
///     const FrictionStep<double> step = model.advance(now, dq, creepage, next, workspace);  // does not change now
///     if (accepted) std::swap(now, next);
template <class Scalar_ = double>
class FrictionModel {
public:
    using Scalar = Scalar_;
    using State = FrictionState<Scalar>;
    using Step = FrictionStep<Scalar>;
    using LoadedStep = LoadedFrictionStep<Scalar>;
    using Workspace = FrictionWorkspace<Scalar>;

    /// Throws std::invalid_argument if the verdict does not belong to this system or does not establish that no
    /// eigenvalue grows, if steady rolling shows that the scheme does not converge (Status::inconsistent), if the
    /// contact's half-width is infinite or not that of the system's kernel, if the law does not meet the requirements
    /// of CoulombFriction (one pressure per element of the mesh), and for Integrator::matrix_exponential, which cannot
    /// treat friction.
    FrictionModel(const Contact<Scalar>& contact, ElementSystem<Scalar> system, const StabilityVerdict& verdict,
                  const CoulombFriction<Scalar>& friction, Integrator integrator = Integrator::sdirk2)
        : FrictionModel(contact, std::move(system), unchecked, friction, integrator) {
        detail::require_usable_in_time("FrictionModel", system_, verdict);
    }

    /// The same without checks of the eigenvalues and of convergence.
    FrictionModel(const Contact<Scalar>& contact, ElementSystem<Scalar> system, Unchecked,
                  const CoulombFriction<Scalar>& friction, Integrator integrator = Integrator::sdirk2)
        : system_(std::move(system)),
          core_(contact, system_.weights(), system_.points(),
                detail::checked_friction("FrictionModel", friction, system_.element_count(), system_.size()),
                system_.fingerprint()),
          integrator_(integrator) {
        detail::require_same_aspect("FrictionModel", contact, system_);
        detail::require(integrator != Integrator::matrix_exponential, "FrictionModel", "integrator", name(integrator),
                        "be implicit_euler or sdirk2");
    }

    Eigen::Index size() const { return core_.size(); }  ///< number of unknown elements
    /// Of the system, the contact and the pressures of the law, but not of the coefficient of friction. To continue a
    /// state under another load, pass the load to a step; a model with other pressures refuses the state.
    std::uint64_t fingerprint() const { return core_.fingerprint(); }
    Integrator integrator() const { return integrator_; }

    /// No traction, all elements stick.
    State at_rest() const { return core_.at_rest(); }
    Workspace workspace() const { return Workspace(size()); }

    /// 2b F_bar of a state [N]. The state must have size() elements.
    Scalar force(const State& state) const { return core_.force(state); }

    /// Elastic energy of the tangential tractions in both bodies, E = 1/2 int p u dx, per unit width [J/m] and in total
    /// [J]. Positive, except for tractions that alternate from element to element; of second order in 1/n on cosine
    /// meshes at alpha = 0.5. The state must have size() elements; NaN if the system cannot represent its half-length.
    ///
    /// The work that the rigid bodies do on the contact, -F times the rigid slip (creepage times the distance rolled),
    /// becomes heat or elastic energy, even while the load or the length of the contact varies: heat = -F slip - dE,
    /// for any scheme. The sum of slip_work_per_width agrees with it to the orders of both in n and dq.
    Scalar elastic_energy_per_width(const State& state) const { return core_.elastic_energy(state, system_); }
    Scalar elastic_energy(const State& state) const { return core_.width() * elastic_energy_per_width(state); }

    /// Steady rolling at a creepage [-] under the load of `from`, e.g. as an initial state: SteadyFrictionModel::solve
    /// for states of this model.
    Step steady(const State& from, Scalar creepage, State& to, Workspace& workspace) const noexcept {
        return settle(from, creepage, {from.normal_pressure, from.half_length}, to, workspace);
    }
    /// The same under another load. If its half-length is not the contact's, the system must be able to breathe.
    Step steady(const State& from, Scalar creepage, const NormalLoad<Scalar>& load, State& to,
                Workspace& workspace) const noexcept {
        const StepStatus possible = load.check(system_.element_count());
        if (possible != StepStatus::ok) return Core::failed(possible);
        return settle(from, creepage, {load.normal_pressure, load.half_length}, to, workspace);
    }

    /// Rolls by dq [m], positive and finite, or 0 for a rigid shift without rolling, under the load of `from`. `to`
    /// must be another state with the same number of elements. It is not written if the status is invalid_step,
    /// wrong_state, invalid_load or needs_fixed_mesh or the motion is not finite; if the result is not finite, it
    /// becomes a copy of `from`. The result depends on `from`, dq and the motion alone, to the last bit. Does not
    /// allocate; a new dq costs a factorisation.
    Step advance(const State& from, Scalar dq, const RigidMotion<Scalar>& motion, State& to,
                 Workspace& workspace) const noexcept {
        const Load load{from.normal_pressure, from.half_length};
        const StepStatus possible = check(from, dq, motion, load, to, workspace);
        if (possible != StepStatus::ok) return Core::failed(possible);
        detail::ConstantStages<Scalar> stages;
        return roll<false>(stages, from, dq / core_.half_length(), motion, load, to, workspace);
    }

    /// The same under a load that varies linearly from that of `from` to this one at the end of the step. If the system
    /// can breathe (log_strength), the mesh follows the half-length, |da| < dq; a new half-length costs a
    /// factorisation, new pressures do not. Let steps end at kinks of the load, or sdirk2 loses its second order. No
    /// status warns if the contact grows so long (a > 2.4b) that Lambda of the plane kernel for the new half-length is
    /// no longer positive: a mode then grows in time until all elements slip, possibly in the direction of the
    /// creepage.
    LoadedStep advance(const State& from, Scalar dq, const RigidMotion<Scalar>& motion, const NormalLoad<Scalar>& load,
                       State& to, Workspace& workspace) const noexcept {
        StepStatus possible = load.check(system_.element_count());
        const Load end{load.normal_pressure, load.half_length};
        if (possible == StepStatus::ok) possible = check(from, dq, motion, end, to, workspace);
        if (possible != StepStatus::ok) return {Core::failed(possible)};
        detail::ConstantStages<Scalar> stages;
        core_.begin_tangents(load.pressure_rate, system_.log_strength() && dq > 0, workspace);
        return roll<true>(stages, from, dq / core_.half_length(), motion, end, to, workspace);
    }

    /// A rigid shift [m] of body 1 on body 2, positive like creepage, without rolling.
    Step shift(const State& from, Scalar shift, State& to, Workspace& workspace) const noexcept {
        return advance(from, 0, RigidMotion<Scalar>::shift(shift), to, workspace);
    }

private:
    using Core = detail::FrictionCore<Scalar>;

    template <class, class>
    friend class FallingFrictionModel;

    using Stage = detail::RollingStage<Scalar>;
    using Load = typename Core::Load;

    static constexpr Scalar gamma = detail::sdirk2_part<Scalar>;
    static constexpr Scalar ratio = detail::sdirk2_ratio<Scalar>;

    // A step whose arguments have been checked; dq in a_0. If it is loaded, the result includes the tangents that
    // begin_tangents() has asked for. `stages` determine the bounds.
    template <bool loaded, class Stages>
    auto roll(Stages& stages, const State& from, Scalar dq, const RigidMotion<Scalar>& motion, const Load& load,
              State& to, Workspace& workspace) const noexcept {
        const Scalar unit = core_.half_length(), a = from.half_length / unit, a_end = load.half_length / unit;
        // A stage takes `part` of the step: (s/V) part dq = xi part dq + M p - U.
        const bool two_stages = integrator_ == Integrator::sdirk2 && dq > 0;
        const Scalar part = two_stages ? gamma : Scalar(1);
        const Scalar travel = motion.is_shift() ? part / unit : part * dq;
        const detail::StagePlace<Scalar> first{part, part}, last{part, 1};
        core_.remember(from, system_, a, a != a_end, part * dq, workspace);
        typename Core::Before before{.zones = &from.zones};
        typename Core::Gain gain{.first = 0, .last = travel};
        if (two_stages) {
            const Stage stage = Stage::within(part, dq, a, a_end);
            enter(stage, workspace);
            stages.enter(first, stage);
            if constexpr (loaded) {
                core_.press(from.normal_pressure, load.pressure, part, workspace);
            } else {
                core_.press(load.pressure, workspace);  // for both stages
            }
            core_.impose(travel * (motion.start() + gamma * (motion.end() - motion.start())), system_, workspace);
            before = core_.solve_first(stages, from, ratio, system_, workspace);
            if constexpr (loaded) {
                if (before.tangent_exists) core_.carry_tangents(stages, system_, first, ratio, workspace);
            }
            gain.first = motion.is_linear() ? gamma * travel : travel;
            core_.extrapolate_memory(system_, ratio, workspace);
        }
        const Stage stage = Stage::last(part, dq, a, a_end);
        enter(stage, workspace);
        stages.enter(last, stage);
        if (loaded || !two_stages) core_.press(load.pressure, workspace);
        core_.impose(travel * motion.end(), system_, workspace);
        Step step = core_.solve_last(stages, from, before, gain, load, unit, to, workspace);
        core_.template add_jump_work<Stages>(from, system_, two_stages, dq > 0, load, workspace, step);
        if constexpr (loaded) {
            return core_.with_tangents(stages, step, system_, last, load, workspace);
        } else {
            return step;
        }
    }

    Step settle(const State& from, Scalar creepage, const Load& load, State& to, Workspace& workspace) const noexcept {
        const StepStatus possible = check_steady(from, load, to, workspace);
        if (possible != StepStatus::ok) return Core::failed(possible);
        detail::ConstantStages<Scalar> stages;
        return core_.solve_steady(stages, from, creepage, system_.G_prime(), load, to, workspace);
    }

    // Whether the arguments of a steady solution are valid,
    StepStatus check_steady(const State& from, const Load& load, const State& to,
                            const Workspace& workspace) const noexcept {
        if (!core_.fits(from, to, workspace)) return StepStatus::wrong_state;
        const StepStatus possible = core_.check_load(from);
        if (possible != StepStatus::ok) return possible;
        const Scalar a = load.half_length / core_.half_length();
        return detail::check_growth(system_, Scalar(0), a, a);
    }

    // and those of a step.
    StepStatus check(const State& from, Scalar dq, const RigidMotion<Scalar>& motion, const Load& load, const State& to,
                     const Workspace& workspace) const noexcept {
        if (!core_.fits(from, to, workspace)) return StepStatus::wrong_state;
        const Scalar unit = core_.half_length();
        StepStatus status = motion.check(dq / unit);
        if (status == StepStatus::ok) status = core_.check_load(from);
        if (status != StepStatus::ok) return status;
        return detail::check_growth(system_, dq / unit, from.half_length / unit, load.half_length / unit);
    }

    // Assembles the matrix of a stage unless the workspace has it.
    void enter(const Stage& stage, Workspace& workspace) const noexcept {
        if (MatrixX<Scalar>* matrix = core_.claim(stage, workspace)) detail::fill_stage_matrix(system_, stage, *matrix);
    }

    ElementSystem<Scalar> system_;
    Core core_;
    Integrator integrator_;
};

}  // namespace rollbem
