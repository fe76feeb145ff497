// An elastic layer between the bodies, such as a third body or roughness: an adaptor for any line kernel, and what the
// assembly requires of a kernel that is the sum of a smooth one and a delta function.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <type_traits>
#include <utility>

#include <Eigen/Core>

#include "../detail/require.hpp"
#include "../types.hpp"
#include "line_kernel.hpp"

namespace rollbem {

/// A kernel that is the sum of another one and a delta function, g(x) = elastic().g(x) + compliance() delta(x). The
/// assembly treats elastic() in the way that suits it best, and the delta by the geometry of the mesh alone, so that
/// rounding cannot move a point across an edge. compliance() is in units of a/G.
template <class Kernel>
concept DeltaKernel = LineKernel<Kernel> && requires(const Kernel& kernel) {
    { kernel.compliance() } -> std::same_as<typename Kernel::Scalar>;
    requires LineKernel<std::remove_cvref_t<decltype(kernel.elastic())>>;
    requires std::is_lvalue_reference_v<decltype(kernel.elastic())>;  // a reference that is valid as long as the kernel
};

/// The surface of `Kernel` under a thin elastic layer: u gains L p(x), where L = h_3/G_3 is the compliance of a layer
/// of thickness h_3 and shear modulus G_3. L = 0 is the kernel without a layer; L >> a/G is the brush model,
/// p = -(xi/L) (a - x) in steady rolling, c11 = 2 a/(G L).
///
/// Tractions jump at the edges of elements, and so does u: G at an edge takes the mean of both sides. du/dx does not
/// exist there, only differences of u do. Schemes that need du/dx are refused: Collocation and KnotheBoundary with
/// Derivative::analytic, and Galerkin with that derivative and a quadrature. Galerkin in closed form takes the mean of
/// du/dx over an interval, which is a difference of u, and so allows either derivative. The delta has no logarithmic
/// split: methods that require one (Chebyshev states, solve_stick_border) do not take this kernel, nor does a contact
/// that breathes.
///
/// Invariant: 0 <= L < inf.
template <LineKernel Kernel>
class LayeredKernel {
public:
    using Scalar = typename Kernel::Scalar;
    using Array = ArrayX<Scalar>;

    /// `compliance` L in units of a/G: L [m/Pa] times G [Pa] over a [m]. Throws std::invalid_argument unless it is
    /// finite and not negative.
    LayeredKernel(Kernel kernel, std::type_identity_t<Scalar> compliance)
        : kernel_(std::move(kernel)), compliance_(compliance) {
        detail::require_not_negative("LayeredKernel", "compliance", compliance);
    }

    const Kernel& elastic() const { return kernel_; }  ///< the kernel without the layer
    Scalar compliance() const { return compliance_; }  ///< L [a/G]

    /// b in units of a, if the kernel has one.
    Scalar half_width() const requires requires(const Kernel& kernel) { kernel.half_width(); }
    { return kernel_.half_width(); }
    /// Lambda of the kernel without the layer, if it has one. A compliant layer could stabilise the plane model at
    /// Lambda <= 0, but b >> a, which that model assumes, would still not hold.
    Scalar lambda() const requires requires(const Kernel& kernel) { kernel.lambda(); }
    { return kernel_.lambda(); }

    /// g of the kernel; the delta makes it infinite at x = 0.
    Array g(const Array& x) const {
        Array result = kernel_.g(x);
        for (Eigen::Index i = 0; i < x.size(); ++i) {
            if (x[i] == 0 && compliance_ > 0) result[i] = std::numeric_limits<Scalar>::infinity();
        }
        return result;
    }
    /// H of the kernel plus (L/2) sign(x).
    Array H(const Array& x) const {
        Array result = kernel_.H(x);
        for (Eigen::Index i = 0; i < x.size(); ++i) {
            if (x[i] != 0) result[i] += x[i] < 0 ? -compliance_ / 2 : compliance_ / 2;
        }
        return result;
    }
    /// H_integral of the kernel plus (L/2) |x|.
    Array H_integral(const Array& x) const {
        Array result = kernel_.H_integral(x);
        for (Eigen::Index i = 0; i < x.size(); ++i) result[i] += compliance_ / 2 * std::abs(x[i]);
        return result;
    }

private:
    Kernel kernel_;
    Scalar compliance_;
};

}  // namespace rollbem
