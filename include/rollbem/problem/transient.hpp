// Non-steady rolling step by step: G dp/dq = G' p - xi(q), q = V t the distance rolled, Eqs. (11) and (12).
// A force element for somebody else's time loop: const model, plain state, no exception and no allocation in a step.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../assembly/influence.hpp"
#include "../detail/in_place_lu.hpp"
#include "../detail/require.hpp"
#include "../discretisation/mesh.hpp"
#include "../discretisation/scheme.hpp"
#include "../elasticity/line_kernel.hpp"
#include "../scene/contact.hpp"
#include "adhesion.hpp"
#include "plane_model.hpp"
#include "stability_verdict.hpp"
#include "status.hpp"

namespace rollbem {

/// How a step is taken. With w = dq G^-1 G', each replaces e^w by a rational function r(w) with one real pole that
/// tends to 0 for w -> -inf (L-stable): stiff modes, which a nearly singular G has, die out instead of ringing.
enum class Integrator {
    implicit_euler,      ///< first order
    sdirk2,              ///< second order, two stages, gamma = 1 - 1/sqrt(2) (Alexander 1977); the default
    matrix_exponential,  ///< e^w to rounding: exact in dq for constant (zero-order hold) or linear creepage (first-order
                         ///< hold); for distances rolled that are prepared
};

/// What became of a step.
enum class StepStatus {
    ok,
    invalid_step,   ///< dq is not positive and finite (for a rigid shift: not finite or negative)
    not_finite,     ///< the motion or the result is not finite
    needs_prepare,  ///< dq is new and has to be prepared: too many elements, or Integrator::matrix_exponential
    wrong_state,    ///< a state or prepared step of a different size, or one object both `from` and `to`
};

/// What the bodies do relative to each other, as rigid bodies, while the contact rolls on by dq. The same for both
/// directions of creepage: which one it is, is the kernel's business.
template <class Scalar>
class RigidMotion {
public:
    /// The same creepage xi [-] all the way.
    RigidMotion(Scalar creepage) : start_(creepage), end_(creepage) {}  // NOLINT: a number is meant to convert

    /// Creepage [-] that varies linearly along the way.
    static RigidMotion linear(Scalar start, Scalar end) { return {start, end, Kind::linear}; }

    /// Rigid shift xi dq [m] of body 1 against body 2, even along the way: needs no division by a speed that may vanish,
    /// and is allowed with dq = 0.
    static RigidMotion shift(Scalar shift) { return {shift, shift, Kind::shift}; }

private:
    enum class Kind { constant, linear, shift };

    RigidMotion(Scalar start, Scalar end, Kind kind) : start_(start), end_(end), kind_(kind) {}

    Scalar start_, end_;
    Kind kind_ = Kind::constant;

    template <class>
    friend class TransientModel;
    template <class>
    friend class FrictionModel;
};

/// Tractions of the unknown elements [Pa] on body 1, trailing to leading. All there is to a state: a copy is a
/// checkpoint.
template <class Scalar>
struct TransientState {
    VectorX<Scalar> traction;
};

/// Result of one step. Not a number where the status is not ok.
template <class Scalar>
struct TransientStep {
    Scalar force = std::numeric_limits<Scalar>::quiet_NaN();            ///< 2b F_bar on body 1 [N]
    Scalar force_per_width = std::numeric_limits<Scalar>::quiet_NaN();  ///< F_bar [N/m]
    Scalar tangent =
        std::numeric_limits<Scalar>::quiet_NaN();  ///< d force / d creepage at the end of the step [N]; for
                                                   ///< a rigid shift d force / d shift [N/m]
    StepStatus status = StepStatus::ok;
};

/// Everything that a step of a given dq needs, computed once: n^2 numbers. Const use is safe from several threads.
template <class Scalar>
class PreparedStep {
public:
    Scalar dq() const { return dq_; }  ///< distance rolled in the step [m]

private:
    Scalar dq_ = 0;
    // Columns [change, per_shift, per_ramp]: p_new - p = change p + per_shift (xi dq) + per_ramp (change of xi) dq.
    MatrixX<Scalar> map_;                              // n x (n+2) [-], [Pa/m], [Pa/m]
    Scalar force_per_shift_ = 0, force_per_ramp_ = 0;  // [N/m]

    template <class>
    friend class TransientModel;
};

/// Tag in place of a verdict: build the model whatever its eigenvalues.
struct Unchecked {};
inline constexpr Unchecked unchecked{};

/// The contact as a force element. Built once; const and free of caches, so threads may share it. SI units outside.
///
/// Invariant: G and G' are finite and square, the half-width is finite, and the scheme is stable as far as the verdict
/// says.
///
///     const TransientModel<double> model(contact, mesh, scheme, kernel, verdict);
///     State now = model.at_rest(), next = now;
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

    /// Takes creepage in the direction of the kernel, whose half-width must be the contact's in units of a. Throws
    /// std::invalid_argument unless the verdict is one of this scheme's eigenvalues and settles that none grows, where
    /// steady rolling shows that the scheme does not converge to full adhesion (Status::inconsistent), where the
    /// contact's half-width is infinite, and as assemble and require_stable_model do.
    template <class Scheme, LineKernel Kernel>
    TransientModel(const Contact<Scalar>& contact, const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel,
                   const StabilityVerdict& verdict, Integrator integrator = Integrator::sdirk2)
        : TransientModel(contact, mesh, scheme, kernel, unchecked, integrator) {
        require_stable(verdict);
    }

    /// The same whatever the eigenvalues.
    template <class Scheme, LineKernel Kernel>
    TransientModel(const Contact<Scalar>& contact, const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel,
                   Unchecked, Integrator integrator = Integrator::sdirk2)
        : TransientModel(contact, assemble_model(contact, mesh, scheme, kernel), unknown_widths(mesh, scheme),
                         unchecked, integrator) {}

    /// From ready matrices (G in units of a/G, G' in 1/G) and the widths of their elements (in units of a). Throws
    /// std::invalid_argument as above, and where sizes differ or an entry is not finite.
    TransientModel(const Contact<Scalar>& contact, InfluenceMatrices<Scalar> matrices, const ArrayX<Scalar>& widths,
                   const StabilityVerdict& verdict, Integrator integrator = Integrator::sdirk2)
        : TransientModel(contact, std::move(matrices), widths, unchecked, integrator) {
        require_stable(verdict);
    }

    /// The same whatever the eigenvalues.
    TransientModel(const Contact<Scalar>& contact, InfluenceMatrices<Scalar> matrices, const ArrayX<Scalar>& widths,
                   Unchecked, Integrator integrator = Integrator::sdirk2);

    Eigen::Index size() const { return areas_.size(); }  ///< number of unknown elements
    Integrator integrator() const { return integrator_; }

    /// No traction anywhere.
    State at_rest() const { return {VectorX<Scalar>::Zero(size())}; }

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

    void require_stable(const StabilityVerdict& verdict) const {
        detail::require(verdict.n == size(), "TransientModel", "n of the verdict", verdict.n,
                        "equal the number of unknown elements");
        detail::require(verdict.status == Status::ok, "TransientModel", "status of the verdict",
                        static_cast<int>(verdict.status), "be ok (0)");
        detail::require(verdict.unstable_count == 0, "TransientModel", "unstable_count", verdict.unstable_count,
                        "be 0: a mode of the scheme grows without bound");
        detail::require(verdict.uncertain_count == 0, "TransientModel", "uncertain_count", verdict.uncertain_count,
                        "be 0: rounding leaves open whether a mode grows");
        const Scalar share = detail::assisting_share<Scalar>(steady(1).traction, areas_);
        detail::require(share <= Scalar(detail::largest_assisting_share), "TransientModel",
                        "share of steady traction that pushes with the creepage", share,
                        "be at most 0.05: the scheme does not converge to full adhesion (alpha <= 0, or alpha > 1)");
    }
    static void require_finite_width(const Contact<Scalar>& contact) {
        detail::require(std::isfinite(contact.half_width()), "TransientModel", "half_width", contact.half_width(),
                        "be finite: an infinite one is for steady problems only");
    }

    template <class Scheme, class Kernel>
    static InfluenceMatrices<Scalar> assemble_model(const Contact<Scalar>& contact, const Mesh<Scalar>& mesh,
                                                    const Scheme& scheme, const Kernel& kernel) {
        require_finite_width(contact);
        require_stable_model(kernel);
        return assemble(mesh, scheme, kernel);
    }

    static constexpr std::size_t index(int j) { return static_cast<std::size_t>(j); }

    // Coefficients of (r(w) - 1)/w - 1 in y^j: the response to linear creepage.
    Scalar ramp_weight(int j) const { return gamma_ * (b_[index(j)] + b_[index(j + 1)]); }

    // e^w is taken for steps so short that the norm of w is at most 1/16: there the eighth order r(w) is exact to
    // rounding. The cap matters only where G is singular to rounding: what it leaves out decays at once.
    int count_doublings(Scalar h) const;

    static void solve(MatrixX<Scalar> matrix, MatrixX<Scalar>& right);

    StepStatus check(const State& from, Scalar dq, const Motion& motion, const State& to) const noexcept {
        if (&from == &to || from.traction.size() != size() || to.traction.size() != size()) {
            return StepStatus::wrong_state;
        }
        const bool valid = motion.kind_ == Motion::Kind::shift ? dq >= 0 : dq > 0;
        if (!valid || !std::isfinite(dq)) return StepStatus::invalid_step;
        if (!std::isfinite(motion.start_) || !std::isfinite(motion.end_)) return StepStatus::not_finite;
        return StepStatus::ok;
    }

    static Step failed(StepStatus status) noexcept {
        Step result;
        result.status = status;
        return result;
    }

    static Travel travel_of(const Motion& motion, Scalar dq) noexcept {
        switch (motion.kind_) {
            case Motion::Kind::shift: return {.shift = motion.start_, .ramp = 0, .shift_per_end = 1};
            case Motion::Kind::linear:
                return {.shift = motion.start_ * dq, .ramp = (motion.end_ - motion.start_) * dq, .ramp_per_end = dq};
            default: return {.shift = motion.start_ * dq, .ramp = 0, .shift_per_end = dq};
        }
    }

    Step finish(const State& from, const Travel& travel, Scalar force_per_shift, Scalar force_per_ramp,
                State& to) const noexcept {
        Step result;
        result.force = areas_.dot(to.traction);
        result.force_per_width = result.force / width_;
        result.tangent = travel.shift_per_end * force_per_shift + travel.ramp_per_end * force_per_ramp;
        if (std::isfinite(result.force) && std::isfinite(result.tangent)) return result;
        to.traction = from.traction;
        return failed(StepStatus::not_finite);
    }

    // What prepare() does for a whole matrix, for this one state. Apart from advance() so that only it needs the stack.
    [[gnu::noinline]] Step solve_step(const State& from, Scalar dq, const Travel& travel, State& to) const noexcept;

    Scalar half_length_, width_, traction_scale_;  // a [m], 2b [m], G/a [Pa/m]
    MatrixX<Scalar> G_, G_prime_;
    Integrator integrator_;
    VectorX<Scalar> areas_;  // 2b dx of each element [m^2]
    int stages_ = 1;
    Scalar gamma_ = 1;
    std::array<Scalar, 10> b_{};
};

template <class Scalar_>
TransientModel<Scalar_>::TransientModel(const Contact<Scalar>& contact, InfluenceMatrices<Scalar> matrices,
                                        const ArrayX<Scalar>& widths, Unchecked, Integrator integrator)
    : half_length_(contact.half_length()),
      width_(2 * contact.half_width()),
      traction_scale_(contact.shear_modulus() / contact.half_length()),
      G_(std::move(matrices.G)),
      G_prime_(std::move(matrices.G_prime)),
      integrator_(integrator) {
    require_finite_width(contact);
    const Eigen::Index n = widths.size();
    detail::require(n >= 1, "TransientModel", "number of elements", n, "be at least 1");
    for (const MatrixX<Scalar>* matrix : {&G_, &G_prime_}) {
        detail::require(matrix->rows() == n && matrix->cols() == n, "TransientModel", "size of a matrix",
                        matrix->rows() != n ? matrix->rows() : matrix->cols(), "equal the number of elements");
        const Scalar sum = matrix->sum();
        detail::require(std::isfinite(sum), "TransientModel", "sum of a matrix", sum, "be finite");
    }
    areas_ = width_ * half_length_ * widths.matrix();
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
    detail::require(std::isfinite(creepage), "TransientModel", "creepage", creepage, "be finite");
    MatrixX<Scalar> traction(size(), 1);
    traction.setConstant(creepage * traction_scale_ * half_length_);
    solve(G_prime_, traction);
    return {traction};
}

template <class Scalar_>
auto TransientModel<Scalar_>::prepare(Scalar dq) const -> Prepared {
    detail::require(dq >= 0 && std::isfinite(dq), "TransientModel", "dq", dq, "be finite and not negative");
    const Eigen::Index n = size();
    const int doublings = count_doublings(dq / half_length_);
    const Scalar h = std::ldexp(dq / half_length_, -doublings);

    // Powers of Y = gamma h (G - gamma h G')^-1 G' make the change of p; applied to the column beside it, those of
    // the creepage.
    MatrixX<Scalar> Y(n, n + 1);
    Y.leftCols(n) = gamma_ * h * G_prime_;
    Y.col(n).setConstant(gamma_);
    solve(G_ - gamma_ * h * G_prime_, Y);
    Prepared step;
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
    if (step.map_.rows() != n) return failed(StepStatus::wrong_state);
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
    MatrixX<Scalar> rates = G_prime_;
    solve(G_, rates);
    const Scalar norm = 16 * h * rates.cwiseAbs().colwise().sum().maxCoeff();
    return std::isfinite(norm) ? std::clamp(std::ilogb(norm) + 1, 0, 60) : 60;
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
    Eigen::Map<MatrixX<Scalar>>(memory.data(), n, n) = G_ - gamma_ * h * G_prime_;
    const detail::MatrixRef<Scalar> factors(Eigen::Map<MatrixX<Scalar>>(memory.data(), n, n));
    detail::factorise_in_place<Scalar>(factors, swaps.data());

    SmallVector unit = SmallVector::Constant(n, gamma_);
    detail::solve_in_place<Scalar>(factors, swaps.data(), unit);
    SmallVector right(n);
    SmallVector change(n);
    change.noalias() = G_prime_ * from.traction;
    change *= gamma_ * h;
    detail::solve_in_place<Scalar>(factors, swaps.data(), change);
    SmallVector per_shift = b_[1] * unit;
    SmallVector per_ramp = ramp_weight(1) * unit;
    to.traction = from.traction + b_[1] * change;
    for (int j = 2; j <= stages_; ++j) {
        right.noalias() = G_prime_ * unit;
        unit = gamma_ * h * right;
        detail::solve_in_place<Scalar>(factors, swaps.data(), unit);
        per_shift += b_[index(j)] * unit;
        per_ramp += ramp_weight(j) * unit;
        right.noalias() = G_prime_ * change;
        change = gamma_ * h * right;
        detail::solve_in_place<Scalar>(factors, swaps.data(), change);
        to.traction += b_[index(j)] * change;
    }
    to.traction -= traction_scale_ * (travel.shift * per_shift + travel.ramp * per_ramp);
    return finish(from, travel, -traction_scale_ * areas_.dot(per_shift), -traction_scale_ * areas_.dot(per_ramp), to);
}

}  // namespace rollbem
