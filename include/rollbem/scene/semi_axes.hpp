// Semi-axes of an ellipse of contact, where they vary.
#pragma once

#include "../detail/finite.hpp"

namespace rollbem {

/// Semi-axes in metres, or over the semi-axes of a contact.
struct SemiAxes {
    double half_length;  ///< a, in the rolling direction
    double half_width;   ///< b, across it

    friend bool operator==(const SemiAxes&, const SemiAxes&) = default;
};

namespace detail {

/// The semi-axes of a contact over themselves.
inline constexpr SemiAxes contact_axes{1, 1};

inline bool are_positive(const SemiAxes& axes) noexcept {
    return is_finite(axes.half_length) && axes.half_length > 0 && is_finite(axes.half_width) && axes.half_width > 0;
}

}  // namespace detail

}  // namespace rollbem
