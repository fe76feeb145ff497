// One step in full adhesion by the stages of its integrator, of a contact whose length may change during the step.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "../../types.hpp"
#include "rational_exponential.hpp"
#include "rolling_stage.hpp"
#include "stage_factors.hpp"

namespace rollbem::detail {

/// Solves a step of implicit_euler or sdirk2. Lengths are in units of a_0, the half-length for which the system was
/// made; everything else is in the unit of the unknowns y.
///
/// With M(a) as in LengthScale and dU/dq = (1 + a' zeta) du/dx - inputs v, each stage, of the fraction g of the step,
/// is
///
///     M(a_k) y_k - g (dq + da zeta) G' y_k = U_old + carried - g inputs v dq,    carried = ((1-g)/g) (U_1 - U_old)
///
/// where `carried` occurs in the last of two stages. It is solved for y_k - y_old, so that short steps keep their
/// digits.
///
/// For Chebyshev states y are the coefficients of u for a = 1, and represent the traction that causes it, whatever a
/// is. Their equations are again those of the tau method: both sides of the equation are polynomials of degree at most
/// m, and the tau method lets them differ by a multiple of T_m, which vanishes at the m Chebyshev points; m equations
/// at these points allow exactly that difference. The T_m in U itself also vanishes there.
template <int k, class Scalar>
class AdhesionStages {
public:
    using Vector = VectorX<Scalar>;

    explicit AdhesionStages(Eigen::Index n)
        : change_(Vector::Zero(n)),
          per_length_(change_),
          carried_(change_),
          carried_per_length_(change_),
          G_old_(change_),
          slope_(change_),
          scratch_(change_),
          now_(change_),
          per_end_(MatrixX<Scalar>::Zero(n, k)),
          carried_per_end_(per_end_) {}

    /// From `old`, the unknowns at the half-length `a_old`, to `a_new`, rolling dq > |a_new - a_old|, or not rolling at
    /// all with constant length. `inputs` times the travel is in the unit of y. per_length() is computed only if asked
    /// for.
    void solve(std::uint64_t model, const Influence<Scalar>& influence, const RationalExponential<Scalar>& integrator,
               const MatrixX<Scalar>& inputs, const Vector& old, Scalar a_old, Scalar a_new, Scalar dq,
               const ImposedMotion<k, Scalar>& motion, bool by_length, StageFactors<Scalar>& factors) {
        using Stage = RollingStage<Scalar>;
        const Scalar da = a_new - a_old, part = integrator.gamma;
        const bool grows = da != 0;
        if (grows) G_old_.noalias() = influence.G * old;
        carried_.setZero();
        carried_per_end_.setZero();
        carried_per_length_.setZero();
        for (int index = 1; index <= integrator.stages; ++index) {
            const bool last = index == integrator.stages;
            const Scalar along = last ? Scalar(1) : part;  // position of the stage in the step
            const Stage stage = last ? Stage::last(part, dq, a_old, a_new) : Stage::within(part, dq, a_old, a_new);
            const Scalar a = stage.half_length;
            factors.prepare(model, influence, stage);

            change_ = carried_;
            if (grows) add_growth(influence, LengthScale<Scalar>::growth(a_old, a), -1, old, change_);
            slope_.noalias() = influence.G_prime * old;
            if (grows) {
                change_.array() += (part * (dq + da * influence.points)) * slope_.array();
            } else {
                change_ += (part * dq) * slope_;
            }
            const Scalar per_end = part * (motion.shift_per_end + along * motion.ramp_per_end);
            for (Eigen::Index j = 0; j < k; ++j) {
                change_ -= part * (motion.shift[j] + along * motion.ramp[j]) * inputs.col(j);
                per_end_.col(j) = carried_per_end_.col(j) - per_end * inputs.col(j);
                factors.solve(per_end_.col(j));
            }
            factors.solve(change_);
            // by a_new: the derivative of M, through a_k, and of the travel zeta da of the points
            if (by_length) {
                now_ = old + change_;
                slope_.noalias() = influence.G_prime * now_;
                influence.find_displacement(LengthScale<Scalar>::rate(a), now_, scratch_);
                per_length_ = carried_per_length_ - along * scratch_;
                per_length_.array() += part * influence.points * slope_.array();
                factors.solve(per_length_);
            }
            if (last) return;

            const Scalar share = (1 - part) / part;
            const LengthScale<Scalar> scale = LengthScale<Scalar>::at(a);
            if (by_length) {
                carried_per_length_ = share * along * scratch_;
                influence.find_displacement(scale, per_length_, scratch_);
                carried_per_length_ += share * scratch_;
            }
            if (grows) add_growth(influence, LengthScale<Scalar>::growth(a_old, a), share, old, carried_);
            influence.find_displacement(scale, change_, scratch_);
            carried_ += share * scratch_;
            for (Eigen::Index j = 0; j < k; ++j) {
                influence.find_displacement(scale, per_end_.col(j), carried_per_end_.col(j));
            }
            carried_per_end_ *= share;
        }
    }

    const Vector& change() const { return change_; }             ///< of the unknowns
    const MatrixX<Scalar>& per_end() const { return per_end_; }  ///< derivative by the motion's end values
    const Vector& per_length() const { return per_length_; }     ///< derivative by a_new

private:
    // adds factor times what `old` causes at the scale
    void add_growth(const Influence<Scalar>& influence, const LengthScale<Scalar>& scale, Scalar factor,
                    const Vector& old, Vector& sum) {
        scratch_ = G_old_;
        influence.rescale(scale, old, scratch_);
        sum += factor * scratch_;
    }

    Vector change_, per_length_, carried_, carried_per_length_, G_old_, slope_, scratch_, now_;
    MatrixX<Scalar> per_end_, carried_per_end_;
};

}  // namespace rollbem::detail
