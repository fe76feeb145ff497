// An elastic layer between the bodies, such as a third body or roughness: an adaptor for any line kernel.
#pragma once

#include <type_traits>
#include <utility>

#include "../detail/require.hpp"
#include "kernel_concepts.hpp"

namespace rollbem {

/// The surface of `Kernel` under a thin elastic layer: u gains L p(x), where L = h_3/G_3 is the compliance of a layer
/// of thickness h_3 and shear modulus G_3. L = 0 is the kernel without a layer; L >> a/G is the brush model,
/// p = -(xi/L) (a - x) in steady rolling, c11 = 2 a/(G L).
///
/// Tractions jump at the edges of elements, and so does u: G at an edge takes the mean of both sides. du/dx does not
/// exist there, only differences of u do. Schemes that need du/dx are refused: Collocation and KnotheBoundary with
/// Derivative::analytic, and Galerkin with this derivative and a quadrature. Galerkin in closed form takes the mean of
/// du/dx over an interval, which is a difference of u, and so allows either derivative. Only elements accept this
/// kernel: Chebyshev states refuse it, solve_stick_border has no exact border for it, and its contact cannot breathe.
///
/// Invariant: 0 <= L < inf.
template <LineKernel Kernel>
class LayeredKernel {
public:
    using Scalar = typename Kernel::Scalar;

    /// `compliance` L in units of a/G: L [m/Pa] times G [Pa] over a [m]. Throws std::invalid_argument unless it is
    /// finite and not negative.
    LayeredKernel(Kernel kernel, std::type_identity_t<Scalar> compliance)
        : kernel_(std::move(kernel)), compliance_(compliance) {
        detail::require_not_negative("LayeredKernel", "compliance", compliance);
    }

    SmoothSplit<Scalar> smooth_split() const {
        SmoothSplit<Scalar> split = kernel_.smooth_split();
        split.compliance += compliance_;
        return split;
    }
    Scalar smooth_part(Scalar x) const { return kernel_.smooth_part(x); }
    Scalar smooth_slope(Scalar x) const { return kernel_.smooth_slope(x); }

    /// b in units of a, if the kernel has one.
    Scalar half_width() const requires requires(const Kernel& kernel) { kernel.half_width(); }
    { return kernel_.half_width(); }
    /// Lambda of the kernel without the layer, if it has one. A compliant layer could stabilise the plane model at
    /// Lambda <= 0, but the model's assumption b >> a would still not hold.
    Scalar lambda() const requires requires(const Kernel& kernel) { kernel.lambda(); }
    { return kernel_.lambda(); }

private:
    Kernel kernel_;
    Scalar compliance_;
};

}  // namespace rollbem
