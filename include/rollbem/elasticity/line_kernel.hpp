// Kernels of line contacts: the concept, the strip of finite width, the plane far wider than long, either of them, and
// an elastic layer between the bodies.
#pragma once

#include "../detail/language.hpp"

#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>
#include <type_traits>
#include <utility>

#include "../scene/contact.hpp"
#include "detail/parameters.hpp"

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

/// Limit b >> a of the strip, the kernel of Eq. (20): g = (1/(pi G)) [c1 ln(4 b^2/x^2) + 2 c2]. b remains a parameter;
/// for b = inf only g' exists, and hence only steady problems.
template <class Scalar_ = double>
class PlaneKernel {
public:
    using Scalar = Scalar_;

    /// half_width b in units of a; (c1, c2) = (1 - nu, nu) for longitudinal creepage and (1, -nu) for lateral. Throws
    /// std::invalid_argument unless b > 0 and c1 and c2 are finite.
    PlaneKernel(Scalar half_width, Scalar c1, Scalar c2);

    static PlaneKernel longitudinal(const Contact& contact) {
        return detail::longitudinal_kernel<PlaneKernel>(contact);
    }
    static PlaneKernel lateral(const Contact& contact) { return detail::lateral_kernel<PlaneKernel>(contact); }

    Scalar half_width() const { return b_; }  ///< b in units of a

    /// Lambda = ln(4b/a) + c2/c1, for longitudinal creepage ln(4b/a) + nu/(1-nu): the compliance for a constant
    /// displacement over the compliance for the first harmonic. All modes of the plane model decay for positive Lambda;
    /// one grows for negative Lambda, where the kernel is used far outside b >> a.
    Scalar lambda() const { return lambda_; }

    SmoothSplit<Scalar> smooth_split() const { return {constant_, strength_, std::numeric_limits<Scalar>::infinity()}; }
    Scalar smooth_part(Scalar) const { return 0; }
    Scalar smooth_slope(Scalar) const { return 0; }

private:
    Scalar b_, lambda_, strength_, constant_;
};

/// Eqs. (3) and (7): Cerruti's solution, integrated over -b <= y <= b and seen from y = 0:
/// g = (2/(pi G)) [c1 asinh(b/|x|) + c2 b / sqrt(x^2 + b^2)].
///
/// \code
/// #include <rollbem/line.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const auto lateral = StripKernel<double>::lateral(Contact::dimensionless(10, 0.28));  // b/a, nu
///     return solve_steady(Chebyshev{8}, lateral).c11() > 1.5 ? 0 : 1;                       // c22
/// }
/// \endcode
template <class Scalar_ = double>
class StripKernel {
public:
    using Scalar = Scalar_;

    /// half_width b in units of a; (c1, c2) = (1 - nu, nu) for longitudinal creepage and (1, -nu) for lateral. Throws
    /// std::invalid_argument unless b > 0 and c1 and c2 are finite.
    StripKernel(Scalar half_width, Scalar c1, Scalar c2);

    static StripKernel longitudinal(const Contact& contact) {
        return detail::longitudinal_kernel<StripKernel>(contact);
    }
    static StripKernel lateral(const Contact& contact) { return detail::lateral_kernel<StripKernel>(contact); }

    Scalar half_width() const { return b_; }  ///< b in units of a

    /// With r = sqrt(x^2 + b^2), asinh(b/|x|) = ln(2b) - ln|x| + ln((b + r)/(2b)) and b/r = 1 + (b/r - 1): r has branch
    /// points at +-ib.
    SmoothSplit<Scalar> smooth_split() const { return {scale() * (c1_ * std::log(2 * b_) + c2_), scale() * c1_, b_}; }

    /// (2/pi) [c1 ln((b + r)/(2b)) + c2 (b/r - 1)] with r - b = x^2/(r + b): nothing cancels in wide strips.
    Scalar smooth_part(Scalar x) const;
    /// Written in x/r and b/r so that nothing overflows or cancels.
    Scalar smooth_slope(Scalar x) const;

private:
    static constexpr Scalar scale() { return 2 / std::numbers::pi_v<Scalar>; }

    Scalar b_, c1_, c2_;
};

/// Models of a line contact.
enum class LineModel {
    strip,  ///< StripKernel; if b is infinite, its limit PlaneKernel
    plane,  ///< PlaneKernel
};

/// A StripKernel or a PlaneKernel.
///
/// \code
/// #include <rollbem/line.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const Contact contact = Contact::dimensionless(10, 0.28);
///     const auto c11 = [&](LineModel model) {
///         return solve_steady(Chebyshev{12}, AnyKernel<double>::longitudinal(model, contact)).c11();
///     };
///     return std::abs(c11(LineModel::strip) / c11(LineModel::plane) - 1) < 0.05 ? 0 : 1;
/// }
/// \endcode
template <class Scalar_ = double>
class AnyKernel {
public:
    using Scalar = Scalar_;

    /// half_width, c1 and c2 as in both kernels.
    AnyKernel(LineModel model, Scalar half_width, Scalar c1, Scalar c2);

    static AnyKernel longitudinal(LineModel model, const Contact& contact) {
        return detail::longitudinal_kernel<AnyKernel>(contact, model);
    }
    static AnyKernel lateral(LineModel model, const Contact& contact) {
        return detail::lateral_kernel<AnyKernel>(contact, model);
    }

    LineModel model() const { return is_plane_ ? LineModel::plane : LineModel::strip; }
    Scalar half_width() const { return plane_.half_width(); }  ///< b in units of a
    /// Lambda of the plane; infinite for the strip, all of whose modes decay.
    Scalar lambda() const { return is_plane_ ? plane_.lambda() : std::numeric_limits<Scalar>::infinity(); }

    SmoothSplit<Scalar> smooth_split() const { return is_plane_ ? plane_.smooth_split() : strip_.smooth_split(); }
    Scalar smooth_part(Scalar x) const { return is_plane_ ? plane_.smooth_part(x) : strip_.smooth_part(x); }
    Scalar smooth_slope(Scalar x) const { return is_plane_ ? plane_.smooth_slope(x) : strip_.smooth_slope(x); }

private:
    bool is_plane_;
    PlaneKernel<Scalar> plane_;
    StripKernel<Scalar> strip_;
};

/// The surface of `Kernel` under a thin elastic layer: u gains L p(x), where L = h_3/G_3 is the compliance of a layer
/// of thickness h_3 and shear modulus G_3. L = 0 is the kernel without a layer; L >> a/G is the brush model,
/// p = -(xi/L) (a - x) in steady rolling, c11 = 2 a/(G L).
///
/// \code
/// #include <rollbem/line.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const LayeredKernel brush(PlaneKernel<double>(100, 0.72, 0.28), 1e3);  // L = 1000 a/G
///     const double c11 = solve_steady(cosine_mesh(40), NodeDifference{}, brush).c11();
///     return std::abs(c11 / (2 / 1e3) - 1) < 0.05 ? 0 : 1;
/// }
/// \endcode
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
    LayeredKernel(Kernel kernel, std::type_identity_t<Scalar> compliance);

    SmoothSplit<Scalar> smooth_split() const;
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

#include "impl/line_kernel.tpp"
