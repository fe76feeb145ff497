// Bodies of elasticity/line_kernel.hpp. Internal.
#pragma once

#include "../line_kernel.hpp"

#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>

#include "../../closed_form/detail/plane_lambda.hpp"
#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../detail/parameters.hpp"

namespace rollbem {

template <class Scalar_>
PlaneKernel<Scalar_>::PlaneKernel(Scalar half_width, Scalar c1, Scalar c2)
    : b_(half_width),
      lambda_(detail::plane_lambda_of(half_width, c2 / c1)),
      strength_(2 * c1 / std::numbers::pi_v<Scalar>),
      constant_(2 / std::numbers::pi_v<Scalar> * (c1 * std::log(2 * half_width) + c2)) {
    detail::check_line_kernel("PlaneKernel", half_width, c1, c2);
}

template <class Scalar_>
StripKernel<Scalar_>::StripKernel(Scalar half_width, Scalar c1, Scalar c2) : b_(half_width), c1_(c1), c2_(c2) {
    detail::check_line_kernel("StripKernel", half_width, c1, c2);
}

template <class Scalar_>
inline auto StripKernel<Scalar_>::smooth_part(Scalar x) const -> Scalar {
    const Scalar r = std::sqrt(x * x + b_ * b_), rise = x * x / (r + b_);
    return scale() * (c1_ * std::log1p(rise / (2 * b_)) - c2_ * (rise / r));
}

template <class Scalar_>
inline auto StripKernel<Scalar_>::smooth_slope(Scalar x) const -> Scalar {
    if (!detail::is_finite(b_)) return 0;
    const Scalar r = std::sqrt(x * x + b_ * b_), inverse = 1 / r;
    return scale() * (x * inverse) * (c1_ / (b_ + r) - c2_ * (b_ * inverse) * inverse);
}

template <class Scalar_>
AnyKernel<Scalar_>::AnyKernel(LineModel model, Scalar half_width, Scalar c1, Scalar c2)
    : is_plane_(model == LineModel::plane || !detail::is_finite(half_width)),
      plane_(half_width, c1, c2),
      strip_(half_width, c1, c2) {}

template <LineKernel Kernel>
LayeredKernel<Kernel>::LayeredKernel(Kernel kernel, std::type_identity_t<Scalar> compliance)
    : kernel_(std::move(kernel)), compliance_(compliance) {
    detail::require_not_negative("LayeredKernel", "compliance", compliance);
}

template <LineKernel Kernel>
auto LayeredKernel<Kernel>::smooth_split() const -> SmoothSplit<Scalar> {
    SmoothSplit<Scalar> split = kernel_.smooth_split();
    split.compliance += compliance_;
    return split;
}

}  // namespace rollbem
