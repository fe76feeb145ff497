// StripKernel: the line kernel of a contact of finite half-width b.
#pragma once

#include <cmath>
#include <numbers>

#include "../detail/finite.hpp"
#include "../scene/contact.hpp"
#include "detail/parameters.hpp"
#include "kernel_concepts.hpp"

namespace rollbem {

/// Eqs. (3) and (7): Cerruti's solution, integrated over -b <= y <= b and seen from y = 0:
/// g = (2/(pi G)) [c1 asinh(b/|x|) + c2 b / sqrt(x^2 + b^2)].
template <class Scalar_ = double>
class StripKernel {
public:
    using Scalar = Scalar_;

    /// half_width b in units of a; (c1, c2) = (1 - nu, nu) for longitudinal creepage and (1, -nu) for lateral. Throws
    /// std::invalid_argument unless b > 0 and c1 and c2 are finite.
    StripKernel(Scalar half_width, Scalar c1, Scalar c2) : b_(half_width), c1_(c1), c2_(c2) {
        detail::check_line_kernel("StripKernel", half_width, c1, c2);
    }

    static StripKernel longitudinal(const Contact& contact) {
        return detail::longitudinal_kernel<StripKernel>(contact);
    }
    static StripKernel lateral(const Contact& contact) { return detail::lateral_kernel<StripKernel>(contact); }

    Scalar half_width() const { return b_; }  ///< b in units of a

    /// With r = sqrt(x^2 + b^2), asinh(b/|x|) = ln(2b) - ln|x| + ln((b + r)/(2b)) and b/r = 1 + (b/r - 1): r has branch
    /// points at +-ib.
    SmoothSplit<Scalar> smooth_split() const { return {scale() * (c1_ * std::log(2 * b_) + c2_), scale() * c1_, b_}; }

    /// (2/pi) [c1 ln((b + r)/(2b)) + c2 (b/r - 1)] with r - b = x^2/(r + b): nothing cancels in wide strips.
    Scalar smooth_part(Scalar x) const {
        const Scalar r = std::sqrt(x * x + b_ * b_), rise = x * x / (r + b_);
        return scale() * (c1_ * std::log1p(rise / (2 * b_)) - c2_ * (rise / r));
    }
    /// Written in x/r and b/r so that nothing overflows or cancels.
    Scalar smooth_slope(Scalar x) const {
        if (!detail::is_finite(b_)) return 0;
        const Scalar r = std::sqrt(x * x + b_ * b_), inverse = 1 / r;
        return scale() * (x * inverse) * (c1_ / (b_ + r) - c2_ * (b_ * inverse) * inverse);
    }

private:
    static constexpr Scalar scale() { return 2 / std::numbers::pi_v<Scalar>; }

    Scalar b_, c1_, c2_;
};

}  // namespace rollbem
