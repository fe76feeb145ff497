// LineKernel: the displacement of the surface under a line of unit traction across the contact, split into its
// logarithm, a smooth part and perhaps a delta function.
#pragma once

#include "../detail/language.hpp"

#include <concepts>

namespace rollbem {

/// g(x) = constant - strength ln|x| + smooth_part(x) + compliance delta(x): the singularities and an analytic
/// remainder.
template <class Scalar>
struct SmoothSplit {
    Scalar constant;  ///< [1/G]; infinite for b = inf, where only the derivative of g exists
    Scalar strength;  ///< [1/G]
    Scalar distance;  ///< smooth_part is analytic except on the imaginary axis from +-i distance outwards; infinite if
                      ///< smooth_part vanishes
    /// [a/G]. If it is not 0, only elements accept the kernel; they integrate the delta by the geometry of the mesh
    /// alone, so that rounding cannot move a point across an edge.
    Scalar compliance = 0;
};

/// Requirements of discretisations on a kernel. They integrate the logarithm in closed form and the rest by quadrature.
/// x is in units of a, g in units of 1/G.
/// - smooth_split(): the constant, the logarithm, the distance and the delta;
/// - smooth_part(x): even in x, zero at x = 0;
/// - smooth_slope(x): its derivative.
template <class Kernel>
concept LineKernel = requires(const Kernel& kernel, typename Kernel::Scalar x) {
    { kernel.smooth_split() } -> std::same_as<SmoothSplit<typename Kernel::Scalar>>;
    { kernel.smooth_part(x) } -> std::same_as<typename Kernel::Scalar>;
    { kernel.smooth_slope(x) } -> std::same_as<typename Kernel::Scalar>;
};

}  // namespace rollbem
