// Schemes: the points and the form in which the rolling contact equation is imposed on a mesh, as plain option structs.
// Collocation, Galerkin, collocation with Knothe and Gross-Thebing's boundary conditions, and differences between
// neighbouring nodes; any other type that defines its rows can serve as a scheme.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <functional>
#include <limits>
#include <numbers>
#include <type_traits>
#include <utility>
#include <variant>

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

/// The rows of a scheme. Row l belongs to an interval about the point x_l + alpha_l dx_l, with x_l and dx_l the centre
/// and the width of element l. It evaluates the quantity at points of the interval, or its mean over the interval; the
/// mean of the slope is the difference of u between both ends over their distance. rows_about and rows_between make
/// both kinds.
template <class Scalar>
struct SchemeRows {
    ArrayX<Scalar> alpha;    ///< alpha_l of every element of the mesh [-]
    ArrayX<Scalar> lengths;  ///< lengths of the intervals, in widths dx_l; positive
    /// A quadrature rule over the interval [-]: at least one point, measured from its middle in lengths of the
    /// interval; the weights add up to 1.
    ArrayX<Scalar> offsets = detail::constant_array<Scalar>(1, 0), weights = detail::constant_array<Scalar>(1, 1);
    /// Number of times that the mean over the interval is taken: once for a difference between its ends, Eq. (29), and
    /// once for Galerkin's integral in closed form, Eq. (14). The number is at most 2 for the slope and 1 for the
    /// displacement.
    int averages = 0;
    /// The distance that a row stands for, from its equation to the next, in lengths of the interval.
    Scalar way = 1;
    /// Moves points that are closer than 0.001 dx to an edge of an element, where du/dx is infinite, to that distance.
    bool guard = false;
    /// The rows belong to points half an element ahead of the centres, where the rigid slip is taken, even if G is
    /// evaluated a little behind them.
    bool half_element_ahead = false;
    /// Differences that end on the leading edge of the contact take the displacement just ahead of it, where a layer
    /// is not loaded, instead of the mean of both sides.
    bool unloaded_ahead = false;
    Eigen::Index first_equation = 0;  ///< the element whose row is the first equation; the following elements have the
                                      ///< other equations
    Eigen::Index unknown_count = 0;   ///< number of equations and of unknowns, the tractions of the first elements
};

/// A scheme has rows(quantity, mesh), its rows on a mesh, which throws std::invalid_argument if the options are out of
/// range or do not fit the mesh. G and G' have the same equations and unknowns.
template <class Scheme, class Scalar = double>
concept RollingScheme = requires(const Scheme& scheme, Quantity quantity, const Mesh<Scalar>& mesh) {
    { scheme.rows(quantity, mesh) } -> std::same_as<SchemeRows<Scalar>>;
};

/// The method by which du/dx is obtained from the displacement u of the elements.
enum class Derivative {
    finite_difference,  ///< central over the element's own width about the point, Eq. (29)
    analytic,           ///< closed form; points closer than 0.001 dx to an element's edge are moved to that distance
    fourth_order,       ///< central over the same width, but from four points, of fourth order; not for Galerkin
};

/// Eq. (12) at one point per element, x_l + alpha_l dx_l, with alpha_l linear between both ends, Eq. (28).
/// alpha > 0 lies ahead of the element's centre; alpha = 0.5 is its leading edge. The defaults are 0.5 and 0.5, the
/// most accurate; the programs' options default to the 0 and 0.63 of the paper, whose study they repeat.
struct Collocation {
    double alpha_L = 0.5;  ///< alpha of the leading element [-], in [-2, 2]
    double alpha_T = 0.5;  ///< alpha of the trailing element [-], in [-2, 2]
    Derivative derivative = Derivative::finite_difference;
    double lambda = 1;  ///< G is evaluated at x_l + lambda alpha_l dx_l [-], in [0, 1]

    template <class Scalar>
    SchemeRows<Scalar> rows(Quantity quantity, const Mesh<Scalar>& mesh) const;
};

/// Value of Galerkin::quadrature that selects the integrals in closed form.
inline constexpr int exact_quadrature = 0;

/// Eq. (14): each row is the mean over an interval of width dx_l centred at x_l + alpha_l dx_l.
struct Galerkin {
    double alpha_L = 0.5;  ///< alpha as in Collocation
    double alpha_T = 0.5;  ///< alpha as in Collocation
    Derivative derivative = Derivative::analytic;
    double lambda = 1;                  ///< centre of the interval of G, as in Collocation
    int quadrature = exact_quadrature;  ///< Gauss-Legendre points, 1 to 1000, or exact_quadrature

    template <class Scalar>
    SchemeRows<Scalar> rows(Quantity quantity, const Mesh<Scalar>& mesh) const;
};

/// Knothe and Gross-Thebing's boundary conditions: collocation at the centres; the leading element carries no traction
/// and the trailing element slides. Elements 0 ... n-2 have the unknowns, elements 1 ... n-1 the equations.
struct KnotheBoundary {
    Derivative derivative = Derivative::finite_difference;

    template <class Scalar>
    SchemeRows<Scalar> rows(Quantity quantity, const Mesh<Scalar>& mesh) const;
};

/// The nodes between which NodeDifference takes differences, one in each element.
enum class Nodes {
    centres,    ///< centres of the elements, on any mesh: the most accurate in full adhesion
    chebyshev,  ///< t_i = -cos(pi (i + 1/2)/n) in units of a, i = 0 ... n-1, on the cosine mesh: for friction
};

/// Differences of u between neighbouring nodes t_i, (u(t_{i+1}) - u(t_i)) / (t_{i+1} - t_i): the row follows a particle
/// of the surface from one node to the next, and the last row ends on the leading edge, t_n = a. The differences are of
/// second order on the cosine mesh. The point X_i of row i, where the rigid slip is taken, is the middle between both
/// nodes; G is evaluated at X_i, but not beyond the leading edge of element i: from the next element it would be
/// unstable on long patches.
struct NodeDifference {
    Nodes nodes = Nodes::centres;

    template <class Scalar>
    SchemeRows<Scalar> rows(Quantity quantity, const Mesh<Scalar>& mesh) const;
};

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

/// Rows at the points x_l + alpha_l dx_l, with alpha_l of Eq. (28), or means about them: the intervals are as long as
/// the elements.
template <class Scalar>
SchemeRows<Scalar> rows_about(const Mesh<Scalar>& mesh, double alpha_L, double alpha_T) {
    SchemeRows<Scalar> rows;
    rows.alpha = interpolate_alpha(mesh, alpha_L, alpha_T);
    rows.lengths = detail::constant_array<Scalar>(mesh.size(), 1);
    rows.unknown_count = mesh.size();
    return rows;
}

/// Rows of differences between two points, x_l + from_l dx_l and x_l + to_l dx_l, from_l < to_l: set averages to 1 for
/// the slope. For the displacement the row is u in the middle.
template <class Scalar>
SchemeRows<Scalar> rows_between(const ArrayX<Scalar>& from, const ArrayX<Scalar>& to) {
    SchemeRows<Scalar> rows;
    rows.alpha.resize(from.size());
    rows.lengths.resize(from.size());
    for (Eigen::Index l = 0; l < from.size(); ++l) {
        rows.alpha[l] = (from[l] + to[l]) / 2;
        rows.lengths[l] = to[l] - from[l];
    }
    rows.unknown_count = from.size();
    return rows;
}

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

// Differences over the thirds of each interval, weighted so that they give the slope in its middle to fourth order.
template <class Scalar>
void take_thirds(SchemeRows<Scalar>& rows) {
    for (Scalar& length : rows.lengths) length /= 3;
    rows.way = 3;
    rows.offsets.resize(3);
    rows.weights.resize(3);
    for (Eigen::Index k = 0; k < 3; ++k) {
        rows.offsets[k] = Scalar(k - 1);
        rows.weights[k] = Scalar(k == 1 ? 26 : -1) / 24;
    }
}

// Rows at one point per element, for any options with the fields of Collocation.
template <class Scalar, class Scheme>
SchemeRows<Scalar> collocation_rows(const Scheme& scheme, Quantity quantity, const Mesh<Scalar>& mesh) {
    const double shift = quantity == Quantity::slope ? 1 : scheme.lambda;
    const bool analytic = scheme.derivative == Derivative::analytic;
    const bool differenced = quantity == Quantity::slope && !analytic;
    SchemeRows<Scalar> rows = rows_about(mesh, shift * scheme.alpha_L, shift * scheme.alpha_T);
    rows.averages = differenced ? 1 : 0;
    rows.guard = quantity == Quantity::slope && analytic;
    if (differenced && scheme.derivative == Derivative::fourth_order) take_thirds(rows);
    return rows;
}

// The sine of `k` quarters of pi/n, 0 <= k <= 4n. Its argument is kept below pi/2 so that the rounding of pi does not
// affect the small results at the leading edge.
template <class Scalar>
Scalar sine_of_quarters(Eigen::Index k, Eigen::Index n) {
    const Scalar quarter = std::numbers::pi_v<Scalar> / static_cast<Scalar>(4 * n);
    return std::sin(static_cast<Scalar>((std::min)(k, 4 * n - k)) * quarter);
}

// Throws std::invalid_argument unless a mesh is the cosine mesh to rounding.
template <class Scalar>
void require_cosine_mesh(const char* who, const Mesh<Scalar>& mesh) {
    const Eigen::Index n = mesh.size();
    for (Eigen::Index i = 0; i < n; ++i) {
        const Scalar width = 2 * sine_of_quarters<Scalar>(4 * i + 2, n) * sine_of_quarters<Scalar>(2, n);
        const Scalar ratio = mesh.widths()[i] / width;
        require(std::abs(ratio - 1) <= std::sqrt(std::numeric_limits<Scalar>::epsilon()), who,
                "width of an element over its width in the cosine mesh", ratio,
                "be 1: Chebyshev nodes require the cosine mesh");
    }
}

// Throws std::invalid_argument if rows do not meet the requirements of SchemeRows.
template <class Scalar>
void check_rows(const SchemeRows<Scalar>& rows, Quantity quantity, Eigen::Index n) {
    require(rows.alpha.size() == n, "SchemeRows", "number of alphas", rows.alpha.size(),
            "equal the number of elements");
    require(rows.lengths.size() == n, "SchemeRows", "number of lengths", rows.lengths.size(),
            "equal the number of elements");
    for (Eigen::Index l = 0; l < n; ++l) {
        require_finite("SchemeRows", "alpha", rows.alpha[l]);
        require_positive("SchemeRows", "length", rows.lengths[l]);
    }
    const Eigen::Index points = rows.offsets.size();
    require(points >= 1, "SchemeRows", "number of offsets", points, "be at least 1");
    require(rows.weights.size() == points, "SchemeRows", "number of weights", rows.weights.size(),
            "equal the number of offsets");
    Scalar sum = 0;
    for (Eigen::Index k = 0; k < points; ++k) {
        require_finite("SchemeRows", "offset", rows.offsets[k]);
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
SchemeRows<Scalar> Collocation::rows(Quantity quantity, const Mesh<Scalar>& mesh) const {
    detail::check_alphas(*this, "Collocation", mesh.size());
    SchemeRows<Scalar> result = detail::collocation_rows(*this, quantity, mesh);
    result.half_element_ahead = alpha_L == 0.5 && alpha_T == 0.5 && lambda == 1 && derivative != Derivative::analytic;
    return result;
}

template <class Scalar>
SchemeRows<Scalar> Galerkin::rows(Quantity quantity, const Mesh<Scalar>& mesh) const {
    detail::check_alphas(*this, "Galerkin", mesh.size());
    detail::require(quadrature >= 0 && quadrature <= 1000, "Galerkin", "quadrature", quadrature,
                    "be exact_quadrature (0) or lie in [1, 1000]");
    detail::require(derivative != Derivative::fourth_order, "Galerkin", "derivative", "fourth_order",
                    "be analytic or finite_difference: the fourth order is for slopes at points");
    SchemeRows<Scalar> result = detail::collocation_rows(*this, quantity, mesh);
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
SchemeRows<Scalar> KnotheBoundary::rows(Quantity quantity, const Mesh<Scalar>& mesh) const {
    const Eigen::Index n = mesh.size();
    detail::require(n >= 2, "KnotheBoundary", "n", n, "be at least 2");
    SchemeRows<Scalar> result = Collocation{0, 0, derivative, 1}.rows(quantity, mesh);
    result.first_equation = 1;
    result.unknown_count = n - 1;
    return result;
}

template <class Scalar>
SchemeRows<Scalar> NodeDifference::rows(Quantity quantity, const Mesh<Scalar>& mesh) const {
    const Eigen::Index n = mesh.size();
    const Scalar half = Scalar(0.5);
    ArrayX<Scalar> from(n), to(n);  // t_i and t_{i+1}; both relative to element i, so that nothing cancels
    if (nodes == Nodes::chebyshev) {
        detail::require_cosine_mesh("NodeDifference", mesh);
        // node and edge are half an angle of pi/n apart: products of sines, like the widths
        const auto sine = [n](Eigen::Index quarters) { return detail::sine_of_quarters<Scalar>(quarters, n); };
        for (Eigen::Index i = 0; i < n; ++i) {
            const Scalar width = sine(4 * i + 2) * sine(2);
            from[i] = half - sine(4 * i + 3) * sine(1) / width;
            to[i] = half + (i + 1 < n ? sine(4 * i + 5) * sine(1) / width : Scalar(0));
        }
    } else {
        for (Eigen::Index i = 0; i < n; ++i) {
            from[i] = 0;
            to[i] = i + 1 < n ? half + half * (mesh.widths()[i + 1] / mesh.widths()[i]) : half;
        }
    }
    SchemeRows<Scalar> result = rows_between(from, to);
    result.half_element_ahead = true;
    result.unloaded_ahead = true;
    if (quantity == Quantity::slope) {
        result.averages = 1;
    } else {
        for (Scalar& alpha : result.alpha) alpha = (std::min)(alpha, half);
    }
    return result;
}

/// The rows of a scheme on a mesh, of G or G'. Throws std::invalid_argument if the scheme does not fit the mesh, or its
/// rows do not meet the requirements of SchemeRows.
template <class Scalar, RollingScheme<Scalar> Scheme>
SchemeRows<Scalar> scheme_rows(const Scheme& scheme, Quantity quantity, const Mesh<Scalar>& mesh) {
    SchemeRows<Scalar> rows = scheme.rows(quantity, mesh);
    detail::check_rows(rows, quantity, mesh.size());
    return rows;
}

/// Checks a scheme before anything is assembled, or in tests of a user's own. Throws std::invalid_argument if the
/// scheme does not fit the mesh, or if its rows, of G or G', do not meet the requirements of SchemeRows.
template <class Scalar, RollingScheme<Scalar> Scheme>
void check_scheme(const Scheme& scheme, const Mesh<Scalar>& mesh) {
    scheme_rows(scheme, Quantity::slope, mesh);
    scheme_rows(scheme, Quantity::displacement, mesh);
}

/// Number of elements whose tractions are unknown, the first of the mesh. Throws std::invalid_argument if the scheme
/// does not fit the mesh.
template <class Scalar, RollingScheme<Scalar> Scheme>
Eigen::Index unknown_count(const Scheme& scheme, const Mesh<Scalar>& mesh) {
    return scheme_rows(scheme, Quantity::slope, mesh).unknown_count;
}

/// The widths of the unknown elements: the weights that turn tractions into a force. Throws std::invalid_argument if
/// the scheme does not fit the mesh.
template <class Scalar, RollingScheme<Scalar> Scheme>
ArrayX<Scalar> unknown_widths(const Mesh<Scalar>& mesh, const Scheme& scheme) {
    return detail::segment(mesh.widths(), 0, unknown_count(scheme, mesh));
}

/// Any RollingScheme, itself a scheme: AnyScheme scheme = Galerkin{}. A user's own scheme has rows in double only; rows
/// in other scalars throw std::invalid_argument.
class AnyScheme {
public:
    AnyScheme() = default;  ///< Collocation{}

    template <class Scheme>
    requires(!std::same_as<Scheme, AnyScheme> && RollingScheme<Scheme>) AnyScheme(Scheme scheme) {  // NOLINT: implicit
        if constexpr (std::is_constructible_v<Kind, std::in_place_type_t<Scheme>, Scheme>) {
            kind_ = std::move(scheme);
        } else {
            kind_ = Own{[own = std::move(scheme)](Quantity quantity, const Mesh<double>& mesh) {
                return own.rows(quantity, mesh);
            }};
        }
    }

    /// The scheme if it is one of the library's and of this type, else null.
    template <class Scheme>
    const Scheme* get_if() const {
        return std::get_if<Scheme>(&kind_);
    }

    template <class Scalar>
    SchemeRows<Scalar> rows(Quantity quantity, const Mesh<Scalar>& mesh) const {
        return std::visit([&](const auto& scheme) { return scheme.rows(quantity, mesh); }, kind_);
    }

private:
    struct Own {
        std::function<SchemeRows<double>(Quantity, const Mesh<double>&)> in_double;

        template <class Scalar>
        SchemeRows<Scalar> rows(Quantity quantity, const Mesh<Scalar>& mesh) const {
            if constexpr (std::same_as<Scalar, double>) return in_double(quantity, mesh);
            detail::require(false, "AnyScheme", "size of the scalar", sizeof(Scalar),
                            "be the size of double for a scheme of the user's own");
            return {};
        }
    };
    using Kind = std::variant<Collocation, Galerkin, KnotheBoundary, NodeDifference, Own>;

    Kind kind_;
};

}  // namespace rollbem
