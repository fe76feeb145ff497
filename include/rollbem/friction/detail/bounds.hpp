// The bounds mu p_n of the stages of a step: with a constant coefficient, or with one that depends on the velocity of
// slip and is found together with the tractions.
#pragma once

#include <algorithm>
#include <cstddef>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../rolling/stage.hpp"
#include "../../scene/rigid_motion.hpp"
#include "../../types.hpp"
#include "../law.hpp"
#include "../state.hpp"
#include "scratch.hpp"
#include "slip_dependent_set.hpp"
#include "stick_slip.hpp"

namespace rollbem::detail {

/// Piecewise linear function of x/a with given values at the `points`, in ascending order, and the value `ahead` from
/// the leading edge on, or from the last point on if that lies in front of the contact; constant behind the
/// first point.
template <class Scalar>
class AlongContact {
public:
    AlongContact(const ArrayX<Scalar>& points, const Scalar* values, Scalar ahead)
        : points_(points), values_(values), ahead_(ahead) {}

    /// Arguments must not decrease from call to call.
    Scalar operator()(Scalar x) {
        while (next_ < points_.size() && points_[next_] < x) ++next_;
        const bool between = next_ < points_.size();
        const Scalar right = between ? points_[next_] : Scalar(1), value = between ? values_[next_] : ahead_;
        if (next_ == 0 || x >= right) return value;
        const Scalar left = points_[next_ - 1];
        return value + (right - x) / (right - left) * (values_[next_ - 1] - value);
    }

    /// The derivative; at a point, that from behind. Arguments must not decrease from call to call.
    Scalar slope(Scalar x) {
        while (next_ < points_.size() && points_[next_] < x) ++next_;
        const bool between = next_ < points_.size();
        const Scalar right = between ? points_[next_] : Scalar(1), value = between ? values_[next_] : ahead_;
        if (next_ == 0 || x >= right) return 0;
        return (value - values_[next_ - 1]) / (right - points_[next_ - 1]);
    }

private:
    const ArrayX<Scalar>& points_;
    const Scalar* values_;
    Scalar ahead_;
    Eigen::Index next_ = 0;
};

/// Bounds of one step or steady solution if mu is constant: mu times the pressures.
template <int directions, class Scalar>
class ConstantBounds {
public:
    using Solver = StickSlip<directions, Scalar>;
    using Vectors = ElementVectors<Scalar, directions>;
    using Start = SolutionStart<directions, Scalar>;
    static constexpr bool are_given = true;

    /// Of what SlipDependentBounds read.
    template <class... Read>
    explicit ConstantBounds(const Read&...) noexcept {}

    /// Called before each stage is solved.
    void enter(const StagePlace<Scalar>&, const RollingStage<Scalar>&) noexcept {}
    auto solve(Solver& solver, const VectorX<Scalar>& bound, const Start& start) noexcept {
        return solver.solve(bound, start);
    }
    /// dp in the stage solved last caused by a change dc and by a change of the bounds, `progress` times bound_change.
    void respond(Solver& solver, const Vectors& change, Vectors& traction_change, std::size_t,
                 const VectorX<Scalar>* bound_change = nullptr, Scalar progress = 1) noexcept {
        solver.respond(change, traction_change, bound_change, progress);
    }
    /// dp caused by the half-length at the end of the step, which changes the constants by `change`.
    void respond_to_half_length(Solver& solver, const Vectors& change, Vectors& traction_change,
                                std::size_t parameter) noexcept {
        respond(solver, change, traction_change, parameter);
    }
    /// Keeps the response of the first of two stages for that of the second.
    void carry_response(std::size_t) noexcept {}
    /// Completes the state at the end of the step.
    void finish(FrictionState<directions, Scalar>&) const noexcept {}
};

/// Bounds of one step or steady solution if mu depends on slip; `bound` is then p_n/G. In a step, the equation for
/// mu is integrated along the path of each particle by the same stages as the tractions, implicit Euler or sdirk2.
template <int directions, class Scalar>
class SlipDependentBounds {
public:
    using Solver = StickSlip<directions, Scalar>;
    using Vectors = ElementVectors<Scalar, directions>;
    using Vector = VectorX<Scalar>;
    using Law = AnySlipLaw<Scalar>;
    using Scratch = SlipDependentScratch<directions, Scalar>;
    using State = FrictionState<directions, Scalar>;
    static constexpr bool are_given = false;

    /// A step; lengths in a_0 = `unit` [m]. `points` are the collocation points, used if there is a memory. Keeps
    /// references to all arguments that are not numbers.
    SlipDependentBounds(const Friction<Law, Scalar>& friction, const ArrayX<Scalar>& points, const State& from,
                        Scalar unit, const rollbem::Travel<Scalar>& travel, Scratch& scratch) noexcept
        : law_(friction.law),
          memory_(friction.memory),
          points_(friction.memory.distance > 0 ? &points : nullptr),
          start_(from.friction_coefficient),
          unit_(unit),
          dq_(travel.dq / unit),
          duration_(travel.duration),
          half_length_(from.half_length / unit),
          per_half_length_(1 / half_length_),
          scratch_(scratch) {
        if (from.solver.stage_coefficient.size() == start_.size()) first_start_ = &from.solver.stage_coefficient;
        scratch_.friction = start_.matrix();
        if (points_ == nullptr) scratch_.before.setZero();
    }

    /// Steady rolling at a speed [m/s]: particles arrive from the equation ahead. Ways in units of the half-length [m].
    SlipDependentBounds(const Friction<Law, Scalar>& friction, const Vector& ways, const State& from,
                        Scalar half_length, Scalar speed, Scratch& scratch) noexcept
        : law_(friction.law),
          memory_(friction.memory),
          start_(from.friction_coefficient),
          steady_(true),
          velocity_per_slip_(speed),
          scratch_(scratch) {
        scratch_.friction = start_.matrix();
        scratch_.duration = half_length / speed * ways;
    }

    /// Writes mu of the stage solved last, and mu from which the next step starts the search in its first stage: that
    /// of the first stage of this step, unless mu has jumped.
    void finish(State& to) const noexcept {
        to.friction_coefficient = scratch_.friction.array();
        to.solver.stage_coefficient = (is_second() && is_easy_ ? scratch_.first_friction : scratch_.friction).array();
    }

    void enter(const StagePlace<Scalar>& place, const RollingStage<Scalar>& stage) noexcept {
        const Scalar duration = place.part * duration_;
        velocity_per_slip_ = unit_ / duration;
        scratch_.duration.setConstant(duration);
        place_ = place;
        stage_half_length_ = stage.half_length;
        if (!place.is_last() && first_start_ != nullptr) scratch_.friction = first_start_->matrix();
        if (points_ == nullptr) return;
        AlongContact<Scalar> start = at_start();
        if (!is_second()) {
            for (Index i = 0; i < size(); ++i) scratch_.before[i] = start(origin(i));
            first_half_length_ = stage.half_length;
            return;
        }
        scratch_.rise = scratch_.friction - scratch_.before;
        if (is_easy_) scratch_.friction = start_.matrix();
        AlongContact<Scalar> rise(*points_, scratch_.rise.data(), Scalar(0));
        for (Index i = 0; i < size(); ++i) {
            // extrapolation may overshoot if much is forgotten in a step
            const Scalar before = start(origin(i)) + place_.ratio() * rise(between(i));
            scratch_.before[i] = (std::max)(before, Scalar(0));
        }
    }

    typename Solver::Outcome solve(Solver& solver, const Vector& pressure,
                                   const typename Solver::Start& from) noexcept {
        typename SlipDependentSet<directions, Scalar>::Outcome outcome =
            scratch_.set.solve(passage(pressure), from, solver, scratch_.friction);
        outcome.solution.residual = (std::max)(outcome.solution.residual, outcome.change);
        if (!is_finite(outcome.change)) outcome.solution.residual = outcome.change;
        is_easy_ = outcome.solutions <= 4 && (is_easy_ || !is_second());
        if (!is_second()) scratch_.first_friction = scratch_.friction;
        pressure_ = &pressure;
        return outcome.solution;
    }

    /// dp in the stage solved last caused by a change dc, by a change of the pressures, `progress` times
    /// pressure_change, and in the second stage by the response of the first, kept by carry_response().
    void respond(Solver& solver, const Vectors& change, Vectors& traction_change, std::size_t parameter,
                 const Vector* pressure_change = nullptr, Scalar progress = 1) noexcept {
        SlipDependentChange<directions, Scalar> changes{change};
        if (is_second() && points_ != nullptr) {
            scratch_.before_change.setZero();
            add_carried(parameter);
            changes.before = &scratch_.before_change;
        }
        if (pressure_change != nullptr) {
            scratch_.bound = progress * scratch_.friction.cwiseProduct(*pressure_change);
            changes.bound = &scratch_.bound;
        }
        respond(solver, changes, traction_change);
        moves_paths_ = false;
    }

    /// dp caused by the half-length at the end of the step, in a_0, which changes the constants by `change` and the
    /// paths of the particles.
    void respond_to_half_length(Solver& solver, const Vectors& change, Vectors& traction_change,
                                std::size_t parameter) noexcept {
        SlipDependentChange<directions, Scalar> changes{change};
        moves_paths_ = points_ != nullptr;
        if (moves_paths_) {
            find_path_change();
            scratch_.before_change = scratch_.path_change;
            if (is_second()) add_carried(parameter);
            changes.before = &scratch_.before_change;
        }
        respond(solver, changes, traction_change);
    }

    /// Keeps the response of the first of two stages for that of the second.
    void carry_response(std::size_t parameter) noexcept {
        scratch_.carried_change[parameter] = scratch_.change;
        if (moves_paths_) scratch_.carried_change[parameter] -= scratch_.path_change;
    }

private:
    using Index = Eigen::Index;

    Index size() const { return start_.size(); }
    bool is_second() const { return place_.is_second; }

    AlongContact<Scalar> at_start() const { return {*points_, start_.data(), law_(0)}; }
    // Position x/a of the particle that arrives at point i, at the start of the step.
    Scalar origin(Index i) const {
        return (stage_half_length_ * (*points_)[i] + place_.progress * dq_) * per_half_length_;
    }
    // Position x/a of the same particle at the end of the first stage.
    Scalar between(Index i) const {
        return (stage_half_length_ * (*points_)[i] + (1 - place_.part) * dq_) / first_half_length_;
    }

    // Adds the response of the first stage to the change of the initial coefficients of the second.
    void add_carried(std::size_t parameter) {
        AlongContact<Scalar> change(*points_, scratch_.carried_change[parameter].data(), Scalar(0));
        for (Index i = 0; i < size(); ++i) {
            const Scalar added = place_.ratio() * change(between(i));
            if (scratch_.before[i] > 0) scratch_.before_change[i] += added;
        }
    }

    // Derivatives with respect to the half-length at the end of the step; that of a stage changes by `progress` times
    // as much.
    void find_path_change() {
        AlongContact<Scalar> start = at_start();
        for (Index i = 0; i < size(); ++i) {
            scratch_.path_change[i] = start.slope(origin(i)) * place_.progress * (*points_)[i] / half_length_;
        }
        if (!is_second()) return;
        AlongContact<Scalar> rise(*points_, scratch_.rise.data(), Scalar(0));
        for (Index i = 0; i < size(); ++i) {
            const Scalar x = between(i),
                         moved = (place_.progress * (*points_)[i] - place_.part * x) / first_half_length_;
            scratch_.path_change[i] += place_.ratio() * rise.slope(x) * moved;
            if (!(scratch_.before[i] > 0)) scratch_.path_change[i] = 0;
        }
    }

    void respond(Solver& solver, const SlipDependentChange<directions, Scalar>& changes, Vectors& traction_change) {
        scratch_.set.respond(passage(*pressure_), solver, scratch_.friction, changes, traction_change, scratch_.change);
    }

    FrictionPassage<Scalar> passage(const Vector& pressure) const {
        return {law_, memory_, pressure, scratch_.duration, steady_ ? nullptr : &scratch_.before, velocity_per_slip_};
    }

    const Law& law_;
    const FrictionMemory<Scalar>& memory_;
    const ArrayX<Scalar>* points_ = nullptr;
    const ArrayX<Scalar>& start_;  // mu when the step begins
    const ArrayX<Scalar>* first_start_ = nullptr;
    bool steady_ = false;
    // Newton's method has converged at once. A second stage then starts from mu at the start of the step, which is
    // nearer than that of the first stage if little changes; after a jump it is the other way round.
    bool is_easy_ = false;
    bool moves_paths_ = false;  // the last tangent was that by the half-length
    Scalar unit_ = 1, dq_ = 0, duration_ = 0;
    Scalar half_length_ = 1, per_half_length_ = 1;          // at the start of the step, and its reciprocal
    Scalar first_half_length_ = 1, stage_half_length_ = 1;  // at the end of the first stage, and of this one
    StagePlace<Scalar> place_{1, 1};
    Scalar velocity_per_slip_ = 0;  // slip velocity [m/s] over the solver's slip
    const Vector* pressure_ = nullptr;
    Scratch& scratch_;
};

}  // namespace rollbem::detail
