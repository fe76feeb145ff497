// Bodies of elasticity/patch_kernel.hpp. Internal.
#pragma once

#include "../patch_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

#include "../../detail/require.hpp"

namespace rollbem {

template <class Scalar_>
HalfSpace<Scalar_>::HalfSpace(Scalar poisson_ratio, std::type_identity_t<Scalar> layer_compliance)
    : nu_(poisson_ratio), layer_(layer_compliance) {
    detail::require_poisson_ratio("HalfSpace", nu_);
    detail::require_not_negative("HalfSpace", "layer_compliance", layer_);
}

template <class Scalar_>
inline auto HalfSpace<Scalar_>::corner(Scalar x, Scalar y) const -> RectangleInfluence<Scalar> {
    const Scalar r = std::sqrt(x * x + y * y);
    const Scalar width = (std::max)(std::abs(x), least), height = (std::max)(std::abs(y), least);
    // each product is 0 where its first factor is
    const Scalar along = std::copysign(x, x * y) * area_sine(height, width, r);
    const Scalar across = std::copysign(y, x * y) * area_sine(width, height, r);
    constexpr Scalar over_pi = std::numbers::inv_pi_v<Scalar>;
    return {over_pi * ((1 - nu_) * along + across), -over_pi * nu_ * r, over_pi * (along + (1 - nu_) * across)};
}

template <class Scalar_>
inline auto HalfSpace<Scalar_>::corner_lateral_slope(Scalar x, Scalar y) const -> RectangleInfluence<Scalar> {
    const Scalar r = (std::max)(std::sqrt(x * x + y * y), least);
    const Scalar width = (std::max)(std::abs(x), least), height = (std::max)(std::abs(y), least);
    const Scalar angle = std::copysign(area_sine(width, height, r), x), shear = nu_ * x / r;
    constexpr Scalar over_pi = std::numbers::inv_pi_v<Scalar>;
    return {over_pi * (angle - shear), -over_pi * nu_ * y / r, over_pi * ((1 - nu_) * angle + shear)};
}

template <class Scalar_>
inline auto HalfSpace<Scalar_>::coupling_integral(Scalar x, Scalar y) const -> Scalar {
    const Scalar r = std::sqrt(x * x + y * y);
    const Scalar width = (std::max)(std::abs(x), least), height = (std::max)(std::abs(y), least);
    const Scalar sum = height / (r + height) + area_sine(height, width, r);
    return -nu_ * std::numbers::inv_pi_v<Scalar> / 2 * x * x * std::copysign(sum, y);
}

template <class Scalar_>
inline auto HalfSpace<Scalar_>::line_coupling_integral(Scalar x, Scalar y) const -> Scalar {
    const Scalar r = (std::max)(std::sqrt(x * x + y * y), least);
    const Scalar width = (std::max)(std::abs(x), least), height = (std::max)(std::abs(y), least);
    return nu_ * std::numbers::inv_pi_v<Scalar> * (std::copysign(area_sine(height, width, r), y) - y / r);
}

template <class Scalar_>
inline auto HalfSpace<Scalar_>::line_slope(Scalar x, Scalar y0, Scalar y1) const -> RectangleInfluence<Scalar> {
    const Scalar r0 = std::sqrt(x * x + y0 * y0), r1 = std::sqrt(x * x + y1 * y1);
    // (y0/r0 - y1/r1)/x, whose numerator cancels if both have the same sign
    const Scalar angle =
        y0 * y1 > 0 ? x * (y0 - y1) * (y0 + y1) / (r0 * r1 * (y0 * r1 + y1 * r0)) : (y0 / r0 - y1 / r1) / x;
    const Scalar cube0 = r0 * r0 * r0, cube1 = r1 * r1 * r1;
    const Scalar shear = nu_ * x * (y0 / cube0 - y1 / cube1);
    constexpr Scalar over_pi = std::numbers::inv_pi_v<Scalar>;
    return {over_pi * ((nu_ - 1) * angle - shear), over_pi * nu_ * (y1 * y1 / cube1 - y0 * y0 / cube0),
            over_pi * (shear - angle)};
}

template <class Scalar_>
inline auto HalfSpace<Scalar_>::area_sine(Scalar p, Scalar q, Scalar r) -> Scalar {
    return p < q ? std::log1p(p / q * (1 + p / (q + r))) : std::log((p + r) / q);
}

}  // namespace rollbem
