// RollingSystem: G' p - (1/V) G dp/dt = inputs . v, Eq. (12), and the outputs that turn its unknowns into forces. All
// problems that are not steady start from it; it does not depend on mesh, scheme or kernel. Steady friction needs G'
// alone.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include <Eigen/Core>

#include "../detail/fingerprint.hpp"
#include "../detail/require.hpp"
#include "../types.hpp"
#include "elements.hpp"

namespace rollbem {

namespace detail {

/// Throws std::invalid_argument if a system has G' alone.
template <class System>
void require_G(const char* who, const System& system) {
    require(system.has_G(), who, "number of rows of G", 0,
            "be the number of rows of G_prime: a system without G is for steady friction alone");
}

}  // namespace detail

/// G' p - G dp/dq = inputs v, q = V t/a, with k creepages v; the forces over a G are outputs^T p. One creepage, the
/// same in every equation, and one force unless said otherwise: F_bar/(a G) = weights . p. Dimensionless: G in units of
/// a/G, G' in units of 1/G. The meaning of the unknowns p depends on the discretisation.
/// Invariant: n >= 1 and k >= 1; G and G' are n x n, inputs and outputs n x k, and all numbers are finite. G may be
/// empty (0 x 0), as after steady_system(): the system then serves FrictionModel::steady alone, and constructors that
/// need G throw std::invalid_argument.
template <class Scalar_>
class RollingSystem {
public:
    using Scalar = Scalar_;

    /// Properties of a system besides its matrices; unknown for ready matrices.
    struct Origin {
        bool unknowns_are_tractions = false;     ///< true for elements: only then can their signs reveal a scheme that
                                                 ///< fails
        std::optional<Scalar> aspect{};          ///< b/a of the kernel; empty for kernels without a half-width
        std::optional<ArrayX<Scalar>> points{};  ///< x/a of the point of each equation
        /// S, if the kernel is exactly C - S ln|x| (the plane kernel) and each equation follows its point: then G and
        /// G' of any half-length follow from these matrices, and the contact may breathe.
        std::optional<Scalar> log_strength{};
        /// 2 exp(C/S) of this kernel, in half-lengths of the contact: there Lambda = 0, and a mode of a longer contact
        /// grows in time. Infinite for other systems.
        Scalar half_length_limit = std::numeric_limits<Scalar>::infinity();
    };

    /// Takes ready matrices, for one creepage. Throws std::invalid_argument if they break the invariant.
    RollingSystem(MatrixX<Scalar> G, MatrixX<Scalar> G_prime, const ArrayX<Scalar>& weights, Origin origin = {})
        : RollingSystem(std::move(G), std::move(G_prime), MatrixX<Scalar>::Ones(weights.size(), 1), weights.matrix(),
                        std::move(origin)) {}

    /// Takes ready matrices for k creepages, a column each in `inputs`, and their forces, a column each in `outputs`.
    RollingSystem(MatrixX<Scalar> G, MatrixX<Scalar> G_prime, MatrixX<Scalar> inputs, MatrixX<Scalar> outputs,
                  Origin origin = {});

    Eigen::Index size() const { return outputs_.rows(); }        ///< n, number of unknowns
    Eigen::Index input_count() const { return inputs_.cols(); }  ///< k, number of creepages and of forces
    bool has_G() const { return G_.size() > 0; }
    /// G [a/G]. Throws std::invalid_argument if there is none.
    const MatrixX<Scalar>& G() const {
        detail::require_G("RollingSystem", *this);
        return G_;
    }
    const MatrixX<Scalar>& G_prime() const { return G_prime_; }  ///< [1/G]
    const MatrixX<Scalar>& inputs() const { return inputs_; }    ///< rigid slip in each equation per creepage
    const MatrixX<Scalar>& outputs() const { return outputs_; }  ///< forces per unknown
    /// The first output: widths in units of a where p are tractions of a line contact.
    Eigen::Map<const ArrayX<Scalar>> weights() const& { return {outputs_.data(), outputs_.rows()}; }
    ArrayX<Scalar> weights() const&& { return outputs_.col(0).array(); }

    const Origin& origin() const { return origin_; }
    bool unknowns_are_tractions() const { return origin_.unknowns_are_tractions; }
    const std::optional<Scalar>& aspect() const { return origin_.aspect; }
    const std::optional<ArrayX<Scalar>>& points() const { return origin_.points; }
    const std::optional<Scalar>& log_strength() const { return origin_.log_strength; }
    Scalar half_length_limit() const { return origin_.half_length_limit; }

    /// Equal for equal matrices, inputs and outputs, in any process; different, with near certainty, for others.
    std::uint64_t fingerprint() const {
        detail::Fingerprint fingerprint;
        fingerprint.add(G_);
        fingerprint.add(G_prime_);
        fingerprint.add(inputs_);
        fingerprint.add(outputs_);
        return fingerprint.value();
    }

protected:
    void require_points(const char* who) const {
        detail::require(points().has_value(), who, "number of places", 0,
                        "equal the number of equations: spin needs them");
    }

    /// The same equations with spin as a second input, `moments` the moment per unknown. Throws std::invalid_argument
    /// if the points are unknown.
    RollingSystem with_spin_by(const char* who, const VectorX<Scalar>& moments) const {
        require_points(who);
        MatrixX<Scalar> inputs(size(), 2), outputs(size(), 2);
        inputs << inputs_, points()->matrix();
        outputs << outputs_, moments;
        // named, as g++ 12 without optimisation fails on nested braces
        return RollingSystem(G_, G_prime_, std::move(inputs), std::move(outputs),
                             {unknowns_are_tractions(), aspect(), points()});
    }

private:
    MatrixX<Scalar> G_, G_prime_, inputs_, outputs_;
    Origin origin_;
};

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

/// A system whose unknowns are the tractions of elements, p/G, which friction requires as it bounds each of them, along
/// one direction (this template) or two (its specialisation in element_blocks.hpp).
///
/// Invariant: in addition, all weights are positive; they are the widths of the elements in units of a.
template <class Scalar_, int directions = 1>
class ElementSystem : public RollingSystem<Scalar_> {
    static_assert(directions == 1, "for two directions include system/element_blocks.hpp");

public:
    using Scalar = Scalar_;
    using Origin = typename RollingSystem<Scalar>::Origin;

    /// Takes ready matrices and the widths of the elements; for steady friction alone G may be empty. Throws
    /// std::invalid_argument if they break the invariant, or if the signs of both diagonals show that G and G' have
    /// been exchanged.
    ElementSystem(MatrixX<Scalar> G, MatrixX<Scalar> G_prime, const ArrayX<Scalar>& widths)
        : ElementSystem(std::move(G), std::move(G_prime), Elements<Scalar>::unplaced(widths), widths.size(), {}) {}

    /// Takes ready matrices with the coordinates of the elements, on a mesh of `element_count`.
    ElementSystem(MatrixX<Scalar> G, MatrixX<Scalar> G_prime, Elements<Scalar> elements, Eigen::Index element_count,
                  Origin origin);

    /// Number of elements of the mesh; more than unknowns if the scheme leaves leading elements without traction.
    Eigen::Index element_count() const { return element_count_; }

    /// The coordinates of the unknown elements and of their equations.
    const Elements<Scalar>& elements() const { return elements_; }

    /// The lateral system with spin. Inputs: lateral creepage, and spin times a, whose rigid slip is x at the points of
    /// the equations. Outputs: F_y over a G and the moment M_z over a^2 G, both per width, by tractions at the centres.
    /// Throws std::invalid_argument where coordinates are not known.
    RollingSystem<Scalar> with_spin() const {
        this->require_points("ElementSystem");  // such systems know the centres, too
        return this->with_spin_by("ElementSystem", (elements_.areas * elements_.centre_x).matrix());
    }

private:
    static Origin tractions(Origin origin) {
        origin.unknowns_are_tractions = true;
        return origin;
    }

    Eigen::Index element_count_;
    Elements<Scalar> elements_;
};

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

/// Two uncoupled systems as one: inputs and outputs of the first, then of the second. With spin in the lateral one,
/// AdhesionModel<2> takes the result. Throws std::invalid_argument if their kernels differ in b/a.
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
