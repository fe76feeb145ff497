// Rolling with friction, steady or step by step under a load that may vary, and rigid shifts without rolling, in one
// direction of creepage or two. The slip s is s/V = xi - G' p + G dp/dq, Eq. (1), with q = V t the distance rolled.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

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
#include "detail/rolling_friction.hpp"
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

    using State = FrictionState<directions>;
    using Step = FrictionStep<directions>;
    using Workspace = FrictionWorkspace<directions>;
    using System = ElementSystem<double, directions>;
    using Force = typename Step::Force;                       ///< a number, or TangentialForce with two directions
    using Value = detail::CreepageAlong<directions, double>;  ///< a creepage: a number, or Creepage with two directions
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
        : contact_(name, contact, std::move(system), detail::AnyFriction(friction)), integrator_(integrator) {
        const System& own = contact_.system;
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

    Eigen::Index size() const { return contact_.size(); }  ///< number of unknown elements
    /// Fingerprint of G', the areas of the elements, the contact and the pressures; G and the law do not enter. To
    /// continue a state under another load, pass the load to a step; a model with other pressures refuses the state.
    std::uint64_t fingerprint() const { return contact_.fingerprint; }
    Integrator integrator() const { return integrator_; }
    /// Whether the scheme converges to full adhesion. Only a model of a system without G can return false, and none
    /// that is made `unchecked`.
    bool converges() const { return converges_; }

    /// The state at rest under the pressures of the model: no traction, all elements stick, mu = mu_s(0).
    State at_rest() const;
    /// The state at rest under a load. Throws std::invalid_argument if the mesh cannot carry the load.
    State at_rest(const NormalLoad<double>& load) const;
    Workspace workspace() const { return Workspace(size(), contact_.varies(), detail::is_coupled(contact_.system)); }

    /// The force of a state [N]. The state must have size() elements.
    Force force(const State& state) const {
        const auto forces = contact_.forces.of(state.traction, axes(state));
        return 1 / contact_.units.shear_modulus * detail::force_along<directions, double>(forces);
    }

    /// Elastic energy of the tangential tractions in both bodies, E = 1/2 int p u dA [J], summed over the
    /// directions. Positive, except for tractions that alternate from element to element; of
    /// second order in 1/n on cosine meshes at alpha = 0.5. The state must have size() elements; NaN if the system
    /// cannot represent its half-length.
    ///
    /// The work that the rigid bodies do on the contact, -F times the rigid slip (creepage times the distance rolled),
    /// becomes heat or elastic energy, even while the load or the length of the contact varies: heat = -F slip - dE,
    /// for any scheme. The sum of FrictionStep::slip_work agrees with it to the orders of both in n and dq.
    double elastic_energy(const State& state) const;

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
            return contact_.system.G_prime();
        } else {
            return contact_.system.G_prime_blocks();
        }
    }
    template <class Loaded>
    SemiAxes<double> axes(const Loaded& loaded) const {
        return contact_.units.axes(loaded);
    }
    static bool are_coefficients(const ArrayX<double>& values) {
        return values.size() == 0 || (detail::all_finite(values) && !(values.minCoeff() < 0));
    }

    // Whether the load of a step can follow a state: ok; invalid_load, also if a patch changes its half-length without
    // a new half-width; needs_fixed_mesh if a line contact changes its half-width.
    Status check_load(const State& from, const NormalLoad<double>& load) const noexcept;
    // The load at the end of a step. A half-width of 0 is replaced by the half-width of `from`.
    detail::LoadAtEnd load_after(const State& from, const NormalLoad<double>* load) const noexcept {
        if (load == nullptr) return {from.normal_pressure, from.half_length, from.half_width};
        const double b = load->half_width == 0 ? from.half_width : load->half_width;
        return {load->normal_pressure, load->half_length, b, &load->pressure_rate};
    }
    detail::LoadAtEnd load_after(const State& from, const RollingStep& step) const noexcept {
        return load_after(from, step.load ? &*step.load : nullptr);
    }
    // Whether states and workspace belong to the model, and whether the load in a state is valid.
    Status check(const State& from, const State& to, const Workspace& workspace) const noexcept;
    // Whether the rigid slip of a creepage is known.
    bool can_impose([[maybe_unused]] const Value& creepage) const noexcept {
        if constexpr (directions == 2) return creepage.spin == 0 || contact_.system.elements().places_are_known();
        return true;
    }
    // The result of a scheme that does not converge: residual and counts, but NaN for forces, tangents and works.
    static Step without_forces(const Step& solved) noexcept {
        if (solved.status != Status::ok && solved.status != Status::no_solution) return solved;
        Step step = detail::failed<Step>(Status::assists_creepage);
        step.complementarity_residual = solved.complementarity_residual;
        step.stick_count = solved.stick_count;
        step.rounds = solved.rounds;
        step.path_points = solved.path_points;
        return step;
    }

    detail::ContactData<directions> contact_;
    Integrator integrator_;
    bool converges_ = true;
};

template <class Law, int directions>
auto FrictionModel<Law, directions>::at_rest() const -> State {
    State state{.traction = ElementVectors<directions>::Zero(size(), directions),
                .zones = std::vector<Zone>(static_cast<std::size_t>(size()), Zone::stick),
                .normal_pressure = contact_.normal_pressure,
                .half_length = contact_.units.length,
                .half_width = contact_.units.half_width,
                .system = contact_.fingerprint,
                .friction_coefficient = {},
                .solver = {},
                .plain_traction = {}};
    if (contact_.varies()) {
        state.friction_coefficient.setConstant(size(), contact_.law.at_rest());
        state.solver.stage_coefficient = state.friction_coefficient;
    }
    if (contact_.rotates) state.plain_traction = state.traction;
    return state;
}

template <class Law, int directions>
auto FrictionModel<Law, directions>::at_rest(const NormalLoad<double>& load) const -> State {
    State state = at_rest();
    Status possible = check_load(state, load);
    const detail::LoadAtEnd given = load_after(state, &load);
    if (possible == Status::ok) possible = detail::check_growth(contact_.system, 0.0, axes(given), axes(given));
    detail::require(possible == Status::ok, name, "status of the load at rest", rollbem::name(possible),
                    "be ok: pressures of all elements, finite and not negative, on semi-axes that the mesh can follow");
    state.normal_pressure = given.pressure.head(size());
    state.half_length = given.half_length;
    state.half_width = given.half_width;
    return state;
}

template <class Law, int directions>
double FrictionModel<Law, directions>::elastic_energy(const State& state) const {
    const SemiAxes<double> present = axes(state);
    const System& system = contact_.system;
    if (!system.has_G() || detail::check_growth(system, 0.0, present, present) != Status::ok) {
        return detail::unknown<double>;
    }
    const ElementVectors<directions> traction = state.traction / contact_.units.shear_modulus;
    ElementVectors<directions> displacement = traction;
    detail::find_displacements(system, present, traction, displacement);
    return contact_.energy_unit(present) * contact_.work.product(traction, displacement) / 2;
}

template <class Law, int directions>
Status FrictionModel<Law, directions>::check_load(const State& from, const NormalLoad<double>& load) const noexcept {
    const Status possible = load.check(contact_.system.element_count());
    if (possible != Status::ok) return possible;
    const auto& units = contact_.units;
    if (load.half_width == 0) {
        return units.line || load.half_length == from.half_length ? Status::ok : Status::invalid_load;
    }
    return units.line && load.half_width != units.half_width ? Status::needs_fixed_mesh : Status::ok;
}

template <class Law, int directions>
Status FrictionModel<Law, directions>::check(const State& from, const State& to,
                                             const Workspace& workspace) const noexcept {
    const Eigen::Index n = size();
    const bool varies = contact_.varies();
    const auto sized = [&](const State& state) {
        return state.traction.rows() == n && (state.plain_traction.size() == 0 || state.plain_traction.rows() == n) &&
               state.zones.size() == static_cast<std::size_t>(n) && state.normal_pressure.size() == n &&
               state.friction_coefficient.size() == (varies ? n : 0);
    };
    const bool belongs = &from != &to && from.system == contact_.fingerprint && sized(from) && sized(to) &&
                         workspace.fits(n, varies, detail::is_coupled(contact_.system));
    const Eigen::Index kept = from.solver.stage_coefficient.size();
    if (!belongs || (kept != 0 && kept != from.friction_coefficient.size()) ||
        !are_coefficients(from.friction_coefficient) || !are_coefficients(from.solver.stage_coefficient)) {
        return Status::wrong_state;
    }
    const bool valid = detail::is_finite(from.half_length) && from.half_length > 0 &&
                       (contact_.units.line || (detail::is_finite(from.half_width) && from.half_width > 0)) &&
                       detail::all_pressures(from.normal_pressure);
    return valid ? Status::ok : Status::invalid_load;
}

template <class Law, int directions>
auto FrictionModel<Law, directions>::steady(const State& from, const RollingStep& step, State& to,
                                            Workspace& workspace) const noexcept -> Step {
    Status possible = step.load ? check_load(from, *step.load) : Status::ok;
    if (possible != Status::ok) return detail::failed<Step>(possible);
    const detail::LoadAtEnd load = load_after(from, step);
    const SemiAxes<double> at = axes(load);
    possible = check(from, to, workspace);
    if (possible == Status::ok) possible = detail::check_growth(contact_.system, 0.0, at, at);
    if (possible == Status::ok)
        possible = step.motion.is_shift() ? Status::invalid_step : step.motion.check_rows(size());
    if (possible == Status::ok && !can_impose(step.motion.end())) possible = Status::needs_places;
    const double speed = step.travel.speed();
    if (possible == Status::ok && contact_.varies() && !(detail::is_finite(speed) && speed > 0))
        possible = Status::invalid_step;
    if (possible != Status::ok) return detail::failed<Step>(possible);
    detail::TimeStep<directions, double> rolled{step.motion, contact_.units.length, at, at};
    rolled.steady = true;
    rolled.speed = speed;
    const Step solved = detail::solve<directions>({contact_, rolled, from, load, workspace.scratch()}, to);
    return converges_ ? solved : without_forces(solved);
}

template <class Law, int directions>
auto FrictionModel<Law, directions>::advance(const State& from, const RollingStep& step, State& to,
                                             Workspace& workspace) const noexcept -> Step {
    Status possible = step.load ? check_load(from, *step.load) : Status::ok;
    if (possible == Status::ok && !contact_.system.has_G()) possible = Status::invalid_step;
    if (possible != Status::ok) return detail::failed<Step>(possible);
    const detail::LoadAtEnd load = load_after(from, step);
    const double dq = step.travel.dq / contact_.units.length;
    possible = detail::check_step(check(from, to, workspace), step.motion, dq, size(),
                                  [&] { return detail::check_growth(contact_.system, dq, axes(from), axes(load)); });
    const double duration = step.travel.duration;
    if (possible == Status::ok && contact_.varies() && !(detail::is_finite(duration) && duration > 0))
        possible = Status::invalid_step;
    const bool can_roll = can_impose(step.motion.start()) && can_impose(step.motion.end());
    if (possible == Status::ok && !can_roll) possible = Status::needs_places;
    if (possible != Status::ok) return detail::failed<Step>(possible);
    detail::TimeStep<directions, double> rolled{
        step.motion, contact_.units.length, axes(from), axes(load), dq, *detail::stage_table<double>(integrator_)};
    rolled.duration = duration;
    return detail::solve<directions>({contact_, rolled, from, load, workspace.scratch()}, to);
}

// Friction in braces, whose law cannot be deduced, has a constant coefficient.
template <class AnyContact, int directions, class Law = ConstantFriction>
FrictionModel(const AnyContact&, ElementSystem<double, directions>, const StabilityVerdict&, const Friction<Law>&,
              Integrator = Integrator::sdirk2) -> FrictionModel<Law, directions>;
template <class AnyContact, int directions, class Law = ConstantFriction>
FrictionModel(const AnyContact&, ElementSystem<double, directions>, const Friction<Law>&)
    -> FrictionModel<Law, directions>;

}  // namespace rollbem
