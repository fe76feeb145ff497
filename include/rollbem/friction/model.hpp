// Rolling with friction, steady or step by step under a load that may vary, and rigid shifts without rolling, in one
// direction of creepage or two. The slip s is s/V = xi - G' p + G dp/dq, Eq. (1), with q = V t the distance rolled.
#pragma once

#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>

#include <Eigen/Core>

#include "../detail/require.hpp"
#include "../normal/load.hpp"
#include "../rolling/integrator.hpp"
#include "../rolling/rolling_step.hpp"
#include "../rolling/stage_equations.hpp"
#include "../scene/contact.hpp"
#include "../scene/rigid_motion.hpp"
#include "../status.hpp"
#include "../system/contact_fit.hpp"
#include "../system/element_blocks.hpp"
#include "../system/stability_verdict.hpp"
#include "../system/time_domain.hpp"
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
/// Steady rolling alone needs only G', which steady_system() makes: the kernel is not integrated for G, no eigenvalue
/// is judged, and the half-width may be infinite. A model of such a system refuses to advance and to shift
/// (Status::invalid_step), and its elastic energy is NaN. A time-domain model with the same contact, G' and pressures
/// accepts its states as starting points. If the scheme does not converge to full adhesion (alpha <= 0, or alpha > 1),
/// forces would be wrong wherever elements stick: the status of every solution is then Status::assists_creepage, with
/// the residual but with NaN for forces, tangents and works, unless the model is made `unchecked`. Collocation at the
/// centres (alpha = 0) is a special case: its tractions assist the creepage in full adhesion, but are correct with
/// friction. The scheme does not represent the energy lost at the singular trailing edge in full adhesion, so that its
/// force in full adhesion is zero. It does represent dissipation by slip: the force converges, with first order, once
/// several elements slip at the trailing edge.
///
///     const FrictionModel model(contact, steady_system(mesh, scheme, kernel), {0.3, pressure});
///     Run run(model);
///     for (double creepage : curve) {
///         const FrictionStep<> point = run.steady({.motion = creepage});  // starts from the one before
///     }
///
/// If mu falls steeply with slip and has no memory, several solutions may exist at one creepage, which differ in where
/// slip begins. The solver usually returns the one nearest to `from`, so that a creep curve whose points start from
/// their predecessors follows its branch until the branch ends. From at_rest(), where mu = mu_s(0) everywhere, it finds
/// the branch of high friction.
///
/// Integrator::sdirk2 solves for stick and slip twice per step and is of second order in dq, for forces and slip work
/// alike; implicit_euler solves once and is of first order. Each of these solutions satisfies the law, and slip never
/// gains energy. Transitions between stick and slip within a step do not reduce the order; a memory of falling friction
/// reduces it to between first and second.
///
/// In time the scheme must meet the requirements of AdhesionModel: a verdict that its eigenvalues decay, and
/// convergence in full adhesion. With any other scheme the tractions are bounded by friction but wrong, unless
/// alpha = 0 and several elements slip at the trailing edge.
///
/// If mu depends on slip, steps have a duration, and v = |slip in a stage| / its duration. With a memory, mu belongs to
/// the particles of the surfaces, which roll through the contact: each element starts from the coefficient of the
/// particle that arrives there. A particle enters with mu_s(0), and its memory is reset where there is no pressure. A
/// step may have several solutions, and the nearest one may vanish; the force then jumps within the step, however short
/// it is. Without memory, or with a short one, such jumps are a property of the equations, not of the steps. The
/// solution found is reached from the coefficients of `from`. Steps must resolve the memory: the slip in a step should
/// be shorter than the memory's distance.
///
///     const ElementSystem system = rolling_system(mesh, scheme, kernel);
///     const FrictionModel model(contact, system, judge_stability(system), {0.3, pressure});
///     FrictionWorkspace<> workspace = model.workspace();
///     FrictionState<> now = model.at_rest(), next = now;
///     const FrictionStep<> step = model.advance(now, {dq, creepage}, next, workspace);  // does not change now
///     if (accepted) std::swap(now, next);
///
/// Both directions:
///
///     const ElementSystem system(rolling_system(mesh, scheme, StripKernel<double>::longitudinal(contact)),
///                                rolling_system(mesh, scheme, StripKernel<double>::lateral(contact)));
///     const FrictionStep<2> step = model.advance(now, {dq, {1e-3, 5e-4}}, next, workspace);
///
/// A patch, whose system has both directions and one verdict for both symmetric halves:
///
///     const PatchContact<double> contact({...});
///     const PatchMesh<double> mesh = patch_mesh(contact, 12, 12);
///     const FrictionModel model(contact, rolling_system(mesh, scheme, kernel),
///                               judge_stability(patch_subsystems(mesh, scheme, kernel)),
///                               {0.3, hertz_pressures(contact, mesh, load)});
///     const FrictionStep<2> step = model.advance(now, {dq, {1e-3, 5e-4, 0.1}}, next, workspace);
///
/// A coefficient that depends on slip:
///
///     const FrictionModel model(contact, system, verdict, Friction{ExponentialFall{0.3, 0.18, 0.1}, pressure});
///     const FrictionStep<> step = model.advance(now, {{dq, duration}, creepage}, next, workspace);
template <class Law_ = ConstantFriction, int directions_ = 1>
class FrictionModel {
public:
    using Law = Law_;
    static constexpr int directions = directions_;
    static_assert(SlipLaw<Law>);

private:
    using Core = detail::FrictionCore<detail::UniformLaw<Law>, directions>;

public:
    using State = FrictionState<directions>;
    using Step = FrictionStep<directions>;
    using Workspace = FrictionWorkspace<directions>;
    using System = ElementSystem<double, directions>;
    using Force = typename Step::Force;  ///< a number, or TangentialForce with two directions
    using Value = typename Core::Value;  ///< a creepage: a number, or Creepage with two directions
    using Motion = RigidMotion<Value>;
    /// The load is a NormalLoad or, if none is given, the load of the state; travel needs a duration if mu depends on
    /// slip.
    using RollingStep = rollbem::RollingStep<Motion, GivenLoad<NormalLoad<double>>>;

    /// `contact` is a line contact (Contact) or a patch (PatchContact, whose half_length() is the system's unit of
    /// length); `verdict` judges `system`, or is `unchecked`. A system without G needs no verdict, no finite half-width
    /// and no known points. Throws std::invalid_argument
    /// - if the verdict does not belong to this system or does not establish that no eigenvalue grows,
    /// - if steady rolling shows that the scheme does not converge (Status::assists_creepage),
    /// - if a line contact's half-width is infinite or differs from the half-width of the system's kernel,
    /// - if the system of a patch is not the system of a PatchMesh, or is made for another a/b,
    /// - if the law does not meet the requirements of Friction (one pressure per element of the mesh),
    /// - if the law has a memory although the points of the system's equations are unknown,
    /// - for Integrator::matrix_exponential, which cannot treat friction.
    template <class AnyContact>
    FrictionModel(const AnyContact& contact, System system, const StabilityVerdict& verdict,
                  const Friction<Law>& friction, Integrator integrator = Integrator::sdirk2)
        : core_(name, contact, std::move(system), detail::with_uniform_law(friction)), integrator_(integrator) {
        const System& own = core_.system();
        if constexpr (std::is_same_v<AnyContact, Contact<double>>) {
            detail::require_same_aspect(name, contact, own);
        } else {
            detail::require(!own.aspect() && own.elements().places_are_known(), name,
                            "number of places of a patch's elements", own.elements().x.size(),
                            "be theirs: a patch has the system of a PatchMesh");
            detail::require_same_shape(name, contact, own);
        }
        detail::require(detail::stage_table<double>(integrator).has_value(), name, "integrator",
                        rollbem::name(integrator), "solve stages, as implicit_euler and sdirk2 do");
        if (!own.has_G()) {
            converges_ = !verdict.checked || detail::converges(slope(), own.elements().areas);
            return;
        }
        detail::require(friction.memory.distance == 0 || own.elements().places_are_known(), name,
                        "distance of the memory", friction.memory.distance,
                        "be 0 for a system that does not know the points of its equations");
        detail::require_usable_in_time(name, own, verdict);
    }
    /// A model of a system without G, for steady rolling alone.
    template <class AnyContact>
    FrictionModel(const AnyContact& contact, System system, const Friction<Law>& friction)
        : FrictionModel(contact, std::move(system), StabilityVerdict{}, friction) {}

    Eigen::Index size() const { return core_.size(); }  ///< number of unknown elements
    /// Fingerprint of G', the areas of the elements, the contact and the pressures; G and the law do not enter. To
    /// continue a state under another load, pass the load to a step; a model with other pressures refuses the state.
    std::uint64_t fingerprint() const { return core_.fingerprint(); }
    Integrator integrator() const { return integrator_; }
    /// Whether the scheme converges to full adhesion. Only a model of a system without G can return false, and none
    /// that is made `unchecked`.
    bool converges() const { return converges_; }

    /// The state at rest under the pressures of the model: no traction, all elements stick, mu = mu_s(0).
    State at_rest() const { return core_.at_rest(); }
    /// The state at rest under a load. Throws std::invalid_argument if the mesh cannot carry the load.
    State at_rest(const NormalLoad<double>& load) const;
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
    double elastic_energy(const State& state) const { return core_.elastic_energy(state); }

    /// Solves for steady rolling with the creepage [-] at the end of the step's motion, which must not be a shift, at
    /// the speed V > 0 [m/s] of its travel, which a constant coefficient does not need. The search starts from the
    /// zones and coefficients of `from`. If the semi-axes of the load differ from the contact's, the system must be
    /// able to breathe. `to` must be another state with the same number of elements; it is not written if the status is
    /// wrong_state, invalid_load, invalid_step or needs_fixed_mesh or the creepage is not finite. The status is
    /// no_solution also if the iteration for coefficients and slip does not converge. Tangents hold at constant speed.
    /// Does not allocate.
    Step steady(const State& from, const RollingStep& step, State& to, Workspace& workspace) const noexcept;

    /// Rolls by travel.dq [m], positive and finite, or 0 for a rigid shift [m] of body 1 on body 2 without rolling, in
    /// travel.duration [s], positive and finite if mu depends on slip. `to` must be another state with the same number
    /// of elements. It is not written if the status is invalid_step, wrong_state, invalid_load, needs_fixed_mesh or
    /// needs_places (spin, but the places of the equations are unknown) or the motion is not finite; if the result is
    /// not finite, it becomes a copy of `from`. The status is wrong_state also if a coefficient of `from` is negative
    /// or not finite, and no_solution also if the iteration for coefficients and slip does not converge. Tangents hold
    /// at constant dq and duration. The result depends on `from` and the step alone, to the last bit. Does not
    /// allocate; a new dq costs a factorisation.
    ///
    /// If the system can breathe (log_strength), the mesh follows the half-length of the load, |da| < dq; a new
    /// half-length costs a factorisation, new pressures do not. Let steps end at kinks of the load, or sdirk2 loses its
    /// second order. With a memory, the tangent by the half-length is one-sided if a particle arrives exactly from a
    /// collocation point.
    Step advance(const State& from, const RollingStep& step, State& to, Workspace& workspace) const noexcept;

private:
    static constexpr const char* name = "FrictionModel";

    const auto& slope() const {
        if constexpr (directions == 1) {
            return core_.system().G_prime();
        } else {
            return core_.system().G_prime_blocks();
        }
    }

    // Whether the load of a step can follow a state: ok, invalid_load or needs_fixed_mesh.
    Status check_load(const State& from, const RollingStep& step) const noexcept {
        if (!step.load) return Status::ok;
        const Status possible = step.load->check(core_.system().element_count());
        return possible == Status::ok ? core_.check_width(from, *step.load) : possible;
    }
    typename Core::Request request(const State& from, const RollingStep& step) const noexcept {
        return {from, step.travel, step.motion, step.load ? core_.load_after(from, *step.load) : Core::load_of(from)};
    }

    Core core_;
    Integrator integrator_;
    bool converges_ = true;
};

template <class Law, int directions>
auto FrictionModel<Law, directions>::at_rest(const NormalLoad<double>& load) const -> State {
    State state = at_rest();
    Status possible = load.check(core_.system().element_count());
    if (possible == Status::ok) possible = core_.check_width(state, load);
    const auto given = core_.load_after(state, load);
    if (possible == Status::ok) {
        possible = detail::check_growth(core_.system(), 0.0, core_.axes(given), core_.axes(given));
    }
    detail::require(possible == Status::ok, name, "status of the load at rest", rollbem::name(possible),
                    "be ok: pressures of all elements, finite and not negative, on semi-axes that the mesh can follow");
    state.normal_pressure = given.pressure.head(size());
    state.half_length = given.half_length;
    state.half_width = given.half_width;
    return state;
}

template <class Law, int directions>
auto FrictionModel<Law, directions>::steady(const State& from, const RollingStep& step, State& to,
                                                    Workspace& workspace) const noexcept -> Step {
    Status possible = check_load(from, step);
    if (possible != Status::ok) return detail::failed<Step>(possible);
    const auto asked = request(from, step);
    possible = core_.check(from, to, workspace);
    const auto axes = core_.axes(asked.load);
    if (possible == Status::ok) possible = detail::check_growth(core_.system(), 0.0, axes, axes);
    if (possible != Status::ok) return detail::failed<Step>(possible);
    const Step solved = core_.steady(asked, to, workspace);
    return converges_ ? solved : Core::without_forces(solved);
}

template <class Law, int directions>
auto FrictionModel<Law, directions>::advance(const State& from, const RollingStep& step, State& to,
                                                     Workspace& workspace) const noexcept -> Step {
    Status possible = check_load(from, step);
    if (possible != Status::ok) return detail::failed<Step>(possible);
    if (!core_.system().has_G()) return detail::failed<Step>(Status::invalid_step);
    const auto asked = request(from, step);
    const double dq = step.travel.dq / core_.half_length();
    possible = detail::check_step(core_.check(from, to, workspace), step.motion, dq, size(), [&] {
        return detail::check_growth(core_.system(), dq, core_.axes(from), core_.axes(asked.load));
    });
    if (possible != Status::ok) return detail::failed<Step>(possible);
    return core_.roll(*detail::stage_table<double>(integrator_), asked, to, workspace);
}

// Friction in braces, whose law cannot be deduced, has a constant coefficient.
template <class AnyContact, int directions, class Law = ConstantFriction>
FrictionModel(const AnyContact&, ElementSystem<double, directions>, const StabilityVerdict&,
              const Friction<Law>&, Integrator = Integrator::sdirk2) -> FrictionModel<Law, directions>;
template <class AnyContact, int directions, class Law = ConstantFriction>
FrictionModel(const AnyContact&, ElementSystem<double, directions>, const Friction<Law>&)
    -> FrictionModel<Law, directions>;

}  // namespace rollbem
