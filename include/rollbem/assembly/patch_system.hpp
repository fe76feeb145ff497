// The system of a contact patch: G and G' between all its elements, its uncoupled subsystems where strips at y and -y
// are mirror images, and patches that change their size and shape in time.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../discretisation/patch_mesh.hpp"
#include "../discretisation/scheme.hpp"
#include "../elasticity/patch_kernel.hpp"
#include "../scene/patch_contact.hpp"
#include "../system/detail/shape_set.hpp"
#include "../system/rolling_system.hpp"
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

namespace detail {

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

}  // namespace detail

/// The system of a patch that may change its size but not its shape: a(t)/b(t) remains the contact's a/b (ellipses), or
/// the outline grows evenly about its origin. Its mesh follows. Throws std::invalid_argument unless the scheme takes
/// differences of u and fits the strips' mesh, and all entries are finite.
template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
ElementSystem<Scalar, 2> breathing_system(const PatchContact& contact, const PatchMesh<Scalar>& mesh,
                                          const Scheme& scheme, const Kernel& kernel) {
    Elements<Scalar> elements = patch_elements(mesh, scheme);
    auto set = std::make_shared<detail::ShapeSet<Scalar>>();
    set->nodes.push_back(detail::shape_node(
        mesh, scheme, kernel, static_cast<Scalar>(contact.c() / contact.half_length()), detail::has_wide_strips(mesh)));
    const auto a_over_b = static_cast<Scalar>(contact.a_over_b());
    set->first = std::log(a_over_b);
    set->zeta = elements.x;
    set->upsilon = elements.y * a_over_b;
    set->coupled = kernel.couples();
    return detail::system_of<Scalar>(std::move(set), std::move(elements), a_over_b);
}

/// Ellipses of every a/b in a range, for steps in which an ellipse changes its size and its shape, and for steady
/// rolling of any of them. Systems at nodes a constant factor in a/b apart are made once; between the nodes entries are
/// interpolated over ln(a/b) by cubics. Copies share the systems. Immutable: threads may share it.
///
///     const PatchShapes<double> shapes(12, 12, NodeDifference{Nodes::chebyshev}, HalfSpace<double>(0.28));
///     const FrictionModel model(contact, shapes.system(contact.a_over_b()), judge_stability(shapes), friction);
///     model.advance(now, {dq, creepage, load}, next, workspace);  // load.half_length and half_width as they are then
template <class Scalar_ = double>
class PatchShapes {
public:
    using Scalar = Scalar_;

    struct Range {
        Scalar least = Scalar(0.1), largest = 10;  ///< a/b
        /// Largest factor from node to node; a smaller one interpolates creep coefficients more exactly
        /// (docs/measured.md).
        Scalar factor = Scalar(1.25);
    };

    /// Cosine meshes of n elements a strip and m strips. Throws std::invalid_argument unless
    /// 0 < least < largest < inf and 1 < factor <= 2, the scheme takes differences of u and fits the strips' mesh, and
    /// all entries are finite.
    template <RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
    PatchShapes(Eigen::Index n, Eigen::Index m, const Scheme& scheme, const Kernel& kernel, const Range& range = {})
        : PatchShapes(cosine_mesh<Scalar>(n), cosine_mesh<Scalar>(m), scheme, kernel, range) {}

    /// Takes any mesh along each strip, and across them.
    template <RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
    PatchShapes(const Mesh<Scalar>& along, const Mesh<Scalar>& across, const Scheme& scheme, const Kernel& kernel,
                const Range& range = {})
        : circle_(patch_elements(ellipse_mesh<Scalar>(1, along, across), scheme)),
          mirrored_(ellipse_mesh<Scalar>(1, along, across).is_mirrored()),
          strips_(across.size()) {
        detail::require(range.least > 0, "PatchShapes", "least a/b", range.least, "be positive");
        detail::require(detail::is_finite(range.largest) && range.largest > range.least, "PatchShapes", "largest a/b",
                        range.largest, "be finite and more than the least");
        detail::require(range.factor > 1 && range.factor <= 2, "PatchShapes", "factor from node to node", range.factor,
                        "be more than 1 and at most 2");
        auto set = std::make_shared<detail::ShapeSet<Scalar>>();
        const Scalar length = std::log(range.largest / range.least);
        const int count =
            (std::max)(4, static_cast<int>(std::ceil(length / std::log(range.factor) - Scalar(1e-6))) + 1);
        set->first = std::log(range.least);
        set->step = length / static_cast<Scalar>(count - 1);
        // the same kind for all, as entries of the two kinds cannot be interpolated
        const bool over_width = detail::has_wide_strips(ellipse_mesh<Scalar>(range.least, along, across));
        for (int k = 0; k < count; ++k) {
            const Scalar a_over_b = std::exp(set->first + static_cast<Scalar>(k) * set->step);
            set->nodes.push_back(detail::shape_node(ellipse_mesh<Scalar>(a_over_b, along, across), scheme, kernel,
                                                    1 / std::sqrt(a_over_b), over_width));
        }
        set->zeta = circle_.x;
        set->upsilon = circle_.y;
        set->coupled = kernel.couples();
        set_ = std::move(set);
    }

    Eigen::Index size() const { return circle_.size(); }  ///< number of elements
    std::size_t node_count() const { return set_->nodes.size(); }
    /// Memory of the matrices [bytes].
    std::size_t memory() const { return node_count() * 9 * static_cast<std::size_t>(size() * size()) * sizeof(Scalar); }
    bool covers(Scalar a_over_b) const noexcept { return set_->covers(a_over_b); }

    /// The system of one a/b, which may change to any other in the range. Throws std::invalid_argument unless the range
    /// covers it.
    ElementSystem<Scalar, 2> system(std::type_identity_t<Scalar> a_over_b) const;

    /// The system at a node as uncoupled subsystems, see patch_subsystems.
    std::vector<RollingSystem<Scalar>> subsystems(std::size_t node) const;

private:
    // Elements at semi-axes 1 and 1/a_over_b.
    Elements<Scalar> elements(Scalar a_over_b) const {
        Elements<Scalar> elements = circle_;
        for (ArrayX<Scalar>* along_y : {&elements.y, &elements.centre_y, &elements.areas}) *along_y /= a_over_b;
        return elements;
    }

    std::shared_ptr<const detail::ShapeSet<Scalar>> set_;
    Elements<Scalar> circle_;  // elements for a = b = 1
    bool mirrored_;
    Eigen::Index strips_;
};

template <class Scalar_>
ElementSystem<Scalar_, 2> PatchShapes<Scalar_>::system(std::type_identity_t<Scalar> a_over_b) const {
    detail::require(detail::is_finite(a_over_b) && a_over_b > 0 && covers(a_over_b), "PatchShapes", "a_over_b",
                    a_over_b, "lie in the range of the shapes");
    return detail::system_of<Scalar>(set_, elements(a_over_b), a_over_b);
}

template <class Scalar_>
std::vector<RollingSystem<Scalar_>> PatchShapes<Scalar_>::subsystems(std::size_t node) const {
    const Scalar a_over_b = std::exp(set_->first + static_cast<Scalar>(node) * set_->step);
    if (!mirrored_) return {{system(a_over_b).joined()}};
    const detail::ShapeNode<Scalar>& at = set_->nodes[node];
    return detail::mirrored_parts<Scalar>(at.G, at.G_prime, elements(a_over_b), strips_, std::sqrt(a_over_b));
}

}  // namespace rollbem
