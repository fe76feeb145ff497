// What a line kernel is: the displacement of the surface under a line of unit traction across the contact, and its
// antiderivatives; and what a kernel may offer in addition, which some computations require.
#pragma once

#include <concepts>
#include <optional>

#include <Eigen/Core>

#include "../types.hpp"

namespace rollbem {

/// What the assembly requires of a kernel. x is in units of a, results are in units of 1/G (g), a/G (H) and a^2/G
/// (H_integral).
/// - g(x): displacement at distance x from the line, even in x; may be infinite at x = 0;
/// - H(x): an odd antiderivative of g, H(0) = 0;
/// - H_integral(x): an even antiderivative of H.
template <class Kernel>
concept LineKernel = requires(const Kernel& kernel, const ArrayX<typename Kernel::Scalar>& x) {
    { kernel.g(x) } -> std::convertible_to<ArrayX<typename Kernel::Scalar>>;
    { kernel.H(x) } -> std::convertible_to<ArrayX<typename Kernel::Scalar>>;
    { kernel.H_integral(x) } -> std::convertible_to<ArrayX<typename Kernel::Scalar>>;
};

/// g(x) = constant - strength ln|x| + sum_{k>=1} even[k-1] x^{2k}: a kernel split into its singularity, which all
/// kernels share, and a polynomial. The assembly uses the split if there is one: it is cheaper and free of
/// cancellation.
template <class Scalar>
struct LogSplit {
    Scalar constant;  ///< [1/G]; infinite for b = inf, where only the derivative of g exists
    Scalar strength;  ///< [1/G]
    ArrayX<Scalar> even;
};

/// A kernel that offers its LogSplit, exact to rounding for |x| <= reach, or none if it would be too long.
template <class Kernel>
concept SplitKernel = LineKernel<Kernel> && requires(const Kernel& kernel, typename Kernel::Scalar reach) {
    { kernel.log_split(reach) } -> std::same_as<std::optional<LogSplit<typename Kernel::Scalar>>>;
};

/// g(x) = constant - strength ln|x| + smooth_part(x) for every x: the singularity and an analytic remainder.
template <class Scalar>
struct SmoothSplit {
    Scalar constant;  ///< [1/G]; infinite for b = inf, where only the derivative of g exists
    Scalar strength;  ///< [1/G], positive
    Scalar distance;  ///< smooth_part is analytic except on the imaginary axis from +-i distance outwards; infinite if
                      ///< smooth_part vanishes
};

/// A kernel that offers its SmoothSplit, and smooth_part(x), even in x and zero at x = 0. Discretisations by
/// polynomials require it: they integrate the logarithm in closed form and the rest by quadrature.
template <class Kernel>
concept SmoothSplitKernel = LineKernel<Kernel> && requires(const Kernel& kernel) {
    { kernel.smooth_split() } -> std::same_as<SmoothSplit<typename Kernel::Scalar>>;
} && requires(const Kernel& kernel, const ArrayX<typename Kernel::Scalar>& x) {
    { kernel.smooth_part(x) } -> std::convertible_to<ArrayX<typename Kernel::Scalar>>;
};

/// A SmoothSplitKernel that also offers the derivative of its smooth part: g'(x) = -strength/x + smooth_slope(x).
template <class Kernel>
concept SlopeSplitKernel = SmoothSplitKernel<Kernel> && requires(const Kernel& kernel, typename Kernel::Scalar x) {
    { kernel.smooth_slope(x) } -> std::same_as<typename Kernel::Scalar>;
};

/// A kernel that offers its Taylor coefficients: column k of taylor(x, order) is g^{(k)}(x) x^k / k!, k = 0 ... order.
template <class Kernel>
concept TaylorKernel = LineKernel<Kernel> && requires(const Kernel& kernel, const ArrayX<typename Kernel::Scalar>& x) {
    {
        kernel.taylor(x, 1)
        } -> std::convertible_to<Eigen::Array<typename Kernel::Scalar, Eigen::Dynamic, Eigen::Dynamic>>;
};

}  // namespace rollbem
