// Bodies of discretisation/scheme.hpp. Internal.
#pragma once

#include "../scheme.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Core>

#include "../../detail/array_functions.hpp"
#include "../../detail/finite.hpp"
#include "../../detail/gauss_legendre.hpp"
#include "../../detail/require.hpp"
#include "../../types.hpp"
#include "../mesh.hpp"

namespace rollbem::detail {

template <class Scheme>
void check_alphas(const Scheme& scheme, const char* who, Eigen::Index n);

// Differences over the thirds of each interval, weighted so that they give the slope in its middle to fourth order.
template <class Scalar>
void take_thirds(SchemeRows<Scalar>& rows);

// Rows at one point per element, for any options with the fields of Collocation.
template <class Scalar, class Scheme>
SchemeRows<Scalar> collocation_rows(const Scheme& scheme, Quantity quantity, const Mesh<Scalar>& mesh);

// The sine of `k` quarters of pi/n, 0 <= k <= 4n. Its argument is kept below pi/2 so that the rounding of pi does not
// affect the small results at the leading edge.
template <class Scalar>
Scalar sine_of_quarters(Eigen::Index k, Eigen::Index n);

// Throws std::invalid_argument unless a mesh is the cosine mesh to rounding.
template <class Scalar>
void require_cosine_mesh(const char* who, const Mesh<Scalar>& mesh);

}  // namespace rollbem::detail

namespace rollbem {

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

template <class Scalar>
SchemeRows<Scalar> rows_about(const Mesh<Scalar>& mesh, double alpha_L, double alpha_T) {
    SchemeRows<Scalar> rows;
    rows.alpha = interpolate_alpha(mesh, alpha_L, alpha_T);
    rows.lengths = detail::constant_array<Scalar>(mesh.size(), 1);
    rows.unknown_count = mesh.size();
    return rows;
}

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

}  // namespace rollbem

namespace rollbem::detail {

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

template <class Scalar>
Scalar sine_of_quarters(Eigen::Index k, Eigen::Index n) {
    const Scalar quarter = std::numbers::pi_v<Scalar> / static_cast<Scalar>(4 * n);
    return std::sin(static_cast<Scalar>((std::min)(k, 4 * n - k)) * quarter);
}

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

}  // namespace rollbem::detail

namespace rollbem {

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

template <class Scalar, RollingScheme<Scalar> Scheme>
SchemeRows<Scalar> scheme_rows(const Scheme& scheme, Quantity quantity, const Mesh<Scalar>& mesh) {
    SchemeRows<Scalar> rows = scheme.rows(quantity, mesh);
    detail::check_rows(rows, quantity, mesh.size());
    return rows;
}

template <class Scalar, RollingScheme<Scalar> Scheme>
void check_scheme(const Scheme& scheme, const Mesh<Scalar>& mesh) {
    scheme_rows(scheme, Quantity::slope, mesh);
    scheme_rows(scheme, Quantity::displacement, mesh);
}

template <class Scalar>
SchemeRows<Scalar> AnyScheme::Own::rows(Quantity quantity, const Mesh<Scalar>& mesh) const {
    if constexpr (std::same_as<Scalar, double>) return in_double(quantity, mesh);
    detail::require(false, "AnyScheme", "size of the scalar", sizeof(Scalar),
                    "be the size of double for a scheme of the user's own");
    return {};
}

}  // namespace rollbem
