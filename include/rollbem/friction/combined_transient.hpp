// Non-steady rolling with Coulomb friction under longitudinal and lateral creepage, step by step, under a load that may
// vary, and rigid shifts without rolling. s/V = xi - G' p + G dp/dq in both directions, q = V t the distance rolled.
#pragma once

#include "../detail/language.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "../adhesion/integrator.hpp"
#include "../assembly/rolling_system.hpp"
#include "../normal/load.hpp"
#include "../scene/contact.hpp"
#include "../scene/creepage.hpp"
#include "../scene/rigid_motion.hpp"
#include "combined_state.hpp"
#include "combined_workspace.hpp"
#include "detail/combined_core.hpp"
#include "detail/combined_tangent.hpp"
#include "detail/rolling_stage.hpp"
#include "law.hpp"

namespace rollbem {

/// The contact as a force element with friction in two directions, stepped like FrictionModel, which is for one
/// direction and costs less. Const and free of caches: threads may share it. Integrators, order and the requirements on
/// the scheme are those of FrictionModel.
///
///     const auto longitudinal = rolling_system(mesh, scheme, StripKernel<double>::longitudinal(contact));
///     const auto lateral = rolling_system(mesh, scheme, StripKernel<double>::lateral(contact));
///     const CombinedFrictionModel<double> model(contact, longitudinal, judge_stability(longitudinal), lateral,
///                                               judge_stability(lateral), friction);
///     CombinedFrictionWorkspace<double> workspace = model.workspace();
///     CombinedFrictionState<double> now = model.at_rest(), next = now;
///     const auto step = model.advance(now, dq, Creepage<double>{1e-3, 5e-4}, next, workspace);  // now stays as it is
///     if (accepted) std::swap(now, next);
template <class Scalar_ = double>
class CombinedFrictionModel {
public:
    using Scalar = Scalar_;
    using State = CombinedFrictionState<Scalar>;
    using Step = CombinedFrictionStep<Scalar>;
    using LoadedStep = LoadedCombinedStep<Scalar>;
    using Workspace = CombinedFrictionWorkspace<Scalar>;
    using Motion = RigidMotion<Creepage<Scalar>>;

    /// Both systems come from one mesh and scheme, with the contact's longitudinal and lateral kernels. Throws
    /// std::invalid_argument as FrictionModel does for each, and if their elements differ in number or width.
    CombinedFrictionModel(const Contact<Scalar>& contact, ElementSystem<Scalar> longitudinal,
                          const StabilityVerdict& longitudinal_verdict, ElementSystem<Scalar> lateral,
                          const StabilityVerdict& lateral_verdict, const CoulombFriction<Scalar>& friction,
                          Integrator integrator = Integrator::sdirk2)
        : CombinedFrictionModel(contact, std::move(longitudinal), std::move(lateral), unchecked, friction, integrator) {
        detail::require_usable_in_time("CombinedFrictionModel", systems_[0], longitudinal_verdict);
        detail::require_usable_in_time("CombinedFrictionModel", systems_[1], lateral_verdict);
    }

    /// The same without any requirement on eigenvalues or convergence.
    CombinedFrictionModel(const Contact<Scalar>& contact, ElementSystem<Scalar> longitudinal,
                          ElementSystem<Scalar> lateral, Unchecked, const CoulombFriction<Scalar>& friction,
                          Integrator integrator = Integrator::sdirk2)
        : systems_{std::move(longitudinal), std::move(lateral)},
          core_(contact, systems_[0].weights(), systems_[0].points(),
                detail::checked_friction("CombinedFrictionModel", friction, systems_[0].element_count(),
                                         systems_[0].size()),
                fingerprint_of(systems_)),
          integrator_(integrator) {
        for (const ElementSystem<Scalar>& system : systems_) {
            detail::require_same_aspect("CombinedFrictionModel", contact, system);
        }
        require_one_mesh();
        detail::require(integrator != Integrator::matrix_exponential, "CombinedFrictionModel", "integrator",
                        name(integrator), "be implicit_euler or sdirk2");
    }

    Eigen::Index size() const { return core_.size(); }                 ///< number of unknown elements
    std::uint64_t fingerprint() const { return core_.fingerprint(); }  ///< of the systems, contact and pressures
    Integrator integrator() const { return integrator_; }

    /// No traction anywhere, everything sticks.
    State at_rest() const { return core_.at_rest(); }
    Workspace workspace() const { return Workspace(size()); }

    /// 2b F_bar of a state [N]. The state must have size() elements.
    TangentialForce<Scalar> force(const State& state) const { return core_.force(state); }

    /// Elastic energy of both bodies per unit width [J/m] and in total [J], as in FrictionModel, summed over both
    /// directions. The state must have size() elements.
    Scalar elastic_energy_per_width(const State& state) const { return core_.elastic_energy(state, systems_); }
    Scalar elastic_energy(const State& state) const { return core_.width() * elastic_energy_per_width(state); }

    /// Steady rolling at a creepage under the load of `from`, as an initial state: as SteadyCombinedModel::solve, with
    /// states of this model.
    Step steady(const State& from, const Creepage<Scalar>& creepage, State& to, Workspace& workspace) const noexcept {
        return settle(from, creepage, {from.normal_pressure, from.half_length}, to, workspace);
    }
    /// The same under another load. If its half-length is not the contact's, both systems must be able to breathe.
    Step steady(const State& from, const Creepage<Scalar>& creepage, const NormalLoad<Scalar>& load, State& to,
                Workspace& workspace) const noexcept {
        const StepStatus possible = load.check(systems_[0].element_count());
        if (possible != StepStatus::ok) return Core::failed(possible);
        return settle(from, creepage, {load.normal_pressure, load.half_length}, to, workspace);
    }

    /// Rolls on by dq [m], positive and finite, or 0 for a rigid shift without rolling, under the load of `from`.
    /// `from` is never written; `to` must be another state of as many elements. It is left unchanged if the status is
    /// invalid_step, wrong_state, invalid_load or needs_fixed_mesh or the motion is not finite, and becomes a copy of
    /// `from` if the result is not finite. The result depends on `from` and the motion alone, to the last bit. No
    /// allocation; a new dq costs a factorisation.
    Step advance(const State& from, Scalar dq, const Motion& motion, State& to, Workspace& workspace) const noexcept {
        const Load load{from.normal_pressure, from.half_length};
        LoadedStep step;
        step.status = check(from, dq, motion, load, to, workspace);
        if (step.status != StepStatus::ok) return step;
        Stages stages;
        roll(stages, from, dq / core_.half_length(), motion, load, {}, to, Core::memory(workspace), step);
        return step;
    }

    /// The same under a load that changes linearly from that of `from` to this one at the end of the step, as in
    /// FrictionModel::advance.
    LoadedStep advance(const State& from, Scalar dq, const Motion& motion, const NormalLoad<Scalar>& load, State& to,
                       Workspace& workspace) const noexcept {
        const Load end{load.normal_pressure, load.half_length};
        LoadedStep step;
        step.status = load.check(systems_[0].element_count());
        if (step.status == StepStatus::ok) step.status = check(from, dq, motion, end, to, workspace);
        if (step.status != StepStatus::ok) return step;
        const bool breathes = systems_[0].log_strength() && systems_[1].log_strength() && dq > 0;
        const Asked asked{load.pressure_rate.size() > 0, breathes};
        Memory& memory = Core::memory(workspace);
        if (asked.by_load) core_.set_bound_rate(load.pressure_rate, memory);
        Stages stages;
        roll(stages, from, dq / core_.half_length(), motion, end, asked, to, memory, step);
        return step;
    }

    /// A rigid shift [m] of body 1 on body 2, positive like creepage, without rolling.
    Step shift(const State& from, const Creepage<Scalar>& shift, State& to, Workspace& workspace) const noexcept {
        return advance(from, 0, Motion::shift(shift), to, workspace);
    }

private:
    using Core = detail::CombinedCore<Scalar>;
    using Load = typename Core::Load;
    using Memory = detail::CombinedMemory<Scalar>;
    using Parameter = detail::Parameter;
    using Stage = detail::RollingStage<Scalar>;
    using Stages = detail::ConstantCombinedStages<Scalar>;
    template <class, class>
    friend class CombinedFallingModel;

    static constexpr Scalar gamma = detail::sdirk2_part<Scalar>;
    static constexpr Scalar ratio = detail::sdirk2_ratio<Scalar>;

    // Derivatives in addition to those by the creepages.
    struct Asked {
        bool by_load = false, by_half_length = false;
    };

    // A step whose arguments have been checked; dq in a_0.
    template <class AnyStages>
    void roll(AnyStages& stages, const State& from, Scalar dq, const Motion& motion, const Load& load,
              const Asked& asked, State& to, Memory& memory, LoadedStep& step) const noexcept {
        const Scalar unit = core_.half_length(), a = from.half_length / unit, a_end = load.half_length / unit;
        // A stage takes `part` of the step: (s/V) part dq = xi part dq + M p - U.
        const bool two_stages = integrator_ == Integrator::sdirk2 && dq > 0;
        const Scalar part = two_stages ? gamma : Scalar(1);
        const Scalar travel = motion.is_shift() ? part / unit : part * dq;
        typename Core::Course course;
        core_.begin(from, memory);
        remember(a, 1, memory);
        if (two_stages) {
            const Stage stage = Stage::within(part, dq, a, a_end);
            enter(stage, memory);
            stages.enter({part, part}, stage);
            memory.pressure = from.normal_pressure + part * (load.pressure.head(size()) - from.normal_pressure);
            core_.solve(stages, between(motion, gamma, travel), from.zones, ratio, memory, course);
            for (std::size_t d = 0; d < 2 && !AnyStages::bounds_are_given; ++d) {
                memory.jump_work[d].keep_first(memory.start.col(static_cast<Eigen::Index>(d)));
            }
            if (course.tangent_exists) carry(stages, motion.is_linear() ? gamma * travel : travel, asked, memory);
            remember(memory.stage.half_length, ratio, memory);
        }
        const Stage stage = Stage::last(part, dq, a, a_end);
        enter(stage, memory);
        stages.enter({part, 1}, stage);
        memory.pressure = load.pressure.head(size());
        core_.solve(stages, between(motion, 1, travel), two_stages ? memory.solver.zones() : from.zones, 1, memory,
                    course);
        core_.finish(from, course, load, unit, to, memory, step);
        core_.template add_jump_work<AnyStages>(from, systems_, two_stages, dq > 0, load, memory, step);
        if (step.status == StepStatus::not_finite || !course.tangent_exists) return;
        core_.add_tangent(stages, travel, two_stages, load.half_length, memory, step);
        if (asked.by_load) core_.add_load_tangent(stages, two_stages, load.half_length, memory, step);
        if (asked.by_half_length) {
            core_.add_half_length_tangent(stages, systems_, part, two_stages, load.half_length, memory, step);
        }
    }

    // Moves the displacement that a stage starts from towards that of memory.start at a half-length, by `factor`.
    void remember(Scalar half_length, Scalar factor, Memory& memory) const noexcept {
        for (std::size_t d = 0; d < 2; ++d) {
            const auto column = static_cast<Eigen::Index>(d);
            memory.column = memory.start.col(column);
            detail::find_displacement(systems_[d], half_length, memory.column, memory.product);
            memory.displacement.col(column) += factor * (memory.product - memory.displacement.col(column));
        }
    }

    // What the first of two stages passes on to the second; d(part dq xi)/d creepage = `imposed`.
    template <class AnyStages>
    void carry(AnyStages& stages, Scalar imposed, const Asked& asked, Memory& memory) const noexcept {
        for (const Parameter direction : {Parameter::longitudinal, Parameter::lateral}) {
            detail::CombinedTangent tangent(stages, memory, direction, false);
            tangent.by_creepage(imposed);
            tangent.carry(systems_, ratio, gamma);
        }
        if (asked.by_load) {
            detail::CombinedTangent tangent(stages, memory, Parameter::load, false);
            tangent.by_load(gamma);
            tangent.carry(systems_, ratio, gamma);
        }
        if (asked.by_half_length) {
            detail::CombinedTangent tangent(stages, memory, Parameter::half_length, false);
            tangent.by_half_length(systems_, {gamma, gamma});
            tangent.carry(systems_, ratio, gamma);
        }
    }

    // The motion imposed on a stage that takes `travel` of it, at the creepage after `progress` of the step.
    static Creepage<Scalar> between(const Motion& motion, Scalar progress, Scalar travel) {
        const Creepage<Scalar> start = motion.start(), end = motion.end();
        return {travel * (start.longitudinal + progress * (end.longitudinal - start.longitudinal)),
                travel * (start.lateral + progress * (end.lateral - start.lateral))};
    }

    // The matrices of a stage, unless the memory has them already.
    void enter(const Stage& stage, Memory& memory) const noexcept {
        if (!core_.claim(stage, memory)) return;
        for (std::size_t d = 0; d < 2; ++d) {
            detail::fill_stage_matrix(systems_[d], stage, memory.solver.new_matrix(d));
        }
    }

    Step settle(const State& from, const Creepage<Scalar>& creepage, const Load& load, State& to,
                Workspace& workspace) const noexcept {
        const StepStatus possible = check_steady(from, load, to, workspace);
        if (possible != StepStatus::ok) return Core::failed(possible);
        Stages stages;
        return core_.solve_steady(stages, from, creepage, systems_[0].G_prime(), systems_[1].G_prime(), load, to,
                                  workspace);
    }

    // Whether a steady solution can be sought at all.
    StepStatus check_steady(const State& from, const Load& load, const State& to,
                            const Workspace& workspace) const noexcept {
        const StepStatus possible = core_.check(from, to, workspace);
        return possible == StepStatus::ok ? check_growth(0, load.half_length, load.half_length) : possible;
    }

    // Whether a step can be made at all.
    StepStatus check(const State& from, Scalar dq, const Motion& motion, const Load& load, const State& to,
                     const Workspace& workspace) const noexcept {
        StepStatus status = core_.check(from, to, workspace);
        if (status == StepStatus::wrong_state) return status;
        const StepStatus moves = motion.check(dq / core_.half_length());
        if (moves != StepStatus::ok) return moves;
        if (status != StepStatus::ok) return status;
        return check_growth(dq, from.half_length, load.half_length);
    }
    StepStatus check_growth(Scalar dq, Scalar from, Scalar to) const noexcept {
        const Scalar unit = core_.half_length();
        const StepStatus status = detail::check_growth(systems_[0], dq / unit, from / unit, to / unit);
        return status != StepStatus::ok ? status : detail::check_growth(systems_[1], dq / unit, from / unit, to / unit);
    }

    void require_one_mesh() const {
        const ElementSystem<Scalar>&one = systems_[0], &two = systems_[1];
        constexpr const char* who = "CombinedFrictionModel";
        detail::require(two.size() == one.size(), who, "number of unknowns of the lateral system", two.size(),
                        "equal that of the longitudinal one");
        detail::require(two.element_count() == one.element_count(), who, "number of elements of the lateral system",
                        two.element_count(), "equal that of the longitudinal one");
        for (Eigen::Index i = 0; i < one.size(); ++i) {
            const Scalar ratio_of_widths = two.weights()[i] / one.weights()[i];
            detail::require(std::abs(ratio_of_widths - 1) <= 8 * std::numeric_limits<Scalar>::epsilon(), who,
                            "width of a lateral element over that of the longitudinal one", ratio_of_widths, "be 1");
        }
    }

    static std::uint64_t fingerprint_of(const detail::SystemPair<Scalar>& systems) {
        detail::Fingerprint fingerprint;
        for (const ElementSystem<Scalar>& system : systems) {
            fingerprint.add(system.G());
            fingerprint.add(system.G_prime());
            fingerprint.add(system.weights());
        }
        return fingerprint.value();
    }

    detail::SystemPair<Scalar> systems_;
    Core core_;
    Integrator integrator_;
};

}  // namespace rollbem
