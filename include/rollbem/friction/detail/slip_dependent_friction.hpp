// Friction that depends on slip: iterations for the coefficients around a solver of stick and slip, which do not know
// rolling, and the evolution of the coefficients through the stages of a step.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "../../detail/array_functions.hpp"
#include "../../detail/finite.hpp"
#include "../../detail/in_place_lu.hpp"
#include "../../rolling/detail/time_step.hpp"
#include "../../status.hpp"
#include "../../system/detail/along_contact.hpp"
#include "../../system/rolling_system.hpp"
#include "../../types.hpp"
#include "../law.hpp"
#include "../state.hpp"
#include "stick_slip.hpp"

namespace rollbem::detail {

/// The data that determine the friction coefficient of each element: particles arrive with a coefficient and slip for a
/// period. References to values of the caller, made on the stack for one call.
struct FrictionEvolution {
    const Friction::Law& law;
    const Friction::Memory& memory;
    const VectorX<double>& duration;  ///< of the period [s]
    const VectorX<double>* before;    ///< mu before the period; null in steady rolling: mu of the element ahead
    const VectorX<double>& pressure;  ///< p_n/G; without pressure the coefficient is mu_s(0)
    double velocity_per_slip;         ///< slip velocity [m/s] over the solver's slip

    bool has_pressure(Index i) const { return pressure[i] > 0; }

    double kept(Index i, double v) const { return memory.kept(v, duration[i]); }
    /// mu after the period at a slip velocity v.
    double after(Index i, double mu_before, double v) const {
        const double share = kept(i, v);
        return share * mu_before + (1 - share) * (v == 0 ? law.at_rest() : law.of_slip()(v));
    }
};

/// Solves mu = kept(v) mu_before + (1 - kept(v)) mu_s(v), where v is the slip velocity for the bounds mu p_n.
///
/// Newton's method with a line search; the derivative is exact while no element changes its zone. If the iteration
/// stagnates, the solution has usually vanished in a fold and the next one is far away: fixed-point iterations from the
/// initial mu then pass the bottleneck and approach it, followed by Newton's method. All iterations are bounded. If
/// several solutions exist, the one found depends on the initial mu.
template <int directions>
class SlipDependentFriction {
public:
    using Stage = StageView<directions>;
    using Solution = StageSolution<directions>;
    using Matrix = MatrixX<double>;

    explicit SlipDependentFriction(Index n)
        : coupling_(n, n), by_friction_(n, n), newton_(n, n), swaps_(static_cast<std::size_t>(n)) {
        for (VectorX<double>* vector : {&start_, &mu_, &residual_, &tried_, &step_, &velocity_, &slope_, &kept_,
                                        &response_, &gain_, &newton_slope_, &newton_gain_, &newton_kept_}) {
            vector->setZero(n);
        }
    }

    Index size() const { return start_.size(); }

    /// Starts from `friction`, finite and not negative, and overwrites it with the result, and the bounds of the
    /// problem. StickSlipSolver::start() comes first. Returns the number of solutions for stick and slip.
    int solve(const FrictionEvolution& evolution, const Stage& stage, VectorX<double>& friction) noexcept {
        Search search{evolution, stage, friction, (std::max)(evolution.law.at_rest(), friction.maxCoeff())};
        Solution& solution = stage.solution;
        start_ = friction;
        find(search);
        double scale = residual_.norm();
        for (int restart = 0; !newton(search) && restart < most_restarts && is_finite(search.change); ++restart) {
            if (restart == 0) friction = start_;
            find(search);
            scale = iterate_fixed_point(search, scale, restart);
        }
        if (!search.has_converged()) {
            solution.status = is_finite(search.change) ? Status::no_solution : Status::not_finite;
            solution.has_tangent = false;
        }
        solution.at_once = false;  // bounds change after start()
        solution.rounds = search.rounds;
        solution.path_points = search.path_points;
        solution.residual = is_finite(search.change) ? (std::max)(solution.residual, search.change) : search.change;
        return search.solutions;
    }

    /// To be called before respond(). Returns a number that changes whenever respond() may differ.
    std::uint64_t linearise(const FrictionEvolution& evolution, const Stage& stage) {
        factorise(evolution, stage, true);
        return revision_;
    }
    /// Finds the response of the last solution while no element changes its zone: dp of each pass, and d mu in
    /// `friction_change`. The causes are a change of the problem at constant mu and, unless null, the change `before`
    /// of each particle's mu_before. `friction_change` must differ from all vectors of the causes.
    void respond(const FrictionEvolution& evolution, const Stage& stage, const ProblemChange<directions>& change,
                 const VectorX<double>* before, VectorX<double>& friction_change, PerPass<directions>& dp) {
        auto& solver = stage.solver;
        solver.respond(stage.problem, stage.solution, change, stage.centres, dp, &response_);
        double ahead = 0;
        for (Index i = size() - 1; i >= 0; --i) {
            ahead = slope_[i] * response_[i] + kept_[i] * ahead;
            if (before != nullptr && evolution.has_pressure(i)) {
                ahead += evolution.kept(i, rounded(velocity_[i])) * (*before)[i];
            }
            friction_change[i] = ahead;
        }
        find_total_change(solver, friction_change);
        tried_ = friction_change.cwiseProduct(evolution.pressure);
        if (change.bound != nullptr) tried_ += *change.bound;
        solver.respond(stage.problem, stage.solution, {change.constant, &tried_}, stage.centres, dp);
    }

private:
    static constexpr int most_steps = 30, most_halvings = 8, most_restarts = 6, most_rounds = 600;

    struct Search {
        const FrictionEvolution& evolution;
        const Stage& stage;
        VectorX<double>& friction;
        double largest;        // mu at rest or at the start; a rising law may lead far above it
        double tolerance = 0;  // residual that rounding explains
        double change = 0;     // largest residual of the equation above
        int solutions = 0, rounds = 0, path_points = 0;

        bool has_converged() const { return change <= tolerance; }
    };

    // Solves for the bounds of the present mu.
    void find(Search& search) {
        const auto& [problem, centres, solver, solution] = search.stage;
        problem.bound = search.friction.cwiseProduct(search.evolution.pressure);
        ++problem.bounds;
        solver.solve(problem, centres, true, solution);
        search.rounds += solution.rounds;
        search.path_points += solution.path_points;
        is_regular_ = solution.has_tangent;
        ++search.solutions;
        evaluate(search);
        // Eigen's maximum may pass over NaN
        search.change =
            all_finite(residual_) ? residual_.cwiseAbs().maxCoeff() : std::numeric_limits<double>::quiet_NaN();
        search.tolerance = 64 * static_cast<double>(size() + 10) * std::numeric_limits<double>::epsilon() *
                           (std::max)(search.largest, search.friction.maxCoeff());
    }

    // Finds slip velocities, right-hand side and residual.
    void evaluate(const Search& search) {
        const FrictionEvolution& evolution = search.evolution;
        double ahead = evolution.law.at_rest();
        for (Index i = size() - 1; i >= 0; --i) {
            velocity_[i] = evolution.velocity_per_slip * search.stage.solution.slip_size(i);
            const double before = evolution.before == nullptr ? ahead : (*evolution.before)[i];
            mu_[i] = ahead =
                evolution.has_pressure(i) ? evolution.after(i, before, velocity_[i]) : evolution.law.at_rest();
            residual_[i] = ahead - search.friction[i];
        }
    }

    // Takes Newton steps until the residual is small enough (true) or cannot be reduced: (1 - d right-hand side / d mu)
    // step = residual. The coefficients of sticking elements have no influence.
    bool newton(Search& search) {
        for (int step = 0; step < most_steps; ++step) {
            if (search.has_converged()) return true;
            if (!is_finite(search.change)) return false;
            factorise(search.evolution, search.stage, false);
            step_ = residual_;
            find_total_change(search.stage.solver, step_);
            const double size = residual_.norm();
            bool better = false;
            double part = 1;
            gain_ = search.friction;
            for (int halving = 0; halving < most_halvings && !better; ++halving, part /= 2) {
                search.friction = (gain_ + part * step_).cwiseMax(0.0);
                find(search);
                better = residual_.norm() < (1 - part / 10) * size || search.has_converged();
            }
            if (!better) return false;
        }
        return search.has_converged();
    }

    // Fixed-point iterations until the residual has risen and fallen again. In the bottleneck, where it hardly changes,
    // the steps are enlarged; after unsuccessful restarts they are damped.
    double iterate_fixed_point(Search& search, double scale, int restart) {
        const double part = restart < 2 ? 1.0 : restart < 4 ? 0.4 : 0.15;
        const int rounds = restart == 0 ? most_rounds : most_rounds / 3;
        double before = residual_.norm(), peak = before;
        int falling = 0, flat = 0;
        double leap = 10;
        for (int round = 0; round < rounds; ++round) {
            const bool leaps = flat >= 3;
            search.friction = (search.friction + (leaps ? leap : part) * residual_).cwiseMax(0.0);
            find(search);
            const double size = residual_.norm();
            if (!is_finite(size)) break;
            leap = leaps ? 2 * leap : flat == 0 ? 10.0 : leap;
            flat = !leaps && std::abs(size - before) < before / 100 ? flat + 1 : leaps ? 1 : 0;
            falling = size < before ? falling + 1 : 0;
            before = size;
            peak = (std::max)(peak, size);
            const bool passed = peak > 50 * scale && falling >= 25 && size < peak / 5;
            if (size <= search.tolerance || passed) break;
        }
        return (std::max)(scale, peak / 50);
    }

    // Rounds to 30 bits, which is within the accuracy of the difference quotients. While quantities change by round-off
    // only, the derivatives and everything computed from them then stay the same to the last bit.
    static double rounded(double x) {
        const double high = x * static_cast<double>((std::uint64_t(1) << 23) + 1);
        return high - (high - x);
    }

    // Finds the derivatives of the last solution's right-hand side by the slip and, in steady rolling, by the
    // coefficient of the element ahead. The slip of sticking elements remains zero.
    void differentiate(const FrictionEvolution& evolution, const Solution& solution) {
        const bool steady = evolution.before == nullptr;
        // the width of the differences must suit elements that hardly slip, and ignore a least velocity far above any
        // slip
        const double fastest = rounded(velocity_.maxCoeff());
        const double unit = (std::min)(evolution.memory.least_velocity, fastest) + fastest / 1000;
        const double share = std::cbrt(std::numeric_limits<double>::epsilon());
        for (Index i = 0; i < size(); ++i) {
            slope_[i] = kept_[i] = 0;
            if (!evolution.has_pressure(i)) continue;
            const double v = rounded(velocity_[i]);
            if (steady) kept_[i] = evolution.kept(i, v);
            if (solution.slides[i] == 0) continue;
            const double ahead = i + 1 < size() ? mu_[i + 1] : evolution.law.at_rest();
            const double before = rounded(steady ? ahead : (*evolution.before)[i]);
            const double nearby = share * (v + unit) + (std::numeric_limits<double>::min)();
            const double low = (std::max)(v - nearby, 0.0), high = v + nearby;
            slope_[i] = evolution.velocity_per_slip *
                        ((evolution.after(i, before, high) - evolution.after(i, before, low)) / (high - low));
        }
    }

    // Factorises Newton's matrix, if it has changed. Tangents need the `exact` derivatives; Newton's method leaves out
    // the derivatives of the angles of rotated slip.
    void factorise(const FrictionEvolution& evolution, const Stage& stage, bool exact) {
        const auto& solver = stage.solver;
        find_coupling(stage, exact);
        differentiate(evolution, stage.solution);
        gain_ = -stage.solution.slides.cwiseProduct(evolution.pressure);
        if (newton_revision_ == coupling_revision_ && same_bits(newton_slope_, slope_) &&
            same_bits(newton_gain_, gain_) && same_bits(newton_kept_, kept_)) {
            return;
        }
        ++revision_;
        newton_revision_ = coupling_revision_;
        newton_slope_ = slope_;
        newton_gain_ = gain_;
        newton_kept_ = kept_;
        for (Index k = 0; k < count_; ++k) {
            double leading = 0;
            Index next = count_ - 1;
            for (Index i = size() - 1; i >= 0; --i) {
                leading *= kept_[i];
                if (next >= 0 && solver.sliding(next) == i) {
                    leading += slope_[i] * gain_[solver.sliding(k)] * coupling_(next--, k);
                }
                by_friction_(i, k) = leading;
            }
            for (Index l = 0; l < count_; ++l) newton_(l, k) = (k == l ? 1 : 0) - by_friction_(solver.sliding(l), k);
        }
        factorise_in_place<double>(newton_.topLeftCorner(count_, count_), swaps_.data());
    }

    // Finds in coupling_ the derivatives of the sliding elements' slip by their bounds. If there is no tangent, no
    // element counts as sliding. `exact` includes the angles of rotated slip.
    void find_coupling(const Stage& stage, bool exact) {
        const auto& [problem, centres, solver, solution] = stage;
        const std::uint64_t kind = is_regular_ ? exact && solution.rotation.follows() ? 2 : 1 : 0;
        const std::uint64_t revision = 3 * solution.revision + kind;
        if (coupling_revision_ == revision) return;
        coupling_revision_ = revision;
        count_ = is_regular_ ? solver.sliding_count() : 0;
        if (is_regular_) solver.find_slip_by_bounds(solution, centres, exact, coupling_, newton_, by_friction_);
    }

    // Overwrites direct changes of the coefficients with the total changes that they cause.
    void find_total_change(const StickSlipSolver<directions>& solver, VectorX<double>& change) {
        for (Index k = 0; k < count_; ++k) response_[k] = change[solver.sliding(k)];
        solve_in_place<double>(newton_.topLeftCorner(count_, count_), swaps_.data(), response_.head(count_));
        change.noalias() += by_friction_.leftCols(count_) * response_.head(count_);
    }

    static constexpr std::uint64_t never = (std::numeric_limits<std::uint64_t>::max)();

    VectorX<double> start_, mu_, residual_, tried_, step_;
    VectorX<double> velocity_, slope_, kept_;  // v; d right-hand side / d slip and / d mu of the element ahead
    VectorX<double> response_, gain_;
    Matrix coupling_, by_friction_, newton_;
    VectorX<double> newton_slope_, newton_gain_, newton_kept_;  // data of the present by_friction_ and newton_
    std::uint64_t coupling_revision_ = never, newton_revision_ = never, revision_ = 0;
    Index count_ = 0;  // number of elements that slide
    bool is_regular_ = false;
    std::vector<Index> swaps_;
};

/// Memory for a coefficient that depends on slip, allocated by the constructor; of size 0 if mu is constant.
template <int directions>
struct CoefficientScratch {
    explicit CoefficientScratch(Index n) : iteration(n) {
        for (VectorX<double>* vector : {&friction, &pressure, &duration, &before, &increment, &first, &change, &bound,
                                        &path_change, &before_change}) {
            vector->setZero(n);
        }
        carried.fill(change);
    }

    SlipDependentFriction<directions> iteration;
    VectorX<double> friction, pressure;  ///< mu and p_n/G of the stage
    VectorX<double> duration, before;    ///< of the stage; mu of each particle before it
    VectorX<double> increment;           ///< change of mu along the paths of particles in the first of two stages
    VectorX<double> first;               ///< mu after the first of two stages
    VectorX<double> change;              ///< d mu of the last tangent
    VectorX<double> bound;               ///< d bound of the last tangent at constant mu
    VectorX<double> path_change;         ///< d before by the half-length, on which the paths of the particles depend
    VectorX<double> before_change;       ///< d before of the last tangent
    std::array<VectorX<double>, Parameters<directions>::count> carried;  ///< d increment of each tangent
    /// Whether Newton's method has converged after few solutions. A second stage then starts from mu at the start of
    /// the step, which is nearer to the solution than mu of the first stage if little changes; after a jump mu of the
    /// first stage is nearer.
    bool converged_quickly = false;
    bool moves_paths = false;  ///< the last tangent was by the half-length
};

/// mu of particles that roll through the contact, integrated along the path of each by the same stages as the
/// tractions. References to values of the caller, made on the stack for one step; bounds are p_n/G.
template <int directions>
struct Coefficients {
    using Step = TimeStep<directions>;
    using Stage = detail::Stage<directions>;

    const Friction::Law& law;
    const Friction::Memory& memory;
    const Elements<double>& elements;
    const Step& step;
    const FrictionState& from;
    CoefficientScratch<directions>& own;

    /// To be called before a stage is solved. In steady rolling particles arrive from the collocation point ahead.
    void enter(const Stage& now) {
        if (!now.place.is_second) {
            own.friction = from.friction_coefficient.matrix();
            own.converged_quickly = own.moves_paths = false;
        }
        if (step.steady) {
            const ArrayX<double>& ways = elements.intervals.size() > 0 ? elements.intervals : elements.areas;
            own.duration = now.geometry.half_length * step.unit / step.speed * ways.matrix();
            return;
        }
        own.duration.setConstant(now.place.part * step.duration);
        const ArrayX<double>& first_guess = from.solver.stage_coefficient;
        if (!now.place.is_last() && first_guess.size() == size()) own.friction = first_guess.matrix();
        if (!remembers()) return own.before.setZero(), void();
        AlongContact<double> at_start = along_start();
        if (!now.place.is_second) {
            for (Index i = 0; i < size(); ++i) own.before[i] = at_start(origin(now, i)).value;
            return;
        }
        own.increment = own.friction - own.before;
        if (own.converged_quickly) own.friction = from.friction_coefficient.matrix();
        AlongContact<double> increment = along_first(own.increment);
        for (Index i = 0; i < size(); ++i) {
            // extrapolation may overshoot if much is forgotten in a step
            const double before = at_start(origin(now, i)).value + now.place.ratio() * increment(between(now, i)).value;
            own.before[i] = (std::max)(before, 0.0);
        }
    }

    void solve(const Stage& now, const StageView<directions>& stage) {
        const int solutions = own.iteration.solve(evolution(now), stage, own.friction);
        own.converged_quickly = solutions <= 4 && (own.converged_quickly || !now.place.is_second);
        if (!now.place.is_second) own.first = own.friction;
    }

    /// To be called before respond(). Returns a number that changes whenever the response to a change of c may change;
    /// 0 if there is no such number.
    std::uint64_t linearise(const Stage& now, const StageView<directions>& stage) {
        const std::uint64_t revision = own.iteration.linearise(evolution(now), stage);
        return remembers() && now.place.is_second ? 0 : revision;
    }
    /// Finds dp of the last solved stage by a parameter. Its causes are
    /// - a change of the problem, with the change of p_n/G in place of the bounds,
    /// - the change of the particles' paths, if the parameter is the half-length,
    /// - in the second stage the response of the first, kept by carry().
    void respond(const Stage& now, std::size_t parameter, const ProblemChange<directions>& change,
                 const StageView<directions>& stage, PerPass<directions>& dp) {
        ProblemChange<directions> direct = change;
        const VectorX<double>* before = nullptr;
        own.moves_paths = remembers() && parameter == Parameters<directions>::half_length;
        if (own.moves_paths || (remembers() && now.place.is_second)) {
            own.moves_paths ? find_path_change(now) : void(own.path_change.setZero());
            own.before_change = own.path_change;
            if (now.place.is_second) add_carried(now, parameter);
            before = &own.before_change;
        }
        if (change.bound != nullptr) {
            own.bound = own.friction.cwiseProduct(*change.bound);
            direct.bound = &own.bound;
        }
        own.iteration.respond(evolution(now), stage, direct, before, own.change, dp);
    }
    /// Keeps the response of the first of two stages, on which the response of the second depends.
    void carry(std::size_t parameter) {
        own.carried[parameter] = own.change;
        if (own.moves_paths) own.carried[parameter] -= own.path_change;
    }

private:
    Index size() const { return own.friction.size(); }
    bool remembers() const { return memory.distance > 0 && !step.steady; }

    FrictionEvolution evolution(const Stage& now) const {
        const double per_slip = step.steady ? step.speed : step.unit / (now.place.part * step.duration);
        return {law, memory, own.duration, step.steady ? nullptr : &own.before, own.pressure, per_slip};
    }

    AlongContact<double> along_start() const { return {elements.x, from.friction_coefficient.data(), law.at_rest()}; }
    AlongContact<double> along_first(const VectorX<double>& change) const { return {elements.x, change.data(), 0.0}; }
    // Position x/a of the particle that arrives at point i, at the start of the step.
    double origin(const Stage& now, Index i) const {
        return (now.geometry.half_length * elements.x[i] + now.place.progress * step.dq) * per_half_length();
    }
    // Position x/a of the same particle at the end of the first stage.
    double between(const Stage& now, Index i) const {
        return (now.geometry.half_length * elements.x[i] + (1 - now.place.part) * step.dq) * per_first(now);
    }
    // 1/half-length at the start of the step; after the first stage.
    double per_half_length() const { return 1 / step.start.half_length; }
    double per_first(const Stage& now) const {
        return 1 / detail::between(step.start.half_length, step.end.half_length, now.place.part);
    }

    // Adds the response of the first stage to the change of the initial coefficients of the second.
    void add_carried(const Stage& now, std::size_t parameter) {
        AlongContact<double> change = along_first(own.carried[parameter]);
        for (Index i = 0; i < size(); ++i) {
            const double added = now.place.ratio() * change(between(now, i)).value;
            if (own.before[i] > 0) own.before_change[i] += added;
        }
    }
    // Finds d before / d half-length at the end of the step; the half-length of a stage changes by `progress` times as
    // much.
    void find_path_change(const Stage& now) {
        AlongContact<double> at_start = along_start(), increment = along_first(own.increment);
        for (Index i = 0; i < size(); ++i) {
            const double point = elements.x[i];
            double& change = own.path_change[i];
            change = at_start(origin(now, i)).slope * now.place.progress * point * per_half_length();
            if (!now.place.is_second) continue;
            const double x = between(now, i),
                         moved = (now.place.progress * point - now.place.part * x) * per_first(now);
            change += now.place.ratio() * increment(x).slope * moved;
            if (!(own.before[i] > 0)) change = 0;
        }
    }
};

}  // namespace rollbem::detail
