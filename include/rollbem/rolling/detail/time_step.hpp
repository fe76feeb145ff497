// TimeStep: a step of rolling, or steady rolling, as a value, its stages, and their rigid slip with its derivatives.
// Internal.
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "../../scene/creepage.hpp"
#include "../../scene/detail/contact_units.hpp"
#include "../../scene/detail/directions.hpp"
#include "../../scene/patch_contact.hpp"
#include "../../scene/rigid_motion.hpp"
#include "../../status.hpp"
#include "../../types.hpp"
#include "../run.hpp"
#include "stage.hpp"
#include "stage_table.hpp"

namespace rollbem::detail {

/// Rigid slip of unit creepages, a column for each. The slip of spin, (-y, x), follows the points of a patch: its
/// longitudinal half grows with the half-width, its lateral half with the half-length.
template <int directions>
class RigidSlip {
public:
    using Axes = SemiAxes;

    /// Takes the inputs of a system; `modulus` is G in the unit of the tractions.
    RigidSlip(const ContactUnits& units, const MatrixX<double>& inputs, double modulus) : columns_(modulus * inputs) {
        for (Eigen::Index j = 0; j < columns_.cols(); ++j) columns_.col(j) *= units.arm(j);
    }

    /// Rigid slip at the contact's own semi-axes.
    const MatrixX<double>& columns() const { return columns_; }

    /// Adds `factor` times the rigid slip of a unit creepage; in `sum` the directions follow one another.
    template <class Vectors>
    void add(std::size_t creepage, double factor, const Axes& at, Vectors&& sum) const {
        if (creepage == 2 && at != contact_axes) return add_spin(factor, at, sum);
        in_a_column(sum) += factor * columns_.col(static_cast<Eigen::Index>(creepage));
    }
    /// Adds `factor` times the derivative of the rigid slip of unit spin by a semi-axis; with `keeps_shape` the
    /// half-width follows the half-length.
    template <class Vectors>
    void add_spin_rate(Axis axis, bool keeps_shape, double factor, Vectors&& sum) const {
        const bool by_length = axis == Axis::half_length;
        add_spin(factor, {by_length ? 1.0 : 0.0, by_length && !keeps_shape ? 0.0 : 1.0}, sum);
    }

private:
    template <class Vectors>
    static auto in_a_column(Vectors& sum) {
        return Eigen::Map<VectorX<double>>(sum.data(), sum.size());
    }
    template <class Vectors>
    void add_spin(double factor, const Axes& stretch, Vectors& sum) const {
        const Eigen::Index n = columns_.rows() / 2;
        auto all = in_a_column(sum);
        all.head(n) += factor * stretch.half_width * columns_.col(2).head(n);
        all.tail(n) += factor * stretch.half_length * columns_.col(2).tail(n);
    }

    MatrixX<double> columns_;
};

/// Forces of unknowns in SI units, and with two directions their moment. Areas grow with both semi-axes, each arm of
/// the moment with one of them.
template <int directions>
class ContactForces {
public:
    using Axes = SemiAxes;
    using Forces = InputVector<directions>;

    /// Takes the outputs of a system; `modulus` is G in the unit of the tractions.
    ContactForces(const ContactUnits& units, const MatrixX<double>& outputs, double modulus)
        : length_(units.length), half_width_(units.half_width), columns_(outputs) {
        const double unit = units.width * units.length * (units.shear_modulus / modulus);
        for (Eigen::Index j = 0; j < columns_.cols(); ++j) columns_.col(j) *= unit * units.arm(j);
    }

    /// Forces per unknown at the contact's own semi-axes, a column for each.
    const MatrixX<double>& columns() const { return columns_; }

    /// Forces of the unknowns of all directions, one direction after the other.
    template <class Vectors>
    Forces of(const Vectors& unknowns, const Axes& at) const {
        return at == contact_axes ? total(unknowns) : stretched(unknowns, at, at);
    }

    /// The derivative of the forces by a semi-axis [m]. `response` is the derivative of the unknowns by the semi-axis
    /// over the contact's; with `keeps_shape` the other semi-axis grows in proportion. At constant tractions the force
    /// is a power of the semi-axis, and either arm of the moment adds a factor to this growth.
    template <class Vectors>
    Forces rate(const Vectors& unknowns, const Vectors& response, const Axes& at, Axis axis, bool keeps_shape) const {
        const bool by_length = axis == Axis::half_length;
        const double power = keeps_shape ? 2 : 1, more = keeps_shape ? 1.5 : 2.0;
        const Axes arms{(by_length || keeps_shape ? more : 1) * at.half_length,
                        (!by_length || keeps_shape ? more : 1) * at.half_width};
        const Forces direct = stretched(unknowns, at, arms) * (power / (by_length ? at.half_length : at.half_width));
        return (direct + of(response, at)) / (by_length ? length_ : half_width_);
    }

private:
    template <class Vectors>
    Forces total(const Vectors& unknowns) const {
        const Eigen::Map<const VectorX<double>> all(unknowns.data(), unknowns.size());
        Forces forces;
        for (Eigen::Index j = 0; j < forces.size(); ++j) forces[j] = columns_.col(j).dot(all);
        return forces;
    }
    template <class Vectors>
    Forces stretched(const Vectors& unknowns, const Axes& at, const Axes& arms) const {
        Forces forces = total(unknowns);
        if constexpr (directions == 2) {
            const Eigen::Index n = columns_.rows() / 2;
            const Eigen::Map<const VectorX<double>> all(unknowns.data(), unknowns.size());
            const auto moment = columns_.col(2);
            forces[2] =
                arms.half_width * moment.head(n).dot(all.head(n)) + arms.half_length * moment.tail(n).dot(all.tail(n));
        }
        return forces * (at.half_length * at.half_width);
    }

    double length_, half_width_;
    MatrixX<double> columns_;
};

/// Parameters of the tangents of a step, in the order of the results: the creepages come first. The load is a parameter
/// of friction alone.
template <int directions>
struct Parameters {
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
inline double between(double start, double end, double progress) { return start + progress * (end - start); }
inline Creepage between(const Creepage& start, const Creepage& end, double progress) {
    return {between(start.longitudinal, end.longitudinal, progress), between(start.lateral, end.lateral, progress),
            between(start.spin, end.spin, progress)};
}

/// One stage of a step: its slip is factor * motion - (slip by the tractions).
template <int directions>
struct Stage {
    StagePlace place;
    RollingStage geometry;
    CreepageAlong<directions> motion;  ///< creepage or shift at the end of the stage
    double factor;         ///< the stage's share of the step times the distance rolled; 1 for steady rolling
    double factor_by_end;  ///< d(factor * motion) / d motion at the end of the step
    double weight;         ///< share of the stage's slip in the step's slip

    /// Adds factor * motion in the equations, without the rows of the motion.
    template <class Result>
    void add_motion(const RigidSlip<directions>& rigid, Result&& sum) const {
        const InputVector<directions> values = in_order(motion);
        for (std::size_t j = 0; j < input_count<directions>; ++j) {
            rigid.add(j, factor * values[static_cast<Eigen::Index>(j)], geometry.axes(), sum);
        }
    }
    /// Adds the derivative of factor * motion - (slip by tractions p at the end of the stage) by a parameter, at
    /// constant p. `scratch` is as large as p.
    template <class Equations, class Tractions, class Result>
    void add_rate(std::size_t parameter, const RigidSlip<directions>& rigid, const Equations& equations,
                  const Tractions& p, Result&& scratch, Result&& sum) const {
        using By = Parameters<directions>;
        if (parameter < By::creepages) return rigid.add(parameter, factor_by_end, geometry.axes(), sum);
        if (!By::is_axis(parameter)) return;
        const Axis axis = By::axis(parameter);
        if constexpr (directions == 2) {
            const double spin = motion.spin;
            if (spin != 0) rigid.add_spin_rate(axis, equations.is_single(), place.progress * factor * spin, sum);
        }
        equations.add_rates(axis, place, p, scratch, sum);
    }
    /// Finds the contribution of the stage's response dp (to a parameter) to the next stage's factor * motion - (slip
    /// by the tractions); the next stage starts from U + ratio (U_1 - U).
    template <class Equations, class Tractions, class Result>
    void find_carried(std::size_t parameter, const Equations& equations, const Tractions& p, const Tractions& dp,
                      Result&& scratch, Result&& carried) const {
        using By = Parameters<directions>;
        equations.find_displacements(dp, carried);
        if (By::is_axis(parameter)) {
            equations.add_displacement_rates(By::axis(parameter), place.progress, p, scratch, carried);
        }
        carried *= -place.ratio();
    }
};

/// A step, or steady rolling as a step of one stage. Lengths in a_0 = `unit` [m], semi-axes in the contact's. The
/// semi-axes vary linearly. A shift without rolling is one stage, whatever the table.
template <int directions>
struct TimeStep {
    RigidMotion<CreepageAlong<directions>> motion;
    double unit;
    SemiAxes start, end;
    double dq = 0;  ///< distance rolled; 0 in steady rolling
    StageTable stages = single_stage;
    bool steady = false;
    double duration = 0, speed = 0;  ///< [s], of a step; [m/s], of steady rolling; for friction that depends on slip

    bool rolls() const { return dq > 0; }
    bool varies() const { return start != end; }
    int stage_count() const { return table().count(); }

    /// A stage, counted from 1.
    Stage<directions> stage(int number) const {
        const StagePlace place = table().place(number);
        const double factor = steady ? 1.0 : motion.is_shift() ? table().part() / unit : table().part() * dq;
        return {place,
                steady ? RollingStage::steadily(end) : RollingStage::of(place, dq, start, end),
                between(motion.start(), motion.end(), place.progress),
                factor,
                motion.is_linear() ? place.progress * factor : factor,
                place.is_last() ? 1.0 : place.ratio()};
    }

private:
    const StageTable& table() const { return rolls() ? stages : single_stage; }
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
template <class Motion, class Grows>
Status check_step(Status belongs, const Motion& motion, double dq, Eigen::Index size, const Grows& grows) noexcept {
    if (belongs == Status::wrong_state) return belongs;
    const Status possible = motion.check(dq, size);
    if (possible != Status::ok) return possible;
    return belongs == Status::ok ? grows() : belongs;
}

}  // namespace rollbem::detail
