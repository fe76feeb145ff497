// The rational function of an integrator, and the motion in a step.
#pragma once

#include <array>
#include <cstddef>

#include "../../rolling/detail/stage_table.hpp"
#include "../../rolling/run.hpp"
#include "../../scene/detail/directions.hpp"
#include "../../scene/rigid_motion.hpp"

namespace rollbem::detail {

/// The approximation r(w) = 1 + sum_j b_j y^j, y = part w / (1 - part w), of e^w by an integrator. With stages it is
/// 1/(1 - w) or (1 + (1 - 2 part) w)/(1 - part w)^2. The matrix exponential has the Taylor series of e^w in y, whose
/// coefficients are Laguerre polynomials of 1/part. It is truncated after the eighth term, where 1/part is a zero of
/// the Laguerre polynomial of that degree, which makes r(-inf) = 0 (Noersett 1974; Hairer & Wanner II, IV.6).
struct RationalExponential {
    explicit RationalExponential(Integrator integrator) {
        if (const auto stages = stage_table(integrator)) {
            *this = RationalExponential(*stages);
            return;
        }
        degree = 8;
        const auto inverse_part = static_cast<double>(4.266700170287658793649421826900639634482L);
        part = 1 / inverse_part;
        double before = 1;
        b_[1] = inverse_part;
        for (int j = 1; j < degree; ++j) {
            const double next = ((inverse_part - double(2 * j)) * b(j) - double(j - 1) * before) / double(j + 1);
            before = b(j);
            b_[static_cast<std::size_t>(j + 1)] = next;
        }
    }
    explicit RationalExponential(const StageTable& stages) : degree(stages.count()), part(stages.part()) {
        b_[1] = 1 / part;
        if (degree == 2) b_[2] = stages.place(2).ratio();
    }

    double b(int j) const { return b_[static_cast<std::size_t>(j)]; }  ///< 1 <= j <= degree; 0 beyond

    /// Coefficients of (r(w) - 1)/w - 1 in y^j: the response to linear creepage.
    double ramp_weight(int j) const { return part * (b(j) + b(j + 1)); }

    int degree = 1;
    double part = 1;

private:
    std::array<double, 10> b_{};
};

/// The rigid slip of a motion in a step: shifts at constant creepage, ramps by a linear change, and their derivatives
/// with respect to the motion's end values, the same for each creepage.
template <int directions>
struct ImposedMotion {
    ImposedMotion(const RigidMotion<CreepageAlong<directions>>& motion, double dq) noexcept
        : shift(in_order(motion.start())) {
        if (motion.is_shift()) {
            shift_per_end = 1;
            return;
        }
        if (motion.is_linear()) {
            ramp = (in_order(motion.end()) - shift) * dq;
            ramp_per_end = dq;
        } else {
            shift_per_end = dq;
        }
        shift *= dq;
    }

    InputVector<directions> shift, ramp = InputVector<directions>::Zero();  ///< [m], for spin angles
    double shift_per_end = 0, ramp_per_end = 0;                             ///< [m], or 1 for a shift
};

}  // namespace rollbem::detail
