// Blocks of G and G' of a patch, its mirrored halves, and its ellipses of other a/b. Internal.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../../detail/require.hpp"
#include "../../discretisation/patch_mesh.hpp"
#include "../../discretisation/scheme.hpp"
#include "../../elasticity/patch_kernel.hpp"
#include "../../system/detail/shape_set.hpp"
#include "../../system/rolling_system.hpp"
#include "../../types.hpp"
#include "line_rows.hpp"
#include "patch_rows.hpp"

namespace rollbem::detail {

/// Rows of all strips from the rows of the strips at y <= 0, of which there are `given`; their mirror images have
/// entries `sign` times as large.
template <class Scalar>
MatrixX<Scalar> unfolded(const MatrixX<Scalar>& given, Eigen::Index n, Eigen::Index m, Scalar sign) {
    const Eigen::Index computed = given.rows() / n;
    MatrixX<Scalar> block(m * n, m * n);
    block.topRows(computed * n) = given;
    for (Eigen::Index j = computed; j < m; ++j) {
        for (Eigen::Index k = 0; k < m; ++k) {
            block.block(j * n, k * n, n, n) = sign * given.block((m - 1 - j) * n, (m - 1 - k) * n, n, n);
        }
    }
    return block;
}

/// All blocks of G or G'.
template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
DirectionBlocks<Scalar> patch_blocks(const PatchMesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel,
                                     Quantity quantity) {
    const Eigen::Index n = mesh.elements_per_strip(), m = mesh.strip_count();
    const InfluenceRows<Scalar> rows =
        patch_rows(mesh, strip_rows(mesh.along(), scheme, quantity), kernel, quantity, has_wide_strips(mesh));
    DirectionBlocks<Scalar> blocks;
    blocks[0][0] = unfolded(rows.xx, n, m, Scalar(1));
    blocks[1][1] = unfolded(rows.yy, n, m, Scalar(1));
    if (kernel.couples()) blocks[0][1] = blocks[1][0] = unfolded(rows.xy, n, m, Scalar(-1));
    return blocks;
}

/// The system of blocks that belong to a mesh.
template <class Scalar, RollingScheme<Scalar> Scheme>
ElementSystem<Scalar, 2> system_of(const PatchMesh<Scalar>& mesh, const Scheme& scheme, DirectionBlocks<Scalar> G,
                                   DirectionBlocks<Scalar> G_prime) {
    return {std::move(G), std::move(G_prime), patch_elements(mesh, scheme), nullptr, 2 / mesh.height()};
}

/// Influence of tractions on the strips at y <= 0 and their mirror images in the strips at y <= 0: `count` strips of
/// rows and columns, tractions at -y `sign` times the tractions at y.
template <class Scalar>
MatrixX<Scalar> folded(const MatrixX<Scalar>& rows, Eigen::Index n, Eigen::Index m, Eigen::Index row_strips,
                       Eigen::Index column_strips, Scalar sign) {
    MatrixX<Scalar> result = rows.topLeftCorner(row_strips * n, column_strips * n);
    for (Eigen::Index k = 0; k < m / 2 && k < column_strips; ++k) {
        result.middleCols(k * n, n) += sign * rows.block(0, (m - 1 - k) * n, row_strips * n, n);
    }
    return result;
}

/// One of the two uncoupled problems of mirrored strips, posed on the strips at y <= 0:
///
/// - sign = 1, for xi: p_x is even in y, and p_y odd;
/// - sign = -1, for eta and phi: p_x is odd, and p_y even.
///
/// The odd traction vanishes on a strip in the middle, so that there are always n m unknowns: p_x, then p_y, on `x` and
/// `y` strips.
template <class Scalar>
struct MirroredHalf {
    Eigen::Index n, m;  ///< elements in a strip, strips
    Scalar sign;
    Eigen::Index x = sign > 0 ? (m + 1) / 2 : m / 2, y = m - x;
    Eigen::Index first = sign > 0 ? 0 : 1, count = sign > 0 ? 1 : 2;  ///< numbers of its creepages

    static std::array<MirroredHalf, 2> both(Eigen::Index n, Eigen::Index m) {
        return {{{.n = n, .m = m, .sign = 1}, {.n = n, .m = m, .sign = -1}}};
    }

    /// The matrix of G or G'.
    MatrixX<Scalar> matrix(const InfluenceRows<Scalar>& rows) const {
        MatrixX<Scalar> result(m * n, m * n);
        result.topLeftCorner(x * n, x * n) = folded(rows.xx, n, m, x, x, sign);
        result.topRightCorner(x * n, y * n) = folded(rows.xy, n, m, x, y, -sign);
        result.bottomLeftCorner(y * n, x * n) = folded(rows.xy, n, m, y, x, sign);
        result.bottomRightCorner(y * n, y * n) = folded(rows.yy, n, m, y, y, -sign);
        return result;
    }

    /// The rows and columns of the 2N x 3 rigid slip that belong to this half.
    MatrixX<Scalar> inputs(const MatrixX<Scalar>& whole) const {
        MatrixX<Scalar> result(m * n, count);
        result.topRows(x * n) = whole.block(0, first, x * n, count);
        result.bottomRows(y * n) = whole.block(m * n, first, y * n, count);
        return result;
    }

    /// The rows and columns of the weights of forces, including strips at y > 0.
    MatrixX<Scalar> outputs(const MatrixX<Scalar>& whole) const {
        MatrixX<Scalar> result = inputs(whole);
        const Eigen::Index pairs = (m / 2) * n;  // without a strip in the middle
        result.topRows(pairs) *= 2;
        result.middleRows(x * n, pairs) *= 2;
        return result;
    }

    /// Writes the unknowns into the unknowns of the whole patch, 2N x 3.
    void unfold(const MatrixX<Scalar>& half, MatrixX<Scalar>& whole) const {
        const auto write = [&](Eigen::Index strips, Eigen::Index from, Eigen::Index to, Scalar parity) {
            for (Eigen::Index j = 0; j < strips; ++j) {
                const auto own = half.middleRows((from + j) * n, n);
                whole.block((to + j) * n, first, n, count) = own;
                if (m - 1 - j != j) whole.block((to + m - 1 - j) * n, first, n, count) = parity * own;
            }
        };
        write(x, 0, 0, sign);
        write(y, x, m, -sign);
    }
};

/// Both halves as systems; G is divided by `scale`.
template <class Scalar>
std::vector<RollingSystem<Scalar>> mirrored_parts(const InfluenceRows<Scalar>& G, const InfluenceRows<Scalar>& G_prime,
                                                  const Elements<Scalar>& elements, Eigen::Index strips, Scalar scale) {
    const MatrixX<Scalar> inputs = rigid_slip(elements), outputs = force_weights(elements);
    std::vector<RollingSystem<Scalar>> parts;
    for (const auto& half : MirroredHalf<Scalar>::both(elements.size() / strips, strips)) {
        parts.emplace_back(half.matrix(G) / scale, half.matrix(G_prime), half.inputs(inputs), half.outputs(outputs));
    }
    return parts;
}

/// G, G' and G_y of a mesh in units of `c`; the mesh has c = 1; `over_width` as in patch_rows.
template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
ShapeNode<Scalar> shape_node(const PatchMesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel, Scalar c,
                             bool over_width) {
    static_assert(
        requires { kernel.corner_lateral_slope(c, c); },
        "patches whose half-width varies require a kernel with corner_lateral_slope");
    require(layer_compliance(kernel) == 0, "patch", "layer_compliance of the kernel", layer_compliance(kernel),
            "be 0 where the size of the patch varies: the layer does not grow with it");
    const Eigen::Index n = mesh.elements_per_strip(), m = mesh.strip_count();
    const auto whole = [&](InfluenceRows<Scalar> rows, Scalar factor, Scalar sign) {
        for (MatrixX<Scalar>* block : {&rows.xx, &rows.xy, &rows.yy}) {
            *block = factor * unfolded(*block, n, m, block == &rows.xy ? -sign : sign);
        }
        return rows;
    };
    const StripRows<Scalar> slope = strip_rows(mesh.along(), scheme, Quantity::slope);
    return {whole(patch_rows(mesh, strip_rows(mesh.along(), scheme, Quantity::displacement), kernel,
                             Quantity::displacement, over_width),
                  1 / c, 1),
            whole(patch_rows(mesh, slope, kernel, Quantity::slope, over_width), 1, 1),
            whole(patch_rows(mesh, at_points(slope), LateralSlope<Kernel>{kernel}, Quantity::displacement, over_width),
                  1, -1)};
}

/// The system of one a/b, in units of the half-length.
template <class Scalar>
ElementSystem<Scalar, 2> system_of(std::shared_ptr<const ShapeSet<Scalar>> set, Elements<Scalar> elements,
                                   Scalar a_over_b) {
    const ShapeWeights<Scalar> weights = set->weights(a_over_b);
    const auto interpolated = [&](const InfluenceRows<Scalar> ShapeNode<Scalar>::*quantity, Scalar factor) {
        DirectionBlocks<Scalar> blocks;
        for (std::size_t d = 0; d < 2; ++d) {
            for (std::size_t e = 0; e < 2; ++e) {
                if (d != e && !set->coupled) continue;
                blocks[d][e] = MatrixX<Scalar>::Zero(elements.size(), elements.size());
                for (std::size_t k = 0; k < weights.count; ++k) {
                    blocks[d][e] += factor * weights.values[k] * (set->nodes[weights.first + k].*quantity).block(d, e);
                }
            }
        }
        return blocks;
    };
    DirectionBlocks<Scalar> G = interpolated(&ShapeNode<Scalar>::G, 1 / std::sqrt(a_over_b)),
                            G_prime = interpolated(&ShapeNode<Scalar>::G_prime, 1);
    return {std::move(G), std::move(G_prime), std::move(elements), std::move(set), a_over_b};
}

}  // namespace rollbem::detail
