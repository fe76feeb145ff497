// Rolling with friction, steady or step by step under a load that may vary, and rigid shifts without rolling, in one
// direction of creepage or two. s/V = xi - G' p + G dp/dq, Eq. (1), with q = V t the distance rolled.
#pragma once

#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>

#include <Eigen/Core>

#include "../adhesion/integrator.hpp"
#include "../adhesion/stability_verdict.hpp"
#include "../detail/require.hpp"
#include "../normal/load.hpp"
#include "../rolling/stage_equations.hpp"
#include "../scene/contact.hpp"
#include "../scene/rigid_motion.hpp"
#include "../status.hpp"
#include "../system/contact_fit.hpp"
#include "../system/element_blocks.hpp"
#include "detail/core.hpp"
#include "law.hpp"
#include "state.hpp"
#include "workspace.hpp"

namespace rollbem {

/// The contact as a force element with friction, stepped like AdhesionModel. Immutable: threads may share it if they
/// may share the law. One direction costs less than two. A creepage xi > 0 gives a negative force in steady rolling.
/// With two directions, slip and traction are vectors. In full sliding the force opposes the creepage exactly,
/// otherwise only approximately, because the bodies are more compliant across the rolling direction.
///
/// For steady rolling alone a system of G' is enough, steady_system(): no kernel must be integrated for G, no
/// eigenvalue judged, and the half-width may be infinite. Such a model refuses to advance and to shift
/// (StepStatus::invalid_step) and knows no elastic energy (NaN). Its states are those of a model with the same contact,
/// G' and pressures, and so start a time-domain run. If the scheme does not converge to full adhesion (alpha <= 0, or
/// alpha > 1), forces would be wrong wherever elements stick: the status of every solution is then
/// StepStatus::assists_creepage, with the residual but without numbers, unless the model is made `unchecked`.
/// Collocation at the centres (alpha = 0) is a special case: its tractions assist the creepage in full adhesion, but
/// are correct with friction. It dissipates no energy, whereas full adhesion loses energy at the singular trailing
/// edge; the force of full adhesion is therefore zero. Dissipation by slip is represented: the force converges, with
/// first order, once several elements slip at the trailing edge.
///
///     const FrictionModel model(contact, steady_system(mesh, scheme, kernel), {0.3, pressure});
///     Run run(model);
///     for (double creepage : curve) const FrictionStep<> point = run.steady(creepage);  // starts from the one before
///
/// If mu falls steeply with slip and has no memory, several solutions may exist at one creepage, which differ in where
/// slip begins. The solver usually returns the one nearest to `from`, so that a creep curve whose points start from
/// their predecessors follows its branch until the branch ends. From at_rest(), where mu = mu_s(0) everywhere, it finds
/// the branch of high friction.
///
/// Integrator::sdirk2 solves for stick and slip twice per step and is of second order in dq, for forces and slip work
/// alike; implicit_euler solves once and is of first order. Each of these solutions satisfies the law, and slip never
/// gains energy. Transitions between stick and slip within a step do not reduce the order; a memory of falling friction
/// does, to about 1.8 for forces and 1.35 for slip work.
///
/// In time the scheme must meet the requirements of AdhesionModel: a verdict that its eigenvalues decay, and
/// convergence in full adhesion. With any other scheme friction bounds the tractions, but they are wrong, unless alpha
/// = 0 and several elements slip at the trailing edge.
///
/// If mu depends on slip, steps have a duration, and v = |slip in a stage| / its duration. With a memory, mu belongs to
/// the particles of the surfaces, which roll through the contact: each element starts from the coefficient of the
/// particle that arrives there. A particle enters with mu_s(0), and its memory is reset where there is no pressure. A
/// step may have several solutions, and the nearest one may vanish; the force then jumps within the step, however short
/// it is. Without memory, or with a short one, such jumps are a property of the equations, not of the steps. The
/// solution found is one to which the coefficients of `from` lead. Steps must resolve the memory: the slip in a step
/// should be shorter than the memory's distance.
///
///     const ElementSystem system = rolling_system(mesh, scheme, kernel);
///     const FrictionModel model(contact, system, judge_stability(system), {0.3, pressure});
///     FrictionWorkspace<> workspace = model.workspace();
///     FrictionState<> now = model.at_rest(), next = now;
///     const FrictionStep<> step = model.advance(now, dq, creepage, next, workspace);  // does not change now
///     if (accepted) std::swap(now, next);
///
/// in both directions
///
///     const ElementSystem system(rolling_system(mesh, scheme, StripKernel<double>::longitudinal(contact)),
///                                rolling_system(mesh, scheme, StripKernel<double>::lateral(contact)));
///     const FrictionStep<2> step = model.advance(now, dq, Creepage{1e-3, 5e-4}, next, workspace);
///
/// on a patch, whose system has both directions and one verdict for both halves
///
///     const PatchContact<double> contact({...});
///     const PatchMesh<double> mesh = patch_mesh(contact, 12, 12);
///     const FrictionModel model(contact, rolling_system(mesh, scheme, kernel),
///                               judge_stability(patch_parts(mesh, scheme, kernel)),
///                               {0.3, hertz_pressures(contact, mesh, load)});
///     const FrictionStep<2> step = model.advance(now, dq, Creepage{1e-3, 5e-4, 0.1}, next, workspace);
///
/// and with a coefficient that depends on slip
///
///     const FrictionModel model(contact, system, verdict, Friction{ExponentialFall<>{0.3, 0.18, 0.1}, pressure});
///     const FrictionStep<> step = model.advance(now, {dq, duration}, creepage, next, workspace);
template <class Law_ = ConstantFriction<double>, int directions_ = 1, class Scalar_ = double>
class FrictionModel {
public:
    using Law = Law_;
    using Scalar = Scalar_;
    static constexpr int directions = directions_;
    static_assert(SlipLaw<Law, Scalar>);

private:
    using Core = detail::FrictionCore<detail::UniformLaw<Law, Scalar>, directions, Scalar>;

public:
    using State = FrictionState<directions, Scalar>;
    using Step = FrictionStep<directions, Scalar>;
    using Workspace = FrictionWorkspace<directions, Scalar>;
    using System = ElementSystem<Scalar, directions>;
    using Force = typename Step::Force;  ///< a number, or TangentialForce with two directions
    using Value = typename Core::Value;  ///< a creepage: a number, or Creepage with two directions
    using Motion = RigidMotion<Value>;
    /// A plain dq will do if mu is constant.
    using Travel = std::conditional_t<Core::slip_dependent, rollbem::Travel<Scalar>, detail::UntimedTravel<Scalar>>;

    /// A line contact, or a patch (PatchContact, in whose half_length() the system measures lengths); the verdict
    /// is that on the system, or `unchecked`. Throws std::invalid_argument if the verdict does not belong to this
    /// system or does not establish that no eigenvalue grows, if steady rolling shows that the scheme does not converge
    /// (Status::assists_creepage), if the contact's half-width is infinite or not that of the system's kernel, if the
    /// law does not meet the requirements of Friction (one pressure per element of the mesh) or has a memory although
    /// the points of the system's equations are unknown, and for Integrator::matrix_exponential, which cannot treat
    /// friction. A system without G needs no verdict, finite half-width or points.
    template <class AnyContact>
    FrictionModel(const AnyContact& contact, System system, const StabilityVerdict& verdict,
                  const Friction<Law, Scalar>& friction, Integrator integrator = Integrator::sdirk2)
        : system_(std::move(system)),
          core_(name, contact, system_.elements(), system_.element_count(), detail::with_uniform_law(friction),
                detail::gradient(system_), system_.has_G() ? std::optional(system_.fingerprint()) : std::nullopt),
          integrator_(integrator) {
        if constexpr (std::is_same_v<AnyContact, Contact<Scalar>>) {
            detail::require_same_aspect(name, contact, system_);
        } else {
            detail::require(!system_.aspect() && system_.elements().places_are_known(), name,
                            "number of places of a patch's elements", system_.elements().x.size(),
                            "be theirs: a patch has the system of a PatchMesh");
            detail::require_same_shape(name, contact, system_);
        }
        detail::require(detail::stage_table<Scalar>(integrator).has_value(), name, "integrator",
                        rollbem::name(integrator), "solve stages, as implicit_euler and sdirk2 do");
        if (!system_.has_G()) {
            converges_ = !verdict.checked || detail::converges(detail::gradient(system_), system_.elements().areas);
            return;
        }
        detail::require(friction.memory.distance == 0 || system_.elements().places_are_known(), name,
                        "distance of the memory", friction.memory.distance,
                        "be 0 for a system that does not know the points of its equations");
        detail::require_usable_in_time(name, system_, verdict);
    }
    /// Of a system without G.
    template <class AnyContact>
    FrictionModel(const AnyContact& contact, System system, const Friction<Law, Scalar>& friction)
        : FrictionModel(contact, std::move(system), StabilityVerdict{}, friction) {}

    Eigen::Index size() const { return core_.size(); }  ///< number of unknown elements
    /// Of G', the elements, the contact and the pressures, but not of G and the law. To continue a state under another
    /// load, pass the load to a step; a model with other pressures refuses the state.
    std::uint64_t fingerprint() const { return core_.fingerprint(); }
    Integrator integrator() const { return integrator_; }
    /// Whether the scheme converges to full adhesion: false only of a system without G, never if `unchecked`.
    bool converges() const { return converges_; }

    /// No traction, all elements stick, mu = mu_s(0).
    State at_rest() const { return core_.at_rest(); }
    Workspace workspace() const { return core_.workspace(); }

    /// The force of a state [N]. The state must have size() elements.
    Force force(const State& state) const { return core_.force(state); }

    /// Elastic energy of the tangential tractions in both bodies, E = 1/2 int p u dA [J], summed over the
    /// directions. Positive, except for tractions that alternate from element to element; of
    /// second order in 1/n on cosine meshes at alpha = 0.5. The state must have size() elements; NaN if the system
    /// cannot represent its half-length.
    ///
    /// The work that the rigid bodies do on the contact, -F times the rigid slip (creepage times the distance rolled),
    /// becomes heat or elastic energy, even while the load or the length of the contact varies: heat = -F slip - dE,
    /// for any scheme. The sum of FrictionStep::slip_work agrees with it to the orders of both in n and dq.
    Scalar elastic_energy(const State& state) const { return core_.elastic_energy(state, system_); }

    /// Steady rolling at a creepage [-] and a speed V > 0 [m/s], which a constant coefficient does not need, under the
    /// load of `from`, sought from its zones and coefficients. `to` must be another state with the same number of
    /// elements; it is not written if the status is wrong_state, invalid_load, invalid_step or needs_fixed_mesh or the
    /// creepage is not finite. The status is no_solution also if coefficients and slip do not come to agree. Tangents
    /// are at constant speed. Does not allocate.
    Step steady(const State& from, const Value& creepage, Scalar speed, State& to,
                Workspace& workspace) const noexcept {
        return settle(from, creepage, speed, Core::load_of(from), to, workspace);
    }
    /// At the end of a motion that is no shift: with a rigid slip of each element besides (RigidMotion::with_rows).
    Step steady(const State& from, const Motion& motion, Scalar speed, State& to, Workspace& workspace) const noexcept {
        return settle(from, motion, speed, Core::load_of(from), to, workspace);
    }
    Step steady(const State& from, const Value& creepage, State& to, Workspace& workspace) const noexcept
        requires(!Core::slip_dependent) {
        return steady(from, creepage, 1, to, workspace);
    }
    /// Steady rolling under another load. If its semi-axes are not the contact's, the system must be able to breathe.
    Step steady(const State& from, const Value& creepage, Scalar speed, const NormalLoad<Scalar>& load, State& to,
                Workspace& workspace) const noexcept {
        return steady(from, Motion(creepage), speed, load, to, workspace);
    }
    Step steady(const State& from, const Motion& motion, Scalar speed, const NormalLoad<Scalar>& load, State& to,
                Workspace& workspace) const noexcept {
        const StepStatus possible = check(from, load);
        if (possible != StepStatus::ok) return Core::failed(possible);
        return settle(from, motion, speed, core_.load_after(from, load), to, workspace);
    }
    Step steady(const State& from, const Value& creepage, const NormalLoad<Scalar>& load, State& to,
                Workspace& workspace) const noexcept requires(!Core::slip_dependent) {
        return steady(from, creepage, 1, load, to, workspace);
    }

    /// Rolls by travel.dq [m], positive and finite, or 0 for a rigid shift without rolling, in travel.duration [s],
    /// positive and finite if mu depends on slip, under the load of `from`. `to` must be another state with the same
    /// number of elements. It is not written if the status is invalid_step, wrong_state, invalid_load,
    /// needs_fixed_mesh or needs_places (spin, but the places of the equations are unknown) or the motion is not
    /// finite; if the result is not finite, it becomes a copy of `from`. The status is wrong_state also if a
    /// coefficient of `from` is negative or not finite, and no_solution also if coefficients and slip do not come to
    /// agree. Tangents are at constant dq and duration. The result depends on `from`, the travel and the motion alone,
    /// to the last bit. Does not allocate; a new dq costs a factorisation.
    Step advance(const State& from, const Travel& travel, const Motion& motion, State& to,
                 Workspace& workspace) const noexcept {
        return roll(from, travel, motion, Core::load_of(from), to, workspace);
    }

    /// The same under a load that varies linearly from that of `from` to this one at the end of the step. If the system
    /// can breathe (log_strength), the mesh follows the half-length, |da| < dq; a new half-length costs a
    /// factorisation, new pressures do not. Let steps end at kinks of the load, or sdirk2 loses its second order.
    /// With a memory, the tangent by the half-length is one-sided if a particle arrives exactly from a collocation
    /// point.
    Step advance(const State& from, const Travel& travel, const Motion& motion, const NormalLoad<Scalar>& load,
                 State& to, Workspace& workspace) const noexcept {
        const StepStatus possible = check(from, load);
        if (possible != StepStatus::ok) return Core::failed(possible);
        return roll(from, travel, motion, core_.load_after(from, load), to, workspace);
    }

    /// Either of these at a constant creepage, which may stand in braces.
    template <class... Rest>
    Step advance(const State& from, const Travel& travel, const Value& creepage, Rest&&... rest) const noexcept {
        return advance(from, travel, Motion(creepage), std::forward<Rest>(rest)...);
    }

    /// A rigid shift [m] of body 1 on body 2, positive like creepage, without rolling, in `duration` [s], which a
    /// constant coefficient does not need.
    Step shift(const State& from, const Value& shift, Scalar duration, State& to, Workspace& workspace) const noexcept {
        return advance(from, rollbem::Travel<Scalar>{0, duration}, Motion::shift(shift), to, workspace);
    }
    Step shift(const State& from, const Value& shift, State& to, Workspace& workspace) const noexcept
        requires(!Core::slip_dependent) {
        return this->shift(from, shift, 1, to, workspace);
    }

private:
    using Load = typename Core::Load;

    static constexpr const char* name = "FrictionModel";

    StepStatus check(const State& from, const NormalLoad<Scalar>& load) const noexcept {
        const StepStatus possible = load.check(system_.element_count());
        return possible == StepStatus::ok ? core_.check_width(from, load) : possible;
    }

    Step settle(const State& from, const Motion& motion, Scalar speed, const Load& load, State& to,
                Workspace& workspace) const noexcept {
        StepStatus possible = core_.check(from, to, workspace);
        const auto axes = core_.axes(load);
        if (possible == StepStatus::ok) possible = detail::check_growth(system_, Scalar(0), axes, axes);
        if (possible != StepStatus::ok) return Core::failed(possible);
        const System* const shapes = detail::changes_shape(system_) ? &system_ : nullptr;
        const Step step =
            core_.solve_steady(detail::gradient(system_), shapes, from, motion, speed, load, to, workspace);
        return converges_ ? step : Core::without_forces(step);
    }

    Step roll(const State& from, const rollbem::Travel<Scalar>& travel, const Motion& motion, const Load& load,
              State& to, Workspace& workspace) const noexcept {
        if (!system_.has_G()) return Core::failed(StepStatus::invalid_step);
        const Scalar unit = core_.half_length();
        const StepStatus belongs = core_.check(from, to, workspace);
        if (belongs == StepStatus::wrong_state) return Core::failed(belongs);
        StepStatus possible = motion.check(travel.dq / unit, size());
        if (possible == StepStatus::ok) possible = belongs;
        if (possible == StepStatus::ok) {
            possible = detail::check_growth(system_, travel.dq / unit, core_.axes(from), core_.axes(load));
        }
        if (possible != StepStatus::ok) return Core::failed(possible);
        const auto table = *detail::stage_table<Scalar>(integrator_);
        return core_.roll(system_, table, from, travel, motion, load, to, workspace);
    }

    System system_;
    Core core_;
    Integrator integrator_;
    bool converges_ = true;
};

// A law in braces, which is not deduced, has a constant coefficient.
template <class AnyContact, class Scalar, int directions, class Law = ConstantFriction<Scalar>>
FrictionModel(const AnyContact&, ElementSystem<Scalar, directions>, const StabilityVerdict&,
              const Friction<Law, Scalar>&, Integrator = Integrator::sdirk2) -> FrictionModel<Law, directions, Scalar>;
template <class AnyContact, class Scalar, int directions, class Law = ConstantFriction<Scalar>>
FrictionModel(const AnyContact&, ElementSystem<Scalar, directions>, const Friction<Law, Scalar>&)
    -> FrictionModel<Law, directions, Scalar>;

}  // namespace rollbem
