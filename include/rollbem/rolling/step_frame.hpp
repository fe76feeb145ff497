// StepFrame: the data of a step with which a problem in the time domain, with friction or without, solves its stages.
#pragma once

#include <array>
#include <cstddef>

#include "../scene/creepage.hpp"
#include "../scene/directions.hpp"
#include "../scene/rigid_motion.hpp"
#include "../scene/semi_axes.hpp"
#include "../status.hpp"
#include "integrator.hpp"
#include "rigid_slip.hpp"
#include "stage.hpp"
#include "stage_equations.hpp"

namespace rollbem::detail {

/// Parameters of the tangents of a step, and indices into the data that its first stage passes to the second: the
/// creepages come first. The load is a parameter of friction alone.
template <int directions>
struct TangentBy {
    static constexpr std::size_t creepages = input_count<directions>;
    static constexpr std::size_t load = creepages, half_length = creepages + 1, half_width = creepages + 2;
    static constexpr std::size_t count = directions == 1 ? half_width : half_width + 1;

    static constexpr bool is_axis(std::size_t parameter) { return parameter >= half_length; }
    /// The semi-axis of a parameter that stands for a semi-axis.
    static constexpr Axis axis(std::size_t parameter) {
        return parameter == half_length ? Axis::half_length : Axis::half_width;
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
    static constexpr int directions = Motion::directions;
    using Axes = SemiAxes<Scalar>;
    using By = TangentBy<directions>;

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
    /// Parameters of the wanted tangents.
    std::array<bool, By::count> asked{true, directions == 2, directions == 2};

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
    /// Adds factor() motion() in the equations.
    template <class Result>
    void add_motion(const RigidSlip<directions, Scalar>& slip, Result&& sum) const {
        const InputVector<directions, Scalar> values = in_order(moved());
        for (std::size_t j = 0; j < By::creepages; ++j) {
            slip.add(j, factor() * values[static_cast<Eigen::Index>(j)], stage.axes(), sum);
        }
    }

    /// Calls use(parameter) for each parameter of a wanted tangent.
    template <class Use>
    void for_parameters(const Use& use) const {
        for (std::size_t parameter = 0; parameter < By::count; ++parameter) {
            if (asked[parameter]) use(parameter);
        }
    }
    /// Adds the derivative of factor() motion() - (slip by tractions p at the end of the stage) by a parameter, at
    /// constant p. `scratch` is as large as p.
    template <class Equations, class Tractions, class Scratch, class Result>
    void add_rate(std::size_t parameter, const RigidSlip<directions, Scalar>& slip, const Equations& equations,
                  const Tractions& p, Scratch&& scratch, Result&& sum) const {
        if (parameter < By::creepages) return slip.add(parameter, per_end(), stage.axes(), sum);
        if (!By::is_axis(parameter)) return;
        const Axis axis = By::axis(parameter);
        if constexpr (directions == 2) {
            const Scalar spin = moved().spin;
            if (spin != 0) slip.add_spin_rate(axis, equations.is_single(), place.progress * factor() * spin, sum);
        }
        equations.add_rates(axis, place, p, scratch, sum);
    }
    /// Finds the contribution of a stage's response dp (to a parameter) to the next stage's factor() motion() - (slip
    /// by the tractions); the next stage starts from U + ratio (U_1 - U).
    template <class Equations, class Tractions, class Scratch, class Result>
    void carry_response(std::size_t parameter, const Equations& equations, const Tractions& p, const Tractions& dp,
                        Scratch&& scratch, Result&& carried) const {
        equations.find_displacements(dp, carried);
        if (By::is_axis(parameter)) {
            equations.add_displacement_rates(By::axis(parameter), place.progress, p, scratch, carried);
        }
        carried *= -place.ratio();
    }

    /// The share of a stage's slip in the step's slip.
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

/// A result with this status and no numbers (NaN).
template <class Result>
Result failed(Status status) noexcept {
    Result result;
    result.status = status;
    return result;
}

/// The first reason, if any, why a step by dq [m] is impossible, in this order:
/// - a state or workspace of another model, if `belongs` says so;
/// - the motion;
/// - the loads of state and step, as `belongs` says;
/// - the semi-axes of the load, as grows() says.
template <class Motion, class Scalar, class Grows>
Status check_step(Status belongs, const Motion& motion, Scalar dq, Eigen::Index size, const Grows& grows) noexcept {
    if (belongs == Status::wrong_state) return belongs;
    const Status possible = motion.check(dq, size);
    if (possible != Status::ok) return possible;
    return belongs == Status::ok ? grows() : belongs;
}

}  // namespace rollbem::detail
