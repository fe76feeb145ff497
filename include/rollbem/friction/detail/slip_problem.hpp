// The problem that a search for stick and slip is to solve: its conditions, and the equations of the elements that
// stick and slide.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../../detail/in_place_lu.hpp"
#include "../../types.hpp"
#include "../state.hpp"
#include "condensed_slip.hpp"
#include "nested_stick.hpp"
#include "roles.hpp"
#include "slip_matrix.hpp"
#include "slip_turn.hpp"

namespace rollbem::detail {

/// Newton's equations for the directions of sliding tractions, whose magnitudes are given: one unknown tau for each
/// sliding element, in the order of RoleLists. At a point (p, s), let n be the unit vector along the traction of an
/// element, t the unit vector across it, a and w the vectors n and t turned back (SlipTurn), and k = -a.s/b the
/// stiffness of the element. With C from CondensedSlip, the tractions change by tau t, where
///     (w.C t + k) tau = -w.s
/// All memory is allocated by the constructor.
class Sliding {
public:
    using Index = Eigen::Index;
    using Vector = VectorX<double>;
    using Vectors = ElementVectors<2>;
    using Row = ElementVector<2>;
    using Matrix = MatrixX<double>;

    explicit Sliding(Index n)
        : along_(Vectors::Zero(n, 2)),
          across_(along_),
          against_(along_),
          aside_(along_),
          stiffness_(n),
          turn_(n),
          factors_(n, n),
          swaps_(static_cast<std::size_t>(n)) {}

    /// Sets the directions and the stiffness of each sliding element.
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
            // the stiffness stays finite, however small the bound
            stiffness_[l] = std::clamp(-against.dot(slip.row(i)) / bound[i], 0.0,
                                       (std::numeric_limits<double>::max)() / 1000);
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

    const Vectors& along() const { return along_; }      ///< n
    const Vectors& across() const { return across_; }    ///< t
    const Vectors& against() const { return against_; }  ///< a
    const Vectors& aside() const { return aside_; }      ///< w
    /// Solves for tau at this slip and adds tau t to the tractions.
    void turn(const RoleLists& lists, const Vectors& slip, Vectors& traction) {
        for (Index l = 0; l < count_; ++l) turn_[l] = -aside_.row(l).dot(slip.row(lists.other(l)));
        solve_in_place<double>(factors_.topLeftCorner(count_, count_), swaps_.data(), turn_.head(count_));
        for (Index l = 0; l < count_; ++l) traction.row(lists.other(l)) += turn_[l] * across_.row(l);
    }
    void solve_columns(Eigen::Ref<Matrix> right) {
        solve_columns_in_place<double>(factors_.topLeftCorner(count_, count_), swaps_.data(), right);
    }

private:
    Vectors along_, across_, against_, aside_;
    Vector stiffness_, turn_;
    Matrix factors_;
    std::vector<Index> swaps_;
    Index count_ = 0;
};

/// M, and for each solution the equations that are kept: entry 0 belongs to the solution without turned slip, entry 1
/// (two directions only) to the solution with turned slip. If both solutions have the same roles, as is usual, they
/// share the condensed equations. All memory is allocated by the constructor.
template <int directions>
struct SlipEquations {
    using Condensed = ByDirections<directions, NestedStick, CondensedSlip>;
    using Base = typename Condensed::Base;

    SlipEquations(Eigen::Index n, bool coupled)
        : matrix(n, coupled),
          condensed(directions, Condensed(matrix)),
          base(directions, Base(n)),
          sliding(directions, Sliding(directions == 1 ? 0 : n)) {}

    /// Null if the equations of the sticking elements cannot be solved.
    Condensed* condense(std::size_t which, const Roles<directions>& roles) {
        Condensed *at = &condensed[which], *const other = &condensed[directions - 1 - which];
        if (!at->are_of(matrix, roles.of) && other->are_of(matrix, roles.of)) {
            if (which == 0) std::swap(*at, *other);  // the other one would be overwritten
            if (which == 1) at = other;
        }
        return at->condense(matrix, roles.of) ? at : nullptr;
    }

    SlipMatrix<directions> matrix;
    std::vector<Condensed> condensed;
    std::vector<Base> base;
    std::vector<Sliding> sliding;  // used with two directions only
};

/// A solution, or a point on the way to one.
template <int directions>
struct SlipPoint {
    explicit SlipPoint(Eigen::Index n)
        : roles(n), traction(ElementVectors<directions>::Zero(n, directions)), slip(traction) {}

    Roles<directions> roles;
    ElementVectors<directions> traction, slip;
};

/// Tractions p within the bounds b that oppose the slip R (M p + c): |p_i| <= b_i, s_i = 0 where |p_i| < b_i, and
/// R_i s_i = -v_i p_i, v_i >= 0, where |p_i| = b_i.
template <int directions>
struct SlipProblem {
    using Turn = SlipTurn<directions>;

    SlipEquations<directions>& equations;
    std::size_t which;                                       ///< entry of `equations`
    typename SlipEquations<directions>::Base& base;  ///< contribution of c
    const ElementVectors<directions>& constant;      ///< c
    const VectorX<double>& bound;
    const Turn& turn;              ///< R
    const VectorX<double>& reach;  ///< rho
    double imposed;                ///< max |c|
    Turn* next = nullptr;          ///< turn of the next problem, whose angles come from the solution of this one
    bool has_next = false;         ///< the next problem is solved even if no angle differs from 0

    /// Whether another problem, with turned slip, follows this one. Finds its angles, for which a point near a solution
    /// is enough.
    bool leads_on(const SlipPoint<directions>& point) const {
        return next != nullptr && (next->find(point.slip, point.roles) || has_next);
    }
};

}  // namespace rollbem::detail
