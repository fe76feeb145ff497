// One step in full adhesion of a patch whose semi-axes may change during the step, by the stages of its integrator, and
// steady rolling at any semi-axes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <Eigen/Core>

#include "../../assembly/detail/shape_set.hpp"
#include "../../scene/semi_axes.hpp"
#include "../../types.hpp"
#include "rational_exponential.hpp"
#include "rolling_stage.hpp"
#include "shape_influence.hpp"
#include "stage_factors.hpp"

namespace rollbem::detail {

/// As AdhesionStages, with the equations of ShapeInfluence. The unknowns are the tractions along x, then along y.
template <class Scalar>
class ShapeStages {
public:
    using Vector = VectorX<Scalar>;
    using Matrix = MatrixX<Scalar>;
    using Shape = ShapeInfluence<Scalar>;
    using Axes = SemiAxes<Scalar>;
    using Stage = RollingStage<Scalar>;

    /// For n unknowns of both directions together.
    explicit ShapeStages(Eigen::Index n)
        : change_(Vector::Zero(n)),
          carried_(change_),
          now_(change_),
          scratch_(change_),
          sum_(change_),
          spin_(change_),
          start_(change_),
          per_end_(Matrix::Zero(n, 3)),
          carried_per_end_(per_end_) {
        per_axis_.fill(change_);
        carried_per_axis_.fill(change_);
    }

    /// From `old`, the unknowns at the semi-axes `from`, to those at `to`, rolling dq; the derivatives by `to` only if
    /// asked for. `inputs` are those at semi-axes 1.
    void solve(std::uint64_t model, const ShapeSet<Scalar>& set, Scalar a_over_b,
               const RationalExponential<Scalar>& integrator, const Matrix& inputs, const Vector& old, const Axes& from,
               const Axes& to, Scalar dq, const ImposedMotion<3, Scalar>& motion, bool by_axes,
               StageFactors<Scalar>& factors) {
        const Scalar part = integrator.gamma;
        const bool varies = from != to;
        if (varies) Shape(set, a_over_b, from).find_displacements(vectors(old), vectors(start_));
        carried_.setZero();
        carried_per_end_.setZero();
        for (Vector& carried : carried_per_axis_) carried.setZero();
        for (int index = 1; index <= integrator.stages; ++index) {
            const bool last = index == integrator.stages;
            const Scalar along = last ? Scalar(1) : part;  // position of the stage in the step
            const Stage stage = Stage::of_patch(part, along, dq, from, to);
            const Shape shape(set, a_over_b, stage);
            factors.prepare(model, stage, [&](Matrix& M) {
                for_blocks(set, M, [&](std::size_t d, std::size_t e, auto block) {
                    shape.fill_stage_matrix(stage, d, e, block);
                });
            });
            turn(inputs, stage.half_width, stage.half_length, spin_);

            // solved for the change, so that short steps keep their digits
            change_ = carried_;
            shape.add_travel(stage, vectors(old), vectors(scratch_), vectors(change_));
            if (varies) {
                shape.find_displacements(vectors(old), vectors(scratch_));
                scratch_ -= start_;  // the growth of U at constant tractions
                change_ -= scratch_;
            }
            const Scalar per_end = part * (motion.shift_per_end + along * motion.ramp_per_end);
            for (Eigen::Index j = 0; j < 3; ++j) {
                const Eigen::Ref<const Vector> input(j == 2 ? Eigen::Ref<const Vector>(spin_) : inputs.col(j));
                change_ -= part * (motion.shift[j] + along * motion.ramp[j]) * input;
                per_end_.col(j) = carried_per_end_.col(j) - per_end * input;
                factors.solve(per_end_.col(j));
            }
            if (varies && !last) carried_ = scratch_;
            factors.solve(change_);
            now_ = old + change_;
            if (by_axes) find_rates(shape, set, stage, part, along, inputs, motion, factors);
            if (last) return;

            const Scalar share = (1 - part) / part;
            shape.find_displacements(vectors(change_), vectors(scratch_));
            carried_ += scratch_;
            carried_ *= share;
            for (Eigen::Index j = 0; j < 3; ++j) {
                shape.find_displacements(vectors(per_end_.col(j)), vectors(carried_per_end_.col(j)));
            }
            carried_per_end_ *= share;
            if (!by_axes) continue;
            for (std::size_t k = 0; k < 2; ++k) {
                shape.find_displacements(vectors(per_axis_[k]), vectors(carried_per_axis_[k]));
                shape.add_displacement_rates(axes[k], along, vectors(now_), vectors(carried_per_axis_[k]));
                carried_per_axis_[k] *= share;
            }
        }
    }

    /// The unknowns per creepage of steady rolling, in per_end().
    void solve_steady(std::uint64_t model, const ShapeSet<Scalar>& set, Scalar a_over_b, const Matrix& inputs,
                      const Axes& at, StageFactors<Scalar>& factors) {
        const Stage stage{.distance = steadily, .half_length = at.half_length, .half_width = at.half_width};
        const Shape shape(set, a_over_b, at);
        factors.prepare(model, stage, [&](Matrix& M) {
            for_blocks(set, M, [&](std::size_t d, std::size_t e, auto block) { shape.fill_slope(1, d, e, block); });
        });
        turn(inputs, at.half_width, at.half_length, spin_);
        per_end_.leftCols(2) = inputs.leftCols(2);
        per_end_.col(2) = spin_;
        for (Eigen::Index j = 0; j < 3; ++j) factors.solve(per_end_.col(j));
    }

    const Vector& change() const { return change_; }    ///< of the unknowns
    const Matrix& per_end() const { return per_end_; }  ///< derivative by the motion's end values
    /// Derivatives by the half-length and by the half-width at the end, in those of the contact. In a set of one a/b the
    /// half-width follows the half-length, and the latter are 0.
    const Vector& per_length() const { return per_axis_[0]; }
    const Vector& per_width() const { return per_axis_[1]; }

private:
    using Axis = typename Shape::Axis;

    static constexpr std::array<Axis, 2> axes{Axis::half_length, Axis::half_width};
    static constexpr Scalar steadily = -2;  // stands for the distance rolled

    // Unknowns with a column for each direction.
    template <class Unknowns>
    static auto vectors(const Unknowns& unknowns) {
        return Eigen::Map<const Eigen::Matrix<Scalar, Eigen::Dynamic, 2>>(unknowns.data(), unknowns.rows() / 2, 2);
    }
    template <class Unknowns>
    static auto vectors(Unknowns&& unknowns) requires(!std::is_const_v<std::remove_reference_t<Unknowns>>) {
        return Eigen::Map<Eigen::Matrix<Scalar, Eigen::Dynamic, 2>>(unknowns.data(), unknowns.rows() / 2, 2);
    }

    template <class Fill>
    static void for_blocks(const ShapeSet<Scalar>& set, Matrix& M, const Fill& fill) {
        const Eigen::Index n = M.rows() / 2;
        for (std::size_t d = 0; d < 2; ++d) {
            for (std::size_t e = 0; e < 2; ++e) {
                auto block = M.block(static_cast<Eigen::Index>(d) * n, static_cast<Eigen::Index>(e) * n, n, n);
                if (d == e || set.coupled) {
                    fill(d, e, block);
                } else {
                    block.setZero();
                }
            }
        }
    }

    // The rigid slip of spin, (-y, x), stretched by both factors.
    static void turn(const Matrix& inputs, Scalar across, Scalar along, Vector& result) {
        const Eigen::Index n = result.size() / 2;
        result.head(n) = across * inputs.col(2).head(n);
        result.tail(n) = along * inputs.col(2).tail(n);
    }

    void find_rates(const Shape& shape, const ShapeSet<Scalar>& set, const Stage& stage, Scalar part, Scalar along,
                    const Matrix& inputs, const ImposedMotion<3, Scalar>& motion, StageFactors<Scalar>& factors) {
        const bool single = set.is_single();
        const Scalar turned = part * along * (motion.shift[2] + along * motion.ramp[2]);
        for (std::size_t k = 0; k < 2; ++k) {
            if (k == 1 && single) break;
            sum_.setZero();
            shape.add_rates(stage, axes[k], part, along, vectors(now_), vectors(scratch_), vectors(sum_));
            const bool by_length = axes[k] == Axis::half_length;
            turn(inputs, by_length && !single ? Scalar(0) : turned, by_length ? turned : Scalar(0), scratch_);
            per_axis_[k] = carried_per_axis_[k] - sum_ - scratch_;
            factors.solve(per_axis_[k]);
        }
    }

    Vector change_, carried_, now_, scratch_, sum_, spin_, start_;
    Matrix per_end_, carried_per_end_;
    std::array<Vector, 2> per_axis_, carried_per_axis_;
};

}  // namespace rollbem::detail
