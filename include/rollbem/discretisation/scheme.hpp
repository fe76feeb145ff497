// Schemes: where and how the rolling contact equation is imposed on a mesh, as plain option structs. Collocation,
// Galerkin, and collocation with Knothe and Gross-Thebing's boundary conditions; any other type that defines its rows
// can serve as a scheme.
#pragma once

#include "../detail/language.hpp"

#include <cmath>
#include <concepts>
#include <limits>

#include <Eigen/Core>

#include "../detail/array_functions.hpp"
#include "../detail/finite.hpp"
#include "../detail/gauss_legendre.hpp"
#include "../detail/require.hpp"
#include "../types.hpp"
#include "mesh.hpp"

namespace rollbem {

/// The quantity that a row of the equations evaluates.
enum class Quantity {
    displacement,  ///< u: a row of G
    slope,         ///< du/dx: a row of G'
};

/// The rows of a scheme. Row l is the weighted sum of the quantity at the points x_l + (alpha_l + offset) dx_l, or of
/// its means about these points. alpha_l varies linearly with the centre of the element, from alpha_T at the trailing
/// element to alpha_L at the leading one, Eq. (28).
template <class Scalar>
struct SchemeRows {
    double alpha_L = 0, alpha_T = 0;  ///< [-], finite
    ArrayX<Scalar> offsets, weights;  ///< of a quadrature rule [-]: at least one point; the weights add up to 1
    /// How many times the mean over the element's own width is taken: once for a central finite difference over that
    /// width, Eq. (29), which is the mean of the slope, and once for Galerkin's integral in closed form, Eq. (14). At
    /// most twice for the slope and once for the displacement.
    int averages = 0;
    /// Moves points that are closer than 0.001 dx to an edge of an element, where du/dx is infinite, to that distance.
    bool guard = false;
    Eigen::Index first_equation = 0;  ///< the element whose row is the first equation; others follow
    Eigen::Index unknown_count = 0;   ///< number of equations and of unknowns, the tractions of the first elements
};

/// A scheme has rows<Scalar>(quantity, n), its rows on a mesh of n elements, which throws std::invalid_argument if the
/// options are out of range or do not fit n elements. G and G' have the same equations and unknowns.
template <class Scheme, class Scalar = double>
concept RollingScheme = requires(const Scheme& scheme, Quantity quantity, Eigen::Index n) {
    { scheme.template rows<Scalar>(quantity, n) } -> std::same_as<SchemeRows<Scalar>>;
};

/// How du/dx is obtained from the displacement u of the elements.
enum class Derivative {
    finite_difference,  ///< central over the element's own width about the point, Eq. (29)
    analytic,           ///< closed form; points closer than 0.001 dx to an element's edge are moved to that distance
};

/// Eq. (12) at one point per element, x_l + alpha_l dx_l, with alpha_l linear between both ends, Eq. (28).
/// alpha > 0 lies ahead of the element's centre; alpha = 0.5 is its leading edge. The defaults are 0.5 and 0.5, which
/// every recommended scheme uses; the programs' options default to the 0 and 0.63 of the paper, whose study they
/// repeat.
struct Collocation {
    double alpha_L = 0.5;  ///< alpha of the leading element [-], in [-2, 2]
    double alpha_T = 0.5;  ///< alpha of the trailing element [-], in [-2, 2]
    Derivative derivative = Derivative::finite_difference;
    double lambda = 1;  ///< G is evaluated at x_l + lambda alpha_l dx_l [-], in [0, 1]

    template <class Scalar>
    SchemeRows<Scalar> rows(Quantity quantity, Eigen::Index n) const;
};

/// Value of Galerkin::quadrature that selects the integrals in closed form.
inline constexpr int exact_quadrature = 0;

/// Eq. (14): each row is the mean over an interval of width dx_l centred at x_l + alpha_l dx_l.
struct Galerkin {
    double alpha_L = 0.5;  ///< as in Collocation
    double alpha_T = 0.5;  ///< as in Collocation
    Derivative derivative = Derivative::analytic;
    double lambda = 1;                  ///< centre of the interval of G, as in Collocation
    int quadrature = exact_quadrature;  ///< Gauss-Legendre points, 1 to 1000, or exact_quadrature

    template <class Scalar>
    SchemeRows<Scalar> rows(Quantity quantity, Eigen::Index n) const;
};

/// Knothe and Gross-Thebing's boundary conditions: collocation at the centres; the leading element carries no traction
/// and the trailing element slides. The unknowns are elements 0 ... n-2, the equations those of elements 1 ... n-1.
struct KnotheBoundary {
    Derivative derivative = Derivative::finite_difference;

    template <class Scalar>
    SchemeRows<Scalar> rows(Quantity quantity, Eigen::Index n) const;
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

// Rows at one point per element, for any options with the fields of Collocation.
template <class Scalar, class Scheme>
SchemeRows<Scalar> collocation_rows(const Scheme& scheme, Quantity quantity, Eigen::Index n) {
    const double shift = quantity == Quantity::slope ? 1 : scheme.lambda;
    const bool differenced = quantity == Quantity::slope && scheme.derivative == Derivative::finite_difference;
    SchemeRows<Scalar> rows;
    rows.alpha_L = shift * scheme.alpha_L;
    rows.alpha_T = shift * scheme.alpha_T;
    rows.offsets = constant_array<Scalar>(1, 0);
    rows.weights = constant_array<Scalar>(1, 1);
    rows.averages = differenced ? 1 : 0;
    rows.guard = quantity == Quantity::slope && !differenced;
    rows.unknown_count = n;
    return rows;
}

// Throws std::invalid_argument if rows do not meet the requirements of SchemeRows.
template <class Scalar>
void check_rows(const SchemeRows<Scalar>& rows, Quantity quantity, Eigen::Index n) {
    require(is_finite(rows.alpha_L), "SchemeRows", "alpha_L", rows.alpha_L, "be finite");
    require(is_finite(rows.alpha_T), "SchemeRows", "alpha_T", rows.alpha_T, "be finite");
    const Eigen::Index points = rows.offsets.size();
    require(points >= 1, "SchemeRows", "number of offsets", points, "be at least 1");
    require(rows.weights.size() == points, "SchemeRows", "number of weights", rows.weights.size(),
            "equal that of offsets");
    Scalar sum = 0;
    for (Eigen::Index k = 0; k < points; ++k) {
        require(is_finite(rows.offsets[k]), "SchemeRows", "offset", rows.offsets[k], "be finite");
        sum += rows.weights[k];
    }
    require(is_finite(sum) && std::abs(sum - 1) <= std::sqrt(std::numeric_limits<Scalar>::epsilon()), "SchemeRows",
            "sum of weights", sum, "be 1");
    const bool slope = quantity == Quantity::slope;
    require(rows.averages >= 0 && rows.averages <= (slope ? 2 : 1), "SchemeRows", "averages", rows.averages,
            slope ? "be 0, 1 or 2 for the slope" : "be 0 or 1 for the displacement");
    require(rows.unknown_count >= 1 && rows.unknown_count <= n, "SchemeRows", "unknown_count", rows.unknown_count,
            "be at least 1 and at most the number of elements");
    require(rows.first_equation >= 0 && rows.first_equation + rows.unknown_count <= n, "SchemeRows", "first_equation",
            rows.first_equation, "be at least 0 and leave as many elements as there are unknowns");
}

}  // namespace detail

template <class Scalar>
SchemeRows<Scalar> Collocation::rows(Quantity quantity, Eigen::Index n) const {
    detail::check_alphas(*this, "Collocation", n);
    return detail::collocation_rows<Scalar>(*this, quantity, n);
}

template <class Scalar>
SchemeRows<Scalar> Galerkin::rows(Quantity quantity, Eigen::Index n) const {
    detail::check_alphas(*this, "Galerkin", n);
    detail::require(quadrature >= 0 && quadrature <= 1000, "Galerkin", "quadrature", quadrature,
                    "be exact_quadrature (0) or lie in [1, 1000]");
    SchemeRows<Scalar> result = detail::collocation_rows<Scalar>(*this, quantity, n);
    if (quadrature == exact_quadrature) {
        ++result.averages;
        result.guard = false;  // the mean over an interval has no singularity
    } else {
        const detail::QuadratureRule<Scalar> rule = detail::gauss_legendre<Scalar>(quadrature);
        result.offsets = detail::halved(rule.nodes);
        result.weights = detail::halved(rule.weights);
    }
    return result;
}

template <class Scalar>
SchemeRows<Scalar> KnotheBoundary::rows(Quantity quantity, Eigen::Index n) const {
    detail::require(n >= 2, "KnotheBoundary", "n", n, "be at least 2");
    SchemeRows<Scalar> result = Collocation{0, 0, derivative, 1}.rows<Scalar>(quantity, n);
    result.first_equation = 1;
    result.unknown_count = n - 1;
    return result;
}

/// The rows of a scheme on a mesh of n elements, of G or G'. Throws std::invalid_argument if the scheme does not fit
/// the mesh, or its rows do not meet the requirements of SchemeRows.
template <class Scalar, RollingScheme<Scalar> Scheme>
SchemeRows<Scalar> scheme_rows(const Scheme& scheme, Quantity quantity, Eigen::Index n) {
    SchemeRows<Scalar> rows = scheme.template rows<Scalar>(quantity, n);
    detail::check_rows(rows, quantity, n);
    return rows;
}

/// Throws std::invalid_argument if scheme_rows does for G or G': checks a scheme before anything is assembled, or in
/// tests of a user's own scheme.
template <RollingScheme Scheme>
void check_scheme(const Scheme& scheme, Eigen::Index n) {
    scheme_rows<double>(scheme, Quantity::slope, n);
    scheme_rows<double>(scheme, Quantity::displacement, n);
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

/// Number of elements whose tractions are unknown, the first of the mesh. Throws std::invalid_argument if the scheme
/// does not fit a mesh of n elements.
template <RollingScheme Scheme>
Eigen::Index unknown_count(const Scheme& scheme, Eigen::Index n) {
    return scheme_rows<double>(scheme, Quantity::slope, n).unknown_count;
}

/// The widths of the unknown elements: the weights that turn tractions into a force. Throws std::invalid_argument if
/// the scheme does not fit the mesh.
template <class Scalar, RollingScheme<Scalar> Scheme>
ArrayX<Scalar> unknown_widths(const Mesh<Scalar>& mesh, const Scheme& scheme) {
    return detail::segment(mesh.widths(), 0, scheme_rows<Scalar>(scheme, Quantity::slope, mesh.size()).unknown_count);
}

}  // namespace rollbem
