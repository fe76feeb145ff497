// Stick and slip if the bound of each element depends on its slip velocity: iterations around a solver for given
// bounds. Independent of rolling and of the origin of the equations.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "../../detail/array_functions.hpp"
#include "../../detail/finite.hpp"
#include "../../detail/in_place_lu.hpp"
#include "../../status.hpp"
#include "../../types.hpp"
#include "../law.hpp"

namespace rollbem::detail {

/// What determines the coefficient of an element: that of the arriving particles before a period of slip.
template <class Scalar>
struct FrictionPassage {
    const VectorX<Scalar>& pressure;  ///< p_n/G; without pressure the coefficient is mu_s(0)
    const VectorX<Scalar>& duration;  ///< duration of the period [s]
    const VectorX<Scalar>* before;    ///< mu before it; null in steady rolling, where it is that of the element ahead
    Scalar velocity_per_slip;         ///< slip velocity [m/s] over the solver's slip
};

/// Derivatives with respect to the parameter of a tangent.
template <class Slip>
struct SlipDependentChange {
    using Vector = VectorX<typename Slip::Scalar>;

    const typename Slip::Vectors& constant;  ///< dc
    const Vector* before = nullptr;          ///< d mu_before of each particle; null for zero
    const Vector* bound = nullptr;           ///< d bound at constant mu; null for zero
};

/// Solves mu = kept(v) mu_before + (1 - kept(v)) mu_s(v), where v is the slip velocity for the bounds mu p_n.
///
/// Newton's method with a line search; the derivative is exact while no element changes its zone. If the iteration
/// stagnates, the solution has usually vanished in a fold and the next one is far away: fixed-point iterations from the
/// initial mu then pass the bottleneck and approach it, followed by Newton's method. All iterations are bounded. If
/// several solutions exist, the one found depends on the initial mu.
///
/// `Slip` represents the solver, in one direction or two: see ActiveSetSlip.
template <class Slip>
class SlipDependentSet {
public:
    using Scalar = typename Slip::Scalar;
    using Solver = typename Slip::Solver;
    using Vectors = typename Slip::Vectors;
    using Index = Eigen::Index;
    using Vector = VectorX<Scalar>;
    using Matrix = MatrixX<Scalar>;
    using Law = AnySlipLaw<Scalar>;

    struct Outcome {
        typename Slip::Outcome solution;  ///< of the last solution; rounds and pivots are those of all
        int solutions = 0;                ///< number of solutions for stick and slip
        Scalar change = 0;                ///< largest residual of the equation above
    };

    explicit SlipDependentSet(Index n)
        : slip_(n),
          start_(n),
          residual_(n),
          tried_(n),
          step_(n),
          velocity_(n),
          slope_(n),
          kept_(n),
          response_(n),
          by_friction_(n, n),
          newton_(n, n),
          right_(n),
          newton_slope_(n),
          newton_gain_(n),
          newton_kept_(n),
          swaps_(static_cast<std::size_t>(n)),
          asked_(Slip::zero(n)),
          answer_(asked_),
          friction_answer_(n) {}

    Index size() const { return start_.size(); }

    /// Starts from `start` and `friction`, finite and not negative, and overwrites `friction` with the result. Matrices
    /// and constants of the solver must be set.
    Outcome solve(const Law& law, const FrictionMemory<Scalar>& memory, const FrictionPassage<Scalar>& passage,
                  const typename Slip::Start& start, Solver& solver, Vector& friction) noexcept {
        Outcome outcome;
        start_ = friction;
        slip_.begin(start);
        const Scalar rounding = 64 * static_cast<Scalar>(friction.size() + 10) * std::numeric_limits<Scalar>::epsilon();
        const Scalar largest = (std::max)(law(0), friction.maxCoeff());
        Scalar settled = 0;  // what rounding explains; a law that rises may lead far above where it starts
        const auto find = [&](const Vector& mu) {
            tried_ = mu.cwiseProduct(passage.pressure);
            typename Slip::Outcome found = slip_.solve(tried_, solver);
            Slip::add(outcome.solution, found);
            outcome.solution = found;
            ++outcome.solutions;
            evaluate(law, memory, passage, solver, mu);
            outcome.change = largest_difference();
            settled = rounding * (std::max)(largest, mu.maxCoeff());
        };
        find(friction);
        Scalar scale = residual_.norm();
        for (int restart = 0;; ++restart) {
            if (newton(law, memory, passage, solver, settled, find, outcome, friction)) break;
            if (restart == most_restarts || !is_finite(outcome.change)) break;
            if (restart == 0) friction = start_;
            find(friction);
            scale = follow(settled, scale, restart, find, friction);
        }
        if (!(outcome.change <= settled)) {
            outcome.solution.status = is_finite(outcome.change) ? StepStatus::no_solution : StepStatus::not_finite;
            outcome.solution.tangent_exists = false;
        }
        return outcome;
    }

    /// dp and d mu in the last solution caused by a change, while no element changes its zone. `friction_change` and
    /// `traction_change` must not be vectors in `change`.
    void respond(const Law& law, const FrictionMemory<Scalar>& memory, const FrictionPassage<Scalar>& passage,
                 Solver& solver, const Vector& friction, const SlipDependentChange<Slip>& change,
                 Vectors& traction_change, Vector& friction_change) {
        factorise(law, memory, passage, solver, friction, true);
        const bool constant_only = Slip::directions == 1 && change.before == nullptr && change.bound == nullptr;
        if (constant_only && answered_ && same_bits(change.constant, asked_)) {
            traction_change = answer_;
            friction_change = friction_answer_;
            return;
        }
        slip_.respond(solver, change.constant, change.bound, traction_change, response_);
        Scalar ahead = 0;
        for (Index i = size() - 1; i >= 0; --i) {
            ahead = slope_[i] * passage.velocity_per_slip * response_[i] + kept_[i] * ahead;
            if (change.before != nullptr && passage.pressure[i] > 0) {
                ahead += memory.kept(rounded(velocity_[i]), passage.duration[i]) * (*change.before)[i];
            }
            friction_change[i] = ahead;
        }
        spread(friction_change);
        tried_ = friction_change.cwiseProduct(passage.pressure);
        slip_.add_response(solver, change.constant, change.bound, tried_, traction_change);
        if (!constant_only) return;
        answered_ = true;
        asked_ = change.constant;
        answer_ = traction_change;
        friction_answer_ = friction_change;
    }

private:
    static constexpr int most_steps = 30, most_halvings = 8, most_restarts = 6, most_rounds = 600;

    // Slip velocities and residual.
    void evaluate(const Law& law, const FrictionMemory<Scalar>& memory, const FrictionPassage<Scalar>& passage,
                  const Solver& solver, const Vector& mu) {
        const auto at_rest = law(0);
        Scalar ahead = at_rest;
        for (Index i = mu.size() - 1; i >= 0; --i) {
            const Scalar v = passage.velocity_per_slip * slip_.size(solver, i);
            velocity_[i] = v;
            if (passage.pressure[i] > 0) {
                const Scalar kept = memory.kept(v, passage.duration[i]);
                const Scalar before = passage.before == nullptr ? ahead : (*passage.before)[i];
                ahead = kept * before + (1 - kept) * (v == 0 ? at_rest : law(v));
            } else {
                ahead = at_rest;
            }
            residual_[i] = ahead - mu[i];
        }
    }

    // NaN if any entry is, which Eigen's maximum may pass over.
    Scalar largest_difference() const {
        return all_finite(residual_) ? residual_.cwiseAbs().maxCoeff() : std::numeric_limits<Scalar>::quiet_NaN();
    }

    static Scalar passed(const Law& law, const FrictionMemory<Scalar>& memory, Scalar duration, Scalar before,
                         Scalar v) {
        const Scalar kept = memory.kept(v, duration), now = law(v);
        return kept * before + (1 - kept) * now;
    }

    // Newton steps until the residual is small enough (true) or cannot be reduced.
    template <class Find>
    bool newton(const Law& law, const FrictionMemory<Scalar>& memory, const FrictionPassage<Scalar>& passage,
                Solver& solver, const Scalar& settled, const Find& find, const Outcome& outcome, Vector& friction) {
        for (int step = 0; step < most_steps; ++step) {
            if (outcome.change <= settled) return true;
            if (!is_finite(outcome.change)) return false;
            linearise(law, memory, passage, solver, friction);
            const Scalar size = residual_.norm();
            bool better = false;
            Scalar part = 1;
            right_ = friction;
            for (int halving = 0; halving < most_halvings && !better; ++halving, part /= 2) {
                friction = (right_ + part * step_).cwiseMax(Scalar(0));
                find(friction);
                better = residual_.norm() < (1 - part / 10) * size || outcome.change <= settled;
            }
            if (!better) return false;
        }
        return outcome.change <= settled;
    }

    // Fixed-point iterations until the residual has risen and fallen again. In the bottleneck, where it hardly changes,
    // the steps are enlarged; after unsuccessful restarts they are damped.
    template <class Find>
    Scalar follow(const Scalar& settled, Scalar scale, int restart, const Find& find, Vector& friction) {
        const Scalar part = restart < 2 ? Scalar(1) : restart < 4 ? Scalar(0.4) : Scalar(0.15);
        const int rounds = restart == 0 ? most_rounds : most_rounds / 3;
        Scalar before = residual_.norm(), peak = before;
        int falling = 0, flat = 0;
        Scalar leap = 10;
        for (int round = 0; round < rounds; ++round) {
            const bool leaps = flat >= 3;
            friction = (friction + (leaps ? leap : part) * residual_).cwiseMax(Scalar(0));
            find(friction);
            const Scalar size = residual_.norm();
            if (!is_finite(size)) break;
            leap = leaps ? 2 * leap : flat == 0 ? Scalar(10) : leap;
            flat = !leaps && std::abs(size - before) < before / 100 ? flat + 1 : leaps ? 1 : 0;
            falling = size < before ? falling + 1 : 0;
            before = size;
            peak = (std::max)(peak, size);
            const bool passed = peak > 50 * scale && falling >= 25 && size < peak / 5;
            if (size <= settled || passed) break;
        }
        return (std::max)(scale, peak / 50);
    }

    // Newton's step: (1 - d right-hand side / d mu) step = residual. The coefficients of sticking elements have no
    // influence.
    void linearise(const Law& law, const FrictionMemory<Scalar>& memory, const FrictionPassage<Scalar>& passage,
                   Solver& solver, const Vector& mu) {
        factorise(law, memory, passage, solver, mu, false);
        step_ = residual_;
        spread(step_);
    }

    // Rounds to 30 bits, which is within the accuracy of the difference quotients. While quantities change by round-off
    // only, the derivatives and everything computed from them then stay the same to the last bit.
    static Scalar rounded(Scalar x) {
        constexpr int digits = std::numeric_limits<Scalar>::digits;
        if constexpr (digits <= 30) {
            return x;
        } else {
            const Scalar high = x * static_cast<Scalar>((std::uint64_t(1) << (digits - 30)) + 1);
            return high - (high - x);
        }
    }

    // The derivatives of the right-hand side by the slip velocity and by the coefficient of the element ahead, and
    // Newton's matrix, which is factorised only if it has changed. The slip of sticking elements remains zero. Tangents
    // need the `exact` derivatives; Newton's method does without those of the angles of turned slip.
    void factorise(const Law& law, const FrictionMemory<Scalar>& memory, const FrictionPassage<Scalar>& passage,
                   Solver& solver, const Vector& mu, bool exact) {
        slip_.linearise(solver, exact);
        const bool steady = passage.before == nullptr;
        // differences of a width that also suits elements that hardly slip, and not that of a least velocity which is
        // far above any slip
        const Scalar fastest = rounded(velocity_.maxCoeff());
        const Scalar unit = (std::min)(memory.least_velocity, fastest) + fastest / 1000;
        const Scalar share = std::cbrt(std::numeric_limits<Scalar>::epsilon());
        Scalar ahead = law(0);
        for (Index i = size() - 1; i >= 0; --i) {
            slope_[i] = kept_[i] = 0;
            const Scalar before = rounded(steady ? ahead : (*passage.before)[i]);
            if (steady) ahead = residual_[i] + mu[i];
            const bool slips = slip_.sense(solver)[i] != 0;
            if (!(passage.pressure[i] > 0) || !(slips || steady)) continue;
            const Scalar v = rounded(velocity_[i]), duration = passage.duration[i];
            if (steady) kept_[i] = memory.kept(v, duration);
            if (!slips) continue;
            const Scalar nearby = share * (v + unit) + (std::numeric_limits<Scalar>::min)();
            const Scalar low = (std::max)(v - nearby, Scalar(0)), high = v + nearby;
            slope_[i] = (passed(law, memory, duration, before, high) - passed(law, memory, duration, before, low)) /
                        (high - low);
        }
        step_ = passage.velocity_per_slip * slip_.sense(solver).cwiseProduct(slope_);
        right_ = -slip_.sense(solver).cwiseProduct(passage.pressure);
        if (newton_revision_ == slip_.revision() && is_steady_ == steady && same_bits(newton_slope_, step_) &&
            same_bits(newton_gain_, right_) && (!steady || same_bits(newton_kept_, kept_))) {
            return;
        }
        answered_ = false;
        is_steady_ = steady;
        newton_revision_ = slip_.revision();
        newton_slope_ = step_;
        newton_gain_ = right_;
        newton_kept_ = kept_;
        const Matrix& slip_by_traction = slip_.by_traction();
        const Index count = slip_.slipping_count();
        for (Index k = 0; k < count; ++k) {
            const Scalar gain = right_[slip_.slipping(k)];
            if (!steady) {  // independent of the element ahead
                for (Index l = 0; l < count; ++l) {
                    const Index i = slip_.slipping(l);
                    newton_(l, k) = (k == l ? 1 : 0) - step_[i] * gain * slip_by_traction(i, k);
                }
                continue;
            }
            Scalar leading = 0;
            for (Index i = size() - 1; i >= 0; --i) {
                leading = step_[i] * gain * slip_by_traction(i, k) + kept_[i] * leading;
                by_friction_(i, k) = leading;
            }
            for (Index l = 0; l < count; ++l) {
                newton_(l, k) = (k == l ? 1 : 0) - by_friction_(slip_.slipping(l), k);
            }
        }
        factorise_in_place<Scalar>(newton_.topLeftCorner(count, count), swaps_.data());
    }

    // Overwrites direct changes of the coefficients with the total changes that they cause.
    void spread(Vector& change) {
        const Index count = slip_.slipping_count();
        for (Index k = 0; k < count; ++k) response_[k] = change[slip_.slipping(k)];
        solve_in_place<Scalar>(newton_.topLeftCorner(count, count), swaps_.data(), response_.head(count));
        if (is_steady_) {
            change.noalias() += by_friction_.leftCols(count) * response_.head(count);
        } else {
            for (Index k = 0; k < count; ++k) change[slip_.slipping(k)] = response_[k];
        }
    }

    static constexpr unsigned long never = (std::numeric_limits<unsigned long>::max)();

    Slip slip_;
    Vector start_, residual_, tried_, step_;
    Vector velocity_, slope_, kept_;  // v; d right-hand side / d v and / d mu of the element ahead
    Vector response_;
    Matrix by_friction_, newton_;
    Vector right_;
    Vector newton_slope_, newton_gain_, newton_kept_;  // for which by_friction_ and newton_ were computed
    unsigned long newton_revision_ = never;
    bool is_steady_ = false;
    std::vector<Index> swaps_;
    typename Slip::Vectors asked_, answer_;  // last argument and result of respond()
    Vector friction_answer_;
    bool answered_ = false;  // with the present newton_
};

}  // namespace rollbem::detail
