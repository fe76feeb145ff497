// Systems of elements with tractions in two directions: four blocks of G and of G', one for each pair of directions.
// On a line the directions do not couple, and the blocks that couple them are empty.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <Eigen/Core>

#include "../detail/fingerprint.hpp"
#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../types.hpp"
#include "elements.hpp"
#include "rolling_system.hpp"
#include "shape_set.hpp"

namespace rollbem {

namespace detail {

/// Blocks of ElementSystem<Scalar, 2>.
template <class Scalar>
using DirectionBlocks = std::array<std::array<MatrixX<Scalar>, 2>, 2>;

/// Throws std::invalid_argument unless the blocks are n x n and finite, or, off the diagonal, both empty.
template <class Scalar>
void require_blocks(const char* who, const char* name, const DirectionBlocks<Scalar>& blocks, Eigen::Index n) {
    const bool coupled = blocks[0][1].size() > 0 || blocks[1][0].size() > 0;
    for (std::size_t d = 0; d < 2; ++d) {
        for (std::size_t e = 0; e < 2; ++e) {
            if (d != e && !coupled) continue;
            const std::string block = std::string(name) + "_" + "xy"[d] + "xy"[e];
            require_square(who, block.c_str(), blocks[d][e], n, "elements");
        }
    }
}

/// The blocks of uncoupled directions.
template <class Scalar>
DirectionBlocks<Scalar> uncoupled(const MatrixX<Scalar>& longitudinal, const MatrixX<Scalar>& lateral) {
    DirectionBlocks<Scalar> blocks;
    blocks[0][0] = longitudinal;
    blocks[1][1] = lateral;
    return blocks;
}

/// [xx xy; yx yy], with zeros for empty blocks.
template <class Scalar>
MatrixX<Scalar> joined(const DirectionBlocks<Scalar>& blocks) {
    const Eigen::Index n = blocks[0][0].rows();
    MatrixX<Scalar> whole = MatrixX<Scalar>::Zero(2 * n, 2 * n);
    for (Eigen::Index d = 0; d < 2; ++d) {
        for (Eigen::Index e = 0; e < 2; ++e) {
            const MatrixX<Scalar>& block = blocks[static_cast<std::size_t>(d)][static_cast<std::size_t>(e)];
            if (block.size() > 0) whole.block(d * n, e * n, n, n) = block;
        }
    }
    return whole;
}

template <class Scalar>
void add_blocks(const DirectionBlocks<Scalar>& blocks, Fingerprint& fingerprint) {
    for (const auto& row : blocks) {
        for (const MatrixX<Scalar>& block : row) fingerprint.add(block);
    }
}

/// Rigid slip of 2n equations, longitudinal ones first, per longitudinal creepage, lateral creepage and spin (times the
/// unit of length): columns (1, 0), (0, 1), (-y, x) at the points of the equations. 2n x 3; the third column is zero
/// where the points are not known.
template <class Scalar>
MatrixX<Scalar> rigid_slip(const Elements<Scalar>& elements) {
    const Eigen::Index n = elements.size();
    MatrixX<Scalar> columns = MatrixX<Scalar>::Zero(2 * n, 3);
    columns.col(0).head(n).setOnes();
    columns.col(1).tail(n).setOnes();
    if (elements.places_are_known()) {
        columns.col(2).head(n) = -elements.y.matrix();
        columns.col(2).tail(n) = elements.x.matrix();
    }
    return columns;
}

/// F_x, F_y and the moment about the origin M_z = int (x p_y - y p_x), per traction: 2n x 3, by areas and centres. The
/// moment is zero where the centres are not known.
template <class Scalar>
MatrixX<Scalar> force_weights(const Elements<Scalar>& elements) {
    const Eigen::Index n = elements.size();
    MatrixX<Scalar> columns = MatrixX<Scalar>::Zero(2 * n, 3);
    columns.col(0).head(n) = elements.areas.matrix();
    columns.col(1).tail(n) = elements.areas.matrix();
    if (elements.places_are_known()) {
        columns.col(2).head(n) = -(elements.areas * elements.centre_y).matrix();
        columns.col(2).tail(n) = (elements.areas * elements.centre_x).matrix();
    }
    return columns;
}

}  // namespace detail

/// Elements with tractions in both directions, of a line (two uncoupled systems) or of a patch: s/V = rigid slip - G' p
/// + G dp/dq. Dimensionless: lengths in a (outlines: c), tractions in G.
///
/// Invariant: the invariant of Elements; all blocks are n x n and finite, and G and G' couple the directions both or
/// not at all. As in RollingSystem, G may be empty.
template <class Scalar_>
class ElementSystem<Scalar_, 2> {
public:
    using Scalar = Scalar_;
    /// Blocks of G or G': entry [d][e] is n x n, from tractions along e to d; 0 is longitudinal (x), 1 lateral (y).
    /// Blocks with d != e are empty (0 x 0) where the directions do not couple.
    using Blocks = detail::DirectionBlocks<Scalar>;

    /// Takes ready blocks. Throws std::invalid_argument if they break the invariant.
    ElementSystem(Blocks G, Blocks G_prime, Elements<Scalar> elements)
        : G_(std::move(G)),
          G_prime_(std::move(G_prime)),
          elements_(std::move(elements)),
          element_count_(elements_.size()) {
        elements_.require_valid("ElementSystem", "area");
        if (has_G()) detail::require_blocks("ElementSystem", "G", G_, size());
        detail::require_blocks("ElementSystem", "G_prime", G_prime_, size());
        detail::require(!has_G() || (G_[0][1].size() > 0) == coupled(), "ElementSystem", "number of rows of G_xy",
                        G_[0][1].rows(), "be the number of rows of G_prime_xy");
    }

    /// Takes ready blocks of a patch of the given a/b; unless null, `shapes` cover it, and the patch may change its
    /// size and shape.
    ElementSystem(Blocks G, Blocks G_prime, Elements<Scalar> elements,
                  std::shared_ptr<const detail::ShapeSet<Scalar>> shapes, Scalar a_over_b)
        : ElementSystem(std::move(G), std::move(G_prime), std::move(elements)) {
        shapes_ = std::move(shapes);
        a_over_b_ = a_over_b;
    }

    /// Joins the systems of both directions on one mesh. Throws std::invalid_argument if their elements differ.
    ElementSystem(const ElementSystem<Scalar>& longitudinal, const ElementSystem<Scalar>& lateral)
        : G_(longitudinal.has_G() ? detail::uncoupled(longitudinal.G(), lateral.G()) : Blocks{}),
          G_prime_(detail::uncoupled(longitudinal.G_prime(), lateral.G_prime())),
          elements_(longitudinal.elements()),
          element_count_(longitudinal.element_count()),
          aspect_(longitudinal.aspect()),
          log_strength_{longitudinal.log_strength(), lateral.log_strength()},
          half_length_limit_((std::min)(longitudinal.half_length_limit(), lateral.half_length_limit())) {
        const Eigen::Index n = lateral.size();
        detail::require(n == size(), "ElementSystem", "number of lateral elements", n,
                        "equal the number of longitudinal ones");
        for (Eigen::Index i = 0; i < n; ++i) {
            const Scalar ratio = lateral.weights()[i] / longitudinal.weights()[i];
            detail::require(std::abs(ratio - 1) <= 16 * std::numeric_limits<Scalar>::epsilon(), "ElementSystem",
                            "width of a lateral element over the width of the longitudinal one", ratio, "be 1");
        }
        const bool aspects_differ = aspect_ && lateral.aspect() && *aspect_ != *lateral.aspect();
        detail::require(!aspects_differ, "ElementSystem", "b/a of the lateral kernel",
                        lateral.aspect().value_or(Scalar(0)), "be b/a of the longitudinal kernel");
        if (!aspect_) aspect_ = lateral.aspect();
    }

    Eigen::Index size() const { return elements_.size(); }  ///< n, number of unknown elements
    /// Number of elements of the mesh, as with one direction.
    Eigen::Index element_count() const { return element_count_; }
    const Elements<Scalar>& elements() const { return elements_; }
    bool has_G() const { return G_[0][0].size() > 0; }
    /// The block from tractions along e to d, 0 longitudinal and 1 lateral; empty if the directions do not couple. G
    /// throws std::invalid_argument if there is none.
    const MatrixX<Scalar>& G(std::size_t d, std::size_t e) const {
        detail::require_G("ElementSystem", *this);
        return G_[d][e];
    }
    const MatrixX<Scalar>& G_prime(std::size_t d, std::size_t e) const { return G_prime_[d][e]; }
    const Blocks& G_prime_blocks() const { return G_prime_; }
    bool coupled() const { return G_prime_[0][1].size() > 0; }

    /// b/a as in RollingSystem; empty for a patch.
    std::optional<Scalar> aspect() const { return aspect_; }
    std::optional<Scalar> log_strength(std::size_t direction) const { return log_strength_[direction]; }
    Scalar half_length_limit() const { return half_length_limit_; }

    /// Shapes of a patch that may change its size or shape, otherwise null: see breathing_system and PatchShapes.
    const std::shared_ptr<const detail::ShapeSet<Scalar>>& shapes() const { return shapes_; }
    Scalar a_over_b() const { return a_over_b_; }  ///< a/b of the patch for which the blocks hold; 0 where not known

    /// All 2n equations, longitudinal ones first, with inputs (xi, eta, phi) and outputs (F_x, F_y, M_z).
    RollingSystem<Scalar> joined() const {
        return {detail::joined(G_), detail::joined(G_prime_), detail::rigid_slip(elements_),
                detail::force_weights(elements_)};
    }
    [[deprecated("joined")]] RollingSystem<Scalar> whole() const { return joined(); }

    /// Fingerprint as in RollingSystem.
    std::uint64_t fingerprint() const {
        detail::Fingerprint fingerprint;
        detail::add_blocks(G_, fingerprint);
        detail::add_blocks(G_prime_, fingerprint);
        fingerprint.add(detail::rigid_slip(elements_));
        fingerprint.add(detail::force_weights(elements_));
        if (shapes_) {
            fingerprint.add(a_over_b_);
            fingerprint.add(shapes_->first);
            fingerprint.add(shapes_->step);
        }
        return fingerprint.value();
    }

private:
    Blocks G_, G_prime_;
    Elements<Scalar> elements_;
    Eigen::Index element_count_;
    std::optional<Scalar> aspect_;
    std::array<std::optional<Scalar>, 2> log_strength_;
    Scalar half_length_limit_ = std::numeric_limits<Scalar>::infinity();
    std::shared_ptr<const detail::ShapeSet<Scalar>> shapes_;
    Scalar a_over_b_ = 0;
};

template <class Scalar>
ElementSystem(const ElementSystem<Scalar>&, const ElementSystem<Scalar>&) -> ElementSystem<Scalar, 2>;

}  // namespace rollbem
