// RollingSystem: G' p - (1/V) G dp/dt = inputs . v, Eq. (12), and the outputs that turn its unknowns into forces. All
// problems that are not steady start from it, and know nothing of meshes, schemes and kernels.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include <Eigen/Core>

#include "../detail/fingerprint.hpp"
#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../discretisation/mesh.hpp"
#include "../discretisation/scheme.hpp"
#include "../elasticity/line_kernel.hpp"
#include "../elasticity/plane_model.hpp"
#include "../scene/contact.hpp"
#include "../types.hpp"
#include "elements.hpp"
#include "influence.hpp"

namespace rollbem {

/// G' p - G dp/dq = inputs v, q = V t/a, with k creepages v; the forces over a G are outputs^T p. One creepage, the
/// same in every equation, and one force unless said otherwise: F_bar/(a G) = weights . p. Dimensionless: G in units of
/// a/G, G' in units of 1/G. The meaning of the unknowns p depends on the discretisation.
///
/// Invariant: n >= 1 and k >= 1; G and G' are n x n, inputs and outputs n x k, and all numbers are finite.
template <class Scalar_>
class RollingSystem {
public:
    using Scalar = Scalar_;

    /// From ready matrices, for one creepage. Throws std::invalid_argument if they break the invariant.
    RollingSystem(MatrixX<Scalar> G, MatrixX<Scalar> G_prime, const ArrayX<Scalar>& weights)
        : RollingSystem(std::move(G), std::move(G_prime), MatrixX<Scalar>::Ones(weights.size(), 1), weights.matrix()) {}

    /// The same for k creepages, a column each in `inputs`, and their forces, a column each in `outputs`.
    RollingSystem(MatrixX<Scalar> G, MatrixX<Scalar> G_prime, MatrixX<Scalar> inputs, MatrixX<Scalar> outputs);

    Eigen::Index size() const { return outputs_.rows(); }        ///< n, number of unknowns
    Eigen::Index input_count() const { return inputs_.cols(); }  ///< k, number of creepages and of forces
    const MatrixX<Scalar>& G() const { return G_; }              ///< [a/G]
    const MatrixX<Scalar>& G_prime() const { return G_prime_; }  ///< [1/G]
    const MatrixX<Scalar>& inputs() const { return inputs_; }    ///< rigid slip in each equation per creepage
    const MatrixX<Scalar>& outputs() const { return outputs_; }  ///< forces per unknown
    /// The first output: widths in units of a where p are tractions of a line contact.
    Eigen::Map<const ArrayX<Scalar>> weights() const { return {outputs_.data(), outputs_.rows()}; }

    /// Whether p are the tractions of elements: only then can their signs reveal that a scheme does not converge.
    bool unknowns_are_tractions() const { return unknowns_are_tractions_; }

    /// b/a of the kernel that was used; empty for ready matrices, and for kernels without a half-width.
    std::optional<Scalar> aspect() const { return aspect_; }

    /// x/a of the point of each equation; empty for ready matrices.
    const std::optional<ArrayX<Scalar>>& points() const { return points_; }

    /// S, if the kernel is C - S ln|x| and nothing else (the plane's) and each equation follows its point: then G and
    /// G' of any half-length follow from these matrices, and the contact may breathe. Empty otherwise.
    std::optional<Scalar> log_strength() const { return log_strength_; }

    /// 2 exp(C/S) of that kernel, in half-lengths of the contact: Lambda = 0 there, and a mode of a longer contact grows
    /// in time. Infinite for other systems.
    Scalar half_length_limit() const { return half_length_limit_; }

    /// Equal for equal matrices, inputs and outputs, in any process; different, with near certainty, for others.
    std::uint64_t fingerprint() const {
        detail::Fingerprint fingerprint;
        fingerprint.add(G_);
        fingerprint.add(G_prime_);
        fingerprint.add(inputs_);
        fingerprint.add(outputs_);
        return fingerprint.value();
    }

    template <class S>
    friend RollingSystem<S> both_directions(const RollingSystem<S>& longitudinal, const RollingSystem<S>& lateral);

protected:
    /// Lets the contact breathe if the kernel is a logarithm and a constant.
    template <class Kernel>
    void set_logarithm(const Kernel& kernel) {
        if constexpr (LineKernel<Kernel>) {
            const auto split = kernel.smooth_split();
            if (detail::is_finite(split.distance)) return;
            log_strength_ = static_cast<Scalar>(split.strength);
            half_length_limit_ = static_cast<Scalar>(2 * std::exp(split.constant / split.strength));
        }
    }

    /// The same equations with spin as a second input, `moments` the moment per unknown. Throws std::invalid_argument
    /// if the points are unknown.
    RollingSystem with_spin_by(const char* who, const VectorX<Scalar>& moments) const {
        detail::require(points_.has_value(), who, "number of places", 0,
                        "equal the number of equations: spin needs them");
        MatrixX<Scalar> inputs(size(), 2), outputs(size(), 2);
        inputs << inputs_, points_->matrix();
        outputs << outputs_, moments;
        RollingSystem system(G_, G_prime_, std::move(inputs), std::move(outputs));
        system.unknowns_are_tractions_ = unknowns_are_tractions_;
        system.aspect_ = aspect_;
        system.points_ = points_;
        return system;
    }

    bool unknowns_are_tractions_ = false;
    std::optional<Scalar> aspect_, log_strength_;
    Scalar half_length_limit_ = std::numeric_limits<Scalar>::infinity();
    std::optional<ArrayX<Scalar>> points_;

private:
    MatrixX<Scalar> G_, G_prime_, inputs_, outputs_;
};

template <class Scalar>
RollingSystem<Scalar>::RollingSystem(MatrixX<Scalar> G, MatrixX<Scalar> G_prime, MatrixX<Scalar> inputs,
                                     MatrixX<Scalar> outputs)
    : G_(std::move(G)), G_prime_(std::move(G_prime)), inputs_(std::move(inputs)), outputs_(std::move(outputs)) {
    const Eigen::Index n = outputs_.rows();
    detail::require(n >= 1, "RollingSystem", "number of weights", n, "be at least 1");
    detail::require(outputs_.cols() >= 1, "RollingSystem", "number of outputs", outputs_.cols(), "be at least 1");
    detail::require(inputs_.cols() == outputs_.cols(), "RollingSystem", "number of inputs", inputs_.cols(),
                    "equal the number of outputs");
    detail::require_square("RollingSystem", "G", G_, n, "weights");
    detail::require_square("RollingSystem", "G_prime", G_prime_, n, "weights");
    detail::require(inputs_.rows() == n, "RollingSystem", "number of rows of inputs", inputs_.rows(),
                    "equal the number of weights");
    detail::require_finite("RollingSystem", "inputs", inputs_);
    detail::require_finite("RollingSystem", outputs_.cols() == 1 ? "weights" : "outputs", outputs_);
}

/// A system whose unknowns are the tractions of elements, p/G, which friction requires as it bounds each of them, along
/// one direction (this template) or two (its specialisation in element_blocks.hpp).
///
/// Invariant: in addition, all weights are positive; they are the widths of the elements in units of a.
template <class Scalar_, int directions = 1>
class ElementSystem : public RollingSystem<Scalar_> {
    static_assert(directions == 1, "for two directions include assembly/element_blocks.hpp");

public:
    using Scalar = Scalar_;

    /// From ready matrices and the widths of the elements. Throws std::invalid_argument if they break the invariant, or
    /// if the signs of both diagonals show that G and G' have been exchanged.
    ElementSystem(MatrixX<Scalar> G, MatrixX<Scalar> G_prime, const ArrayX<Scalar>& widths);

    /// Number of elements of the mesh; more than unknowns if the scheme leaves leading elements without traction.
    Eigen::Index element_count() const { return element_count_; }

    /// The places of the unknown elements and of their equations.
    const Elements<Scalar>& elements() const { return elements_; }

    /// For the lateral direction: inputs lateral creepage and spin times a, whose rigid slip is x at the points of the
    /// equations; outputs F_y over a G and the moment M_z over a^2 G, both per width, of tractions at the centres.
    /// Throws std::invalid_argument where places are not known.
    RollingSystem<Scalar> with_spin() const {
        return this->with_spin_by("ElementSystem", (elements_.areas * elements_.centre_x).matrix());
    }

    template <class S, RollingScheme<S> Scheme, ElementKernel Kernel>
    friend ElementSystem<S> rolling_system(const Mesh<S>& mesh, const Scheme& scheme, const Kernel& kernel);

private:
    Eigen::Index element_count_;
    Elements<Scalar> elements_;
};

template <class Scalar, int directions>
ElementSystem<Scalar, directions>::ElementSystem(MatrixX<Scalar> G, MatrixX<Scalar> G_prime,
                                                 const ArrayX<Scalar>& widths)
    : RollingSystem<Scalar>(std::move(G), std::move(G_prime), widths), element_count_(this->size()) {
    this->unknowns_are_tractions_ = true;
    elements_.areas = widths;
    elements_.behind = Elements<Scalar>::one_strip(this->size());
    elements_.require_valid("ElementSystem", "width");
    // an element is displaced in the direction of its own traction, and what lies ahead of it less than the element
    // itself
    const bool swapped = (this->G().diagonal().array() < 0).all() && (this->G_prime().diagonal().array() > 0).all();
    detail::require(!swapped, "ElementSystem", "first diagonal entry of G", this->G()(0, 0),
                    "be positive, and that of G_prime negative: have they changed places?");
}

namespace detail {

/// b/a of a kernel that has a half-width.
template <class Scalar, class Kernel>
std::optional<Scalar> aspect_of(const Kernel& kernel) {
    if constexpr (requires { kernel.half_width(); }) return kernel.half_width();
    return std::nullopt;
}

/// x/a of the point of each equation of a scheme.
template <class Scalar, class Scheme>
ArrayX<Scalar> equation_points(const Mesh<Scalar>& mesh, const Scheme& scheme) {
    const SchemeRows<Scalar> rows = scheme_rows(scheme, Quantity::slope, mesh);
    Scalar offset = 0;
    for (Eigen::Index k = 0; k < rows.offsets.size(); ++k) offset += rows.weights[k] * rows.offsets[k];
    ArrayX<Scalar> points(rows.unknown_count);
    for (Eigen::Index i = 0; i < rows.unknown_count; ++i) {
        const Eigen::Index element = rows.first_equation + i;
        points[i] =
            mesh.centres()[element] + (rows.alpha[element] + offset * rows.lengths[element]) * mesh.widths()[element];
    }
    return points;
}

/// Whether each row belongs to a point half an element ahead of its element's centre, in G and in G'.
template <class Scalar, class Scheme>
bool rows_lie_half_an_element_ahead(const Scheme& scheme, const Mesh<Scalar>& mesh) {
    return scheme_rows(scheme, Quantity::slope, mesh).half_element_ahead &&
           scheme_rows(scheme, Quantity::displacement, mesh).half_element_ahead;
}

/// Whether the equations of a scheme hold at points, the same for G and G'. Differences count, as they are the mean of
/// the slope over the width of one element; Galerkin's integrals and quadratures do not.
template <class Scalar, class Scheme>
bool holds_at_points(const Scheme& scheme, const Mesh<Scalar>& mesh) {
    const SchemeRows<Scalar> slope = scheme_rows(scheme, Quantity::slope, mesh);
    const SchemeRows<Scalar> displacement = scheme_rows(scheme, Quantity::displacement, mesh);
    return slope.offsets.size() == 1 && slope.averages <= 1 && displacement.offsets.size() == 1 &&
           displacement.averages == 0 && slope.offsets[0] == displacement.offsets[0] &&
           (rows_lie_half_an_element_ahead(scheme, mesh) || (slope.alpha == displacement.alpha).all());
}

/// Throws std::invalid_argument unless G and G' have the same unknowns and the same equations.
template <class Scalar, class Scheme>
void require_one_system(const Scheme& scheme, const Mesh<Scalar>& mesh) {
    const SchemeRows<Scalar> slope = scheme_rows(scheme, Quantity::slope, mesh);
    const SchemeRows<Scalar> displacement = scheme_rows(scheme, Quantity::displacement, mesh);
    require(displacement.unknown_count == slope.unknown_count, "rolling_system", "unknown_count of the scheme for G",
            displacement.unknown_count, "equal that for G_prime");
    require(displacement.first_equation == slope.first_equation, "rolling_system", "first_equation of the scheme for G",
            displacement.first_equation, "equal that for G_prime");
}

}  // namespace detail

/// The places of the unknown elements of a line and of their equations, in units of a. Throws std::invalid_argument if
/// the scheme does not fit the mesh.
template <class Scalar, RollingScheme<Scalar> Scheme>
Elements<Scalar> line_elements(const Mesh<Scalar>& mesh, const Scheme& scheme) {
    const SchemeRows<Scalar> rows = scheme_rows(scheme, Quantity::slope, mesh);
    const Eigen::Index n = rows.unknown_count;
    Elements<Scalar> elements;
    elements.x = detail::equation_points(mesh, scheme);
    elements.intervals = rows.lengths.segment(rows.first_equation, n) * mesh.widths().segment(rows.first_equation, n);
    elements.y = ArrayX<Scalar>::Zero(n);
    elements.centre_x = mesh.centres().head(n);
    elements.centre_y = ArrayX<Scalar>::Zero(n);
    elements.areas = mesh.widths().head(n);
    elements.behind = Elements<Scalar>::one_strip(n);
    elements.half_element_ahead = detail::rows_lie_half_an_element_ahead(scheme, mesh);
    return elements;
}

/// Assembles both matrices. Throws std::invalid_argument if the scheme does not fit the mesh, if G is not finite (an
/// infinite half-width), and for a plane kernel with Lambda <= 0, whose model is unstable in time.
template <class Scalar, RollingScheme<Scalar> Scheme, ElementKernel Kernel>
ElementSystem<Scalar> rolling_system(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
    require_stable_model(kernel);
    detail::require_one_system(scheme, mesh);
    InfluenceMatrices<Scalar> matrices = assemble(mesh, scheme, kernel);
    ElementSystem<Scalar> system(std::move(matrices.G), std::move(matrices.G_prime), unknown_widths(mesh, scheme));
    system.element_count_ = mesh.size();
    system.aspect_ = detail::aspect_of<Scalar>(kernel);
    system.points_ = detail::equation_points(mesh, scheme);
    system.elements_ = line_elements(mesh, scheme);
    if (detail::holds_at_points(scheme, mesh)) system.set_logarithm(kernel);
    return system;
}

/// Two systems that do not couple as one: inputs and outputs of the first, then those of the second. With spin in the
/// lateral one, AdhesionModel<3> takes the result. Throws std::invalid_argument if their kernels differ in b/a.
template <class Scalar>
RollingSystem<Scalar> both_directions(const RollingSystem<Scalar>& longitudinal, const RollingSystem<Scalar>& lateral) {
    const std::optional<Scalar>& aspect = longitudinal.aspect_ ? longitudinal.aspect_ : lateral.aspect_;
    detail::require(!lateral.aspect_ || *lateral.aspect_ == *aspect, "both_directions", "b/a of the lateral kernel",
                    lateral.aspect_.value_or(Scalar(0)), "be that of the longitudinal one");
    const auto diagonal = [](const MatrixX<Scalar>& first, const MatrixX<Scalar>& second) {
        MatrixX<Scalar> whole = MatrixX<Scalar>::Zero(first.rows() + second.rows(), first.cols() + second.cols());
        whole.topLeftCorner(first.rows(), first.cols()) = first;
        whole.bottomRightCorner(second.rows(), second.cols()) = second;
        return whole;
    };
    RollingSystem<Scalar> system(
        diagonal(longitudinal.G_, lateral.G_), diagonal(longitudinal.G_prime_, lateral.G_prime_),
        diagonal(longitudinal.inputs_, lateral.inputs_), diagonal(longitudinal.outputs_, lateral.outputs_));
    system.aspect_ = aspect;
    system.unknowns_are_tractions_ = longitudinal.unknowns_are_tractions_ && lateral.unknowns_are_tractions_;
    return system;
}

namespace detail {

/// Throws std::invalid_argument if a system has more than one creepage.
template <class Scalar>
void require_single_input(const char* who, const RollingSystem<Scalar>& system) {
    require(system.input_count() == 1, who, "number of inputs", system.input_count(), "be 1");
}

/// Throws std::invalid_argument unless a kernel's b/a, if known, equals the contact's to 1e-12. Both may be infinite.
template <class Scalar>
void require_same_aspect(const char* who, const Contact<Scalar>& contact, const std::optional<Scalar>& aspect) {
    if (!aspect || (!is_finite(*aspect) && !is_finite(contact.aspect()))) return;
    const Scalar ratio = *aspect / contact.aspect();
    const bool same = std::abs(ratio - 1) <= Scalar(1e-12) + 4 * std::numeric_limits<Scalar>::epsilon();
    require(is_finite(ratio) && same, who, "b/a of the kernel over that of the contact", ratio, "be 1");
}

/// Throws std::invalid_argument if a system was made for another b/a than the contact's, or if the contact's is
/// infinite.
template <class Scalar>
void require_same_aspect(const char* who, const Contact<Scalar>& contact, const RollingSystem<Scalar>& system) {
    require(is_finite(contact.half_width()), who, "half_width", contact.half_width(),
            "be finite: an infinite one is for steady problems only");
    require_same_aspect(who, contact, system.aspect());
}

}  // namespace detail

}  // namespace rollbem
