// The rigid slip that a motion imposes on elements.
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../rolling/stage.hpp"
#include "../../scene/creepage.hpp"
#include "../../scene/semi_axes.hpp"
#include "../../system/elements.hpp"
#include "../../types.hpp"
#include "../state.hpp"

namespace rollbem::detail {

template <int directions, class Scalar>
using CreepageAlong = ByDirections<directions, Scalar, Creepage<Scalar>>;

/// Lengths in a_0, semi-axes in those of the contact. The rigid slip of spin follows the points of the elements.
template <int directions, class Scalar>
class ImposedSlip {
public:
    using Index = Eigen::Index;
    using Value = CreepageAlong<directions, Scalar>;
    using Vectors = ElementVectors<Scalar, directions>;
    using Axes = SemiAxes<Scalar>;

    explicit ImposedSlip(const Elements<Scalar>& elements) {
        if constexpr (directions == 2) {
            if (!elements.places_are_known()) return;
            spin_.resize(elements.size(), 2);
            spin_ << -elements.y.matrix(), elements.x.matrix();
        }
    }

    /// Creepages by which there are tangents: with spin, if it can be imposed.
    std::size_t creepage_count() const { return directions == 1 ? 1 : spin_.rows() == 0 ? 2 : 3; }
    /// Whether the rigid slip of a creepage is known.
    bool can_impose(const Value& creepage) const noexcept { return spin(creepage) == 0 || spin_.rows() > 0; }

    /// The constants of a stage: the rigid slip of the frame's motion less `displacement`.
    template <class Frame>
    void impose(const Frame& frame, const Vectors& displacement, Vectors& constant) const {
        const Value moved = frame.moved();
        const Scalar factor = frame.factor();
        for (Index d = 0; d < directions; ++d) {
            constant.col(d).array() = factor * along(moved, d) - displacement.col(d).array();
        }
        if (spin(moved) != 0) add_turned(factor * spin(moved) * frame.unit, frame.stage.axes(), constant);
        const auto& motion = frame.motion;
        const Scalar progress = frame.place.progress;
        if (motion.has_rows()) {
            constant += factor * (1 - progress) * motion.start_rows() + factor * progress * motion.end_rows();
        }
        // without creepage tractions decay for ever, but the rounding that solutions are judged by vanishes earlier
        const bool has_decayed = constant.cwiseAbs().maxCoeff() < negligible<Scalar> && all_finite(constant);
        if (has_decayed) constant.setZero();
    }

    /// Adds the derivative of the constants by a creepage or shift at the end of the step.
    template <class Frame>
    void add_rate(const Frame& frame, std::size_t creepage, Vectors& sum) const {
        if (creepage == 2) {
            add_turned(frame.per_end() * frame.unit, frame.stage.axes(), sum);
        } else {
            sum.col(static_cast<Index>(creepage)).array() += frame.per_end();
        }
    }

    /// Adds the derivative of the constants by a semi-axis at the end of the step; with `keeps_shape` the half-width
    /// follows the half-length.
    template <class Frame>
    void add_rate(const Frame& frame, Axis axis, bool keeps_shape, Vectors& sum) const {
        const Scalar rate = frame.place.progress * frame.factor() * spin(frame.moved()) * frame.unit;
        const bool by_length = axis == Axis::half_length;
        add_turned(rate, {by_length ? Scalar(1) : Scalar(0), by_length && !keeps_shape ? Scalar(0) : Scalar(1)}, sum);
    }

private:
    static Scalar along(const Scalar& creepage, Index) { return creepage; }
    static Scalar along(const Creepage<Scalar>& creepage, Index d) {
        return d == 0 ? creepage.longitudinal : creepage.lateral;
    }
    static Scalar spin(const Scalar&) { return 0; }
    static Scalar spin(const Creepage<Scalar>& creepage) { return creepage.spin; }

    // Nothing where places are not known, and the angle is 0.
    void add_turned(Scalar angle, const Axes& axes, Vectors& sum) const {
        if (spin_.rows() == 0) return;
        sum.col(0) += angle * axes.half_width * spin_.col(0);
        sum.col(directions - 1) += angle * axes.half_length * spin_.col(directions - 1);
    }

    Vectors spin_;  // rigid slip of unit spin; empty with one direction, and where places are not known
};

}  // namespace rollbem::detail
