// The bounds mu p_n of the stages of a step: with a constant coefficient, or with a coefficient that depends on the
// slip velocity and is found together with the tractions.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../rolling/step_frame.hpp"
#include "../../scene/directions.hpp"
#include "../../scene/rigid_motion.hpp"
#include "../../system/along_contact.hpp"
#include "../../system/elements.hpp"
#include "../../types.hpp"
#include "../law.hpp"
#include "../state.hpp"
#include "scratch.hpp"
#include "slip_dependent_set.hpp"
#include "stick_slip.hpp"

namespace rollbem::detail {

/// Bounds of one step or steady solution if mu is constant: mu times the pressures.
template <int directions>
class ConstantBounds {
public:
    using Solver = StickSlip<directions>;

    /// Takes the arguments of SlipDependentBounds and ignores them.
    template <class... Read>
    explicit ConstantBounds(const Read&...) noexcept {}

    /// Called before each stage of a frame is solved.
    template <class Frame>
    void enter(const Frame&) noexcept {}
    auto solve(Solver& solver, const VectorX<double>& bound, const typename Solver::Start& start) noexcept {
        return solver.solve(bound, start);
    }
    /// To be called before respond(). Returns a number that changes whenever the response to a change of c may change;
    /// nothing if there is no such number.
    std::optional<std::uint64_t> linearise(Solver& solver) noexcept { return solver.roles_revision(); }
    /// Finds dp of the last solved stage caused by a change; the solver holds dp. The last argument is the tangent's
    /// parameter (TangentBy).
    void respond(Solver& solver, const typename Solver::Change& change, std::size_t) noexcept {
        solver.respond(change);
    }
    /// Keeps the response of the first of two stages, on which the response of the second depends.
    void carry_response(std::size_t) noexcept {}
    /// Completes the state at the end of the step.
    void finish(FrictionState<directions>&) const noexcept {}
};

/// Bounds of one step or steady solution if mu depends on slip; `bound` is then p_n/G. In a step, the equation for
/// mu is integrated along the path of each particle by the same stages as the tractions, implicit Euler or sdirk2.
template <int directions>
class SlipDependentBounds {
public:
    using Solver = StickSlip<directions>;
    using Vector = VectorX<double>;
    using Law = AnySlipLaw;
    using Scratch = SlipDependentScratch<directions>;
    using State = FrictionState<directions>;
    using Frame = StepFrame<CreepageAlong<directions, double>, double>;

    /// The points of the elements are used if there is a memory. Keeps references to all arguments but the travel.
    SlipDependentBounds(const Friction<Law>& friction, const Elements<double>& elements, const State& from,
                        const rollbem::Travel<double>& travel, Scratch& scratch) noexcept
        : passage_{friction.law, friction.memory, friction.law(0), scratch.duration},
          elements_(elements),
          start_(from.friction_coefficient),
          travel_(travel),
          scratch_(scratch) {
        if (from.solver.stage_coefficient.size() == start_.size()) first_start_ = &from.solver.stage_coefficient;
        scratch_.friction = start_.matrix();
    }

    /// Writes mu at the end of the step, and mu from which the first stage of the next step starts its search: mu of
    /// this step's first stage or, if mu has jumped, mu at the end.
    void finish(State& to) const noexcept {
        to.friction_coefficient = scratch_.friction.array();
        to.solver.stage_coefficient = (is_second() && is_easy_ ? scratch_.first_friction : scratch_.friction).array();
    }

    /// Called before each stage of a frame is solved; keeps a reference to the frame. In steady rolling particles
    /// arrive from the collocation point ahead.
    void enter(const Frame& frame) noexcept {
        frame_ = &frame;
        passage_.before = frame.stage.steady ? nullptr : &scratch_.before;
        if (frame.stage.steady) {
            const ArrayX<double>& ways = elements_.intervals.size() > 0 ? elements_.intervals : elements_.areas;
            passage_.velocity_per_slip = travel_.speed();
            scratch_.duration = frame.stage.half_length * frame.unit / travel_.speed() * ways.matrix();
            return;
        }
        const double duration = frame.place.part * travel_.duration;
        passage_.velocity_per_slip = frame.unit / duration;
        scratch_.duration.setConstant(duration);
        if (!frame.place.is_last() && first_start_ != nullptr) scratch_.friction = first_start_->matrix();
        if (!remembers()) return scratch_.before.setZero(), void();
        per_half_length_ = 1 / frame.start.half_length;
        per_first_ = 1 / rollbem::detail::between(frame.start.half_length, frame.end.half_length, frame.place.part);
        AlongContact<double> start = at_start();
        if (!is_second()) {
            for (Index i = 0; i < size(); ++i) scratch_.before[i] = start(origin(i)).value;
            return;
        }
        scratch_.rise = scratch_.friction - scratch_.before;
        if (is_easy_) scratch_.friction = start_.matrix();
        AlongContact<double> rise = in_first_stage(scratch_.rise);
        for (Index i = 0; i < size(); ++i) {
            // extrapolation may overshoot if much is forgotten in a step
            const double before = start(origin(i)).value + frame.place.ratio() * rise(between(i)).value;
            scratch_.before[i] = (std::max)(before, 0.0);
        }
    }

    typename Solver::Outcome solve(Solver& solver, const Vector& pressure,
                                   const typename Solver::Start& from) noexcept {
        passage_.pressure = &pressure;
        typename SlipDependentSet<directions>::Outcome outcome =
            scratch_.set.solve(passage_, from, solver, scratch_.friction);
        outcome.solution.residual = (std::max)(outcome.solution.residual, outcome.change);
        if (!is_finite(outcome.change)) outcome.solution.residual = outcome.change;
        is_easy_ = outcome.solutions <= 4 && (is_easy_ || !is_second());
        if (!is_second()) scratch_.first_friction = scratch_.friction;
        return outcome.solution;
    }

    /// To be called before respond(), as in ConstantBounds.
    std::optional<std::uint64_t> linearise(Solver& solver) noexcept {
        const std::uint64_t revision = scratch_.set.linearise(passage_, solver);
        return remembers() && is_second() ? std::nullopt : std::optional(revision);
    }
    /// Finds dp of the last solved stage; the solver holds dp. Its causes are
    /// - a change of the problem, with the change of p_n/G in place of the bounds,
    /// - the change of the particles' paths, if the parameter is the half-length,
    /// - in the second stage the response of the first, kept by carry_response().
    void respond(Solver& solver, const typename Solver::Change& change, std::size_t parameter) noexcept {
        typename Solver::Change direct = change;
        const Vector* before = nullptr;
        moves_paths_ = remembers() && parameter == TangentBy<directions>::half_length;
        if (moves_paths_ || (remembers() && is_second())) {
            moves_paths_ ? find_path_change() : void(scratch_.path_change.setZero());
            scratch_.before_change = scratch_.path_change;
            if (is_second()) add_carried(parameter);
            before = &scratch_.before_change;
        }
        if (change.bound != nullptr) {
            scratch_.bound = scratch_.friction.cwiseProduct(*change.bound);
            direct.bound = &scratch_.bound;
        }
        scratch_.set.respond(passage_, solver, direct, before, scratch_.change);
    }

    /// Keeps the response of the first of two stages, on which the response of the second depends.
    void carry_response(std::size_t parameter) noexcept {
        scratch_.carried_change[parameter] = scratch_.change;
        if (moves_paths_) scratch_.carried_change[parameter] -= scratch_.path_change;
    }

private:
    using Index = Eigen::Index;

    Index size() const { return start_.size(); }
    bool remembers() const { return passage_.memory.distance > 0 && !frame_->stage.steady; }
    bool is_second() const { return frame_->place.is_second; }

    AlongContact<double> at_start() const { return {elements_.x, start_.data(), passage_.at_rest}; }
    AlongContact<double> in_first_stage(const Vector& change) const { return {elements_.x, change.data(), 0.0}; }
    // Position x/a of the particle that arrives at point i, at the start of the step.
    double origin(Index i) const {
        return (frame_->stage.half_length * elements_.x[i] + frame_->place.progress * frame_->dq) * per_half_length_;
    }
    // Position x/a of the same particle at the end of the first stage.
    double between(Index i) const {
        return (frame_->stage.half_length * elements_.x[i] + (1 - frame_->place.part) * frame_->dq) * per_first_;
    }

    // Adds the response of the first stage to the change of the initial coefficients of the second.
    void add_carried(std::size_t parameter) {
        AlongContact<double> change = in_first_stage(scratch_.carried_change[parameter]);
        for (Index i = 0; i < size(); ++i) {
            const double added = frame_->place.ratio() * change(between(i)).value;
            if (scratch_.before[i] > 0) scratch_.before_change[i] += added;
        }
    }

    // Finds d before / d half-length at the end of the step; the half-length of a stage changes by `progress` times as
    // much.
    void find_path_change() {
        const StagePlace<double>& place = frame_->place;
        AlongContact<double> start = at_start(), rise = in_first_stage(scratch_.rise);
        for (Index i = 0; i < size(); ++i) {
            const double point = elements_.x[i];
            double& change = scratch_.path_change[i];
            change = start(origin(i)).slope * place.progress * point * per_half_length_;
            if (!is_second()) continue;
            const double x = between(i), moved = (place.progress * point - place.part * x) * per_first_;
            change += place.ratio() * rise(x).slope * moved;
            if (!(scratch_.before[i] > 0)) change = 0;
        }
    }

    FrictionPassage passage_;
    const Elements<double>& elements_;
    const ArrayX<double>& start_;  // mu when the step begins
    const ArrayX<double>* first_start_ = nullptr;
    rollbem::Travel<double> travel_;
    const Frame* frame_ = nullptr;
    // Whether Newton's method has converged after few solutions. A second stage then starts from mu at the start of the
    // step, which is nearer to the solution than mu of the first stage if little changes; after a jump mu of the first
    // stage is nearer.
    bool is_easy_ = false;
    bool moves_paths_ = false;                    // the last tangent was by the half-length
    double per_half_length_ = 1, per_first_ = 1;  // 1/half-length at the start of the step; after one stage
    Scratch& scratch_;
};

}  // namespace rollbem::detail
