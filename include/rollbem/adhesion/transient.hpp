// Non-steady rolling in full adhesion step by step: G dp/dq = G' p - inputs v(q), q = V t the distance rolled,
// Eqs. (11) and (12). A force element for an external time loop: const model, plain state, no exception and no
// allocation in a step.
#pragma once

#include "../detail/language.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../assembly/detail/contact_units.hpp"
#include "../assembly/element_blocks.hpp"
#include "../assembly/rolling_system.hpp"
#include "../detail/finite.hpp"
#include "../detail/in_place_lu.hpp"
#include "../detail/require.hpp"
#include "../scene/contact.hpp"
#include "../scene/rigid_motion.hpp"
#include "../scene/travel.hpp"
#include "../status.hpp"
#include "detail/rational_exponential.hpp"
#include "detail/rolling_stage.hpp"
#include "integrator.hpp"
#include "stability_verdict.hpp"
#include "state.hpp"
#include "workspace.hpp"

namespace rollbem {

/// The contact as a force element without slip, stepped like FrictionModel: with one creepage, or with longitudinal and
/// lateral creepage and spin, whose forces are F_x, F_y and the moment M_z. Immutable: threads may share it. Its
/// interface is in SI units.
///
/// A step of the same distance as the one before costs one product of an n x n matrix and a vector; the first one
/// that repeats a distance also computes that matrix, O(n^3). A step of any other distance factorises a matrix of its
/// own and costs a few times less than that. Integrator::matrix_exponential always computes the matrix. Results depend
/// on state and arguments alone, to the last bit, and never on what the workspace was used for.
///
/// The half-length of a line contact may change from step to step if can_breathe(): the unknowns then live on
/// x = a zeta, and the state at one half-length is carried over to the next. b is constant. No status reports that a
/// contact has grown so far that Lambda of the plane kernel, with b over the new half-length, is no longer positive and
/// a mode grows in time: a is then several times b.
///
/// Invariant: the half-width is finite, and the scheme is stable according to the verdict.
///
///     const auto system = rolling_system(mesh, scheme, kernel);
///     const AdhesionModel model(contact, system, judge_stability(system));
///     AdhesionWorkspace<> workspace = model.workspace();
///     AdhesionState<> now = model.at_rest(), next = now;
///     const AdhesionStep<> step = model.advance(now, dq, creepage, next, workspace);  // now stays as it is
///     if (accepted) std::swap(now, next);
///
/// with both creepages and spin, on a line or on a patch
///
///     const ElementSystem system(longitudinal, lateral);
///     const AdhesionModel model(contact, system, judge_stability(system.whole()));
///     const AdhesionStep<3> step = model.advance(now, dq, Creepage{1e-3, 5e-4, 0.1}, next, workspace);
template <int inputs_ = 1, class Scalar_ = double>
class AdhesionModel {
public:
    using Scalar = Scalar_;
    static constexpr int inputs = inputs_;
    using State = AdhesionState<Scalar>;
    using Step = AdhesionStep<inputs, Scalar>;
    using Workspace = AdhesionWorkspace<inputs, Scalar>;
    using Force = typename Step::Force;          ///< a number, or TangentialForce
    using Value = typename Step::Values::Value;  ///< a creepage: a number, or Creepage
    using Motion = RigidMotion<Value>;
    using Travel = detail::UntimedTravel<Scalar>;  ///< a plain dq will do

    /// With one input, creepage in the direction of the kernel with which the system was made; with three, those of
    /// Creepage, as both_directions() makes them. Throws std::invalid_argument if the verdict does not belong to this
    /// system or does not establish that no eigenvalue grows, if steady rolling shows that the scheme does not converge
    /// (Status::inconsistent), or if the contact's half-width is infinite or not that of the system's kernel.
    AdhesionModel(const Contact<Scalar>& contact, RollingSystem<Scalar> system, const StabilityVerdict& verdict,
                  Integrator integrator = Integrator::sdirk2)
        : AdhesionModel(contact, std::move(system), unchecked, integrator) {
        detail::require_usable_in_time(name, system_, verdict);
    }
    /// The same without checks of the eigenvalues and of convergence.
    AdhesionModel(const Contact<Scalar>& contact, RollingSystem<Scalar> system, Unchecked,
                  Integrator integrator = Integrator::sdirk2)
        : AdhesionModel(Units(contact), std::move(system), integrator) {
        detail::require_same_aspect(name, contact, system_);
    }

    /// Both directions of a line, or a patch (PatchContact, whose half_length() is the system's unit of length), with
    /// the verdict on system.whole(). Throws std::invalid_argument for the same reasons.
    template <class AnyContact>
    AdhesionModel(const AnyContact& contact, const ElementSystem<Scalar, 2>& system, const StabilityVerdict& verdict,
                  Integrator integrator = Integrator::sdirk2) requires(inputs == 3)
        : AdhesionModel(contact, system, unchecked, integrator) {
        detail::require_usable_in_time(name, system, verdict);
    }
    template <class AnyContact>
    AdhesionModel(const AnyContact& contact, const ElementSystem<Scalar, 2>& system, Unchecked,
                  Integrator integrator = Integrator::sdirk2) requires(inputs == 3)
        : AdhesionModel(Units(contact), system.whole(), integrator) {
        if constexpr (std::is_same_v<AnyContact, Contact<Scalar>>) {
            detail::require_same_aspect(name, contact, system);
        }
        detail::require(system.elements().places_are_known(), name, "number of places of elements",
                        system.elements().x.size(), "equal the number of elements: spin needs them");
    }

    Eigen::Index size() const { return outputs_in_si_.rows(); }  ///< number of unknowns
    std::uint64_t fingerprint() const { return fingerprint_; }   ///< of the system and the contact
    Integrator integrator() const { return integrator_; }

    /// Whether the half-length may change: for systems with points() and log_strength() (elements and Chebyshev states
    /// of the plane kernel), by implicit_euler and sdirk2.
    bool can_breathe() const { return inputs == 1 && system_.log_strength() && system_.points() && !is_exponential(); }

    /// No traction anywhere, at the contact's half-length.
    State at_rest() const { return {VectorX<Scalar>::Zero(size()), fingerprint_, units_.length}; }
    Workspace workspace() const { return Workspace(size()); }

    /// 2b F_bar of a state [N] at its half-length. The state must have size() unknowns.
    Force force(const State& state) const { return Values::force(forces(state)); }

    /// Steady rolling at a creepage at the half-length of `from`, G' p = inputs v, Eq. (15); the tangent is that of
    /// steady rolling. `from` only gives the half-length and is not changed; for the status see advance().
    Step steady(const State& from, const Value& creepage, State& to, Workspace& workspace) const noexcept {
        const StepStatus status = check(from, from.half_length, to, workspace);
        if (status != StepStatus::ok) return failed(status);
        if (!detail::is_finite(creepage)) return failed(StepStatus::not_finite);
        const Inputs value = Values::vector(creepage);
        to.traction.setZero();
        for (Eigen::Index j = 0; j < inputs; ++j) to.traction += value[j] * steady_.col(j);
        return finish(from, from.half_length, 0, forces_of(steady_), to);
    }
    /// The same at the contact's half-length. Throws std::invalid_argument unless the creepage is finite.
    State steady(const Value& creepage) const;

    /// Rolls by dq [m], positive and finite, or 0 for a rigid shift without rolling. `to` must be another state with
    /// the same number of unknowns. It is not written if the status is invalid_step, wrong_state, invalid_load or
    /// needs_fixed_mesh or the motion is not finite; if the result is not finite, it becomes a copy of `from`. The
    /// half-length remains that of `from`. Does not allocate.
    Step advance(const State& from, const Travel& travel, const Motion& motion, State& to,
                 Workspace& workspace) const noexcept {
        return roll(from, travel.dq, motion, from.half_length, false, to, workspace);
    }

    /// The same with the contact's half-length `half_length` [m] at the end of the step, varying linearly from that of
    /// `from`: sdirk2 is of second order in dq if creepage and length are smooth in each step. dq is the distance
    /// rolled by the centre of the contact. The status is
    /// - invalid_load if the half-length is not positive and finite;
    /// - needs_fixed_mesh if the length would change by dq or more (with dq = 0, if it changes at all), so that an edge
    ///   would not roll forward; and if the model cannot breathe, unless both half-lengths are the contact's.
    Step advance(const State& from, const Travel& travel, const Motion& motion, Scalar half_length, State& to,
                 Workspace& workspace) const noexcept {
        return roll(from, travel.dq, motion, half_length, can_breathe(), to, workspace);
    }

private:
    using Values = typename Step::Values;
    using Inputs = detail::InputVector<inputs, Scalar>;
    using Square = typename detail::StepMap<inputs, Scalar>::Square;

    static constexpr const char* name = "AdhesionModel";

    using Units = detail::ContactUnits<Scalar>;

    // Of a creepage, or of a force over that of F_x.
    Scalar arm(Eigen::Index input) const { return input == 2 ? units_.length : Scalar(1); }

    AdhesionModel(const Units& units, RollingSystem<Scalar> system, Integrator integrator);

    bool is_exponential() const { return integrator_ == Integrator::matrix_exponential; }

    // The number of times to halve the step until the norm of w is at most 1/16, where r(w) of eighth order gives e^w
    // to rounding. The upper limit matters only if G is singular to rounding: the modes it affects decay at once.
    int count_doublings(Scalar h) const {
        if (!is_exponential() || !(h > 0)) return 0;
        const Scalar norm = 16 * h * rates_norm_;
        return detail::is_finite(norm) ? std::clamp(std::ilogb(norm) + 1, 0, 60) : 60;
    }

    static void solve(MatrixX<Scalar> matrix, MatrixX<Scalar>& right);

    StepStatus check(const State& from, Scalar half_length, const State& to,
                     const Workspace& workspace) const noexcept {
        const bool fits = &from != &to && from.system == fingerprint_ && from.traction.size() == size() &&
                          to.traction.size() == size() && workspace.size() == size() && is_length(from.half_length);
        if (!fits) return StepStatus::wrong_state;
        if (!is_length(half_length)) return StepStatus::invalid_load;
        const bool breathes = from.half_length != units_.length || half_length != units_.length;
        return breathes && !can_breathe() ? StepStatus::needs_fixed_mesh : StepStatus::ok;
    }

    static bool is_length(Scalar a) noexcept { return detail::is_finite(a) && a > 0; }

    static Step failed(StepStatus status) noexcept {
        Step result;
        result.status = status;
        return result;
    }

    // At the unit of length.
    template <class Unknowns>
    Inputs force_of(const Unknowns& unknowns) const {
        Inputs result;
        for (Eigen::Index i = 0; i < inputs; ++i) result[i] = outputs_in_si_.col(i).dot(unknowns);
        return result;
    }
    Square forces_of(const MatrixX<Scalar>& unknowns) const {
        Square result;
        for (Eigen::Index j = 0; j < inputs; ++j) result.col(j) = force_of(unknowns.col(j));
        return result;
    }
    Inputs forces(const State& state) const { return force_of(state.traction) * (state.half_length / units_.length); }

    // The result of the tractions in `to`; the tangent is at the unit of length.
    Step finish(const State& from, Scalar half_length, Scalar dq, const Square& tangent, State& to) const noexcept {
        to.half_length = half_length;
        to.system = fingerprint_;
        to.distance = dq;
        Inputs force = force_of(to.traction);
        Square total = tangent;
        if (half_length != units_.length) {  // a division counts in a step of a few states
            force *= half_length / units_.length;
            total *= half_length / units_.length;
        }
        if (!detail::all_finite(force) || !detail::all_finite(total)) {
            to.traction = from.traction;
            to.half_length = from.half_length;
            to.distance = from.distance;
            return failed(StepStatus::not_finite);
        }
        Step step;
        step.force = Values::force(force);
        if (units_.line) step.force_per_width = Values::force(Inputs(force / units_.width));
        step.tangent = Values::tangent(total);
        step.status = StepStatus::ok;
        return step;
    }

    Step roll(const State& from, Scalar dq, const Motion& motion, Scalar half_length, bool by_length, State& to,
              Workspace& workspace) const noexcept;

    Units units_;
    RollingSystem<Scalar> system_;
    std::uint64_t fingerprint_, preparation_;  // the latter also of the integrator
    Integrator integrator_;
    detail::RationalExponential<Scalar> rational_;
    MatrixX<Scalar> inputs_in_si_, outputs_in_si_;  // n x k [Pa/m], for spin [Pa]; [m^2], of the moment [m^3]
    MatrixX<Scalar> steady_;                        // n x k, per creepage [Pa], per spin [Pa m]
    Scalar rates_norm_ = 0;                         // |G^-1 G'|, for the matrix exponential
};

template <class Scalar>
AdhesionModel(const Contact<Scalar>&, RollingSystem<Scalar>, const StabilityVerdict&, Integrator = Integrator::sdirk2)
    -> AdhesionModel<1, Scalar>;
template <class Scalar>
AdhesionModel(const Contact<Scalar>&, RollingSystem<Scalar>, Unchecked, Integrator = Integrator::sdirk2)
    -> AdhesionModel<1, Scalar>;
template <class AnyContact, class Scalar>
AdhesionModel(const AnyContact&, const ElementSystem<Scalar, 2>&, const StabilityVerdict&,
              Integrator = Integrator::sdirk2) -> AdhesionModel<3, Scalar>;
template <class AnyContact, class Scalar>
AdhesionModel(const AnyContact&, const ElementSystem<Scalar, 2>&, Unchecked, Integrator = Integrator::sdirk2)
    -> AdhesionModel<3, Scalar>;

template <int inputs_, class Scalar_>
AdhesionModel<inputs_, Scalar_>::AdhesionModel(const Units& units, RollingSystem<Scalar> system, Integrator integrator)
    : units_(units),
      system_(std::move(system)),
      fingerprint_(units.fingerprint ^ system_.fingerprint()),
      preparation_(fingerprint_ ^ (1 + static_cast<std::uint64_t>(integrator))),
      integrator_(integrator),
      rational_(integrator),
      inputs_in_si_(system_.inputs()),
      outputs_in_si_(system_.outputs()) {
    detail::require(system_.input_count() == inputs, name, "number of inputs", system_.input_count(),
                    inputs == 1 ? "be 1" : "be 3");
    steady_ = units_.shear_modulus * system_.inputs();
    for (Eigen::Index j = 0; j < inputs; ++j) {
        steady_.col(j) *= arm(j);
        inputs_in_si_.col(j) *= units_.shear_modulus / units_.length * arm(j);
        outputs_in_si_.col(j) *= units_.width * units_.length * arm(j);
    }
    solve(system_.G_prime(), steady_);
    if (!is_exponential()) return;
    MatrixX<Scalar> rates = system_.G_prime();
    solve(system_.G(), rates);
    rates_norm_ = rates.cwiseAbs().colwise().sum().maxCoeff();
}

template <int inputs_, class Scalar_>
void AdhesionModel<inputs_, Scalar_>::solve(MatrixX<Scalar> matrix, MatrixX<Scalar>& right) {
    std::vector<Eigen::Index> swaps(static_cast<std::size_t>(matrix.rows()));
    const detail::MatrixRef<Scalar> factors(matrix);
    detail::factorise_in_place<Scalar>(factors, swaps.data());
    for (Eigen::Index j = 0; j < right.cols(); ++j) {
        detail::solve_in_place<Scalar>(factors, swaps.data(), right.col(j));
    }
}

template <int inputs_, class Scalar_>
auto AdhesionModel<inputs_, Scalar_>::steady(const Value& creepage) const -> State {
    const Inputs value = Values::vector(creepage);
    for (const Scalar component : value) {
        detail::require(detail::is_finite(component), name, "creepage", component, "be finite");
    }
    State state = at_rest();
    state.traction.noalias() = steady_ * value;
    return state;
}

template <int inputs_, class Scalar_>
auto AdhesionModel<inputs_, Scalar_>::roll(const State& from, Scalar dq, const Motion& motion, Scalar half_length,
                                           bool by_length, State& to, Workspace& workspace) const noexcept -> Step {
    // what belongs to the model first, then the motion, then the load
    const StepStatus belongs = check(from, half_length, to, workspace);
    if (belongs == StepStatus::wrong_state) return failed(belongs);
    const StepStatus possible = motion.check(dq);
    if (possible != StepStatus::ok) return failed(possible);
    if (belongs != StepStatus::ok) return failed(belongs);
    const Scalar change = half_length - from.half_length;
    if (change != 0 && !(std::abs(change) < dq)) return failed(StepStatus::needs_fixed_mesh);

    const detail::ImposedMotion<inputs, Scalar> imposed(motion, dq);
    const bool repeats = dq > 0 && dq == from.distance && !by_length && half_length == units_.length;
    if (repeats || is_exponential()) {
        detail::StepMap<inputs, Scalar>& map = workspace.map();
        if (!map.is_of(preparation_, dq)) {
            map.prepare(preparation_, detail::influence(system_), rational_, inputs_in_si_, outputs_in_si_, dq,
                        units_.length, count_doublings(dq / units_.length), workspace.factors());
        }
        map.apply(from.traction, imposed, to.traction);
        return finish(from, half_length, dq, map.tangent(imposed), to);
    }
    detail::AdhesionStages<inputs, Scalar>& stages = workspace.stages();
    stages.solve(preparation_, detail::influence(system_), rational_, inputs_in_si_, from.traction,
                 from.half_length / units_.length, half_length / units_.length, dq / units_.length, imposed, by_length,
                 workspace.factors());
    to.traction = from.traction + stages.change();
    Step step = finish(from, half_length, dq, forces_of(stages.per_end()), to);
    if (by_length && step.status == StepStatus::ok) {
        const Inputs by_change = force_of(stages.per_length()) * (half_length / units_.length);
        step.tangent_by_half_length = Values::force(Inputs((force_of(to.traction) + by_change) / units_.length));
    }
    return step;
}

}  // namespace rollbem
