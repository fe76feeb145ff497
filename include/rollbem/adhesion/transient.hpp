// Non-steady rolling step by step: G dp/dq = G' p - xi(q), q = V t the distance rolled, Eqs. (11) and (12).
// A force element for somebody else's time loop: const model, plain state, no exception and no allocation in a step.
#pragma once

#include "../detail/language.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
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
#include "integrator.hpp"
#include "stability_verdict.hpp"

namespace rollbem {

/// All that the next step needs of the past. A copy is a checkpoint; written to a file and read back, it goes on to the
/// last bit as if nothing had happened.
template <class Scalar>
struct TransientState {
    VectorX<Scalar> traction;  ///< the system's unknowns times G: of elements p on body 1 [Pa], trailing to leading
    std::uint64_t system = 0;  ///< fingerprint() of the model that the state belongs to
};

/// Result of one step. Not a number where the status is not ok.
template <class Scalar>
struct TransientStep {
    Scalar force = std::numeric_limits<Scalar>::quiet_NaN();            ///< 2b F_bar on body 1 [N]
    Scalar force_per_width = std::numeric_limits<Scalar>::quiet_NaN();  ///< F_bar [N/m]
    /// d force / d creepage at the end of the step [N]; for a rigid shift d force / d shift [N/m].
    Scalar tangent = std::numeric_limits<Scalar>::quiet_NaN();
    StepStatus status = StepStatus::not_finite;
};

/// Everything that a step of a given dq needs, computed once: n^2 numbers. Const use is safe from several threads.
template <class Scalar>
class PreparedStep {
public:
    Scalar dq() const { return dq_; }  ///< distance rolled in the step [m]

private:
    std::uint64_t made_for_ = 0;  // the model that prepared it: its fingerprint, and its integrator
    Scalar dq_ = 0;
    // Columns [change, per_shift, per_ramp]: p_new - p = change p + per_shift (xi dq) + per_ramp (change of xi) dq.
    MatrixX<Scalar> map_;                              // n x (n+2) [-], [Pa/m], [Pa/m]
    Scalar force_per_shift_ = 0, force_per_ramp_ = 0;  // [N/m]

    template <class>
    friend class TransientModel;
};

/// The contact as a force element. Built once; const and free of caches, so threads may share it. SI units outside.
///
/// Invariant: the half-width is finite, and the scheme is stable as far as the verdict says.
///
///     const auto system = rolling_system(mesh, scheme, kernel);
///     const TransientModel<double> model(contact, system, verdict(system));
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

    /// Up to this many unknown elements, a step that is not prepared is solved on the stack (128 KB in double).
    static constexpr Eigen::Index largest_unprepared = 128;

    /// Takes creepage in the direction of the kernel that the system was made with. Throws std::invalid_argument unless
    /// the verdict is one of this system's eigenvalues and settles that none grows, where steady rolling shows that the
    /// scheme does not converge to full adhesion (Status::inconsistent), and where the contact's half-width is infinite
    /// or not that of the system's kernel.
    TransientModel(const Contact<Scalar>& contact, RollingSystem<Scalar> system, const StabilityVerdict& verdict,
                   Integrator integrator = Integrator::sdirk2)
        : TransientModel(contact, std::move(system), unchecked, integrator) {
        detail::require_usable_in_time("TransientModel", system_, verdict);
    }

    /// The same whatever the eigenvalues, and whether the scheme converges or not.
    TransientModel(const Contact<Scalar>& contact, RollingSystem<Scalar> system, Unchecked,
                   Integrator integrator = Integrator::sdirk2);

    Eigen::Index size() const { return areas_.size(); }         ///< number of unknowns
    std::uint64_t fingerprint() const { return fingerprint_; }  ///< of the system and the contact
    Integrator integrator() const { return integrator_; }

    /// No traction anywhere.
    State at_rest() const { return {VectorX<Scalar>::Zero(size()), fingerprint_}; }

    /// Steady rolling at a creepage [-]: G' p = xi, Eq. (15). Throws std::invalid_argument unless it is finite.
    State steady(Scalar creepage) const;

    /// 2b F_bar of a state [N]. The state must have size() elements.
    Scalar force(const State& state) const { return areas_.dot(state.traction); }

    /// Prepares steps of dq [m]. O(n^3), allocates. Throws std::invalid_argument unless 0 <= dq < inf; with dq = 0 the
    /// step takes rigid shifts only.
    Prepared prepare(Scalar dq) const;

    /// One step of a prepared dq: one product of a matrix and a vector, no allocation. `from` is never written.
    /// `to` must be another state of the same size. It is left alone where the status is invalid_step, needs_prepare or
    /// wrong_state or the motion is not finite; it becomes a copy of `from` where the result is not finite.
    Step advance(const State& from, const Prepared& step, const RigidMotion<Scalar>& motion, State& to) const noexcept;

    /// One step of any dq [m], positive and finite. Up to largest_unprepared elements it solves for the step at once,
    /// without heap memory; above, and with Integrator::matrix_exponential, the status is needs_prepare. Otherwise as
    /// above.
    Step advance(const State& from, Scalar dq, const RigidMotion<Scalar>& motion, State& to) const noexcept;

private:
    using Motion = RigidMotion<Scalar>;
    using SmallVector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1, Eigen::ColMajor, largest_unprepared, 1>;

    // Shift at constant creepage, what a linear change adds, and what the tangent is taken by.
    struct Travel {
        Scalar shift, ramp;                          // [m]
        Scalar shift_per_end = 0, ramp_per_end = 0;  // derivatives by the motion's end value
    };

    std::uint64_t preparation() const { return fingerprint_ ^ (1 + static_cast<std::uint64_t>(integrator_)); }

    static constexpr std::size_t index(int j) { return static_cast<std::size_t>(j); }

    // Coefficients of (r(w) - 1)/w - 1 in y^j: the response to linear creepage.
    Scalar ramp_weight(int j) const { return gamma_ * (b_[index(j)] + b_[index(j + 1)]); }

    // e^w is taken for steps so short that the norm of w is at most 1/16: there the eighth order r(w) is exact to
    // rounding. The cap matters only where G is singular to rounding: what it leaves out decays at once.
    int count_doublings(Scalar h) const;

    static void solve(MatrixX<Scalar> matrix, MatrixX<Scalar>& right);

    StepStatus check(const State& from, Scalar dq, const Motion& motion, const State& to) const noexcept {
        const bool fits = &from != &to && from.system == fingerprint_ && from.traction.size() == size() &&
                          to.traction.size() == size();
        return fits ? motion.check(dq) : StepStatus::wrong_state;
    }

    static Step failed(StepStatus status) noexcept {
        Step result;
        result.status = status;
        return result;
    }

    static Travel travel_of(const Motion& motion, Scalar dq) noexcept {
        if (motion.is_shift()) return {.shift = motion.start(), .ramp = 0, .shift_per_end = 1};
        const Scalar shift = motion.start() * dq;
        if (!motion.is_linear()) return {.shift = shift, .ramp = 0, .shift_per_end = dq};
        return {.shift = shift, .ramp = (motion.end() - motion.start()) * dq, .ramp_per_end = dq};
    }

    Step finish(const State& from, const Travel& travel, Scalar force_per_shift, Scalar force_per_ramp,
                State& to) const noexcept {
        to.system = fingerprint_;
        Step result;
        result.force = areas_.dot(to.traction);
        result.force_per_width = result.force / width_;
        result.tangent = travel.shift_per_end * force_per_shift + travel.ramp_per_end * force_per_ramp;
        result.status = StepStatus::ok;
        if (detail::is_finite(result.force) && detail::is_finite(result.tangent)) return result;
        to.traction = from.traction;
        return failed(StepStatus::not_finite);
    }

    // What prepare() does for a whole matrix, for this one state. Apart from advance() so that only it needs the stack.
    [[gnu::noinline]] Step solve_step(const State& from, Scalar dq, const Travel& travel, State& to) const noexcept;

    Scalar half_length_, width_, traction_scale_;  // a [m], 2b [m], G/a [Pa/m]
    RollingSystem<Scalar> system_;
    std::uint64_t fingerprint_;
    Integrator integrator_;
    VectorX<Scalar> areas_;  // 2b a times the weights: 2b dx of each element [m^2]
    int stages_ = 1;
    Scalar gamma_ = 1;
    std::array<Scalar, 10> b_{};
};

template <class Scalar_>
TransientModel<Scalar_>::TransientModel(const Contact<Scalar>& contact, RollingSystem<Scalar> system, Unchecked,
                                        Integrator integrator)
    : half_length_(contact.half_length()),
      width_(2 * contact.half_width()),
      traction_scale_(contact.shear_modulus() / contact.half_length()),
      system_(std::move(system)),
      fingerprint_(detail::fingerprint_of(contact, system_.fingerprint())),
      integrator_(integrator) {
    detail::require_same_aspect("TransientModel", contact, system_);
    areas_ = width_ * half_length_ * system_.weights().matrix();
    // r(w) = sum_j b_j y^j, y = gamma w / (1 - gamma w): the Taylor series of e^w in y, whose coefficients are
    // Laguerre polynomials of 1/gamma. It is cut off after `stages_` terms, where 1/gamma is a zero of the
    // Laguerre polynomial of that degree, which makes r(-inf) = 0 (Noersett 1974; Hairer & Wanner II, IV.6).
    const Scalar inverse_gamma = integrator == Integrator::implicit_euler ? Scalar(1)
                                 : integrator == Integrator::sdirk2
                                     ? 2 + std::sqrt(Scalar(2))
                                     : static_cast<Scalar>(4.266700170287658793649421826900639634482L);
    stages_ = integrator == Integrator::implicit_euler ? 1 : integrator == Integrator::sdirk2 ? 2 : 8;
    gamma_ = 1 / inverse_gamma;
    Scalar before = 1;
    b_[1] = inverse_gamma;
    for (int j = 1; j < stages_; ++j) {
        const Scalar next = ((inverse_gamma - Scalar(2 * j)) * b_[index(j)] - Scalar(j - 1) * before) / Scalar(j + 1);
        before = b_[index(j)];
        b_[index(j + 1)] = next;
    }
}

template <class Scalar_>
auto TransientModel<Scalar_>::steady(Scalar creepage) const -> State {
    detail::require(detail::is_finite(creepage), "TransientModel", "creepage", creepage, "be finite");
    MatrixX<Scalar> traction(size(), 1);
    traction.setConstant(creepage * traction_scale_ * half_length_);
    solve(system_.G_prime(), traction);
    return {traction, fingerprint_};
}

template <class Scalar_>
auto TransientModel<Scalar_>::prepare(Scalar dq) const -> Prepared {
    detail::require(detail::is_finite(dq) && dq >= 0, "TransientModel", "dq", dq, "be finite and not negative");
    const Eigen::Index n = size();
    const int doublings = count_doublings(dq / half_length_);
    const Scalar h = std::ldexp(dq / half_length_, -doublings);

    // Powers of Y = gamma h (G - gamma h G')^-1 G' make the change of p; applied to the column beside it, those of
    // the creepage.
    MatrixX<Scalar> Y(n, n + 1);
    Y.leftCols(n) = gamma_ * h * system_.G_prime();
    Y.col(n).setConstant(gamma_);
    solve(system_.G() - gamma_ * h * system_.G_prime(), Y);
    Prepared step;
    step.made_for_ = preparation();
    step.dq_ = dq;
    MatrixX<Scalar>& map = step.map_;
    map.setZero(n, n + 2);
    MatrixX<Scalar> product(n, n + 2);
    for (int j = stages_; j >= 1; --j) {
        product.noalias() = Y.leftCols(n) * map;
        map = product;
        map.leftCols(n + 1) += b_[index(j)] * Y;
        map.col(n + 1) += ramp_weight(j) * Y.col(n);
    }
    // Two steps in one. On e^w - 1 rather than e^w, so that short steps keep their digits.
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
    const Travel travel = travel_of(motion, step.dq_);
    to.traction = from.traction + travel.shift * step.map_.col(n) + travel.ramp * step.map_.col(n + 1);
    to.traction.noalias() += step.map_.leftCols(n) * from.traction;
    return finish(from, travel, step.force_per_shift_, step.force_per_ramp_, to);
}

template <class Scalar_>
auto TransientModel<Scalar_>::advance(const State& from, Scalar dq, const RigidMotion<Scalar>& motion,
                                      State& to) const noexcept -> Step {
    const StepStatus status = check(from, dq, motion, to);
    if (status != StepStatus::ok) return failed(status);
    if (size() > largest_unprepared || stages_ > 2) return failed(StepStatus::needs_prepare);
    return solve_step(from, dq, travel_of(motion, dq), to);
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
    const Eigen::Index n = size();
    const Scalar h = dq / half_length_;
    alignas(64) std::array<Scalar, largest_unprepared * largest_unprepared> memory;
    std::array<Eigen::Index, largest_unprepared> swaps;
    Eigen::Map<MatrixX<Scalar>>(memory.data(), n, n) = system_.G() - gamma_ * h * system_.G_prime();
    const detail::MatrixRef<Scalar> factors(Eigen::Map<MatrixX<Scalar>>(memory.data(), n, n));
    detail::factorise_in_place<Scalar>(factors, swaps.data());

    SmallVector unit = SmallVector::Constant(n, gamma_);
    detail::solve_in_place<Scalar>(factors, swaps.data(), unit);
    SmallVector right(n);
    SmallVector change(n);
    change.noalias() = system_.G_prime() * from.traction;
    change *= gamma_ * h;
    detail::solve_in_place<Scalar>(factors, swaps.data(), change);
    SmallVector per_shift = b_[1] * unit;
    SmallVector per_ramp = ramp_weight(1) * unit;
    to.traction = from.traction + b_[1] * change;
    for (int j = 2; j <= stages_; ++j) {
        right.noalias() = system_.G_prime() * unit;
        unit = gamma_ * h * right;
        detail::solve_in_place<Scalar>(factors, swaps.data(), unit);
        per_shift += b_[index(j)] * unit;
        per_ramp += ramp_weight(j) * unit;
        right.noalias() = system_.G_prime() * change;
        change = gamma_ * h * right;
        detail::solve_in_place<Scalar>(factors, swaps.data(), change);
        to.traction += b_[index(j)] * change;
    }
    to.traction -= traction_scale_ * (travel.shift * per_shift + travel.ramp * per_ramp);
    return finish(from, travel, -traction_scale_ * areas_.dot(per_shift), -traction_scale_ * areas_.dot(per_ramp), to);
}

}  // namespace rollbem
