// An elastic layer between the bodies: a third body, or roughness.
// An adaptor for any line kernel, and what the assembly asks of a kernel that is a smooth one and a delta.
#pragma once

#include "../detail/language.hpp"

#include <cmath>
#include <concepts>
#include <limits>
#include <type_traits>
#include <utility>

#include <Eigen/Core>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../types.hpp"
#include "line_kernel.hpp"

namespace rollbem {

/// A kernel that is another one and a delta besides, g(x) = elastic().g(x) + compliance() delta(x): the assembly takes
/// elastic() in whatever way is best for it, and the delta from the geometry of the mesh alone, so that rounding cannot
/// carry a point from one side of an edge to the other. compliance() is in units of a/G.
template <class Kernel>
concept DeltaKernel = LineKernel<Kernel> && requires(const Kernel& kernel) {
    { kernel.compliance() } -> std::same_as<typename Kernel::Scalar>;
    requires LineKernel<std::remove_cvref_t<decltype(kernel.elastic())>>;
    requires std::is_lvalue_reference_v<decltype(kernel.elastic())>;  // it lives as long as the kernel
};

/// The surface of `Kernel` under a thin elastic layer: u gains L p(x), L = h_3/G_3 the compliance of a layer of
/// thickness h_3 and shear modulus G_3. L = 0 is the kernel without it; L >> a/G is the brush model,
/// p = -(xi/L) (a - x) in steady rolling, c11 = 2 a/(G L).
///
/// Tractions of elements jump at their edges, and so does u: G at an edge takes the mean of both sides, and of the
/// slope only differences of u exist, du/dx does not. Schemes that ask for it are refused: Collocation and
/// KnotheBoundary with Derivative::analytic, and Galerkin with that and a quadrature. In closed form Galerkin takes the
/// mean of du/dx over an interval, a difference of u, and has it of either derivative. The delta has no logarithm's
/// split, so that what asks for one (Chebyshev states, solve_stick_border) does not take this kernel, nor does a
/// contact that breathes.
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
        detail::require(detail::is_finite(compliance) && compliance >= 0, "LayeredKernel", "compliance", compliance,
                        "be finite and not negative");
    }

    const Kernel& elastic() const { return kernel_; }  ///< the kernel without the layer
    Scalar compliance() const { return compliance_; }  ///< L [a/G]

    /// b in units of a, where the kernel has one.
    Scalar half_width() const requires requires(const Kernel& kernel) { kernel.half_width(); }
    { return kernel_.half_width(); }
    /// Lambda of the kernel without the layer, where it has one: only a compliant layer would make the plane model
    /// stable where Lambda <= 0, and b >> a, which it is for, would not hold all the same.
    Scalar lambda() const requires requires(const Kernel& kernel) { kernel.lambda(); }
    { return kernel_.lambda(); }

    /// That of the kernel; the delta makes it infinite at x = 0.
    Array g(const Array& x) const {
        Array result = kernel_.g(x);
        for (Eigen::Index i = 0; i < x.size(); ++i) {
            if (x[i] == 0 && compliance_ > 0) result[i] = std::numeric_limits<Scalar>::infinity();
        }
        return result;
    }
    /// That of the kernel and (L/2) sign(x).
    Array H(const Array& x) const {
        Array result = kernel_.H(x);
        for (Eigen::Index i = 0; i < x.size(); ++i) {
            if (x[i] != 0) result[i] += x[i] < 0 ? -compliance_ / 2 : compliance_ / 2;
        }
        return result;
    }
    /// That of the kernel and (L/2) |x|.
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
