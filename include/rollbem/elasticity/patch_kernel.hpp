// RectangleKernel: the displacement of the surface by tractions on a rectangle; and HalfSpace, the kernel of two equal
// elastic half-spaces.
#pragma once

#include <concepts>
#include <type_traits>

#include "../detail/require.hpp"

namespace rollbem {

/// An influence between the directions x and y. By reciprocity the influence of x on y equals the influence of y on x.
template <class Scalar>
struct RectangleInfluence {
    Scalar xx = 0, xy = 0, yy = 0;

    friend RectangleInfluence operator+(const RectangleInfluence& a, const RectangleInfluence& b) {
        return {a.xx + b.xx, a.xy + b.xy, a.yy + b.yy};
    }
    friend RectangleInfluence operator-(const RectangleInfluence& a, const RectangleInfluence& b) {
        return {a.xx - b.xx, a.xy - b.xy, a.yy - b.yy};
    }
    friend RectangleInfluence operator*(const Scalar& factor, const RectangleInfluence& a) {
        return {factor * a.xx, factor * a.xy, factor * a.yy};
    }
};

/// Requirements of the assembly of a patch on a kernel. Lengths are in the system's unit, tractions in G.
/// - corner(x, y): F at the distance (x, y) from a corner. The displacement u of both bodies at (x, y) by unit traction
///   on the rectangle x0 ... x1, y0 ... y1 is F(x-x0, y-y0) - F(x-x1, y-y0) - F(x-x0, y-y1) + F(x-x1, y-y1).
///   xx and yy of F are odd in x and in y, xy is even in both.
/// - couples(): whether xy differs from zero.
///
/// A kernel may also offer
/// - line_slope(x, y0, y1): du/dx at distance x ahead of a line of unit traction along y, whose ends lie y0 and y1 < y0
///   below the point. The assembly uses it for distant elements: with it nothing cancels.
/// - corner_lateral_slope(x, y), the derivative of corner(x, y) with respect to y: xx and yy are odd in x and even in
///   y, xy is even in x and odd in y. Patches whose half-width varies require it.
/// - coupling_integral(x, y), an antiderivative over y of the xy of corner(x, y), up to functions of y alone, which
///   cancel; and, if there is line_slope, line_coupling_integral(x, y), an antiderivative over y of f, where
///   f(y1) - f(y0) is the xy of line_slope. With both, patches with strips much wider than long have accurate
///   couplings of the two directions;
/// - layer_compliance(), L of an additional displacement L p, which is local.
template <class Kernel>
concept RectangleKernel = requires(const Kernel& kernel, typename Kernel::Scalar x) {
    { kernel.corner(x, x) } -> std::same_as<RectangleInfluence<typename Kernel::Scalar>>;
    { kernel.couples() } -> std::same_as<bool>;
};

/// Two equal half-spaces (Boussinesq, Cerruti): with r = sqrt(x^2 + y^2), pi G F is
/// xx: (1-nu) x asinh(y/|x|) + y asinh(x/|y|), yy: x asinh(y/|x|) + (1-nu) y asinh(x/|y|), xy: -nu r. A thin elastic
/// layer between them adds L p to the displacement, as LayeredKernel does on a line.
///
/// \code
/// #include <rollbem/patch.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const PatchContact contact = PatchContact::dimensionless(1, 0.28);
///     const HalfSpace<double> layered(0.28, 0.1);  // with a layer of compliance L = 0.1 a/G
///     return solve_steady(patch_mesh(contact, 8, 8), NodeDifference{Nodes::chebyshev}, layered).c11() > 0 ? 0 : 1;
/// }
/// \endcode
template <class Scalar_>
class HalfSpace {
public:
    using Scalar = Scalar_;

    /// L = h_3/G_3 of the layer, times G, in the unit of length of the patch. Throws std::invalid_argument unless 0 <=
    /// nu <= 0.5 and 0 <= L < inf.
    explicit HalfSpace(Scalar poisson_ratio, std::type_identity_t<Scalar> layer_compliance = 0);

    bool couples() const { return nu_ != 0; }
    Scalar layer_compliance() const { return layer_; }

    RectangleInfluence<Scalar> corner(Scalar x, Scalar y) const;

    RectangleInfluence<Scalar> corner_lateral_slope(Scalar x, Scalar y) const;

    /// -nu/(2 pi) (y r + x^2 asinh(y/|x|) - y |y|), which grows like x^2 only.
    Scalar coupling_integral(Scalar x, Scalar y) const;

    /// nu/pi (asinh(y/|x|) - y/r).
    Scalar line_coupling_integral(Scalar x, Scalar y) const;

    RectangleInfluence<Scalar> line_slope(Scalar x, Scalar y0, Scalar y1) const;

private:
    // asinh(p/q), p and q positive, r = sqrt(p^2 + q^2); to all digits where it is small
    static Scalar area_sine(Scalar p, Scalar q, Scalar r);

    // far below any distance, and the ratio of a distance to it does not overflow
    static constexpr Scalar least = detail::negligible<Scalar>;

    Scalar nu_, layer_;
};

}  // namespace rollbem

#include "impl/patch_kernel.tpp"
