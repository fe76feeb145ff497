// Systems of rolling contact: G' p - (1/V) G dp/dt = inputs . v, Eq. (12), and the outputs that turn unknowns into
// forces; with elements in one direction or two, and the verdict on their stability. Independent of mesh and kernel.
#pragma once

#include "../detail/decl.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../detail/fingerprint.hpp"
#include "../detail/require.hpp"
#include "../status.hpp"
#include "../types.hpp"
#include "detail/shape_set.hpp"

namespace rollbem {

/// Coordinates of n elements and of their equations, in the system's unit of length (a; for outlines c). Elements are
/// numbered from trailing to leading, strip by strip from small to large y; equation i belongs to element i.
///
/// Invariant: all areas are positive and finite; the other arrays have as many entries, or none if coordinates are not
/// known, as for ready matrices.
template <class Scalar>
struct Elements {
    ArrayX<Scalar> x, y;                ///< the point of each equation, at which the rigid slip is taken
    ArrayX<Scalar> centre_x, centre_y;  ///< the centre of each element, at which its traction acts in moments
    ArrayX<Scalar> areas;               ///< area of each element; on a line contact its width
    /// Length along x of the interval, about its point, in which each equation holds; for a difference of u, the
    /// distance between its two points. Empty where it is not known.
    ArrayX<Scalar> intervals;
    std::vector<Eigen::Index> behind;  ///< the equation behind in the same strip; -1 for a trailing element
    /// Whether each equation belongs to a point half an element ahead of its element's centre: node differences, and
    /// finite differences at equal alphas of 0.5. False where it is not known.
    bool half_element_ahead = false;

    Eigen::Index size() const { return areas.size(); }
    bool places_are_known() const { return x.size() == size(); }
    bool is_one_strip() const { return behind == one_strip(size()); }

    /// `behind` for n elements in one strip.
    static std::vector<Eigen::Index> one_strip(Eigen::Index n);

    /// Elements of one strip at unknown coordinates.
    static Elements unplaced(const ArrayX<Scalar>& areas);

    /// Throws std::invalid_argument if the invariant does not hold; `area` is the name of the areas in the terms of
    /// `who`.
    void require_valid(const char* who, const char* area) const;
};

/// G' p - G dp/dq = inputs v, q = V t/a, with k creepages v; the forces over a G are outputs^T p. One creepage, the
/// same in every equation, and one force unless said otherwise: F_bar/(a G) = weights . p. Dimensionless: G in units of
/// a/G, G' in units of 1/G. The meaning of the unknowns p depends on the discretisation.
/// Invariant: n >= 1 and k >= 1; G and G' are n x n, inputs and outputs n x k, and all numbers are finite. G may be
/// empty (0 x 0), as after steady_system(): the system then serves FrictionModel::steady alone, and constructors that
/// need G throw std::invalid_argument.
///
/// \code
/// #include <rollbem/line.hpp>
///
/// int main() {
///     using namespace rollbem;
///     // G, G' and weights of your own: two elements
///     const Eigen::Matrix2d G{{2, 1}, {1, 2}}, G_prime{{-1, 0.5}, {-0.5, -1}};
///     const RollingSystem<double> system(G, G_prime, Eigen::Array2d(1, 1));
///     return std::isfinite(solve_steady(system).c11()) ? 0 : 1;
/// }
/// \endcode
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
    const MatrixX<Scalar>& G() const;
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
    std::uint64_t fingerprint() const;

protected:
    void require_points(const char* who) const;

    /// The same equations with spin as a second input, `moments` the moment per unknown. Throws std::invalid_argument
    /// if the points are unknown.
    RollingSystem with_spin_by(const char* who, const VectorX<Scalar>& moments) const;

private:
    MatrixX<Scalar> G_, G_prime_, inputs_, outputs_;
    Origin origin_;
};

/// A system whose unknowns are the tractions of elements, p/G, which friction requires as it bounds each of them, along
/// one direction (this template) or two (its specialisation below).
///
/// Invariant: in addition, all weights are positive; they are the widths of the elements in units of a.
template <class Scalar_, int directions = 1>
class ElementSystem : public RollingSystem<Scalar_> {
    static_assert(directions == 1, "there are one or two directions");

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
    RollingSystem<Scalar> with_spin() const;

private:
    static Origin tractions(Origin origin);

    Eigen::Index element_count_;
    Elements<Scalar> elements_;
};

/// Two uncoupled systems as one: inputs and outputs of the first, then of the second. With spin in the lateral one,
/// AdhesionModel<2> takes the result. Throws std::invalid_argument if their kernels differ in b/a.
template <class Scalar>
RollingSystem<Scalar> both_directions(const RollingSystem<Scalar>& longitudinal, const RollingSystem<Scalar>& lateral);

namespace detail {

/// Blocks of ElementSystem<Scalar, 2>.
template <class Scalar>
using DirectionBlocks = std::array<std::array<MatrixX<Scalar>, 2>, 2>;

/// Throws std::invalid_argument unless the blocks are n x n and finite, or, off the diagonal, both empty.
template <class Scalar>
void require_blocks(const char* who, const char* name, const DirectionBlocks<Scalar>& blocks, Eigen::Index n);

/// [xx xy; yx yy], with zeros for empty blocks.
template <class Scalar>
MatrixX<Scalar> joined(const DirectionBlocks<Scalar>& blocks);

/// Rigid slip of 2n equations, longitudinal ones first, per longitudinal creepage, lateral creepage and spin (times the
/// unit of length): columns (1, 0), (0, 1), (-y, x) at the points of the equations. 2n x 3; the third column is zero
/// where the points are not known.
template <class Scalar>
MatrixX<Scalar> rigid_slip(const Elements<Scalar>& elements);

/// F_x, F_y and the moment about the origin M_z = int (x p_y - y p_x), per traction: 2n x 3, by areas and centres. The
/// moment is zero where the centres are not known.
template <class Scalar>
MatrixX<Scalar> force_weights(const Elements<Scalar>& elements);

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
    ElementSystem(Blocks G, Blocks G_prime, Elements<Scalar> elements);

    /// Takes ready blocks of a patch of the given a/b; unless null, `shapes` cover it, and the patch may change its
    /// size and shape.
    ElementSystem(Blocks G, Blocks G_prime, Elements<Scalar> elements,
                  std::shared_ptr<const detail::ShapeSet<Scalar>> shapes, Scalar a_over_b);

    /// Joins the systems of both directions on one mesh. Throws std::invalid_argument if their elements differ.
    ElementSystem(const ElementSystem<Scalar>& longitudinal, const ElementSystem<Scalar>& lateral);

    Eigen::Index size() const { return elements_.size(); }  ///< n, number of unknown elements
    /// Number of elements of the mesh, as with one direction.
    Eigen::Index element_count() const { return element_count_; }
    const Elements<Scalar>& elements() const { return elements_; }
    bool has_G() const { return G_[0][0].size() > 0; }
    /// The block from tractions along e to d, 0 longitudinal and 1 lateral; empty if the directions do not couple. G
    /// throws std::invalid_argument if there is none.
    const MatrixX<Scalar>& G(std::size_t d, std::size_t e) const;
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
    RollingSystem<Scalar> joined() const;
    std::uint64_t fingerprint() const;  ///< as in RollingSystem

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

/// Signs of the real parts of the n eigenvalues nu a of G' p = nu G p; a mode grows like e^{nu V t}.
///
/// An eigenvalue is uncertain if rounding of G and G' alone could change the sign of its real part, to first order;
/// otherwise its sign is settled. Infinite eigenvalues are uncertain. Eigenvalues too ill-conditioned for this may be
/// proved to decay all together.
struct StabilityVerdict {
    Eigen::Index n = 0;
    Eigen::Index unstable_count = 0;          ///< real part > 0 as computed
    Eigen::Index settled_unstable_count = 0;  ///< eigenvalues among these whose sign is settled
    Eigen::Index uncertain_count = 0;         ///< with either sign
    double spectral_abscissa = 0;             ///< largest real part of the finite eigenvalues, times a [-]
    bool decay_proved = false;                ///< whether all modes are proved to decay, although some signs are
                                              ///< uncertain one by one
    Status status = Status::not_finite;       ///< unless ok, the eigenvalues were not found
    bool checked = true;                      ///< when a model is made, see `unchecked`

    /// No mode grows, whatever the rounding.
    bool stable() const {
        return status == Status::ok && unstable_count == 0 && (uncertain_count == 0 || decay_proved);
    }
    /// At least one mode certainly grows.
    bool certainly_unstable() const { return status == Status::ok && settled_unstable_count > 0; }

    /// The verdict on two uncoupled systems, which together have the eigenvalues of both.
    friend StabilityVerdict operator+(const StabilityVerdict& one, const StabilityVerdict& other);
};

/// Replaces a verdict: builds a model for any eigenvalues, and whether or not the scheme converges.
inline constexpr StabilityVerdict unchecked{.checked = false};

}  // namespace rollbem

#include "impl/rolling_system.tpp"

#ifdef ROLLBEM_COMPILED
namespace rollbem {
extern template struct Elements<double>;
extern template class RollingSystem<double>;
extern template class ElementSystem<double, 1>;
extern template void detail::require_blocks<double>(const char*, const char*, const detail::DirectionBlocks<double>&,
                                                    Eigen::Index);
extern template MatrixX<double> detail::joined<double>(const detail::DirectionBlocks<double>&);
extern template MatrixX<double> detail::rigid_slip<double>(const Elements<double>&);
extern template MatrixX<double> detail::force_weights<double>(const Elements<double>&);
extern template class ElementSystem<double, 2>;
}  // namespace rollbem
#endif
