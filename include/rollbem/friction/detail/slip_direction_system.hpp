// Newton's equations for the directions in which the elements of a friction problem slide.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "../../detail/in_place_lu.hpp"
#include "../../types.hpp"
#include "condensed_slip.hpp"
#include "roles.hpp"
#include "slip_matrix.hpp"

namespace rollbem::detail {

/// Newton's equations for the directions of sliding tractions, whose magnitudes are given: one unknown tau for each
/// sliding element, in the order of RoleLists. At a point (p, s), let n be the unit vector along the traction of an
/// element, t the unit vector across it, a and w the vectors n and t turned back (SlipRotation), and k = -a.s/b the
/// stiffness of the element. With C from CondensedSlip, the tractions change by tau t, where
///     (w.C t + k) tau = -w.s
/// All memory is allocated by the constructor.
class SlipDirectionSystem {
public:
    using Row = ElementVector<2>;

    explicit SlipDirectionSystem(Index n)
        : along_(Vectors<2>::Zero(n, 2)),
          across_(along_),
          against_(along_),
          aside_(along_),
          stiffness_(n),
          turn_(n),
          factors_(n, n),
          swaps_(static_cast<std::size_t>(n)) {}

    /// Sets the directions and the stiffness of each sliding element.
    template <class Rotation>
    void aim(const RoleLists& lists, const Vectors<2>& direction, const Vectors<2>& slip, const VectorX<double>& bound,
             const Rotation& rotation) {
        count_ = lists.sliding();
        for (Index l = 0; l < count_; ++l) {
            const Index i = lists.other(l);
            const Row along = direction.row(i), against = rotation.turned_back(i, along);
            along_.row(l) = along;
            across_.row(l) << -along[1], along[0];
            against_.row(l) = against;
            aside_.row(l) << -against[1], against[0];
            // the stiffness stays finite, however small the bound
            stiffness_[l] =
                std::clamp(-against.dot(slip.row(i)) / bound[i], 0.0, (std::numeric_limits<double>::max)() / 1000);
        }
    }
    /// False if the equations are singular to working precision.
    bool factorise(const SlipMatrix<2>& matrix, const CondensedSlip& condensed) {
        auto factors = factors_.topLeftCorner(count_, count_);
        condensed.form(matrix, aside_, across_, factors);
        factors.diagonal() += stiffness_.head(count_);
        factorise_in_place<double>(factors, swaps_.data());
        return has_pivots(factors_, count_);
    }

    const Vectors<2>& along() const { return along_; }      ///< n
    const Vectors<2>& across() const { return across_; }    ///< t
    const Vectors<2>& against() const { return against_; }  ///< a
    const Vectors<2>& aside() const { return aside_; }      ///< w
    /// Solves for tau at this slip and adds tau t to the tractions.
    void turn(const RoleLists& lists, const Vectors<2>& slip, Vectors<2>& traction) {
        for (Index l = 0; l < count_; ++l) turn_[l] = -aside_.row(l).dot(slip.row(lists.other(l)));
        solve_in_place<double>(factors_.topLeftCorner(count_, count_), swaps_.data(), turn_.head(count_));
        for (Index l = 0; l < count_; ++l) traction.row(lists.other(l)) += turn_[l] * across_.row(l);
    }
    void solve_columns(Eigen::Ref<MatrixX<double>> right) {
        solve_columns_in_place<double>(factors_.topLeftCorner(count_, count_), swaps_.data(), right);
    }

private:
    Vectors<2> along_, across_, against_, aside_;
    VectorX<double> stiffness_, turn_;
    MatrixX<double> factors_;
    std::vector<Index> swaps_;
    Index count_ = 0;
};

}  // namespace rollbem::detail
