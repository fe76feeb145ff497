// What a line kernel is: the displacement of the surface under a line of unit traction across the contact, split into
// its logarithm and a smooth part; and what elements take in addition, a kernel with a delta function.
#pragma once

#include "../detail/language.hpp"

#include <concepts>
#include <type_traits>

namespace rollbem {

/// g(x) = constant - strength ln|x| + smooth_part(x) for every x: the singularity and an analytic remainder.
template <class Scalar>
struct SmoothSplit {
    Scalar constant;  ///< [1/G]; infinite for b = inf, where only the derivative of g exists
    Scalar strength;  ///< [1/G]
    Scalar distance;  ///< smooth_part is analytic except on the imaginary axis from +-i distance outwards; infinite if
                      ///< smooth_part vanishes
};

/// What discretisations require of a kernel. They integrate the logarithm in closed form and the rest by quadrature. x
/// is in units of a, g in units of 1/G.
/// - smooth_split(): the constant, the logarithm and the distance;
/// - smooth_part(x): even in x, zero at x = 0;
/// - smooth_slope(x): its derivative.
template <class Kernel>
concept LineKernel = requires(const Kernel& kernel, typename Kernel::Scalar x) {
    { kernel.smooth_split() } -> std::same_as<SmoothSplit<typename Kernel::Scalar>>;
    { kernel.smooth_part(x) } -> std::same_as<typename Kernel::Scalar>;
    { kernel.smooth_slope(x) } -> std::same_as<typename Kernel::Scalar>;
};

/// A kernel that is the sum of another ElementKernel, elastic(), and the delta function compliance() delta(x), in units
/// of a/G. The delta is integrated by the geometry of the mesh alone, so that rounding cannot move a point across an
/// edge.
template <class Kernel>
concept DeltaKernel = requires(const Kernel& kernel) {
    { kernel.compliance() } -> std::same_as<typename Kernel::Scalar>;
    requires std::is_lvalue_reference_v<decltype(kernel.elastic())>;  // a reference that is valid as long as the kernel
};

/// What elements take: a line kernel, or one with a delta.
template <class Kernel>
concept ElementKernel = LineKernel<Kernel> || DeltaKernel<Kernel>;

}  // namespace rollbem
