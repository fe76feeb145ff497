// Influence between the elements of elliptic patches of several a/b, and of ellipses between them. Internal.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "../../types.hpp"

namespace rollbem::detail {

/// Rows of influence of tractions on elements, along both directions; by reciprocity xy of the kernel is its yx.
template <class Scalar>
struct InfluenceRows {
    MatrixX<Scalar> xx, xy, yy;

    InfluenceRows(Eigen::Index rows, Eigen::Index columns) : xx(rows, columns), xy(rows, columns), yy(rows, columns) {}

    template <class Influence>
    void set(Eigen::Index row, Eigen::Index column, const Influence& value) {
        xx(row, column) = value.xx;
        xy(row, column) = value.xy;
        yy(row, column) = value.yy;
    }
    const MatrixX<Scalar>& block(std::size_t d, std::size_t e) const { return d != e ? xy : d == 0 ? xx : yy; }
};

/// u, du/dx and du/dy at the equations of one ellipse, by unit tractions; lengths in c = sqrt(a b).
template <class Scalar>
struct ShapeNode {
    InfluenceRows<Scalar> G, G_prime, G_y;
};

/// Weights of neighbouring nodes for the matrices of one a/b, and their derivatives with respect to ln(a/b).
template <class Scalar>
struct ShapeWeights {
    std::size_t first = 0, count = 1;
    std::array<Scalar, 4> values{1, 0, 0, 0}, rates{};
};

/// Ellipses whose meshes differ by stretching alone, a constant factor in a/b from one to the next. Entries of other
/// ellipses are interpolated over ln(a/b), by cubics. A single node serves its own a/b alone.
template <class Scalar>
struct ShapeSet {
    std::vector<ShapeNode<Scalar>> nodes;  ///< one node, or at least four
    Scalar first = 0, step = 0;            ///< ln(a/b) of the first node, and its difference from node to node
    ArrayX<Scalar> zeta, upsilon;          ///< x/a and y/b of the points of the equations
    bool coupled = false;                  ///< whether xy differs from zero

    bool is_single() const { return nodes.size() == 1; }

    /// Whether a/b lies in the range of the nodes; the a/b of a single node must agree to half the digits.
    bool covers(Scalar a_over_b) const noexcept {
        const Scalar place = std::log(a_over_b) - first, slack = std::sqrt(std::numeric_limits<Scalar>::epsilon());
        return place >= -slack && place <= static_cast<Scalar>(nodes.size() - 1) * step + slack;
    }

    /// Weights of an a/b that is covered.
    ShapeWeights<Scalar> weights(Scalar a_over_b) const noexcept {
        if (is_single()) return {};
        const Scalar place = (std::log(a_over_b) - first) / step, last = static_cast<Scalar>(nodes.size() - 4);
        const Scalar begin = std::clamp(std::floor(place) - 1, Scalar(0), last);
        const Scalar t = place - begin - 1;  // the four nodes lie at -1, 0, 1 and 2
        const Scalar s = t * t;
        return {static_cast<std::size_t>(begin),
                4,
                {-t * (t - 1) * (t - 2) / 6, (s - 1) * (t - 2) / 2, -t * (t + 1) * (t - 2) / 2, t * (s - 1) / 6},
                {-(3 * s - 6 * t + 2) / (6 * step), (3 * s - 4 * t - 1) / (2 * step), -(3 * s - 2 * t - 2) / (2 * step),
                 (3 * s - 1) / (6 * step)}};
    }
};

}  // namespace rollbem::detail
