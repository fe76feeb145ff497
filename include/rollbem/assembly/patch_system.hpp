// The system of a contact patch: G and G' between all its elements, and its uncoupled subsystems where strips at y and
// -y are mirror images.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../discretisation/patch_mesh.hpp"
#include "../discretisation/scheme.hpp"
#include "../elasticity/rectangle_kernel.hpp"
#include "../system/element_blocks.hpp"
#include "../system/elements.hpp"
#include "../types.hpp"
#include "detail/patch_rows.hpp"
#include "rolling_system.hpp"

namespace rollbem {

/// The coordinates of the elements of a patch and of their equations. Each strip has the scheme, stretched to the
/// strip's length. Throws std::invalid_argument unless the scheme takes differences of u and fits the strips' mesh.
template <class Scalar, RollingScheme<Scalar> Scheme>
Elements<Scalar> patch_elements(const PatchMesh<Scalar>& mesh, const Scheme& scheme) {
    const detail::StripRows<Scalar> rows = detail::strip_rows(mesh.along(), scheme, Quantity::slope);
    const Eigen::Index n = mesh.elements_per_strip(), size = mesh.size();
    Elements<Scalar> elements;
    for (ArrayX<Scalar>* places : {&elements.x, &elements.y, &elements.centre_x, &elements.centre_y, &elements.areas}) {
        places->resize(size);
    }
    for (Eigen::Index j = 0; j < mesh.strip_count(); ++j) {
        const Scalar middle = mesh.middles_x()[j], scale = mesh.half_lengths()[j];
        elements.x.segment(j * n, n) = middle + scale * rows.points;
        elements.centre_x.segment(j * n, n) = middle + scale * mesh.along().centres();
        elements.y.segment(j * n, n).setConstant(mesh.middles_y()[j]);
        elements.areas.segment(j * n, n) = scale * mesh.widths()[j] * mesh.along().widths();
        for (Eigen::Index i = 0; i < n; ++i) elements.behind.push_back(i == 0 ? -1 : j * n + i - 1);
    }
    elements.centre_y = elements.y;
    elements.half_element_ahead = detail::BothRows<Scalar>(scheme, mesh.along()).half_element_ahead();
    return elements;
}

namespace detail {

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

}  // namespace detail

/// The blocks of G' in units of 1/G. Throws std::invalid_argument unless the scheme takes differences of u and fits the
/// strips' mesh.
template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
typename ElementSystem<Scalar, 2>::Blocks assemble_G_prime(const PatchMesh<Scalar>& mesh, const Scheme& scheme,
                                                           const Kernel& kernel) {
    return detail::patch_blocks(mesh, scheme, kernel, Quantity::slope);
}

/// G' alone, for steady friction. Throws std::invalid_argument as rolling_system.
template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
ElementSystem<Scalar, 2> steady_system(const PatchMesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
    return detail::system_of<Scalar>(mesh, scheme, {}, assemble_G_prime(mesh, scheme, kernel));
}

/// Assembles both matrices, in the units of the mesh. Throws std::invalid_argument unless the scheme takes
/// differences of u and fits the strips' mesh, and all entries are finite.
template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
ElementSystem<Scalar, 2> rolling_system(const PatchMesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
    return detail::system_of(mesh, scheme, detail::patch_blocks(mesh, scheme, kernel, Quantity::displacement),
                             assemble_G_prime(mesh, scheme, kernel));
}

/// A patch as uncoupled subsystems for linear problems. If the strips are mirrored, there are two, xi; eta and phi,
/// each with N = n m unknowns (the tractions p_x, then p_y, of the strips at y <= 0); otherwise one. Throws
/// std::invalid_argument unless the scheme takes differences of u and fits the strips' mesh, and all entries are
/// finite.
template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
std::vector<RollingSystem<Scalar>> patch_subsystems(const PatchMesh<Scalar>& mesh, const Scheme& scheme,
                                                    const Kernel& kernel) {
    if (!mesh.is_mirrored()) return {{rolling_system(mesh, scheme, kernel).joined()}};
    const auto rows = [&](Quantity quantity) {
        return detail::patch_rows(mesh, detail::strip_rows(mesh.along(), scheme, quantity), kernel, quantity,
                                  detail::has_wide_strips(mesh));
    };
    return detail::mirrored_parts<Scalar>(rows(Quantity::displacement), rows(Quantity::slope),
                                          patch_elements(mesh, scheme), mesh.strip_count(), 1);
}

template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
[[deprecated("patch_subsystems")]] std::vector<RollingSystem<Scalar>> patch_parts(const PatchMesh<Scalar>& mesh,
                                                                                  const Scheme& scheme,
                                                                                  const Kernel& kernel) {
    return patch_subsystems(mesh, scheme, kernel);
}

}  // namespace rollbem
