// One step in full adhesion by the stages of its integrator, of a contact whose semi-axes may change during the step.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <Eigen/Core>

#include "../../rolling/stage_equations.hpp"
#include "../../rolling/step_frame.hpp"
#include "../../scene/semi_axes.hpp"
#include "../../types.hpp"
#include "../state.hpp"
#include "stage_factors.hpp"

namespace rollbem::detail {

/// A vector of unknowns, of two directions the longitudinal ones first, as columns.
template <int columns, class Unknowns>
auto in_columns(const Unknowns& unknowns) {
    using Columns = Eigen::Matrix<typename Unknowns::Scalar, Eigen::Dynamic, columns>;
    return Eigen::Map<const Columns>(unknowns.data(), unknowns.rows() / columns, columns);
}
template <int columns, class Unknowns>
auto in_columns(Unknowns&& unknowns) requires(!std::is_const_v<std::remove_reference_t<Unknowns>>) {
    using Columns = Eigen::Matrix<typename std::remove_reference_t<Unknowns>::Scalar, Eigen::Dynamic, columns>;
    return Eigen::Map<Columns>(unknowns.data(), unknowns.rows() / columns, columns);
}

/// A step in full adhesion while its stages are solved, from the unknowns `old`. Stages of one `model` have the same
/// matrices. `inputs` times a motion in metres is in the unit of the unknowns. Of the derivatives with respect to the
/// semi-axes at the end `axes` are computed: 0, 1 (by the half-length) or 2.
template <int k, class Scalar>
struct AdhesionFrame : StepFrame<typename AdhesionValues<k, Scalar>::Value, Scalar> {
    std::uint64_t model;
    const VectorX<Scalar>& old;
    const MatrixX<Scalar>& inputs;
    std::size_t axes;
    StageFactors<Scalar>& factors;
};

/// Solves a step by the stages of a StageTable for k creepages. Lengths are in units of a_0, the half-length for which
/// the system was made; everything else is in the unit of the unknowns y.
///
/// With dU/dq = (1 + a' zeta) du/dx - inputs v on a line, and U = M(a) y, each stage, of the part g of the step, is
///
///     M(a_k) y_k - g (dq + da zeta) G' y_k = U_old + carried - g inputs v dq,    carried = ratio (U_1 - U_old)
///
/// with ratio = (1-g)/g, where `carried` occurs in the last of two stages. It is solved for y_k - y_old, so that short
/// steps keep their digits.
template <int k, class Scalar>
class AdhesionStages {
public:
    using Vector = VectorX<Scalar>;

    explicit AdhesionStages(Eigen::Index n)
        : change_(Vector::Zero(n)),
          carried_(change_),
          start_(change_),
          growth_(change_),
          scratch_(change_),
          now_(change_),
          per_end_(MatrixX<Scalar>::Zero(n, k)),
          carried_per_end_(per_end_) {
        per_axis_.fill(change_);
        carried_per_axis_.fill(change_);
    }

    /// with(stage, use) calls use(equations) with those of a stage.
    template <class Frame, class With>
    void solve(Frame& frame, const With& with) {
        carried_.setZero();
        carried_per_end_.setZero();
        for (std::size_t axis = 0; axis < frame.axes; ++axis) carried_per_axis_[axis].setZero();
        Frame::solve_stages(frame, Stages<With>{*this, with});
    }

    /// The unknowns per creepage of steady rolling of a patch, in per_end().
    void solve_steady(std::uint64_t model, const ShapeEquations<Scalar>& equations, const MatrixX<Scalar>& inputs,
                      StageFactors<Scalar>& factors) {
        factors.prepare(model, equations.stage, [&](MatrixX<Scalar>& M) {
            fill<2>(M, equations, [&](auto d, auto e, auto&& block) { equations.fill_slope(1, d, e, block); });
        });
        for (Eigen::Index j = 0; j < k; ++j) {
            per_end_.col(j) = rigid<2>(inputs, j, equations.stage, scratch_);
            factors.solve(per_end_.col(j));
        }
    }

    const Vector& change() const { return change_; }             ///< of the unknowns
    const MatrixX<Scalar>& per_end() const { return per_end_; }  ///< derivative with respect to the motion's end values
    /// Derivatives with respect to the half-length and by the half-width at the end, in those of the contact.
    const Vector& per_length() const { return per_axis_[0]; }
    const Vector& per_width() const { return per_axis_[1]; }

private:
    static constexpr std::array<Axis, 2> of{Axis::half_length, Axis::half_width};

    template <class With>
    struct Stages {
        AdhesionStages& own;
        const With& with;

        template <class Frame>
        void solve_stage(Frame& frame) const {
            with(frame.stage, [&](const auto& equations) {
                own.prepare(frame, equations);
                own.find_change(frame, equations);
                own.find_per_end(frame, equations);
                own.find_per_axis(frame, equations);
            });
        }
        template <class Frame>
        void carry(Frame& frame) const {
            with(frame.stage, [&](const auto& equations) { own.carry(frame, equations); });
        }
    };
    template <class Equations>
    static constexpr int columns = std::remove_cvref_t<Equations>::columns;

    template <class Frame, class Equations>
    void prepare(const Frame& frame, const Equations& equations) {
        frame.factors.prepare(frame.model, equations.stage, [&](MatrixX<Scalar>& M) {
            fill<columns<Equations>>(M, equations, [&](auto d, auto e, auto&& block) { equations.fill(d, e, block); });
        });
    }
    template <class Frame, class Equations>
    void find_change(const Frame& frame, const Equations& equations) {
        const auto in = [](auto&& unknowns) { return in_columns<columns<Equations>>(unknowns); };
        change_ = carried_;
        equations.add_travel(in(frame.old), in(scratch_), in(change_));
        if (frame.varies()) {
            if (!frame.place.is_second) equations.find_start(frame.start, in(frame.old), in(start_));
            equations.find_growth(frame.start, in(frame.old), in(start_), in(growth_));
            change_ -= growth_;
        }
        const InputVector<k, Scalar> moved =
            frame.unit * frame.factor() * AdhesionValues<k, Scalar>::vector(frame.moved());
        for (Eigen::Index j = 0; j < k; ++j) {
            change_ -= moved[j] * rigid<columns<Equations>>(frame.inputs, j, equations.stage, scratch_);
        }
        frame.factors.solve(change_);
    }
    template <class Frame, class Equations>
    void find_per_end(const Frame& frame, const Equations& equations) {
        const Scalar per_end = frame.unit * frame.per_end();
        for (Eigen::Index j = 0; j < k; ++j) {
            per_end_.col(j) = carried_per_end_.col(j) -
                              per_end * rigid<columns<Equations>>(frame.inputs, j, equations.stage, scratch_);
            frame.factors.solve(per_end_.col(j));
        }
    }
    template <class Frame, class Equations>
    void find_per_axis(const Frame& frame, const Equations& equations) {
        const auto in = [](auto&& unknowns) { return in_columns<columns<Equations>>(unknowns); };
        if (frame.axes > 0) now_ = frame.old + change_;
        for (std::size_t axis = 0; axis < frame.axes; ++axis) {
            Vector& response = per_axis_[axis];
            response.setZero();
            equations.add_rates(of[axis], frame.place, in(now_), in(scratch_), in(response));
            if constexpr (columns<Equations> == 2) {  // the rigid slip of spin follows the points
                const Scalar spin = AdhesionValues<k, Scalar>::vector(frame.moved())[k - 1];
                const Scalar turned = frame.place.progress * frame.unit * frame.factor() * spin;
                const bool by_length = axis == 0;
                turn(frame.inputs, by_length && !equations.is_single() ? Scalar(0) : turned,
                     by_length ? turned : Scalar(0), scratch_);
                response += scratch_;
            }
            response = carried_per_axis_[axis] - response;
            frame.factors.solve(response);
        }
    }
    template <class Frame, class Equations>
    void carry(const Frame& frame, const Equations& equations) {
        const auto in = [](auto&& unknowns) { return in_columns<columns<Equations>>(unknowns); };
        const Scalar ratio = frame.place.ratio();
        equations.find_displacements(in(change_), in(carried_));
        if (frame.varies()) carried_ += growth_;
        carried_ *= ratio;
        for (Eigen::Index j = 0; j < k; ++j) {
            equations.find_displacements(in(per_end_.col(j)), in(carried_per_end_.col(j)));
        }
        carried_per_end_ *= ratio;
        for (std::size_t axis = 0; axis < frame.axes; ++axis) {
            Vector& carried = carried_per_axis_[axis];
            equations.find_displacements(in(per_axis_[axis]), in(carried));
            equations.add_displacement_rates(of[axis], frame.place.progress, in(now_), in(scratch_), in(carried));
            carried *= ratio;
        }
    }

    // The matrix of all unknowns, by fill_block(d, e, block).
    template <int columns_of_unknowns, class Equations, class FillBlock>
    static void fill(MatrixX<Scalar>& M, [[maybe_unused]] const Equations& equations, const FillBlock& fill_block) {
        if constexpr (columns_of_unknowns == 1) {
            fill_block(std::size_t(0), std::size_t(0), M);
        } else {
            const Eigen::Index n = M.rows() / 2;
            for (std::size_t d = 0; d < 2; ++d) {
                for (std::size_t e = 0; e < 2; ++e) {
                    auto block = M.block(static_cast<Eigen::Index>(d) * n, static_cast<Eigen::Index>(e) * n, n, n);
                    if (d == e || equations.coupled()) {
                        fill_block(d, e, block);
                    } else {
                        block.setZero();
                    }
                }
            }
        }
    }

    // The rigid slip of a unit input; on a patch that of spin, (-y, x), is stretched with its semi-axes, into `spin`.
    template <int columns_of_unknowns>
    static Eigen::Ref<const Vector> rigid(const MatrixX<Scalar>& inputs, Eigen::Index j,
                                          const RollingStage<Scalar>& stage, Vector& spin) {
        if (columns_of_unknowns == 1 || j < 2) return inputs.col(j);
        turn(inputs, stage.half_width, stage.half_length, spin);
        return spin;
    }
    static void turn(const MatrixX<Scalar>& inputs, Scalar across, Scalar along, Vector& result) {
        const Eigen::Index n = result.size() / 2;
        result.head(n) = across * inputs.col(k - 1).head(n);
        result.tail(n) = along * inputs.col(k - 1).tail(n);
    }

    Vector change_, carried_, start_, growth_, scratch_, now_;
    MatrixX<Scalar> per_end_, carried_per_end_;
    std::array<Vector, k == 1 ? 1 : 2> per_axis_, carried_per_axis_;
};

}  // namespace rollbem::detail
