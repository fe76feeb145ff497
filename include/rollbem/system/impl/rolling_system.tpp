// Bodies of system/rolling_system.hpp. Internal.
#pragma once

#include "../rolling_system.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include <Eigen/Core>

#include "../../detail/fingerprint.hpp"
#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../../status.hpp"
#include "../../types.hpp"
#include "../detail/shape_set.hpp"

namespace rollbem::detail {

/// Throws std::invalid_argument if a system has G' alone.
template <class System>
void require_G(const char* who, const System& system);

/// The blocks of uncoupled directions.
template <class Scalar>
DirectionBlocks<Scalar> uncoupled(const MatrixX<Scalar>& longitudinal, const MatrixX<Scalar>& lateral);

template <class Scalar>
void add_blocks(const DirectionBlocks<Scalar>& blocks, Fingerprint& fingerprint);

}  // namespace rollbem::detail

namespace rollbem {

template <class Scalar>
void Elements<Scalar>::require_valid(const char* who, const char* area) const {
    const Eigen::Index n = size();
    detail::require(n >= 1, who, "number of elements", n, "be at least 1");
    for (Eigen::Index i = 0; i < n; ++i) {
        detail::require_positive(who, area, areas[i]);
    }
    for (const ArrayX<Scalar>* places : {&x, &y, &centre_x, &centre_y}) {
        detail::require(places->size() == (places_are_known() ? n : 0), who, "number of places", places->size(),
                        "equal the number of elements");
        detail::require(detail::all_finite(*places), who, "a place", places->sum(), "be finite");
    }
    const Eigen::Index ways = intervals.size();
    detail::require(ways == 0 || ways == n, who, "number of intervals", ways, "equal the number of elements");
    detail::require(detail::all_finite(intervals), who, "an interval", intervals.sum(), "be finite");
    detail::require(behind.size() == static_cast<std::size_t>(n), who, "number of equations behind", behind.size(),
                    "equal the number of elements");
    for (Eigen::Index i = 0; i < n; ++i) {
        const Eigen::Index other = behind[static_cast<std::size_t>(i)];
        detail::require(other >= -1 && other < n && other != i, who, "equation behind", other,
                        "be the index of another element, or -1");
    }
}

}  // namespace rollbem

namespace rollbem::detail {

template <class System>
void require_G(const char* who, const System& system) {
    require(system.has_G(), who, "number of rows of G", 0,
            "be the number of rows of G_prime: a system without G is for steady friction alone");
}

}  // namespace rollbem::detail

namespace rollbem {

template <class Scalar>
RollingSystem<Scalar>::RollingSystem(MatrixX<Scalar> G, MatrixX<Scalar> G_prime, MatrixX<Scalar> inputs,
                                     MatrixX<Scalar> outputs, Origin origin)
    : G_(std::move(G)),
      G_prime_(std::move(G_prime)),
      inputs_(std::move(inputs)),
      outputs_(std::move(outputs)),
      origin_(std::move(origin)) {
    const Eigen::Index n = outputs_.rows();
    detail::require(n >= 1, "RollingSystem", "number of weights", n, "be at least 1");
    detail::require(outputs_.cols() >= 1, "RollingSystem", "number of outputs", outputs_.cols(), "be at least 1");
    detail::require(inputs_.cols() == outputs_.cols(), "RollingSystem", "number of inputs", inputs_.cols(),
                    "equal the number of outputs");
    if (G_.size() > 0) detail::require_square("RollingSystem", "G", G_, n, "weights");
    detail::require_square("RollingSystem", "G_prime", G_prime_, n, "weights");
    detail::require(inputs_.rows() == n, "RollingSystem", "number of rows of inputs", inputs_.rows(),
                    "equal the number of weights");
    detail::require_finite("RollingSystem", "inputs", inputs_);
    detail::require_finite("RollingSystem", outputs_.cols() == 1 ? "weights" : "outputs", outputs_);
}

template <class Scalar, int directions>
ElementSystem<Scalar, directions>::ElementSystem(MatrixX<Scalar> G, MatrixX<Scalar> G_prime, Elements<Scalar> elements,
                                                 Eigen::Index element_count, Origin origin)
    : RollingSystem<Scalar>(std::move(G), std::move(G_prime), elements.areas, tractions(std::move(origin))),
      element_count_(element_count),
      elements_(std::move(elements)) {
    elements_.require_valid("ElementSystem", "width");
    if (!this->has_G()) return;
    // an element is displaced in the direction of its own traction, and points ahead of it less than the element itself
    const bool swapped = (this->G().diagonal().array() < 0).all() && (this->G_prime().diagonal().array() > 0).all();
    detail::require(!swapped, "ElementSystem", "first diagonal entry of G", this->G()(0, 0),
                    "be positive, and the entry of G_prime negative: have the matrices changed places?");
}

template <class Scalar>
RollingSystem<Scalar> both_directions(const RollingSystem<Scalar>& longitudinal, const RollingSystem<Scalar>& lateral) {
    const std::optional<Scalar>& aspect = longitudinal.aspect() ? longitudinal.aspect() : lateral.aspect();
    detail::require(!lateral.aspect() || *lateral.aspect() == *aspect, "both_directions", "b/a of the lateral kernel",
                    lateral.aspect().value_or(Scalar(0)), "be b/a of the longitudinal kernel");
    const auto diagonal = [](const MatrixX<Scalar>& first, const MatrixX<Scalar>& second) {
        MatrixX<Scalar> whole = MatrixX<Scalar>::Zero(first.rows() + second.rows(), first.cols() + second.cols());
        whole.topLeftCorner(first.rows(), first.cols()) = first;
        whole.bottomRightCorner(second.rows(), second.cols()) = second;
        return whole;
    };
    return {diagonal(longitudinal.G(), lateral.G()),
            diagonal(longitudinal.G_prime(), lateral.G_prime()),
            diagonal(longitudinal.inputs(), lateral.inputs()),
            diagonal(longitudinal.outputs(), lateral.outputs()),
            {longitudinal.unknowns_are_tractions() && lateral.unknowns_are_tractions(), aspect}};
}

}  // namespace rollbem

namespace rollbem::detail {

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

template <class Scalar>
DirectionBlocks<Scalar> uncoupled(const MatrixX<Scalar>& longitudinal, const MatrixX<Scalar>& lateral) {
    DirectionBlocks<Scalar> blocks;
    blocks[0][0] = longitudinal;
    blocks[1][1] = lateral;
    return blocks;
}

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

}  // namespace rollbem::detail

namespace rollbem {

template <class Scalar_>
ElementSystem<Scalar_, 2>::ElementSystem(const ElementSystem<Scalar>& longitudinal,
                                         const ElementSystem<Scalar>& lateral)
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
    detail::require(!aspects_differ, "ElementSystem", "b/a of the lateral kernel", lateral.aspect().value_or(Scalar(0)),
                    "be b/a of the longitudinal kernel");
    if (!aspect_) aspect_ = lateral.aspect();
}

template <class Scalar_>
std::uint64_t ElementSystem<Scalar_, 2>::fingerprint() const {
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

template <class Scalar>
auto Elements<Scalar>::one_strip(Eigen::Index n) -> std::vector<Eigen::Index> {
    std::vector<Eigen::Index> behind(static_cast<std::size_t>(n));
    for (Eigen::Index i = 0; i < n; ++i) behind[static_cast<std::size_t>(i)] = i - 1;
    return behind;
}

template <class Scalar>
auto Elements<Scalar>::unplaced(const ArrayX<Scalar>& areas) -> Elements {
    Elements elements;
    elements.areas = areas;
    elements.behind = one_strip(areas.size());
    return elements;
}

template <class Scalar_>
inline auto RollingSystem<Scalar_>::G() const -> const MatrixX<Scalar>& {
    detail::require_G("RollingSystem", *this);
    return G_;
}

template <class Scalar_>
std::uint64_t RollingSystem<Scalar_>::fingerprint() const {
    detail::Fingerprint fingerprint;
    fingerprint.add(G_);
    fingerprint.add(G_prime_);
    fingerprint.add(inputs_);
    fingerprint.add(outputs_);
    return fingerprint.value();
}

template <class Scalar_>
void RollingSystem<Scalar_>::require_points(const char* who) const {
    detail::require(points().has_value(), who, "number of places", 0, "equal the number of equations: spin needs them");
}

template <class Scalar_>
auto RollingSystem<Scalar_>::with_spin_by(const char* who, const VectorX<Scalar>& moments) const -> RollingSystem {
    require_points(who);
    MatrixX<Scalar> inputs(size(), 2), outputs(size(), 2);
    inputs << inputs_, points()->matrix();
    outputs << outputs_, moments;
    // named, as g++ 12 without optimisation fails on nested braces
    return RollingSystem(G_, G_prime_, std::move(inputs), std::move(outputs),
                         {unknowns_are_tractions(), aspect(), points()});
}

template <class Scalar_, int directions>
auto ElementSystem<Scalar_, directions>::with_spin() const -> RollingSystem<Scalar> {
    this->require_points("ElementSystem");  // such systems know the centres, too
    return this->with_spin_by("ElementSystem", (elements_.areas * elements_.centre_x).matrix());
}

template <class Scalar_, int directions>
auto ElementSystem<Scalar_, directions>::tractions(Origin origin) -> Origin {
    origin.unknowns_are_tractions = true;
    return origin;
}

template <class Scalar_>
ElementSystem<Scalar_, 2>::ElementSystem(Blocks G, Blocks G_prime, Elements<Scalar> elements)
    : G_(std::move(G)), G_prime_(std::move(G_prime)), elements_(std::move(elements)), element_count_(elements_.size()) {
    elements_.require_valid("ElementSystem", "area");
    if (has_G()) detail::require_blocks("ElementSystem", "G", G_, size());
    detail::require_blocks("ElementSystem", "G_prime", G_prime_, size());
    detail::require(!has_G() || (G_[0][1].size() > 0) == coupled(), "ElementSystem", "number of rows of G_xy",
                    G_[0][1].rows(), "be the number of rows of G_prime_xy");
}

template <class Scalar_>
ElementSystem<Scalar_, 2>::ElementSystem(Blocks G, Blocks G_prime, Elements<Scalar> elements,
                                         std::shared_ptr<const detail::ShapeSet<Scalar>> shapes, Scalar a_over_b)
    : ElementSystem(std::move(G), std::move(G_prime), std::move(elements)) {
    shapes_ = std::move(shapes);
    a_over_b_ = a_over_b;
}

template <class Scalar_>
inline auto ElementSystem<Scalar_, 2>::G(std::size_t d, std::size_t e) const -> const MatrixX<Scalar>& {
    detail::require_G("ElementSystem", *this);
    return G_[d][e];
}

template <class Scalar_>
auto ElementSystem<Scalar_, 2>::joined() const -> RollingSystem<Scalar> {
    return {detail::joined(G_), detail::joined(G_prime_), detail::rigid_slip(elements_),
            detail::force_weights(elements_)};
}

inline StabilityVerdict operator+(const StabilityVerdict& one, const StabilityVerdict& other) {
    return {.n = one.n + other.n,
            .unstable_count = one.unstable_count + other.unstable_count,
            .settled_unstable_count = one.settled_unstable_count + other.settled_unstable_count,
            .uncertain_count = one.uncertain_count + other.uncertain_count,
            .spectral_abscissa = (std::max)(one.spectral_abscissa, other.spectral_abscissa),
            .decay_proved = one.stable() && other.stable(),
            .status = one.status == Status::ok ? other.status : one.status};
}

}  // namespace rollbem
