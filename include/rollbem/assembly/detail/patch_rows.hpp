// Influence of the rectangles of a patch on the rows of node differences: the entries of G and G', strip by strip.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "../../detail/require.hpp"
#include "../../discretisation/patch_mesh.hpp"
#include "../../discretisation/scheme.hpp"
#include "../../elasticity/patch_kernel.hpp"
#include "../../system/detail/shape_set.hpp"
#include "../../types.hpp"

namespace rollbem::detail {

/// The rows of one strip, -1 <= x <= 1.
template <class Scalar>
struct StripRows {
    struct Place {
        Scalar from_trailing, from_leading;  ///< 1 + x and 1 - x: the smaller one has all digits
    };
    std::vector<Place> places;        ///< places at which u is needed
    std::vector<std::size_t> behind;  ///< n: index of the place of row i, or for the slope of the place behind; the
                                      ///< next place lies ahead
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
        // rows between nodes share places
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

/// Gauss's rule of five points for the distance between a point of an interval of length d and a point of an interval
/// of length h, measured from the distance of their middles: exact for the mean of polynomials of degree 9. The points
/// are 0, +-near and +-far.
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

    /// Mean over an interval, by unit traction on an element of length h whose middle lies x behind the interval's
    /// middle; line(x) is the influence of a line across, x behind a point.
    template <class Line>
    auto mean(const Line& line, Scalar x, Scalar h) const {
        const auto pair = [&](Scalar distance) { return line(x - distance) + line(x + distance); };
        return h * ((1 - near_weight_ - far_weight_) * line(x) + near_weight_ / 2 * pair(near_) +
                    far_weight_ / 2 * pair(far_));
    }

private:
    Scalar near_, far_, near_weight_, far_weight_;
};

/// A patch's width over its mean length.
template <class Scalar>
Scalar width_over_length(const PatchMesh<Scalar>& mesh) {
    const Scalar width = mesh.height();
    return width / (2 * (mesh.widths() * mesh.half_lengths()).sum()) * width;
}

/// Whether a patch is more than 13 times as wide as it is long in the mean (ellipses below a/b = 0.098), or its strips
/// are more than 1.6 times. Tractions of one direction that vary over y displace the surface in the other direction, by
/// the same amount for each factor in distance, from the length of the patch to its width. At the middle of a strip
/// this variation counts from half a strip's width on, in the mean over the strip's width from the patch's length on.
template <class Scalar>
bool has_wide_strips(const PatchMesh<Scalar>& mesh) {
    return width_over_length(mesh) > (std::min)(Scalar(13), Scalar(1.6) * static_cast<Scalar>(mesh.strip_count()));
}

/// Whether rows of the coupling can be means over the width of a strip.
template <class Kernel>
concept HasCouplingIntegral = requires(const Kernel& kernel, typename Kernel::Scalar x) {
    { kernel.coupling_integral(x, x) } -> std::same_as<typename Kernel::Scalar>;
};

/// The displacement of one strip by another, from which entries of the influence follow.
template <class Scalar, RectangleKernel Kernel>
class StripPair {
public:
    /// Influence on strip `row` by tractions on strip `column`. xy is the mean over the width of `row` if `over_width`
    /// is set and the kernel has this mean; otherwise all is taken at the middle of `row`.
    StripPair(const PatchMesh<Scalar>& mesh, const Kernel& kernel, Eigen::Index row, Eigen::Index column,
              bool over_width)
        : kernel_(kernel),
          along_(mesh.along()),
          over_width_(over_width && HasCouplingIntegral<Kernel>),
          row_scale_(mesh.half_lengths()[row]),
          scale_(mesh.half_lengths()[column]),
          offset_(mesh.middles_x()[row] - mesh.middles_x()[column]),
          row_width_(mesh.widths()[row]),
          y0_(mesh.middles_y()[row] - mesh.lower()[column]),
          y1_(mesh.middles_y()[row] - mesh.upper()[column]),
          row_edges_{mesh.lower()[row], mesh.upper()[row]},
          edges_{mesh.lower()[column], mesh.upper()[column]},
          beside_(row == column ? Scalar(0) : (std::min)(std::abs(y0_), std::abs(y1_))),
          gap_((std::max)({Scalar(0), row_edges_[0] - edges_[1], edges_[0] - row_edges_[1]})) {}

    Scalar row_scale() const { return row_scale_; }

    /// u at a place by unit traction on the part of the other strip behind edge `c`.
    RectangleInfluence<Scalar> behind(const typename StripRows<Scalar>::Place& place, Eigen::Index c) const {
        // distances from the nearer end of the strip, where elements are smallest
        const Scalar x = place.from_leading < 1
                             ? offset_ + (row_scale_ - scale_) +
                                   (scale_ * along_.edges_from_leading()[c] - row_scale_ * place.from_leading)
                             : offset_ - (row_scale_ - scale_) +
                                   (row_scale_ * place.from_trailing - scale_ * along_.edges_from_trailing()[c]);
        RectangleInfluence<Scalar> u = kernel_.corner(x, y0_) - kernel_.corner(x, y1_);
        if constexpr (HasCouplingIntegral<Kernel>) {
            if (over_width_) u.xy = (integral(x, edges_[0]) - integral(x, edges_[1])) / row_width_;
        }
        return u;
    }

    /// The mean of du/dx over an interval of length d about `point` due to unit traction on element `c`. `difference`
    /// is this mean as a difference of u; it is the result where its rounding is smaller than the error of MeanRule, or
    /// the kernel has no line_slope.
    RectangleInfluence<Scalar> slope(Scalar point, Scalar d, Eigen::Index c,
                                     const RectangleInfluence<Scalar>& difference) const {
        if constexpr (requires { kernel_.line_slope(d, d, d); }) {
            const Scalar x = offset_ + (row_scale_ * point - scale_ * along_.centres()[c]);
            const Scalar h = scale_ * along_.widths()[c];
            const auto is_distant = [&](Scalar beside) {
                return MeanRule<Scalar>::is_better(d, h, y0_ - y1_, std::sqrt(x * x + beside * beside));
            };
            if (!is_distant(beside_)) return difference;
            const MeanRule<Scalar> rule(d, h);
            RectangleInfluence<Scalar> mean =
                rule.mean([&](Scalar distance) { return kernel_.line_slope(distance, y0_, y1_); }, x, h);
            if (over_width_) mean.xy = difference.xy;
            if constexpr (requires { kernel_.line_coupling_integral(x, x); }) {
                if (over_width_ && is_distant(gap_)) {
                    mean.xy = rule.mean([&](Scalar distance) { return line_coupling(distance); }, x, h);
                }
            }
            return mean;
        }
        return difference;
    }

private:
    Scalar integral(Scalar x, Scalar edge) const {
        return kernel_.coupling_integral(x, row_edges_[1] - edge) - kernel_.coupling_integral(x, row_edges_[0] - edge);
    }

    /// The mean of xy of line_slope over the width of the row's strip.
    Scalar line_coupling(Scalar x) const {
        const auto sum = [&](Scalar edge) {
            return kernel_.line_coupling_integral(x, row_edges_[1] - edge) -
                   kernel_.line_coupling_integral(x, row_edges_[0] - edge);
        };
        return (sum(edges_[1]) - sum(edges_[0])) / row_width_;
    }

    const Kernel& kernel_;
    const Mesh<Scalar>& along_;
    bool over_width_;
    Scalar row_scale_, scale_, offset_, row_width_;
    Scalar y0_, y1_;  // distances of the row's middle ahead of the strip's edges
    std::array<Scalar, 2> row_edges_, edges_;
    Scalar beside_;  // distance from the row's middle to the strip
    Scalar gap_;     // distance between both strips
};

/// The number of strips whose rows are computed.
template <class Scalar>
Eigen::Index computed_strips(const PatchMesh<Scalar>& mesh) {
    return mesh.is_mirrored() ? (mesh.strip_count() + 1) / 2 : mesh.strip_count();
}

/// L of a kernel with a layer, or 0.
template <RectangleKernel Kernel>
typename Kernel::Scalar layer_compliance(const Kernel& kernel) {
    if constexpr (requires { kernel.layer_compliance(); }) return kernel.layer_compliance();
    return 0;
}

/// Contribution of a layer of unit compliance to the rows of a strip at its own elements: p of the element in which a
/// place lies, half of it on an edge, nothing on the leading edge of the contact, ahead of which there is no load.
template <class Scalar>
MatrixX<Scalar> layer_rows(const Mesh<Scalar>& along, const StripRows<Scalar>& rows, Quantity quantity,
                           Scalar row_scale) {
    const auto share = [&](const typename StripRows<Scalar>::Place& at, Eigen::Index c) -> Scalar {
        const Scalar h = along.widths()[c] / 2, to_edge = (std::min)(along.from_trailing()[c], along.from_leading()[c]);
        const Scalar d = at.from_trailing < at.from_leading ? at.from_trailing - along.from_trailing()[c]
                                                            : along.from_leading()[c] - at.from_leading;
        const Scalar rounding = (std::min)(64 * std::numeric_limits<Scalar>::epsilon() * (to_edge + h), h / 8);
        if (std::abs(std::abs(d) - h) > rounding) return std::abs(d) < h ? Scalar(1) : Scalar(0);
        return at.from_leading <= rounding ? Scalar(0) : Scalar(0.5);
    };
    MatrixX<Scalar> result(along.size(), along.size());
    for (Eigen::Index r = 0; r < along.size(); ++r) {
        const std::size_t place = rows.behind[static_cast<std::size_t>(r)];
        for (Eigen::Index c = 0; c < along.size(); ++c) {
            result(r, c) = share(rows.places[place], c);
            if (quantity == Quantity::displacement) continue;
            result(r, c) = (share(rows.places[place + 1], c) - result(r, c)) / (row_scale * rows.lengths[r]);
        }
    }
    return result;
}

/// Rows of G (displacement) or G' (slope) of the strips that are computed, for all elements; xy at the middles of
/// strips or over their widths.
template <class Scalar, RectangleKernel Kernel>
InfluenceRows<Scalar> patch_rows(const PatchMesh<Scalar>& mesh, const StripRows<Scalar>& rows, const Kernel& kernel,
                                 Quantity quantity, bool over_width) {
    const Eigen::Index n = mesh.elements_per_strip(), m = mesh.strip_count(), strips = computed_strips(mesh);
    const std::size_t height = rows.places.size();
    InfluenceRows<Scalar> result(strips * n, m * n);
    // u at each place by a strip that ends at each edge: neighbouring elements and rows share it
    std::vector<RectangleInfluence<Scalar>> table(height * static_cast<std::size_t>(n + 1));
    for (Eigen::Index j = 0; j < strips; ++j) {
        for (Eigen::Index k = 0; k < m; ++k) {
            const StripPair<Scalar, Kernel> pair(mesh, kernel, j, k, over_width);
            RectangleInfluence<Scalar>* entry = table.data();
            for (Eigen::Index c = 0; c <= n; ++c) {
                for (const auto& place : rows.places) *entry++ = pair.behind(place, c);
            }
            for (Eigen::Index c = 0; c < n; ++c) {
                const RectangleInfluence<Scalar>* const trailing = table.data() + static_cast<std::size_t>(c) * height;
                const RectangleInfluence<Scalar>* const leading = trailing + height;
                for (Eigen::Index r = 0; r < n; ++r) {
                    const std::size_t place = rows.behind[static_cast<std::size_t>(r)];
                    RectangleInfluence<Scalar> influence = trailing[place] - leading[place];
                    if (quantity == Quantity::slope) {
                        const Scalar d = pair.row_scale() * rows.lengths[r];
                        influence = (1 / d) * ((trailing[place + 1] - leading[place + 1]) - influence);
                        influence = pair.slope(rows.points[r], d, c, influence);
                    }
                    result.set(j * n + r, k * n + c, influence);
                }
            }
        }
        if (const Scalar layer = layer_compliance(kernel); layer > 0) {
            const MatrixX<Scalar> local = layer * layer_rows(mesh.along(), rows, quantity, mesh.half_lengths()[j]);
            result.xx.block(j * n, j * n, n, n) += local;
            result.yy.block(j * n, j * n, n, n) += local;
        }
    }
    return result;
}

/// Displacement rows at the points of the rows of G', from which patch_rows makes du/dy.
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

/// A kernel whose displacement is du/dy of another kernel.
template <RectangleKernel Kernel>
struct LateralSlope {
    using Scalar = typename Kernel::Scalar;

    const Kernel& kernel;

    RectangleInfluence<Scalar> corner(Scalar x, Scalar y) const { return kernel.corner_lateral_slope(x, y); }
    Scalar coupling_integral(Scalar x, Scalar y) const { return kernel.corner(x, y).xy; }
    bool couples() const { return kernel.couples(); }
};

}  // namespace rollbem::detail

#ifdef ROLLBEM_COMPILED
namespace rollbem {
extern template detail::InfluenceRows<double> detail::patch_rows<double, HalfSpace<double>>(
    const PatchMesh<double>&, const detail::StripRows<double>&, const HalfSpace<double>&, Quantity, bool);
}  // namespace rollbem
#endif
