// The entries of G or G': the points of the rows, the elements that carry traction, and the distances between them.
// Shared by all ways of computing an entry.
#pragma once

#include <algorithm>
#include <limits>

#include <Eigen/Core>

#include "../../detail/array_functions.hpp"
#include "../../detail/gauss_legendre.hpp"
#include "../../discretisation/scheme.hpp"
#include "../../types.hpp"

namespace rollbem::detail {

/// The points at which rows are taken and the intervals over which they are averaged, in units of a.
template <class Scalar>
struct RowPoints {
    ArrayX<Scalar> from_trailing;  ///< 1 + x of the centre of the row's element
    ArrayX<Scalar> from_leading;   ///< 1 - x of this centre
    ArrayX<Scalar> offset;         ///< point minus centre
    ArrayX<Scalar> half;           ///< delta: half the width over which a row is averaged or differenced
    bool unloaded_ahead = false;   ///< SchemeRows::unloaded_ahead
};

/// The elements that carry unit traction.
template <class Scalar>
struct ColumnElements {
    ArrayX<Scalar> from_trailing;  ///< 1 + x of the centre
    ArrayX<Scalar> from_leading;   ///< 1 - x of the centre
    ArrayX<Scalar> half;           ///< h: half the width
};

/// The integrals of Eqs. (12)-(14): entry (l, m) = int w(tau) g^{(q)}(d + tau) dtau, with
///
/// - g the kernel, q = 0 for the displacement and 1 for the slope;
/// - d = point - centre of the element;
/// - w the element's indicator (half-width h) convolved with `averages` normalised indicators of half-width delta.
///
/// A finite difference, Eq. (29), is an average of the slope: collocation then has q = 1, averages = 1.
template <class Scalar>
struct Entries {
    using Array = ArrayX<Scalar>;

    /// Value of ((h + averages delta) / d)^2 below which entries are far and a series is used.
    static constexpr Scalar far_ratio = Scalar(1) / 16;
    static constexpr Eigen::Index chunk = 8;  ///< rows for which a series is evaluated at once: a few registers
    using Chunk = Eigen::Array<Scalar, chunk, 1>;

    Quantity quantity;
    int averages;
    bool equal_widths;               ///< all h and delta are equal, and so neighbours are 2h apart
    RowPoints<Scalar> rows;          ///< padded to whole chunks by repeating the last
    ColumnElements<Scalar> columns;  ///< n
    Eigen::Index count;              ///< number of rows to be computed

    Entries(Quantity which, int average_count, const RowPoints<Scalar>& points, const ColumnElements<Scalar>& elements)
        : quantity(which),
          averages(average_count),
          equal_widths((elements.half == points.half[0]).all() && (points.half == points.half[0]).all()),
          rows(padded(points)),
          columns(elements),
          count(points.half.size()) {}

    bool slope() const { return quantity == Quantity::slope; }

    /// d of row l and element m.
    Scalar distance(Eigen::Index l, Eigen::Index m) const {
        const Scalar between = columns.from_trailing[m] <= 1 ? rows.from_trailing[l] - columns.from_trailing[m]
                                                             : columns.from_leading[m] - rows.from_leading[l];
        return between + rows.offset[l];
    }

    /// Whether element m is too close to row l for the series.
    bool is_near(Eigen::Index l, Eigen::Index m) const {
        const Scalar size = columns.half[m] + Scalar(averages) * rows.half[l];
        const Scalar d = distance(l, m);
        return !(size * size < far_ratio * d * d);
    }

private:
    static RowPoints<Scalar> padded(const RowPoints<Scalar>& points) {
        const Eigen::Index size = points.half.size();
        const Eigen::Index full = (size + chunk - 1) / chunk * chunk;
        const auto pad = [&](const Array& values) {
            Array result(full);
            for (Eigen::Index l = 0; l < full; ++l) result[l] = values[(std::min)(l, size - 1)];
            return result;
        };
        return {pad(points.from_trailing), pad(points.from_leading), pad(points.offset), pad(points.half),
                points.unloaded_ahead};
    }
};

/// Number of terms that can matter in the series of far entries in even moments of w: 16^-last is below round-off.
template <class Scalar>
inline constexpr int last_moment = (std::numeric_limits<Scalar>::digits + 3) / 4;

/// The second average of a far entry is taken by quadrature: about a far point the integrand is analytic far beyond the
/// interval, so that seven points reach the round-off of double and nine the round-off of long double.
template <class Scalar>
QuadratureRule<Scalar> second_average(int averages) {
    if (averages == 2) return gauss_legendre<Scalar>(std::numeric_limits<Scalar>::digits > 53 ? 9 : 7);
    return {constant_array<Scalar>(1, 0), constant_array<Scalar>(1, 2)};
}

}  // namespace rollbem::detail
