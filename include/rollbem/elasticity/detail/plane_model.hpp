// Properties of a line kernel that its systems keep. The plane model itself, before any discretisation, is unstable in
// the time domain if Lambda <= 0: every problem that is not steady checks this. Internal.
#pragma once

#include <cmath>
#include <utility>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../../system/rolling_system.hpp"
#include "../../types.hpp"
#include "../line_kernel.hpp"

namespace rollbem::detail {

/// Throws std::invalid_argument for a kernel with a lambda(), such as PlaneKernel, unless Lambda > 0.
template <LineKernel Kernel>
void require_stable_model(const Kernel& kernel) {
    if constexpr (requires { kernel.lambda(); }) {
        require(!is_nan(kernel.lambda()) && kernel.lambda() > 0, "PlaneKernel", "Lambda = ln(4b/a) + c2/c1",
                kernel.lambda(),
                "be positive where the problem is not steady: the plane model itself is unstable for so small a "
                "b/a; use the strip kernel");
    }
}

/// The origin of a system with equations at these points; `at_points`: the equations of G and G' hold there, so that
/// the contact may breathe if the kernel is a logarithm and a constant.
template <class Scalar, LineKernel Kernel>
typename RollingSystem<Scalar>::Origin origin_of(const Kernel& kernel, ArrayX<Scalar> points, bool at_points) {
    typename RollingSystem<Scalar>::Origin origin;
    if constexpr (requires { kernel.half_width(); }) origin.aspect = kernel.half_width();
    origin.points = std::move(points);
    const auto split = kernel.smooth_split();
    if (!at_points || is_finite(split.distance) || split.compliance != 0) return origin;
    origin.log_strength = static_cast<Scalar>(split.strength);
    origin.half_length_limit = static_cast<Scalar>(2 * std::exp(split.constant / split.strength));
    return origin;
}

}  // namespace rollbem::detail
