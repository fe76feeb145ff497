// Stick and slip where the bound of each element depends on how fast it slips: rounds around a solver for given bounds.
// Knows neither rolling nor where the equations come from.
#pragma once

#include "../../detail/language.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../detail/in_place_lu.hpp"
#include "../../status.hpp"
#include "../../types.hpp"
#include "../slip_law.hpp"

namespace rollbem::detail {

/// Where the coefficient of an element comes from: after a time at its velocity of slip, from that of the particles that
/// have come to it.
template <class Scalar>
struct FrictionPassage {
    const VectorX<Scalar>& pressure;  ///< p_n/G; without pressure a coefficient is that at rest
    const VectorX<Scalar>& duration;  ///< [s]: how long a particle takes to come to the element
    const VectorX<Scalar>* before;  ///< mu it had there; null in steady rolling, where it is that of the element ahead
    Scalar velocity_per_slip;       ///< [m/s] by the solver's slip
};

/// What tangents are taken by.
template <class Slip>
struct FallingChange {
    using Vector = VectorX<typename Slip::Scalar>;

    const typename Slip::Vectors& constant;  ///< dc
    const Vector* before = nullptr;          ///< d mu_before of each particle; null for none
    const Vector* bound = nullptr;           ///< d bound while mu stays; null for none
};

/// Finds mu = kept(v) mu_before + (1 - kept(v)) mu_s(v), v the velocity of slip that bounds mu p_n lead to.
///
/// Newton's method on the difference of both sides, with a line search; the derivative is exact while no element begins
/// to slip or to stick. Where it stands still, a solution has usually vanished in a fold, and the next is far away: then
/// rounds of mu = right-hand side from the start on, which pass the bottleneck and find it, and Newton's method again.
/// All rounds are bounded. Where several solutions exist, it is one that this way leads to from the mu to start with.
///
/// `Slip` stands for the solver, in one direction or two: see ActiveSetSlip.
template <class Slip>
class FallingSet {
public:
    using Scalar = typename Slip::Scalar;
    using Solver = typename Slip::Solver;
    using Vectors = typename Slip::Vectors;
    using Index = Eigen::Index;
    using Vector = VectorX<Scalar>;
    using Matrix = MatrixX<Scalar>;

    struct Outcome {
        typename Slip::Outcome solution;  ///< of the last; rounds and pivots of all
        int solutions = 0;                ///< how often stick and slip were found
        Scalar change = 0;                ///< largest difference of both sides
    };

    explicit FallingSet(Index n)
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

    /// From `start` and the `friction` to start with, which becomes the result; matrices and constants of the solver are
    /// set. `friction` is finite and not negative.
    template <class Law>
    Outcome solve(const Law& law, const SlipMemory<Scalar>& memory, const FrictionPassage<Scalar>& passage,
                  const typename Slip::Start& start, Solver& solver, Vector& friction) noexcept {
        Outcome outcome;
        start_ = friction;
        slip_.begin(start);
        const Scalar rounding = 64 * static_cast<Scalar>(friction.size() + 10) * std::numeric_limits<Scalar>::epsilon();
        const Scalar largest = std::max(static_cast<Scalar>(law(Scalar(0))), friction.maxCoeff());
        Scalar settled = 0;  // what rounding explains; a law that rises may lead far above where it starts
        const auto find = [&](const Vector& mu) {
            tried_ = mu.cwiseProduct(passage.pressure);
            typename Slip::Outcome found = slip_.solve(tried_, solver);
            Slip::add(outcome.solution, found);
            outcome.solution = found;
            ++outcome.solutions;
            evaluate(law, memory, passage, solver, mu);
            outcome.change = largest_difference();
            settled = rounding * std::max(largest, mu.maxCoeff());
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

    /// dp and d mu that follow a change while no element changes its zone; of what was solved last. `friction_change` and
    /// `traction_change` must be none of those in `change`.
    template <class Law>
    void respond(const Law& law, const SlipMemory<Scalar>& memory, const FrictionPassage<Scalar>& passage,
                 Solver& solver, const Vector& friction, const FallingChange<Slip>& change, Vectors& traction_change,
                 Vector& friction_change) {
        factorise(law, memory, passage, solver, friction);
        const bool constant_only = change.before == nullptr && change.bound == nullptr;
        if (constant_only && answered_ && change.constant == asked_) {
            traction_change = answer_;
            friction_change = friction_answer_;
            return;
        }
        if (change.bound == nullptr) {
            solver.respond(change.constant, traction_change);
        } else {
            solver.respond(change.constant, *change.bound, traction_change);
        }
        slip_.change_size(solver, change.constant, traction_change, response_);
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
        if (change.bound != nullptr) tried_ += *change.bound;
        solver.respond(change.constant, tried_, traction_change);
        if (!constant_only) return;
        answered_ = true;
        asked_ = change.constant;
        answer_ = traction_change;
        friction_answer_ = friction_change;
    }

private:
    static constexpr int most_steps = 30, most_halvings = 8, most_restarts = 6, most_rounds = 600;

    // Velocities of slip, both sides' difference, and the derivatives of the right-hand side.
    template <class Law>
    void evaluate(const Law& law, const SlipMemory<Scalar>& memory, const FrictionPassage<Scalar>& passage,
                  const Solver& solver, const Vector& mu) {
        const auto at_rest = static_cast<Scalar>(law(Scalar(0)));
        Scalar ahead = at_rest;
        for (Index i = mu.size() - 1; i >= 0; --i) {
            const Scalar v = passage.velocity_per_slip * slip_.size(solver, i);
            velocity_[i] = v;
            if (passage.pressure[i] > 0) {
                const Scalar kept = memory.kept(v, passage.duration[i]);
                const Scalar before = passage.before == nullptr ? ahead : (*passage.before)[i];
                ahead = kept * before + (1 - kept) * (v == 0 ? at_rest : static_cast<Scalar>(law(v)));
            } else {
                ahead = at_rest;
            }
            residual_[i] = ahead - mu[i];
        }
    }

    // Not a number where any is none, which a maximum of Eigen's may pass over.
    Scalar largest_difference() const {
        return all_finite(residual_) ? residual_.cwiseAbs().maxCoeff() : std::numeric_limits<Scalar>::quiet_NaN();
    }

    template <class Law>
    static Scalar passed(const Law& law, const SlipMemory<Scalar>& memory, Scalar duration, Scalar before, Scalar v) {
        const Scalar kept = memory.kept(v, duration), now = static_cast<Scalar>(law(v));
        return kept * before + (1 - kept) * now;
    }

    /// Steps until settled, true; or until none brings the difference down.
    template <class Law, class Find>
    bool newton(const Law& law, const SlipMemory<Scalar>& memory, const FrictionPassage<Scalar>& passage,
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

    /// mu = right-hand side, until the difference has risen and come down again. Where it hardly changes from round to
    /// round, in the bottleneck, mu goes many rounds' way at once; where all that has not helped, a part of the way
    /// only.
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
            peak = std::max(peak, size);
            const bool passed = peak > 50 * scale && falling >= 25 && size < peak / 5;
            if (size <= settled || passed) break;
        }
        return std::max(scale, peak / 50);
    }

    // Newton's step: (1 - d right-hand side / d mu) step = difference. Coefficients of elements that stick act on
    // nothing.
    template <class Law>
    void linearise(const Law& law, const SlipMemory<Scalar>& memory, const FrictionPassage<Scalar>& passage,
                   Solver& solver, const Vector& mu) {
        factorise(law, memory, passage, solver, mu);
        step_ = residual_;
        spread(step_);
    }

    // To 30 bits, more than the difference quotients are good for: while nothing changes but by rounding, the derivatives
    // stay as they are, to the last bit, and all that is made of them.
    static Scalar rounded(Scalar x) {
        constexpr int digits = std::numeric_limits<Scalar>::digits;
        if constexpr (digits <= 30) {
            return x;
        } else {
            const Scalar high = x * static_cast<Scalar>((std::uint64_t(1) << (digits - 30)) + 1);
            return high - (high - x);
        }
    }

    // The derivatives of the right-hand sides by slip and by the coefficient ahead, and from them Newton's matrix,
    // unless it is the one there is. Slip of elements that stick stays zero.
    template <class Law>
    void factorise(const Law& law, const SlipMemory<Scalar>& memory, const FrictionPassage<Scalar>& passage,
                   Solver& solver, const Vector& mu) {
        slip_.linearise(solver);
        const bool steady = passage.before == nullptr;
        // differences as wide as the velocities at hand allow, for where an element hardly slips
        const Scalar unit = memory.least_velocity + rounded(velocity_.maxCoeff()) / 1000;
        const Scalar share = std::cbrt(std::numeric_limits<Scalar>::epsilon());
        Scalar ahead = static_cast<Scalar>(law(Scalar(0)));
        for (Index i = size() - 1; i >= 0; --i) {
            slope_[i] = kept_[i] = 0;
            const Scalar before = rounded(steady ? ahead : (*passage.before)[i]);
            if (steady) ahead = residual_[i] + mu[i];
            const bool slips = slip_.sense(solver)[i] != 0;
            if (!(passage.pressure[i] > 0) || !(slips || steady)) continue;
            const Scalar v = rounded(velocity_[i]), duration = passage.duration[i];
            if (steady) kept_[i] = memory.kept(v, duration);
            if (!slips) continue;
            const Scalar nearby = share * (v + unit) + std::numeric_limits<Scalar>::min();
            const Scalar low = std::max(v - nearby, Scalar(0)), high = v + nearby;
            slope_[i] = (passed(law, memory, duration, before, high) - passed(law, memory, duration, before, low)) /
                        (high - low);
        }
        step_ = passage.velocity_per_slip * slip_.sense(solver).cwiseProduct(slope_);
        right_ = -slip_.sense(solver).cwiseProduct(passage.pressure);
        if (newton_revision_ == slip_.revision() && is_steady_ == steady && newton_slope_ == step_ &&
            newton_gain_ == right_ && newton_kept_ == kept_) {
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
            if (!steady) {  // no element knows of the one ahead
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

    // What the coefficients change in all when by themselves they change by `change`, which it overwrites.
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

    static constexpr unsigned long never = std::numeric_limits<unsigned long>::max();

    Slip slip_;
    Vector start_, residual_, tried_, step_;
    Vector velocity_, slope_, kept_;  // v; d right-hand side / d v; and by that of the element ahead
    Vector response_;
    Matrix by_friction_, newton_;
    Vector right_;
    Vector newton_slope_, newton_gain_, newton_kept_;  // what by_friction_ and newton_ were made of
    unsigned long newton_revision_ = never;
    bool is_steady_ = false;
    std::vector<Index> swaps_;
    typename Slip::Vectors asked_, answer_;  // the last change of constants that respond() was asked for
    Vector friction_answer_;
    bool answered_ = false;  // with newton_ as it is
};

}  // namespace rollbem::detail
