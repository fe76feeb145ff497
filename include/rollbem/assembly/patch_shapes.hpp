// Systems of patches that change their size and shape in time: of one a/b, or of every a/b in a range.
#pragma once

#include <algorithm>
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
#include "../elasticity/rectangle_kernel.hpp"
#include "../scene/patch_contact.hpp"
#include "../system/element_blocks.hpp"
#include "../system/shape_set.hpp"
#include "../types.hpp"
#include "detail/patch_rows.hpp"
#include "patch_system.hpp"

namespace rollbem {

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
    [[deprecated("subsystems")]] std::vector<RollingSystem<Scalar>> parts(std::size_t node) const {
        return subsystems(node);
    }

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
