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
#include "../state.hpp"
#include "stick_slip.hpp"

namespace rollbem::detail {

/// What determines the coefficient of an element: that of the arriving particles before a period of slip.
template <class Scalar>
struct FrictionPassage {
    const AnySlipLaw<Scalar>& law;
    const FrictionMemory<Scalar>& memory;
    const VectorX<Scalar>& pressure;  ///< p_n/G; without pressure the coefficient is mu_s(0)
    const VectorX<Scalar>& duration;  ///< duration of the period [s]
    const VectorX<Scalar>* before;    ///< mu before it; null in steady rolling, where it is that of the element ahead
    Scalar velocity_per_slip;         ///< slip velocity [m/s] over the solver's slip
};

/// Derivatives with respect to the parameter of a tangent.
template <int directions, class Scalar>
struct SlipDependentChange {
    typename StickSlip<directions, Scalar>::Change direct;  ///< at constant mu
    const VectorX<Scalar>* before = nullptr;                ///< d mu_before of each particle; null for zero
};

/// Solves mu = kept(v) mu_before + (1 - kept(v)) mu_s(v), where v is the slip velocity for the bounds mu p_n.
///
/// Newton's method with a line search; the derivative is exact while no element changes its zone. If the iteration
/// stagnates, the solution has usually vanished in a fold and the next one is far away: fixed-point iterations from the
/// initial mu then pass the bottleneck and approach it, followed by Newton's method. All iterations are bounded. If
/// several solutions exist, the one found depends on the initial mu.
template <int directions, class Scalar>
class SlipDependentSet {
public:
    using Solver = StickSlip<directions, Scalar>;
    using Change = SlipDependentChange<directions, Scalar>;
    using Index = Eigen::Index;
    using Vector = VectorX<Scalar>;
    using Matrix = MatrixX<Scalar>;

    struct Outcome {
        typename Solver::Outcome solution;  ///< of the last solution; rounds and path points are those of all
        int solutions = 0;                  ///< number of solutions for stick and slip
        Scalar change = 0;                  ///< largest residual of the equation above
    };

    explicit SlipDependentSet(Index n)
        : start_(n),
          residual_(n),
          tried_(n),
          step_(n),
          velocity_(n),
          slope_(n),
          kept_(n),
          response_(n),
          coupling_(n, n),
          by_friction_(n, n),
          newton_(n, n),
          right_(n),
          newton_slope_(n),
          newton_gain_(n),
          newton_kept_(n),
          swaps_(static_cast<std::size_t>(n)) {}

    Index size() const { return start_.size(); }

    /// Starts from `start` and `friction`, finite and not negative, and overwrites `friction` with the result. Matrices
    /// and constants of the solver must be set.
    Outcome solve(const FrictionPassage<Scalar>& passage, const typename Solver::Start& start, Solver& solver,
                  Vector& friction) noexcept {
        Outcome outcome;
        start_ = friction;
        solver.begin(start);
        const Scalar rounding = 64 * static_cast<Scalar>(friction.size() + 10) * std::numeric_limits<Scalar>::epsilon();
        const Scalar largest = (std::max)(passage.law(0), friction.maxCoeff());
        Scalar settled = 0;  // what rounding explains; a law that rises may lead far above where it starts
        const auto find = [&](const Vector& mu) {
            tried_ = mu.cwiseProduct(passage.pressure);
            typename Solver::Outcome found = solver.solve(tried_);
            found.rounds += outcome.solution.rounds;
            found.path_points += outcome.solution.path_points;
            outcome.solution = found;
            is_regular_ = found.tangent_exists;
            ++outcome.solutions;
            evaluate(passage, solver, mu);
            outcome.change = largest_difference();
            settled = rounding * (std::max)(largest, mu.maxCoeff());
        };
        find(friction);
        Scalar scale = residual_.norm();
        for (int restart = 0;; ++restart) {
            if (newton(passage, solver, settled, find, outcome, friction)) break;
            if (restart == most_restarts || !is_finite(outcome.change)) break;
            if (restart == 0) friction = start_;
            find(friction);
            scale = follow(settled, scale, restart, find, friction);
        }
        if (!(outcome.change <= settled)) {
            outcome.solution.status = is_finite(outcome.change) ? Status::no_solution : Status::not_finite;
            outcome.solution.tangent_exists = false;
        }
        return outcome;
    }

    /// Finds dp in the solver, and d mu, of the last solution due to a change while no element changes its zone.
    /// `friction_change` must not be a vector in `change`.
    void respond(const FrictionPassage<Scalar>& passage, Solver& solver, const Vector& friction, const Change& change,
                 Vector& friction_change) {
        factorise(passage, solver, friction, true);
        solver.respond(change.direct, &response_);
        Scalar ahead = 0;
        for (Index i = size() - 1; i >= 0; --i) {
            ahead = slope_[i] * passage.velocity_per_slip * response_[i] + kept_[i] * ahead;
            if (change.before != nullptr && passage.pressure[i] > 0) {
                ahead += passage.memory.kept(rounded(velocity_[i]), passage.duration[i]) * (*change.before)[i];
            }
            friction_change[i] = ahead;
        }
        spread(solver, friction_change);
        tried_ = friction_change.cwiseProduct(passage.pressure);
        if (change.direct.bound != nullptr) tried_ += *change.direct.bound;
        solver.respond({change.direct.constant, &tried_});
    }

private:
    static constexpr int most_steps = 30, most_halvings = 8, most_restarts = 6, most_rounds = 600;

    // Slip velocities and residual.
    void evaluate(const FrictionPassage<Scalar>& passage, const Solver& solver, const Vector& mu) {
        const auto at_rest = passage.law(0);
        Scalar ahead = at_rest;
        for (Index i = mu.size() - 1; i >= 0; --i) {
            const Scalar v = passage.velocity_per_slip * solver.slip_size(i);
            velocity_[i] = v;
            if (passage.pressure[i] > 0) {
                const Scalar kept = passage.memory.kept(v, passage.duration[i]);
                const Scalar before = passage.before == nullptr ? ahead : (*passage.before)[i];
                ahead = kept * before + (1 - kept) * (v == 0 ? at_rest : passage.law(v));
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

    static Scalar passed(const FrictionPassage<Scalar>& passage, Scalar duration, Scalar before, Scalar v) {
        const Scalar kept = passage.memory.kept(v, duration), now = passage.law(v);
        return kept * before + (1 - kept) * now;
    }

    // Newton steps until the residual is small enough (true) or cannot be reduced.
    template <class Find>
    bool newton(const FrictionPassage<Scalar>& passage, Solver& solver, const Scalar& settled, const Find& find,
                const Outcome& outcome, Vector& friction) {
        for (int step = 0; step < most_steps; ++step) {
            if (outcome.change <= settled) return true;
            if (!is_finite(outcome.change)) return false;
            linearise(passage, solver, friction);
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
    void linearise(const FrictionPassage<Scalar>& passage, Solver& solver, const Vector& mu) {
        factorise(passage, solver, mu, false);
        step_ = residual_;
        spread(solver, step_);
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
    void factorise(const FrictionPassage<Scalar>& passage, Solver& solver, const Vector& mu, bool exact) {
        couple(solver, exact);
        const bool steady = passage.before == nullptr;
        // differences of a width that also suits elements that hardly slip, and not that of a least velocity which is
        // far above any slip
        const Scalar fastest = rounded(velocity_.maxCoeff());
        const Scalar unit = (std::min)(passage.memory.least_velocity, fastest) + fastest / 1000;
        const Scalar share = std::cbrt(std::numeric_limits<Scalar>::epsilon());
        Scalar ahead = passage.law(0);
        for (Index i = size() - 1; i >= 0; --i) {
            slope_[i] = kept_[i] = 0;
            const Scalar before = rounded(steady ? ahead : (*passage.before)[i]);
            if (steady) ahead = residual_[i] + mu[i];
            const bool slips = solver.slides()[i] != 0;
            if (!(passage.pressure[i] > 0) || !(slips || steady)) continue;
            const Scalar v = rounded(velocity_[i]), duration = passage.duration[i];
            if (steady) kept_[i] = passage.memory.kept(v, duration);
            if (!slips) continue;
            const Scalar nearby = share * (v + unit) + (std::numeric_limits<Scalar>::min)();
            const Scalar low = (std::max)(v - nearby, Scalar(0)), high = v + nearby;
            slope_[i] =
                (passed(passage, duration, before, high) - passed(passage, duration, before, low)) / (high - low);
        }
        step_ = passage.velocity_per_slip * solver.slides().cwiseProduct(slope_);
        right_ = -solver.slides().cwiseProduct(passage.pressure);
        if (newton_revision_ == coupling_revision_ && is_steady_ == steady && same_bits(newton_slope_, step_) &&
            same_bits(newton_gain_, right_) && (!steady || same_bits(newton_kept_, kept_))) {
            return;
        }
        is_steady_ = steady;
        newton_revision_ = coupling_revision_;
        newton_slope_ = step_;
        newton_gain_ = right_;
        newton_kept_ = kept_;
        for (Index k = 0; k < count_; ++k) {
            const Scalar gain = right_[solver.slipping(k)];
            if (!steady) {  // independent of the element ahead
                for (Index l = 0; l < count_; ++l) {
                    newton_(l, k) = (k == l ? 1 : 0) - step_[solver.slipping(l)] * gain * coupling_(l, k);
                }
                continue;
            }
            Scalar leading = 0;
            Index next = count_ - 1;
            for (Index i = size() - 1; i >= 0; --i) {
                leading *= kept_[i];
                if (next >= 0 && solver.slipping(next) == i) leading += step_[i] * gain * coupling_(next--, k);
                by_friction_(i, k) = leading;
            }
            for (Index l = 0; l < count_; ++l) newton_(l, k) = (k == l ? 1 : 0) - by_friction_(solver.slipping(l), k);
        }
        factorise_in_place<Scalar>(newton_.topLeftCorner(count_, count_), swaps_.data());
    }

    // The slip of the elements that slide by their bounds, in coupling_. If there is no tangent, the derivatives are
    // those without slip. Angles of turned slip follow if it has to be `exact`.
    void couple(Solver& solver, bool exact) {
        const std::uint64_t kind = is_regular_ ? exact && solver.angles_follow() ? 2 : 1 : 0;
        const std::uint64_t revision = 3 * solver.revision() + kind;
        if (coupling_revision_ == revision) return;
        coupling_revision_ = revision;
        count_ = is_regular_ ? solver.slipping_count() : 0;
        if (is_regular_) solver.couple(exact, coupling_, newton_, by_friction_);
    }

    // Overwrites direct changes of the coefficients with the total changes that they cause.
    void spread(const Solver& solver, Vector& change) {
        for (Index k = 0; k < count_; ++k) response_[k] = change[solver.slipping(k)];
        solve_in_place<Scalar>(newton_.topLeftCorner(count_, count_), swaps_.data(), response_.head(count_));
        if (is_steady_) {
            change.noalias() += by_friction_.leftCols(count_) * response_.head(count_);
        } else {
            for (Index k = 0; k < count_; ++k) change[solver.slipping(k)] = response_[k];
        }
    }

    static constexpr std::uint64_t never = (std::numeric_limits<std::uint64_t>::max)();

    Vector start_, residual_, tried_, step_;
    Vector velocity_, slope_, kept_;  // v; d right-hand side / d v and / d mu of the element ahead
    Vector response_;
    Matrix coupling_, by_friction_, newton_;
    Vector right_;
    Vector newton_slope_, newton_gain_, newton_kept_;  // for which by_friction_ and newton_ were computed
    std::uint64_t coupling_revision_ = never, newton_revision_ = never;
    Index count_ = 0;  // of the elements that slide
    bool is_regular_ = false, is_steady_ = false;
    std::vector<Index> swaps_;
};

}  // namespace rollbem::detail
