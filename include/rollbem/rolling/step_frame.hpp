// StepFrame: the data of a step that a problem in the time domain, with friction or without, has before it solves its
// stages.
#pragma once

#include "../scene/creepage.hpp"
#include "../scene/rigid_motion.hpp"
#include "../scene/semi_axes.hpp"
#include "../status.hpp"
#include "integrator.hpp"
#include "stage.hpp"
#include "stage_equations.hpp"

namespace rollbem::detail {

/// The growth of force and moment with a semi-axis at constant tractions: the force is a power of the semi-axis; the
/// moment by tractions with arms along either semi-axis grows by one of `arms` times this power.
template <class Scalar>
struct OwnGrowth {
    Scalar power;
    SemiAxes<Scalar> arms;

    /// `keeps_shape`: the other semi-axis grows in proportion.
    static OwnGrowth by(Axis axis, bool keeps_shape) {
        if (keeps_shape) return {2, {1.5, 1.5}};
        return axis == Axis::half_length ? OwnGrowth{1, {2, 1}} : OwnGrowth{1, {1, 2}};
    }
};

/// A creepage or shift between two others, after `progress` of the way.
template <class Scalar>
Scalar between(Scalar start, Scalar end, Scalar progress) {
    return start + progress * (end - start);
}
template <class Scalar>
Creepage<Scalar> between(const Creepage<Scalar>& start, const Creepage<Scalar>& end, Scalar progress) {
    return {between(start.longitudinal, end.longitudinal, progress), between(start.lateral, end.lateral, progress),
            between(start.spin, end.spin, progress)};
}

/// A step, or steady rolling as its only stage. Lengths in a_0 = `unit` [m], semi-axes in the contact's. A stage's
/// equation for the slip is s = factor() motion() - (slip by the tractions). Refers to the motion.
template <class Value_, class Scalar_>
class StepFrame {
public:
    using Value = Value_;
    using Scalar = Scalar_;
    using Motion = RigidMotion<Value>;
    using Axes = SemiAxes<Scalar>;

    /// A step by dq [m], whose semi-axes vary linearly. A shift without rolling is one stage, whatever the table.
    StepFrame(const Motion& moved, Scalar distance, Scalar length, const StageTable<Scalar>& stages, const Axes& from,
              const Axes& to)
        : motion(moved),
          unit(length),
          dq(distance / length),
          start(from),
          end(to),
          table(dq > 0 ? stages : single_stage<Scalar>) {
        enter(1);
    }
    /// Steady rolling at these semi-axes.
    StepFrame(const Motion& moved, Scalar length, const Axes& at)
        : motion(moved), unit(length), start(at), end(at), table(single_stage<Scalar>) {
        stage = RollingStage<Scalar>::steadily(at);
    }

    const Motion& motion;
    Scalar unit, dq = 0;
    Axes start, end;
    StageTable<Scalar> table;
    StagePlace<Scalar> place{1, 1};  ///< the present stage
    RollingStage<Scalar> stage;

    bool rolls() const { return dq > 0; }
    bool varies() const { return start != end; }

    /// Creepage or shift at the end of the present stage.
    Value moved() const { return between(motion.start(), motion.end(), place.progress); }
    /// Factor of the motion in the slip of a stage: its share of the step times the distance rolled, but 1 for steady
    /// rolling.
    Scalar factor() const {
        if (stage.steady) return 1;
        return motion.is_shift() ? table.part() / unit : table.part() * dq;
    }
    /// d(factor() motion)/d motion at the end of the step.
    Scalar per_end() const { return motion.is_linear() ? place.progress * factor() : factor(); }
    /// The share of a stage's slip in the slip of the step.
    Scalar weight() const { return place.is_last() ? Scalar(1) : place.ratio(); }

    /// Calls problem.solve_stage(frame) for one stage after the other, and problem.carry(frame) between two.
    template <class Frame, class Problem>
    static void solve_stages(Frame& frame, const Problem& problem) {
        for (int index = 1;; ++index) {
            problem.solve_stage(frame);
            if (frame.place.is_last()) return;
            problem.carry(frame);
            frame.enter(index + 1);
        }
    }

private:
    void enter(int index) {
        place = table.place(index);
        stage = RollingStage<Scalar>::of(place, dq, start, end);
    }
};

/// A result without numbers.
template <class Result>
Result failed(Status status) noexcept {
    Result result;
    result.status = status;
    return result;
}

/// The first reason, if any, why a step by dq [m] is impossible. The order is: a state or workspace of another model;
/// the motion; the load, with `belongs`, its check with the state's load; and grows(), the check of its semi-axes.
template <class Motion, class Scalar, class Grows>
Status check_step(Status belongs, const Motion& motion, Scalar dq, Eigen::Index size, const Grows& grows) noexcept {
    if (belongs == Status::wrong_state) return belongs;
    const Status possible = motion.check(dq, size);
    if (possible != Status::ok) return possible;
    return belongs == Status::ok ? grows() : belongs;
}

}  // namespace rollbem::detail
