// Schemes: the points and the form in which the rolling contact equation is imposed on a mesh, as plain option structs.
// Collocation, Galerkin, collocation with Knothe and Gross-Thebing's boundary conditions, and differences between
// neighbouring nodes; any other type that defines its rows can serve as a scheme.
#pragma once

#include "../detail/decl.hpp"

#include <concepts>
#include <functional>
#include <type_traits>
#include <utility>
#include <variant>

#include <Eigen/Core>

#include "../detail/array_functions.hpp"
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
typename Mesh<Scalar>::Array interpolate_alpha(const Mesh<Scalar>& mesh, double alpha_L, double alpha_T);

/// Rows at the points x_l + alpha_l dx_l, with alpha_l of Eq. (28), or means about them: the intervals are as long as
/// the elements.
template <class Scalar>
SchemeRows<Scalar> rows_about(const Mesh<Scalar>& mesh, double alpha_L, double alpha_T);

/// Rows of differences between two points, x_l + from_l dx_l and x_l + to_l dx_l, from_l < to_l: set averages to 1 for
/// the slope. For the displacement the row is u in the middle.
template <class Scalar>
SchemeRows<Scalar> rows_between(const ArrayX<Scalar>& from, const ArrayX<Scalar>& to);

namespace detail {

// Throws std::invalid_argument if rows do not meet the requirements of SchemeRows.
template <class Scalar>
void check_rows(const SchemeRows<Scalar>& rows, Quantity quantity, Eigen::Index n);

}  // namespace detail

/// The rows of a scheme on a mesh, of G or G'. Throws std::invalid_argument if the scheme does not fit the mesh, or its
/// rows do not meet the requirements of SchemeRows.
template <class Scalar, RollingScheme<Scalar> Scheme>
SchemeRows<Scalar> scheme_rows(const Scheme& scheme, Quantity quantity, const Mesh<Scalar>& mesh);

/// Checks a scheme before anything is assembled, or in tests of a user's own. Throws std::invalid_argument if the
/// scheme does not fit the mesh, or if its rows, of G or G', do not meet the requirements of SchemeRows.
template <class Scalar, RollingScheme<Scalar> Scheme>
void check_scheme(const Scheme& scheme, const Mesh<Scalar>& mesh);

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
///
/// \code
/// #include <rollbem/line.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const PlaneKernel<double> kernel(100, 0.72, 0.28);
///     for (const AnyScheme& scheme : {AnyScheme(Galerkin{}), AnyScheme(Collocation{})}) {
///         if (solve_steady(cosine_mesh(20), scheme, kernel).status != Status::ok) return 1;
///     }
/// }
/// \endcode
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
        SchemeRows<Scalar> rows(Quantity quantity, const Mesh<Scalar>& mesh) const;
    };
    using Kind = std::variant<Collocation, Galerkin, KnotheBoundary, NodeDifference, Own>;

    Kind kind_;
};

}  // namespace rollbem

#include "impl/scheme.tpp"

#ifdef ROLLBEM_COMPILED
namespace rollbem {
extern template void detail::check_rows<double>(const SchemeRows<double>&, Quantity, Eigen::Index);
extern template SchemeRows<double> rows_about<double>(const Mesh<double>&, double, double);
extern template SchemeRows<double> NodeDifference::rows<double>(Quantity, const Mesh<double>&) const;
extern template SchemeRows<double> AnyScheme::rows<double>(Quantity, const Mesh<double>&) const;
}  // namespace rollbem
#endif
