// The rational function of an integrator, and the motion in a step.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "../../scene/rigid_motion.hpp"
#include "../integrator.hpp"
#include "../state.hpp"

namespace rollbem::detail {

/// r(w) = sum_j b_j y^j, y = gamma w / (1 - gamma w): the Taylor series of e^w in y, whose coefficients are Laguerre
/// polynomials of 1/gamma. It is truncated after `stages` terms, where 1/gamma is a zero of the Laguerre polynomial of
/// that degree, which makes r(-inf) = 0 (Noersett 1974; Hairer & Wanner II, IV.6).
template <class Scalar>
struct RationalExponential {
    explicit RationalExponential(Integrator integrator) {
        const StageTable<Scalar> table = stage_table<Scalar>(integrator);
        stages = table.count;
        gamma = table.part;
        const Scalar inverse_gamma = 1 / gamma;
        Scalar before = 1;
        b_[1] = inverse_gamma;
        for (int j = 1; j < stages; ++j) {
            const Scalar next = ((inverse_gamma - Scalar(2 * j)) * b(j) - Scalar(j - 1) * before) / Scalar(j + 1);
            before = b(j);
            b_[static_cast<std::size_t>(j + 1)] = next;
        }
    }

    Scalar b(int j) const { return b_[static_cast<std::size_t>(j)]; }  ///< 1 <= j <= stages; 0 beyond

    /// Coefficients of (r(w) - 1)/w - 1 in y^j: the response to linear creepage.
    Scalar ramp_weight(int j) const { return gamma * (b(j) + b(j + 1)); }

    int stages = 1;
    Scalar gamma = 1;

private:
    std::array<Scalar, 10> b_{};
};

/// What a motion imposes on a step of k creepages: the shifts at constant creepage, the contributions of a linear
/// change, and their derivatives with respect to the motion's end values, the same for each creepage.
template <int k, class Scalar>
struct ImposedMotion {
    using Values = AdhesionValues<k, Scalar>;

    ImposedMotion(const RigidMotion<typename Values::Value>& motion, Scalar dq) noexcept
        : shift(Values::vector(motion.start())) {
        if (motion.is_shift()) {
            shift_per_end = 1;
            return;
        }
        if (motion.is_linear()) {
            ramp = (Values::vector(motion.end()) - shift) * dq;
            ramp_per_end = dq;
        } else {
            shift_per_end = dq;
        }
        shift *= dq;
    }

    InputVector<k, Scalar> shift, ramp = InputVector<k, Scalar>::Zero();  ///< [m], for spin angles
    Scalar shift_per_end = 0, ramp_per_end = 0;                           ///< [m], or 1 for a shift
};

}  // namespace rollbem::detail
