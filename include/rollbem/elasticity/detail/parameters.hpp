// The parameters of a kernel for a contact 2b wide: their requirements, and their values for a given contact. Internal.
#pragma once

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../../scene/contact.hpp"

namespace rollbem::detail {

/// Throws std::invalid_argument unless half_width > 0 and c1 and c2 are finite.
template <class Scalar>
void check_line_kernel(const char* who, Scalar half_width, Scalar c1, Scalar c2) {
    require(!is_nan(half_width) && half_width > 0, who, "half_width", half_width, "be positive");
    require_finite(who, "c1", c1);
    require_finite(who, "c2", c2);
}

/// The kernel of a contact for one direction of creepage, with its (c1, c2); `model` is the first argument of kernels
/// that have several models.
template <class Kernel, class... Model>
Kernel longitudinal_kernel(const Contact& contact, Model... model) {
    using Scalar = typename Kernel::Scalar;
    const auto nu = static_cast<Scalar>(contact.poisson_ratio());
    return Kernel(model..., static_cast<Scalar>(contact.aspect()), 1 - nu, nu);
}
template <class Kernel, class... Model>
Kernel lateral_kernel(const Contact& contact, Model... model) {
    using Scalar = typename Kernel::Scalar;
    return Kernel(model..., static_cast<Scalar>(contact.aspect()), Scalar(1),
                  -static_cast<Scalar>(contact.poisson_ratio()));
}

}  // namespace rollbem::detail
