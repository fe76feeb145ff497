// One step in full adhesion by the stages of its integrator, of a contact whose semi-axes may change during the step.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <Eigen/Core>

#include "../../rolling/shape_influence.hpp"
#include "../../rolling/stage.hpp"
#include "../../scene/semi_axes.hpp"
#include "../../system/shape_set.hpp"
#include "../../types.hpp"
#include "rational_exponential.hpp"
#include "stage_factors.hpp"

namespace rollbem::detail {

/// The equations of a stage where the length alone may vary, as in LengthScale. They refer to their arguments.
///
/// For Chebyshev states the unknowns are the coefficients of u for a = 1, and represent the traction that causes it,
/// whatever a is. Their equations are again those of the tau method: both sides of the equation are polynomials of degree
/// at most m, and the tau method lets them differ by a multiple of T_m, which vanishes at the m Chebyshev points; m
/// equations at these points allow exactly that difference. The T_m in U itself also vanishes there.
template <class Scalar>
struct LineEquations {
    using Vector = VectorX<Scalar>;
    using Matrix = MatrixX<Scalar>;

    const Influence<Scalar>& influence;
    const Matrix& inputs;
    Scalar from;  // half-length at the start of the step
    RollingStage<Scalar> stage;

    Scalar a() const { return stage.half_length; }

    void fill(Matrix& M) const { influence.fill_stage_matrix(stage, M); }
    Eigen::Ref<const Vector> input(Eigen::Index j, Vector&) const { return inputs.col(j); }
    /// What find_growth needs of the start of the step.
    void find_start(const Vector& old, Vector& start) const { start.noalias() = influence.G * old; }
    /// The change of U since the start of the step at constant unknowns.
    void find_growth(const Vector& old, const Vector& start, Vector& growth) const {
        growth = start;
        influence.rescale(LengthScale<Scalar>::growth(from, a()), old, growth);
    }
    /// Adds what the particles' way along du/dx changes.
    void add_travel(const Vector& old, Vector& slope, Vector& sum) const {
        slope.noalias() = influence.G_prime * old;
        if (stage.growth != 0) {
            sum.array() += (stage.distance + stage.growth * influence.points) * slope.array();
        } else {
            sum += stage.distance * slope;
        }
    }
    template <class Unknowns, class Displacement>
    void find_displacement(const Unknowns& y, Displacement&& U) const {
        influence.find_displacement(LengthScale<Scalar>::at(a()), y, U);
    }
    /// Adds dU/da times `progress`, of the half-length at the end of the step.
    void add_displacement_rates(std::size_t, Scalar progress, const Vector& y, Vector& scratch, Vector& sum) const {
        influence.find_displacement(LengthScale<Scalar>::rate(a()), y, scratch);
        sum += progress * scratch;
    }
    /// The derivative with respect to the half-length at the end of the step of the equations at constant unknowns.
    void find_rates(std::size_t axis, Scalar part, Scalar progress, Scalar, const Vector& y, Vector& scratch,
                    Vector& rates) const {
        scratch.noalias() = influence.G_prime * y;
        rates.array() = -part * influence.points * scratch.array();
        add_displacement_rates(axis, progress, y, scratch, rates);
    }
};

/// Those of a patch, as in ShapeInfluence: the unknowns are the tractions along x, then along y.
template <class Scalar>
class ShapeEquations {
public:
    using Vector = VectorX<Scalar>;
    using Matrix = MatrixX<Scalar>;
    using Axes = SemiAxes<Scalar>;
    using Shape = ShapeInfluence<Scalar>;

    ShapeEquations(const ShapeSet<Scalar>& set, Scalar a_over_b, const Matrix& inputs, const Axes& from,
                   const RollingStage<Scalar>& present)
        : stage(present), set_(set), a_over_b_(a_over_b), inputs_(inputs), from_(from), shape_(set, a_over_b, stage) {}

    const RollingStage<Scalar> stage;

    void fill(Matrix& M) const {
        for_blocks(M, [&](std::size_t d, std::size_t e, auto block) { shape_.fill_stage_matrix(stage, d, e, block); });
    }
    /// G' alone, of steady rolling.
    void fill_slope(Matrix& M) const {
        for_blocks(M, [&](std::size_t d, std::size_t e, auto block) { shape_.fill_slope(1, d, e, block); });
    }
    Eigen::Ref<const Vector> input(Eigen::Index j, Vector& spin) const {
        if (j < 2) return inputs_.col(j);
        turn(stage.half_width, stage.half_length, spin);
        return spin;
    }
    void find_start(const Vector& old, Vector& start) const {
        Shape(set_, a_over_b_, from_).find_displacements(vectors(old), vectors(start));
    }
    void find_growth(const Vector& old, const Vector& start, Vector& growth) const {
        find_displacement(old, growth);
        growth -= start;
    }
    void add_travel(const Vector& old, Vector& scratch, Vector& sum) const {
        shape_.add_travel(stage, vectors(old), vectors(scratch), vectors(sum));
    }
    template <class Unknowns, class Displacement>
    void find_displacement(const Unknowns& y, Displacement&& U) const {
        shape_.find_displacements(vectors(y), vectors(U));
    }
    /// By the half-length (axis 0) or the half-width at the end of the step.
    void add_displacement_rates(std::size_t axis, Scalar progress, const Vector& y, Vector&, Vector& sum) const {
        shape_.add_displacement_rates(axes[axis], progress, vectors(y), vectors(sum));
    }
    void find_rates(std::size_t axis, Scalar part, Scalar progress, Scalar spin, const Vector& y, Vector& scratch,
                    Vector& rates) const {
        rates.setZero();
        shape_.add_rates(stage, axes[axis], part, progress, vectors(y), vectors(scratch), vectors(rates));
        const Scalar turned = part * progress * spin;
        const bool by_length = axis == 0;
        turn(by_length && !set_.is_single() ? Scalar(0) : turned, by_length ? turned : Scalar(0), scratch);
        rates += scratch;
    }

private:
    using Axis = typename Shape::Axis;
    static constexpr std::array<Axis, 2> axes{Axis::half_length, Axis::half_width};

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
    void for_blocks(Matrix& M, const Fill& fill) const {
        const Eigen::Index n = M.rows() / 2;
        for (std::size_t d = 0; d < 2; ++d) {
            for (std::size_t e = 0; e < 2; ++e) {
                auto block = M.block(static_cast<Eigen::Index>(d) * n, static_cast<Eigen::Index>(e) * n, n, n);
                if (d == e || set_.coupled) {
                    fill(d, e, block);
                } else {
                    block.setZero();
                }
            }
        }
    }

    // The rigid slip of spin, (-y, x), stretched by both factors.
    void turn(Scalar across, Scalar along, Vector& result) const {
        const Eigen::Index n = result.size() / 2;
        result.head(n) = across * inputs_.col(2).head(n);
        result.tail(n) = along * inputs_.col(2).tail(n);
    }

    const ShapeSet<Scalar>& set_;
    Scalar a_over_b_;
    const Matrix& inputs_;
    Axes from_;
    Shape shape_;
};

/// Solves a step of implicit_euler or sdirk2 for k creepages. Lengths are in units of a_0, the half-length for which the
/// system was made; everything else is in the unit of the unknowns y.
///
/// With dU/dq = (1 + a' zeta) du/dx - inputs v on a line, and U = M(a) y, each stage, of the fraction g of the step, is
///
///     M(a_k) y_k - g (dq + da zeta) G' y_k = U_old + carried - g inputs v dq,    carried = ((1-g)/g) (U_1 - U_old)
///
/// where `carried` occurs in the last of two stages. It is solved for y_k - y_old, so that short steps keep their digits.
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

    /// From the unknowns `old`. at(part, progress) are the equations of the stage that takes `part` of the step and ends
    /// when `progress` of it is done; `varies`: the semi-axes change. `inputs` times the travel is in the unit of y. Of
    /// the derivatives with respect to the semi-axes at the end `axes` are computed: 0, 1 (by the half-length) or 2.
    template <class EquationsAt>
    void solve(std::uint64_t model, const EquationsAt& at, const RationalExponential<Scalar>& integrator, bool varies,
               const Vector& old, const ImposedMotion<k, Scalar>& motion, std::size_t axes,
               StageFactors<Scalar>& factors) {
        const Scalar part = integrator.gamma;
        carried_.setZero();
        carried_per_end_.setZero();
        for (std::size_t axis = 0; axis < axes; ++axis) carried_per_axis_[axis].setZero();
        for (int index = 1; index <= integrator.stages; ++index) {
            const bool last = index == integrator.stages;
            const Scalar along = last ? Scalar(1) : part;  // position of the stage in the step
            const auto equations = at(part, along);
            factors.prepare(model, equations.stage, [&](MatrixX<Scalar>& M) { equations.fill(M); });

            change_ = carried_;
            equations.add_travel(old, scratch_, change_);
            if (varies) {
                if (index == 1) equations.find_start(old, start_);
                equations.find_growth(old, start_, growth_);
                change_ -= growth_;
            }
            const Scalar per_end = part * (motion.shift_per_end + along * motion.ramp_per_end);
            for (Eigen::Index j = 0; j < k; ++j) {
                const Eigen::Ref<const Vector> input = equations.input(j, scratch_);
                change_ -= part * (motion.shift[j] + along * motion.ramp[j]) * input;
                per_end_.col(j) = carried_per_end_.col(j) - per_end * input;
                factors.solve(per_end_.col(j));
            }
            factors.solve(change_);
            if (axes > 0) now_ = old + change_;
            const Scalar spin = motion.shift[k - 1] + along * motion.ramp[k - 1];
            for (std::size_t axis = 0; axis < axes; ++axis) {
                Vector& response = per_axis_[axis];
                equations.find_rates(axis, part, along, spin, now_, scratch_, response);
                response = carried_per_axis_[axis] - response;
                factors.solve(response);
            }
            if (last) return;

            const Scalar share = (1 - part) / part;
            equations.find_displacement(change_, carried_);
            if (varies) carried_ += growth_;
            carried_ *= share;
            for (Eigen::Index j = 0; j < k; ++j) {
                equations.find_displacement(per_end_.col(j), carried_per_end_.col(j));
            }
            carried_per_end_ *= share;
            for (std::size_t axis = 0; axis < axes; ++axis) {
                Vector& carried = carried_per_axis_[axis];
                equations.find_displacement(per_axis_[axis], carried);
                equations.add_displacement_rates(axis, along, now_, scratch_, carried);
                carried *= share;
            }
        }
    }

    /// The unknowns per creepage of steady rolling of a patch, in per_end().
    void solve_steady(std::uint64_t model, const ShapeEquations<Scalar>& equations, StageFactors<Scalar>& factors) {
        factors.prepare(model, equations.stage, [&](MatrixX<Scalar>& M) { equations.fill_slope(M); });
        for (Eigen::Index j = 0; j < k; ++j) {
            per_end_.col(j) = equations.input(j, scratch_);
            factors.solve(per_end_.col(j));
        }
    }

    const Vector& change() const { return change_; }             ///< of the unknowns
    const MatrixX<Scalar>& per_end() const { return per_end_; }  ///< derivative with respect to the motion's end values
    /// Derivatives with respect to the half-length and by the half-width at the end, in those of the contact.
    const Vector& per_length() const { return per_axis_[0]; }
    const Vector& per_width() const { return per_axis_[1]; }

private:
    Vector change_, carried_, start_, growth_, scratch_, now_;
    MatrixX<Scalar> per_end_, carried_per_end_;
    std::array<Vector, k == 1 ? 1 : 2> per_axis_, carried_per_axis_;
};

}  // namespace rollbem::detail
