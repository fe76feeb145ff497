// Schemes: where and how the rolling contact equation is imposed on a mesh, as plain option structs.
// Collocation, Galerkin, and collocation with Knothe and Gross-Thebing's boundary conditions.
#pragma once

#include "../detail/language.hpp"

#include <cmath>

#include <Eigen/Core>

#include "../detail/array_functions.hpp"
#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "mesh.hpp"

namespace rollbem {

/// How du/dx is obtained from the displacement u of the elements.
enum class Derivative {
    finite_difference,  ///< central over the element's own width about the point, Eq. (29)
    analytic,           ///< closed form; points nearer than 0.001 dx to an element's edge are moved to that distance
};

/// Eq. (12) at one point per element, x_l + alpha_l dx_l, with alpha_l linear between both ends, Eq. (28).
/// alpha > 0 lies ahead of the element's centre; alpha = 0.5 is its leading edge.
struct Collocation {
    double alpha_L = 0;     ///< alpha of the leading element [-], in [-2, 2]
    double alpha_T = 0.63;  ///< alpha of the trailing element [-], in [-2, 2]
    Derivative derivative = Derivative::finite_difference;
    double lambda = 1;  ///< G is evaluated at x_l + lambda alpha_l dx_l [-], in [0, 1]
};

/// Value of Galerkin::quadrature that asks for the integrals in closed form.
inline constexpr int exact_quadrature = 0;

/// Eq. (14): each row is the mean over an interval of width dx_l centred at x_l + alpha_l dx_l.
struct Galerkin {
    double alpha_L = 0;     ///< as in Collocation
    double alpha_T = 0.63;  ///< as in Collocation
    Derivative derivative = Derivative::analytic;
    double lambda = 1;                  ///< centre of the interval of G, as in Collocation
    int quadrature = exact_quadrature;  ///< Gauss-Legendre points, 1 to 1000, or exact_quadrature
};

/// Knothe and Gross-Thebing's boundary conditions: collocation at the centres; the leading element carries no traction
/// and the trailing element slides. The unknowns are elements 0 ... n-2, the equations those of elements 1 ... n-1.
struct KnotheBoundary {
    Derivative derivative = Derivative::finite_difference;
};

namespace detail {

template <class Scheme>
void check_alphas(const Scheme& scheme, const char* who, Eigen::Index n) {
    require(is_finite(scheme.alpha_L) && std::abs(scheme.alpha_L) <= 2, who, "alpha_L", scheme.alpha_L,
            "lie in [-2, 2]");
    require(is_finite(scheme.alpha_T) && std::abs(scheme.alpha_T) <= 2, who, "alpha_T", scheme.alpha_T,
            "lie in [-2, 2]");
    require(is_finite(scheme.lambda) && scheme.lambda >= 0 && scheme.lambda <= 1, who, "lambda", scheme.lambda,
            "lie in [0, 1]");
    require(n > 1 || scheme.alpha_L == scheme.alpha_T, who, "n", n, "be at least 2 where alpha_L and alpha_T differ");
}

}  // namespace detail

/// Throws std::invalid_argument when the scheme's options are out of range or do not fit a mesh of n elements.
inline void check_scheme(const Collocation& scheme, Eigen::Index n) { detail::check_alphas(scheme, "Collocation", n); }
inline void check_scheme(const Galerkin& scheme, Eigen::Index n) {
    detail::check_alphas(scheme, "Galerkin", n);
    detail::require(scheme.quadrature >= 0 && scheme.quadrature <= 1000, "Galerkin", "quadrature", scheme.quadrature,
                    "be exact_quadrature (0) or lie in [1, 1000]");
}
inline void check_scheme(const KnotheBoundary&, Eigen::Index n) {
    detail::require(n >= 2, "KnotheBoundary", "n", n, "be at least 2");
}

/// Eq. (28): alpha of every element, linear in the element's centre between alpha_T and alpha_L.
template <class Scalar>
typename Mesh<Scalar>::Array interpolate_alpha(const Mesh<Scalar>& mesh, double alpha_L, double alpha_T) {
    const Eigen::Index n = mesh.size();
    using Array = typename Mesh<Scalar>::Array;
    const Scalar first = static_cast<Scalar>(alpha_T);
    const Scalar last = static_cast<Scalar>(alpha_L);
    Array alpha(n);
    const Array& from_trailing = mesh.from_trailing();
    const Array& from_leading = mesh.from_leading();
    const Scalar span = from_trailing[n - 1] - from_trailing[0];
    for (Eigen::Index i = 0; i < n; ++i) {
        alpha[i] = first == last ? first
                                 : last * (from_trailing[i] - from_trailing[0]) / span +
                                       first * (from_leading[i] - from_leading[n - 1]) / span;
    }
    alpha[0] = first;  // exactly: an alpha of 0.5 must not fall on the other side of an edge
    alpha[n - 1] = last;
    return alpha;
}

/// The elements whose tractions are unknown: the first `count` of the mesh.
inline Eigen::Index unknown_count(const Collocation&, Eigen::Index n) { return n; }
inline Eigen::Index unknown_count(const Galerkin&, Eigen::Index n) { return n; }
inline Eigen::Index unknown_count(const KnotheBoundary&, Eigen::Index n) { return n - 1; }

/// The widths of the unknown elements: the weights that turn tractions into a force.
template <class Scalar, class Scheme>
typename Mesh<Scalar>::Array unknown_widths(const Mesh<Scalar>& mesh, const Scheme& scheme) {
    return detail::segment(mesh.widths(), 0, unknown_count(scheme, mesh.size()));
}

}  // namespace rollbem
