// Influence of the rectangles of a patch on the rows of node differences: the entries of G and G', strip by strip.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "../../detail/require.hpp"
#include "../../discretisation/patch_mesh.hpp"
#include "../../discretisation/scheme.hpp"
#include "../../elasticity/rectangle_kernel.hpp"
#include "../../system/shape_set.hpp"
#include "../../types.hpp"

namespace rollbem::detail {

/// The rows of one strip, -1 <= x <= 1.
template <class Scalar>
struct StripRows {
    struct Place {
        Scalar from_trailing, from_leading;  ///< 1 + x and 1 - x: the smaller one has all digits
    };
    std::vector<Place> places;        ///< at which u is needed
    std::vector<std::size_t> behind;  ///< n: the place of row i, or for the slope the one behind; the next lies ahead
    ArrayX<Scalar> points, lengths;   ///< n: middles and lengths of the intervals over which u is differenced
};

/// Throws std::invalid_argument unless the rows are differences of u (slope) or u at one point (displacement).
template <class Scalar, RollingScheme<Scalar> Scheme>
StripRows<Scalar> strip_rows(const Mesh<Scalar>& along, const Scheme& scheme, Quantity quantity) {
    const Eigen::Index n = along.size();
    const SchemeRows<Scalar> given = scheme_rows(scheme, quantity, along);
    const bool slope = quantity == Quantity::slope;
    require(given.averages == (slope ? 1 : 0) && given.offsets.size() == 1 && given.offsets[0] == 0, "patch",
            slope ? "averages of the scheme for G_prime" : "averages of the scheme for G", given.averages,
            slope ? "be 1, at one point: a patch takes differences, by collocation or between nodes"
                  : "be 0, at one point");
    require(given.unknown_count == n, "patch", "unknown_count of the scheme", given.unknown_count,
            "be the number of elements of a strip");
    StripRows<Scalar> rows{{}, {}, along.centres() + given.alpha * along.widths(), given.lengths * along.widths()};
    for (Eigen::Index i = 0; i < n; ++i) {
        const Scalar half = slope ? rows.lengths[i] / 2 : Scalar(0), ahead = given.alpha[i] * along.widths()[i];
        const auto place = [&](Scalar shift) {
            return typename StripRows<Scalar>::Place{along.from_trailing()[i] + (ahead + shift),
                                                     along.from_leading()[i] - (ahead + shift)};
        };
        // rows between nodes share them
        const Scalar rounding = 64 * std::numeric_limits<Scalar>::epsilon() * along.widths()[i];
        const auto back = place(-half);
        const bool shared = slope && i > 0 &&
                            (std::min)(std::abs(back.from_trailing - rows.places.back().from_trailing),
                                       std::abs(back.from_leading - rows.places.back().from_leading)) <= rounding;
        if (!shared) rows.places.push_back(back);
        rows.behind.push_back(rows.places.size() - 1);
        if (slope) rows.places.push_back(place(half));
    }
    return rows;
}

/// Gauss's rule of five points for the distance between a point of an interval of length d and one of length h,
/// measured from that of their middles: exact for the mean of polynomials of degree 9. The points are 0, +-near and
/// +-far.
template <class Scalar>
class MeanRule {
public:
    MeanRule(Scalar d, Scalar h) {
        const Scalar s = d * d, t = h * h;
        const Scalar m2 = (s + t) / 12, m4 = (s * s + t * t) / 80 + s * t / 24;
        const Scalar m6 = (s * s * s + t * t * t) / 448 + s * t * (s + t) / 64;
        const Scalar m8 = (s * s * s * s + t * t * t * t) / 2304 + s * t * ((s * s + t * t) / 192 + 7 * s * t / 640);
        // the squares of the points are the roots of z^2 - 2 p z + q
        const Scalar determinant = m6 * m2 - m4 * m4;
        const Scalar p = (m8 * m2 - m6 * m4) / (2 * determinant), q = (m8 * m4 - m6 * m6) / determinant;
        const Scalar root = std::sqrt(p * p - q), outer = p + root, inner = q / outer;
        near_ = std::sqrt(inner);
        far_ = std::sqrt(outer);
        far_weight_ = (m4 - inner * m2) / (outer * (outer - inner));
        near_weight_ = (m2 - outer * far_weight_) / inner;
    }

    /// Whether the error of this rule, about (t/distance)^10/250 for t = (d + h)/2, is less than the rounding of
    /// differences, eps distance^3/(d h w) for an element of width w, both relative to the entry.
    static bool is_better(Scalar d, Scalar h, Scalar w, Scalar distance) {
        const Scalar t = (d + h) / 2 / distance, t2 = t * t, t4 = t2 * t2;
        return t < Scalar(0.5) && t4 * t4 * t2 * (d / distance) * (h / distance) * (w / distance) <
                                      250 * std::numeric_limits<Scalar>::epsilon();
    }

    /// Mean of du/dx over an interval by unit traction on an element of length h, whose ends lie y0 and y1 below, and
    /// whose middle lies x behind that of the interval.
    template <class Kernel>
    RectangleInfluence<Scalar> slope(const Kernel& kernel, Scalar x, Scalar y0, Scalar y1, Scalar h) const {
        const auto pair = [&](Scalar distance) {
            return kernel.line_slope(x - distance, y0, y1) + kernel.line_slope(x + distance, y0, y1);
        };
        return h * ((1 - near_weight_ - far_weight_) * kernel.line_slope(x, y0, y1) + near_weight_ / 2 * pair(near_) +
                    far_weight_ / 2 * pair(far_));
    }

private:
    Scalar near_, far_, near_weight_, far_weight_;
};

/// Rows of G (displacement) or G' (slope) of the first `strips` strips, for all elements.
template <class Scalar, RectangleKernel Kernel>
InfluenceRows<Scalar> patch_rows(const PatchMesh<Scalar>& mesh, const StripRows<Scalar>& rows, const Kernel& kernel,
                                 Quantity quantity, Eigen::Index strips) {
    const Eigen::Index n = mesh.elements_per_strip(), m = mesh.strip_count();
    const std::size_t height = rows.places.size();
    const Mesh<Scalar>& along = mesh.along();
    InfluenceRows<Scalar> result(strips * n, m * n);
    // u of a strip that ends at each edge, at each place: neighbouring elements and rows share it
    std::vector<RectangleInfluence<Scalar>> table(height * static_cast<std::size_t>(n + 1));
    for (Eigen::Index j = 0; j < strips; ++j) {
        for (Eigen::Index k = 0; k < m; ++k) {
            const Scalar row_scale = mesh.half_lengths()[j], scale = mesh.half_lengths()[k];
            const Scalar offset = mesh.middles_x()[j] - mesh.middles_x()[k];
            const Scalar y0 = mesh.middles_y()[j] - mesh.edges()[k], y1 = mesh.middles_y()[j] - mesh.edges()[k + 1];
            RectangleInfluence<Scalar>* entry = table.data();
            // distances from the nearer end of the strip, where elements are smallest
            const Scalar trailing_ends = offset - (row_scale - scale), leading_ends = offset + (row_scale - scale);
            for (Eigen::Index c = 0; c <= n; ++c) {
                for (const auto& place : rows.places) {
                    const Scalar x =
                        place.from_leading < 1
                            ? leading_ends + (scale * along.edges_from_leading()[c] - row_scale * place.from_leading)
                            : trailing_ends +
                                  (row_scale * place.from_trailing - scale * along.edges_from_trailing()[c]);
                    *entry++ = kernel.corner(x, y0) - kernel.corner(x, y1);
                }
            }
            const Scalar beside = j == k ? Scalar(0) : (std::min)(std::abs(y0), std::abs(y1));
            for (Eigen::Index c = 0; c < n; ++c) {
                const RectangleInfluence<Scalar>* const trailing = table.data() + static_cast<std::size_t>(c) * height;
                const RectangleInfluence<Scalar>* const leading = trailing + height;
                const Scalar h = scale * along.widths()[c];
                for (Eigen::Index r = 0; r < n; ++r) {
                    const Eigen::Index row = j * n + r, column = k * n + c;
                    const std::size_t place = rows.behind[static_cast<std::size_t>(r)];
                    if (quantity == Quantity::displacement) {
                        result.set(row, column, trailing[place] - leading[place]);
                        continue;
                    }
                    const Scalar d = row_scale * rows.lengths[r];
                    if constexpr (requires { kernel.line_slope(d, y0, y1); }) {
                        const Scalar x = offset + (row_scale * rows.points[r] - scale * along.centres()[c]);
                        const Scalar distance = std::sqrt(x * x + beside * beside);
                        if (MeanRule<Scalar>::is_better(d, h, y0 - y1, distance)) {
                            result.set(row, column, MeanRule<Scalar>(d, h).slope(kernel, x, y0, y1, h));
                            continue;
                        }
                    }
                    result.set(
                        row, column,
                        (1 / d) * ((trailing[place + 1] - leading[place + 1]) - (trailing[place] - leading[place])));
                }
            }
        }
    }
    return result;
}

/// The same at the points of the rows of G', for du/dy by patch_rows of a displacement.
template <class Scalar>
StripRows<Scalar> at_points(const StripRows<Scalar>& slope) {
    StripRows<Scalar> rows{{}, {}, slope.points, slope.lengths};
    for (const std::size_t behind : slope.behind) {
        const auto &back = slope.places[behind], &ahead = slope.places[behind + 1];
        rows.behind.push_back(rows.places.size());
        rows.places.push_back(
            {(back.from_trailing + ahead.from_trailing) / 2, (back.from_leading + ahead.from_leading) / 2});
    }
    return rows;
}

/// A kernel whose displacement is du/dy of another.
template <RectangleKernel Kernel>
struct LateralSlope {
    using Scalar = typename Kernel::Scalar;

    const Kernel& kernel;

    RectangleInfluence<Scalar> corner(Scalar x, Scalar y) const { return kernel.corner_lateral_slope(x, y); }
    bool couples() const { return kernel.couples(); }
};

}  // namespace rollbem::detail
