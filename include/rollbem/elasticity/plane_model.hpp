// Where the plane model itself, before any discretisation, is unstable in time.
// Asked by every problem that is not steady.
#pragma once

#include "../detail/language.hpp"

#include <numbers>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../scene/contact.hpp"
#include "line_kernel.hpp"

namespace rollbem {

/// Lambda = ln(4b/a) + c2/c1 of a plane kernel, for longitudinal creepage ln(4b/a) + nu/(1-nu): the compliance of a
/// constant displacement over that of the first harmonic. All modes of the plane model decay where Lambda > 0, one of
/// them grows where Lambda < 0: the kernel is then used far outside b >> a.
template <class Scalar>
Scalar plane_compliance(const PlaneKernel<Scalar>& kernel) {
    const LogSplit<Scalar> split = *kernel.log_split(Scalar(2));
    return split.constant / split.strength + std::numbers::ln2_v<Scalar>;
}

/// Nothing to refuse for kernels in general; see the overload for PlaneKernel.
template <LineKernel Kernel>
void require_stable_model(const Kernel&) {}

/// Throws std::invalid_argument unless Lambda > 0.
template <class Scalar>
void require_stable_model(const PlaneKernel<Scalar>& kernel) {
    const Scalar Lambda = plane_compliance(kernel);
    detail::require(!detail::is_nan(Lambda) && Lambda > 0, "PlaneKernel", "Lambda = ln(4b/a) + c2/c1", Lambda,
                    "be positive where the problem is not steady: the plane model itself is unstable for so small a "
                    "b/a; use the strip kernel");
}

/// The same for longitudinal creepage of a contact: throws std::invalid_argument unless ln(4b/a) + nu/(1-nu) > 0.
template <class Scalar>
void require_stable_plane(const Contact<Scalar>& contact) {
    require_stable_model(PlaneKernel<Scalar>::longitudinal(contact));
}

}  // namespace rollbem
