// One step in full adhesion of a contact whose length changes during the step: the system scales with the length, and
// nothing is assembled again.
#pragma once

#include "../../detail/language.hpp"

#include <array>
#include <cmath>

#include <Eigen/Core>

#include "../../assembly/rolling_system.hpp"
#include "../../detail/in_place_lu.hpp"
#include "../../types.hpp"
#include "rational_exponential.hpp"

namespace rollbem::detail {

/// Solves a step of implicit_euler or sdirk2 for up to `largest` unknowns, on the stack. Lengths are in units of a_0,
/// the half-length for which the system was made; everything else is in the unit of the unknowns y.
///
/// With x = a zeta, U(zeta) = u(a zeta) and the kernel C - S ln|x|, a contact of half-length a has
///
///     U = M(a) y,  M(a) = a (G - S ln(a) 1 w^T),    du/dx = G' y,    F = a w.y,    dU/dq = (1 + a' zeta) du/dx - xi,
///
/// where G, G', w and the points zeta are those of the system: the length adds a constant to the logarithm, which
/// displaces the whole contact uniformly and has no slope. Each stage, of the fraction g of the step, is
///
///     M(a_k) y_k - g (dq + da zeta) G' y_k = U_old + carried - g xi dq,    carried = ((1-g)/g) (U_1 - U_old)
///
/// where `carried` occurs in the last of two stages. It is solved for y_k - y_old, so that short steps keep their
/// digits.
///
/// For Chebyshev states y are the coefficients of u for a = 1, and represent the traction that causes it, whatever a
/// is. Their equations are again those of the tau method: both sides of the equation are polynomials of degree at most
/// m, and the tau method lets them differ by a multiple of T_m, which vanishes at the m Chebyshev points; m equations
/// at these points allow exactly that difference. The T_m in U itself also vanishes there.
template <class Scalar, Eigen::Index largest>
class BreathingStep {
public:
    using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1, Eigen::ColMajor, largest, 1>;

    /// For a system with points() and log_strength(), to which it keeps a reference.
    BreathingStep(const RollingSystem<Scalar>& system, const RationalExponential<Scalar>& integrator)
        : system_(system),
          strength_(*system.log_strength()),
          gamma_(integrator.gamma),
          stages_(integrator.stages),
          n_(system.size()) {}

    /// From `old`, the unknowns at the half-length `a_old`, to `a_new`, rolling dq > |a_new - a_old|, or not rolling at
    /// all with constant length. The travel is in the unit of y.
    void solve(const VectorX<Scalar>& old, Scalar a_old, Scalar a_new, Scalar dq, const Travel<Scalar>& travel) {
        const Scalar da = a_new - a_old;
        const Vector G_old = product(system_.G(), old), slope_old = product(system_.G_prime(), old);
        const Scalar sum_old = sum(old);
        // U_1 - U_old times the factor with which it enters the last stage, and its derivatives
        Vector carried = Vector::Zero(n_), carried_per_end = carried, carried_per_length = carried;
        for (int stage = 1; stage <= stages_; ++stage) {
            const bool last = stage == stages_;
            const Scalar along = last ? Scalar(1) : gamma_;  // position of the stage in the step
            const Scalar a = last ? a_new : a_old + gamma_ * da;
            factorise(a, dq, da);

            const Scale growth = growth_of(a_old, a);
            change_ = carried;
            add(growth, -1, G_old, sum_old, change_);
            const Scalar shift = travel.shift + along * travel.ramp;
            for (Eigen::Index l = 0; l < n_; ++l) {
                change_[l] += gamma_ * ((dq + da * zeta(l)) * slope_old[l] - shift);
            }
            solve_in_place<Scalar>(factors(), swaps_.data(), change_);

            const Scalar shift_per_end = travel.shift_per_end + along * travel.ramp_per_end;
            for (Eigen::Index l = 0; l < n_; ++l) per_end_[l] = carried_per_end[l] - gamma_ * shift_per_end;
            solve_in_place<Scalar>(factors(), swaps_.data(), per_end_);

            // by a_new: the derivative of M, through a_k, and of the travel zeta da of the points
            const Vector now = old + change_;
            const Vector G_now = product(system_.G(), now), slope_now = product(system_.G_prime(), now);
            const Scale rate{1, std::log(a) + 1};
            const Scalar sum_now = sum(now);
            per_length_ = carried_per_length;
            add(rate, -along, G_now, sum_now, per_length_);
            for (Eigen::Index l = 0; l < n_; ++l) per_length_[l] += gamma_ * zeta(l) * slope_now[l];
            solve_in_place<Scalar>(factors(), swaps_.data(), per_length_);
            if (last) return;

            const Scalar share = (1 - gamma_) / gamma_;
            const Scale scale{a, a * std::log(a)};
            add(growth, share, G_old, sum_old, carried);
            add(scale, share, product(system_.G(), change_), sum(change_), carried);
            add(scale, share, product(system_.G(), per_end_), sum(per_end_), carried_per_end);
            add(scale, share, product(system_.G(), per_length_), sum(per_length_), carried_per_length);
            add(rate, share * along, G_now, sum_now, carried_per_length);
        }
    }

    const Vector& change() const { return change_; }          ///< of the unknowns
    const Vector& per_end() const { return per_end_; }        ///< derivative by the motion's end value
    const Vector& per_length() const { return per_length_; }  ///< derivative by a_new

private:
    // linear G - logarithmic S 1 w^T: M(a), its derivative, or a difference of two
    struct Scale {
        Scalar linear, logarithmic;
    };

    // the difference of a ln a between both ends, without cancellation
    static Scale growth_of(Scalar a_old, Scalar a_new) {
        const Scalar da = a_new - a_old;
        return {da, da * std::log(a_old) + a_new * std::log1p(da / a_old)};
    }

    template <class V>
    Vector product(const MatrixX<Scalar>& matrix, const V& y) const {
        Vector result(n_);
        result.noalias() = matrix * y;
        return result;
    }

    template <class V>
    Scalar sum(const V& y) const {
        return system_.weights().matrix().dot(y);
    }

    // adds factor times the scaled matrix times y to `out`
    void add(const Scale& scale, Scalar factor, const Vector& G_y, Scalar sum_y, Vector& out) const {
        const Scalar constant = strength_ * scale.logarithmic * sum_y;
        for (Eigen::Index l = 0; l < n_; ++l) out[l] += factor * (scale.linear * G_y[l] - constant);
    }

    Scalar zeta(Eigen::Index l) const { return (*system_.points())[l]; }

    MatrixRef<Scalar> factors() { return Eigen::Map<MatrixX<Scalar>>(memory_.data(), n_, n_); }

    void factorise(Scalar a, Scalar dq, Scalar da) {
        const Scalar logarithmic = strength_ * a * std::log(a);
        Scalar* entry = memory_.data();
        for (Eigen::Index m = 0; m < n_; ++m) {
            const Scalar constant = logarithmic * system_.weights()[m];
            const Scalar* G = system_.G().data() + m * n_;
            const Scalar* G_prime = system_.G_prime().data() + m * n_;
            for (Eigen::Index l = 0; l < n_; ++l) {
                *entry++ = a * G[l] - constant - gamma_ * (dq + da * zeta(l)) * G_prime[l];
            }
        }
        factorise_in_place<Scalar>(factors(), swaps_.data());
    }

    const RollingSystem<Scalar>& system_;
    Scalar strength_, gamma_;
    int stages_;
    Eigen::Index n_;
    Vector change_{n_}, per_end_{n_}, per_length_{n_};
    alignas(64) std::array<Scalar, largest * largest> memory_;
    std::array<Eigen::Index, largest> swaps_;
};

}  // namespace rollbem::detail
