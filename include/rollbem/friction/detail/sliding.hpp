// The turn of the tractions that slide, whose sizes are given: one unknown for each of their elements.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "../../detail/in_place_lu.hpp"
#include "../../types.hpp"
#include "../state.hpp"
#include "condensed_slip.hpp"
#include "roles.hpp"
#include "slip_matrix.hpp"

namespace rollbem::detail {

/// The elements that slide, in their order, at a point (p, s). With n along the traction, t across it, a and w the same
/// turned back, and k = -a.s/b: the tractions change by tau t, where
///     (w.C t + k) tau = -w.s,
/// C from CondensedSlip. All memory is allocated by the constructor.
template <class Scalar>
class Sliding {
public:
    using Index = Eigen::Index;
    using Vector = VectorX<Scalar>;
    using Vectors = ElementVectors<Scalar>;
    using Row = ElementVector<2, Scalar>;
    using Matrix = MatrixX<Scalar>;

    explicit Sliding(Index n)
        : along_(Vectors::Zero(n, 2)),
          across_(along_),
          against_(along_),
          aside_(along_),
          stiffness_(Vector::Zero(n)),
          factors_(n, n),
          swaps_(static_cast<std::size_t>(n)) {}

    /// The directions and stiffnesses of the elements that slide.
    template <class Turn>
    void aim(const RoleLists& lists, const Vectors& direction, const Vectors& slip, const Vector& bound,
             const Turn& turn) {
        count_ = lists.sliding();
        for (Index l = 0; l < count_; ++l) {
            const Index i = lists.other(l);
            const Row along = direction.row(i), against = turn.turned_back(i, along);
            along_.row(l) = along;
            across_.row(l) << -along[1], along[0];
            against_.row(l) = against;
            aside_.row(l) << -against[1], against[0];
            // finite, however small the bound
            stiffness_[l] = std::clamp(-against.dot(slip.row(i)) / bound[i], Scalar(0),
                                       (std::numeric_limits<Scalar>::max)() / 1000);
        }
    }
    /// False if the equations are singular to working precision.
    bool factorise(const SlipMatrix<2, Scalar>& matrix, const CondensedSlip<Scalar>& condensed) {
        auto factors = factors_.topLeftCorner(count_, count_);
        condensed.form(matrix, aside_, across_, factors);
        factors.diagonal() += stiffness_.head(count_);
        factorise_in_place<Scalar>(factors, swaps_.data());
        return has_pivots(factors_, count_);
    }

    Index count() const { return count_; }
    Row across(Index l) const { return across_.row(l); }
    Row aside(Index l) const { return aside_.row(l); }
    const Vectors& along() const { return along_; }      ///< n
    const Vectors& across() const { return across_; }    ///< t
    const Vectors& against() const { return against_; }  ///< a
    const Vectors& aside() const { return aside_; }      ///< w
    /// Overwrites -w.s with tau.
    void solve(Vector& right) {
        solve_in_place<Scalar>(factors_.topLeftCorner(count_, count_), swaps_.data(), right.head(count_));
    }
    void solve_columns(Eigen::Ref<Matrix> right) {
        solve_columns_in_place<Scalar>(factors_.topLeftCorner(count_, count_), swaps_.data(), right);
    }

private:
    Vectors along_, across_, against_, aside_;
    Vector stiffness_;
    Matrix factors_;
    std::vector<Index> swaps_;
    Index count_ = 0;
};

}  // namespace rollbem::detail
