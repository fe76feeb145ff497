// The rigid slip that a motion imposes on elements.
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../rolling/stage.hpp"
#include "../../scene/rigid_motion.hpp"
#include "../../scene/semi_axes.hpp"
#include "../../system/elements.hpp"
#include "../../types.hpp"
#include "../state.hpp"
#include "directions.hpp"

namespace rollbem::detail {

/// Lengths in a_0, semi-axes in those of the contact. The rigid slip of spin follows the points of the elements.
template <int directions, class Scalar>
class ImposedSlip {
public:
    using Value = typename Directions<directions, Scalar>::Value;
    using Vectors = ElementVectors<Scalar, directions>;
    using Axes = SemiAxes<Scalar>;

    explicit ImposedSlip(const Elements<Scalar>& elements) : unit_(VectorX<Scalar>::Ones(elements.size())) {
        if constexpr (directions == 2) {
            if (!elements.places_are_known()) return;
            spin_.resize(elements.size(), 2);
            spin_ << -elements.y.matrix(), elements.x.matrix();
        }
    }

    /// The constants of a unit creepage in its direction.
    const VectorX<Scalar>& unit() const { return unit_; }
    /// Creepages by which there are tangents: with spin, if it can be imposed.
    std::size_t creepage_count() const { return directions == 1 ? 1 : spin_.rows() == 0 ? 2 : 3; }
    /// Whether the rigid slip of a creepage is known.
    bool can_impose([[maybe_unused]] const Value& creepage) const noexcept {
        if constexpr (directions == 1) {
            return true;
        } else {
            return creepage.spin == 0 || spin_.rows() > 0;
        }
    }

    /// The constants of a stage: the rigid slip of the frame's motion less `displacement`.
    template <class Frame>
    void impose(const Frame& frame, const Vectors& displacement, Vectors& constant) const {
        const Value moved = frame.moved();
        const Scalar factor = frame.factor();
        if constexpr (directions == 1) {
            constant.array() = factor * moved - displacement.array();
        } else {
            constant = -displacement;
            constant.col(0).array() += factor * moved.longitudinal;
            constant.col(1).array() += factor * moved.lateral;
            if (moved.spin != 0) add_turned(factor * moved.spin * frame.unit, frame.stage.axes(), constant);
        }
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
            sum.col(static_cast<Eigen::Index>(creepage)).array() += frame.per_end();
        }
    }

    /// Adds the derivative of the constants by a semi-axis at the end of the step; with `keeps_shape` the half-width
    /// follows the half-length.
    template <class Frame>
    void add_rate(const Frame& frame, Axis axis, bool keeps_shape, Vectors& sum) const {
        if constexpr (directions == 2) {
            const Scalar rate = frame.place.progress * frame.factor() * frame.moved().spin * frame.unit;
            const bool by_length = axis == Axis::half_length;
            add_turned(rate, {by_length ? Scalar(1) : Scalar(0), by_length && !keeps_shape ? Scalar(0) : Scalar(1)},
                       sum);
        }
    }

private:
    // Nothing where places are not known, and the angle is 0.
    void add_turned([[maybe_unused]] Scalar angle, [[maybe_unused]] const Axes& axes,
                    [[maybe_unused]] Vectors& sum) const {
        if constexpr (directions == 2) {
            if (spin_.rows() == 0) return;
            sum.col(0) += angle * axes.half_width * spin_.col(0);
            sum.col(1) += angle * axes.half_length * spin_.col(1);
        }
    }

    VectorX<Scalar> unit_;
    Vectors spin_;  // rigid slip of unit spin; empty where places are not known
};

}  // namespace rollbem::detail
