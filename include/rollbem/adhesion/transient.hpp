// Non-steady rolling step by step: G dp/dq = G' p - xi(q), q = V t the distance rolled, Eqs. (11) and (12). A force
// element for an external time loop: const model, plain state, no exception and no allocation in a step.
#pragma once

#include "../detail/language.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../assembly/rolling_system.hpp"
#include "../detail/finite.hpp"
#include "../detail/in_place_lu.hpp"
#include "../detail/require.hpp"
#include "../scene/contact.hpp"
#include "../scene/rigid_motion.hpp"
#include "../status.hpp"
#include "detail/breathing_step.hpp"
#include "detail/rational_exponential.hpp"
#include "detail/unprepared_step.hpp"
#include "integrator.hpp"
#include "stability_verdict.hpp"
#include "transient_state.hpp"

namespace rollbem {

/// The contact as a force element. Built once; const and without caches, so that threads may share it. Its interface is
/// in SI units.
///
/// The half-length may change from step to step if can_breathe(): the unknowns then live on x = a zeta, and the state
/// at one half-length is carried over to the next. b is constant. No status reports that a contact has grown so far
/// that Lambda of the plane kernel, with b over the new half-length, is no longer positive and a mode grows in time: a
/// is then several times b.
///
/// Invariant: the half-width is finite, and the scheme is stable according to the verdict.
///
///     const auto system = rolling_system(mesh, scheme, kernel);
///     const TransientModel<double> model(contact, system, judge_stability(system));
///     TransientState<double> now = model.at_rest(), next = now;
///     const TransientStep<double> step = model.advance(now, dq, creepage, next);  // now stays as it is
///     if (accepted) std::swap(now, next);
template <class Scalar_ = double>
class TransientModel {
public:
    using Scalar = Scalar_;
    using State = TransientState<Scalar>;
    using Step = TransientStep<Scalar>;
    using Prepared = PreparedStep<Scalar>;

    /// Up to this number of unknowns, a step that is not prepared is solved on the stack (128 KB in double).
    static constexpr Eigen::Index largest_unprepared = 128;

    /// Takes creepage in the direction of the kernel with which the system was made. Throws std::invalid_argument
    /// unless the verdict is one on this system's eigenvalues and establishes that none grows; if steady rolling shows
    /// that the scheme does not converge to full adhesion (Status::inconsistent); and if the contact's half-width is
    /// infinite or not that of the system's kernel.
    TransientModel(const Contact<Scalar>& contact, RollingSystem<Scalar> system, const StabilityVerdict& verdict,
                   Integrator integrator = Integrator::sdirk2)
        : TransientModel(contact, std::move(system), unchecked, integrator) {
        detail::require_usable_in_time("TransientModel", system_, verdict);
    }

    /// The same whatever the eigenvalues, and whether or not the scheme converges.
    TransientModel(const Contact<Scalar>& contact, RollingSystem<Scalar> system, Unchecked,
                   Integrator integrator = Integrator::sdirk2);

    Eigen::Index size() const { return areas_.size(); }         ///< number of unknowns
    std::uint64_t fingerprint() const { return fingerprint_; }  ///< of the system and the contact
    Integrator integrator() const { return integrator_; }

    /// Whether the half-length may change: for systems with points() and log_strength() (elements and Chebyshev states
    /// of the plane kernel) with up to largest_unprepared unknowns, by implicit_euler and sdirk2.
    bool can_breathe() const {
        return system_.log_strength() && system_.points() && size() <= largest_unprepared && rational_.stages <= 2;
    }

    /// No traction anywhere, at the contact's half-length.
    State at_rest() const { return {VectorX<Scalar>::Zero(size()), fingerprint_, half_length_}; }

    /// Steady rolling at a creepage [-] at the contact's half-length: G' p = xi, Eq. (15). Throws std::invalid_argument
    /// unless the creepage is finite.
    State steady(Scalar creepage) const;

    /// 2b F_bar of a state [N], at the half-length of the state, which must have size() unknowns.
    Scalar force(const State& state) const { return areas_.dot(state.traction) * (state.half_length / half_length_); }

    /// Prepares steps of dq [m]. O(n^3), allocates. Throws std::invalid_argument unless 0 <= dq < inf; if dq
    /// is 0, the step takes rigid shifts only.
    Prepared prepare(Scalar dq) const;

    /// One step of a prepared dq: one matrix-vector product, no allocation. `from` is never written. `to` must be
    /// another state of the same size. It is left unchanged if the status is invalid_step, needs_prepare,
    /// needs_fixed_mesh, invalid_load or wrong_state, or if the motion is not finite; it becomes a copy of `from` if
    /// the result is not finite. The half-length remains that of `from`; unless this is the contact's, the step is
    /// solved as if it were not prepared.
    Step advance(const State& from, const Prepared& step, const RigidMotion<Scalar>& motion, State& to) const noexcept;

    /// One step of any dq [m], positive and finite. With up to largest_unprepared unknowns it is solved directly,
    /// without heap memory; with more, and with Integrator::matrix_exponential, the status is needs_prepare. Otherwise
    /// as above.
    Step advance(const State& from, Scalar dq, const RigidMotion<Scalar>& motion, State& to) const noexcept;

    /// One step of any dq [m] at whose end the contact's half-length is `half_length` [m], varying linearly from that
    /// of `from`, without heap memory: sdirk2 is of second order in dq if creepage and length are smooth in each step.
    /// dq is the distance rolled by the centre of the contact. The status is
    /// - invalid_load if the half-length is not positive and finite;
    /// - needs_fixed_mesh if the length would change by dq or more (with dq = 0, if it changes at all), so that an edge
    ///   would not roll forward; and if the model cannot breathe, unless both half-lengths are the contact's: such a
    ///   step is the one above.
    /// Otherwise as above.
    BreathingTransientStep<Scalar> advance(const State& from, Scalar dq, const RigidMotion<Scalar>& motion,
                                           Scalar half_length, State& to) const noexcept;

private:
    using Motion = RigidMotion<Scalar>;
    using Travel = detail::Travel<Scalar>;

    std::uint64_t preparation() const { return fingerprint_ ^ (1 + static_cast<std::uint64_t>(integrator_)); }

    // The number of times to halve the step until the norm of w is at most 1/16, where r(w) of eighth order gives e^w
    // to rounding. The upper limit matters only if G is singular to rounding: the modes it affects decay at once.
    int count_doublings(Scalar h) const;

    static void solve(MatrixX<Scalar> matrix, MatrixX<Scalar>& right);

    StepStatus check(const State& from, Scalar dq, const Motion& motion, const State& to) const noexcept {
        const bool fits = &from != &to && from.system == fingerprint_ && from.traction.size() == size() &&
                          to.traction.size() == size() && is_length(from.half_length);
        return fits ? motion.check(dq) : StepStatus::wrong_state;
    }

    static bool is_length(Scalar a) noexcept { return detail::is_finite(a) && a > 0; }

    static Step failed(StepStatus status) noexcept {
        Step result;
        result.status = status;
        return result;
    }

    Step finish(const State& from, const Travel& travel, Scalar force_per_shift, Scalar force_per_ramp,
                State& to) const noexcept {
        to.half_length = half_length_;
        return finish(from, areas_.dot(to.traction),
                      travel.shift_per_end * force_per_shift + travel.ramp_per_end * force_per_ramp, to);
    }

    Step finish(const State& from, Scalar force, Scalar tangent, State& to) const noexcept {
        to.system = fingerprint_;
        if (detail::is_finite(force) && detail::is_finite(tangent)) {
            return {force, force / width_, tangent, StepStatus::ok};
        }
        to.traction = from.traction;
        to.half_length = from.half_length;
        return failed(StepStatus::not_finite);
    }

    // What prepare() does for a whole matrix, for one state. Separate from advance() so that only it needs the stack.
    [[gnu::noinline]] Step solve_step(const State& from, Scalar dq, const Travel& travel, State& to) const noexcept;

    // The same from one half-length to another, after all checks except that of the change.
    [[gnu::noinline]] BreathingTransientStep<Scalar> breathe(const State& from, Scalar dq, const Travel& travel,
                                                             Scalar half_length, State& to) const noexcept;

    Scalar half_length_, width_, traction_scale_;  // a [m], 2b [m], G/a [Pa/m]
    RollingSystem<Scalar> system_;
    std::uint64_t fingerprint_;
    Integrator integrator_;
    VectorX<Scalar> areas_;  // 2b a times the weights: 2b dx of each element [m^2]
    detail::RationalExponential<Scalar> rational_;
};

template <class Scalar_>
TransientModel<Scalar_>::TransientModel(const Contact<Scalar>& contact, RollingSystem<Scalar> system, Unchecked,
                                        Integrator integrator)
    : half_length_(contact.half_length()),
      width_(2 * contact.half_width()),
      traction_scale_(contact.shear_modulus() / contact.half_length()),
      system_(std::move(system)),
      fingerprint_(detail::fingerprint_of(contact, system_.fingerprint())),
      integrator_(integrator),
      rational_(integrator) {
    detail::require_single_input("TransientModel", system_);
    detail::require_same_aspect("TransientModel", contact, system_);
    areas_ = width_ * half_length_ * system_.weights().matrix();
}

template <class Scalar_>
auto TransientModel<Scalar_>::steady(Scalar creepage) const -> State {
    detail::require(detail::is_finite(creepage), "TransientModel", "creepage", creepage, "be finite");
    MatrixX<Scalar> traction(size(), 1);
    traction.setConstant(creepage * traction_scale_ * half_length_);
    solve(system_.G_prime(), traction);
    return {traction, fingerprint_, half_length_};
}

template <class Scalar_>
auto TransientModel<Scalar_>::prepare(Scalar dq) const -> Prepared {
    detail::require(detail::is_finite(dq) && dq >= 0, "TransientModel", "dq", dq, "be finite and not negative");
    const Eigen::Index n = size();
    const int doublings = count_doublings(dq / half_length_);
    const Scalar h = std::ldexp(dq / half_length_, -doublings);

    // Powers of Y = gamma h (G - gamma h G')^-1 G' give the change of p; applied to the adjacent column, that due to
    // the creepage.
    MatrixX<Scalar> Y(n, n + 1);
    Y.leftCols(n) = rational_.gamma * h * system_.G_prime();
    Y.col(n).setConstant(rational_.gamma);
    solve(system_.G() - rational_.gamma * h * system_.G_prime(), Y);
    Prepared step;
    step.made_for_ = preparation();
    step.dq_ = dq;
    MatrixX<Scalar>& map = step.map_;
    map.setZero(n, n + 2);
    MatrixX<Scalar> product(n, n + 2);
    for (int j = rational_.stages; j >= 1; --j) {
        product.noalias() = Y.leftCols(n) * map;
        map = product;
        map.leftCols(n + 1) += rational_.b(j) * Y;
        map.col(n + 1) += rational_.ramp_weight(j) * Y.col(n);
    }
    // Two steps in one, for e^w - 1 rather than e^w, so that short steps keep their digits.
    for (int k = 0; k < doublings; ++k) {
        product.noalias() = map.leftCols(n) * map;
        map.col(n + 1) = map.col(n + 1) / 2 + map.col(n) / 4 + product.col(n + 1) / 4;
        map.col(n) += product.col(n) / 2;
        map.leftCols(n) += map.leftCols(n) + product.leftCols(n);
    }
    map.rightCols(2) *= -traction_scale_;
    step.force_per_shift_ = areas_.dot(map.col(n));
    step.force_per_ramp_ = areas_.dot(map.col(n + 1));
    return step;
}

template <class Scalar_>
auto TransientModel<Scalar_>::advance(const State& from, const Prepared& step, const RigidMotion<Scalar>& motion,
                                      State& to) const noexcept -> Step {
    const StepStatus status = check(from, step.dq_, motion, to);
    if (status != StepStatus::ok) return failed(status);
    const Eigen::Index n = size();
    if (step.made_for_ != preparation()) return failed(StepStatus::wrong_state);
    const Travel travel(motion, step.dq_);
    if (from.half_length != half_length_) return breathe(from, step.dq_, travel, from.half_length, to);
    to.traction = from.traction + travel.shift * step.map_.col(n) + travel.ramp * step.map_.col(n + 1);
    to.traction.noalias() += step.map_.leftCols(n) * from.traction;
    return finish(from, travel, step.force_per_shift_, step.force_per_ramp_, to);
}

template <class Scalar_>
auto TransientModel<Scalar_>::advance(const State& from, Scalar dq, const RigidMotion<Scalar>& motion,
                                      State& to) const noexcept -> Step {
    const StepStatus status = check(from, dq, motion, to);
    if (status != StepStatus::ok) return failed(status);
    if (from.half_length != half_length_) return breathe(from, dq, Travel(motion, dq), from.half_length, to);
    if (size() > largest_unprepared || rational_.stages > 2) return failed(StepStatus::needs_prepare);
    return solve_step(from, dq, Travel(motion, dq), to);
}

template <class Scalar_>
auto TransientModel<Scalar_>::advance(const State& from, Scalar dq, const RigidMotion<Scalar>& motion,
                                      Scalar half_length, State& to) const noexcept -> BreathingTransientStep<Scalar> {
    const StepStatus status = check(from, dq, motion, to);
    if (status != StepStatus::ok) return {failed(status)};
    if (!is_length(half_length)) return {failed(StepStatus::invalid_load)};
    if (!can_breathe() && from.half_length == half_length_ && half_length == half_length_) {
        return {advance(from, dq, motion, to)};
    }
    return breathe(from, dq, Travel(motion, dq), half_length, to);
}

template <class Scalar_>
auto TransientModel<Scalar_>::count_doublings(Scalar h) const -> int {
    if (integrator_ != Integrator::matrix_exponential || !(h > 0)) return 0;
    MatrixX<Scalar> rates = system_.G_prime();
    solve(system_.G(), rates);
    const Scalar norm = 16 * h * rates.cwiseAbs().colwise().sum().maxCoeff();
    return detail::is_finite(norm) ? std::clamp(std::ilogb(norm) + 1, 0, 60) : 60;
}

template <class Scalar_>
void TransientModel<Scalar_>::solve(MatrixX<Scalar> matrix, MatrixX<Scalar>& right) {
    std::vector<Eigen::Index> swaps(static_cast<std::size_t>(matrix.rows()));
    const detail::MatrixRef<Scalar> factors(matrix);
    detail::factorise_in_place<Scalar>(factors, swaps.data());
    for (Eigen::Index j = 0; j < right.cols(); ++j) {
        detail::solve_in_place<Scalar>(factors, swaps.data(), right.col(j));
    }
}

template <class Scalar_>
auto TransientModel<Scalar_>::solve_step(const State& from, Scalar dq, const Travel& travel, State& to) const noexcept
    -> Step {
    detail::UnpreparedStep<Scalar, largest_unprepared> step;
    step.solve(system_, rational_, dq / half_length_, from.traction, to.traction);
    to.traction -= traction_scale_ * (travel.shift * step.per_shift() + travel.ramp * step.per_ramp());
    return finish(from, travel, -traction_scale_ * areas_.dot(step.per_shift()),
                  -traction_scale_ * areas_.dot(step.per_ramp()), to);
}

template <class Scalar_>
auto TransientModel<Scalar_>::breathe(const State& from, Scalar dq, const Travel& travel, Scalar half_length,
                                      State& to) const noexcept -> BreathingTransientStep<Scalar> {
    const Scalar change = half_length - from.half_length;
    const bool rolls_forward = change == 0 || std::abs(change) < dq;
    if (!can_breathe() || !rolls_forward) return {failed(StepStatus::needs_fixed_mesh)};
    detail::BreathingStep<Scalar, largest_unprepared> step(system_, rational_);
    const Scalar ratio = half_length / half_length_;
    step.solve(from.traction, from.half_length / half_length_, ratio, dq / half_length_,
               travel.scaled(traction_scale_));
    to.traction = from.traction + step.change();
    to.half_length = half_length;
    const Scalar force = areas_.dot(to.traction);
    BreathingTransientStep<Scalar> result{finish(from, ratio * force, ratio * areas_.dot(step.per_end()), to)};
    if (result.status != StepStatus::ok) return result;
    result.tangent_by_half_length = (force + ratio * areas_.dot(step.per_length())) / half_length_;
    return result;
}

}  // namespace rollbem
