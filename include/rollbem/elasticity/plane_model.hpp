// The plane model itself, before any discretisation, is unstable in the time domain if Lambda <= 0. Every problem that
// is not steady checks this.
#pragma once

#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "line_kernel.hpp"

namespace rollbem {

/// Throws std::invalid_argument for a kernel that knows its Lambda, as PlaneKernel does, unless Lambda > 0.
template <LineKernel Kernel>
void require_stable_model(const Kernel& kernel) {
    if constexpr (requires { kernel.lambda(); }) {
        detail::require(
            !detail::is_nan(kernel.lambda()) && kernel.lambda() > 0, "PlaneKernel", "Lambda = ln(4b/a) + c2/c1",
            kernel.lambda(),
            "be positive where the problem is not steady: the plane model itself is unstable for so small a "
            "b/a; use the strip kernel");
    }
}

}  // namespace rollbem
