// What a search for stick and slip is given: the conditions, and the equations with the sticking elements eliminated.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../../types.hpp"
#include "../state.hpp"
#include "condensed_slip.hpp"
#include "nested_stick.hpp"
#include "roles.hpp"
#include "slip_matrix.hpp"
#include "slip_turn.hpp"
#include "sliding.hpp"

namespace rollbem::detail {

/// M and what is kept for its solutions, first with slip as it is, then with slip turned; with one direction there is
/// one. Usually both have the same roles, and then share the condensed equations. All memory is allocated by the
/// constructor.
template <int directions, class Scalar>
struct SlipEquations {
    using Condensed = ByDirections<directions, NestedStick<Scalar>, CondensedSlip<Scalar>>;
    using Base = typename Condensed::Base;

    SlipEquations(Eigen::Index n, bool coupled)
        : matrix(n, coupled),
          condensed(directions, Condensed(matrix)),
          base(directions, Base(n)),
          sliding(directions, Sliding<Scalar>(directions == 1 ? 0 : n)) {}

    /// Null if the equations of the sticking elements cannot be solved.
    Condensed* condense(std::size_t which, const Roles<directions, Scalar>& roles) {
        Condensed *at = &condensed[which], *const other = &condensed[directions - 1 - which];
        if (!at->are_of(matrix, roles.of) && other->are_of(matrix, roles.of)) {
            if (which == 0) std::swap(*at, *other);  // the other one would be overwritten
            if (which == 1) at = other;
        }
        return at->condense(matrix, roles.of) ? at : nullptr;
    }

    SlipMatrix<directions, Scalar> matrix;
    std::vector<Condensed> condensed;
    std::vector<Base> base;
    std::vector<Sliding<Scalar>> sliding;  // with two directions
};

/// A solution, or a point on the way to one.
template <int directions, class Scalar>
struct SlipPoint {
    explicit SlipPoint(Eigen::Index n)
        : roles(n), traction(ElementVectors<Scalar, directions>::Zero(n, directions)), slip(traction) {}

    Roles<directions, Scalar> roles;
    ElementVectors<Scalar, directions> traction, slip;
};

/// Tractions p within the bounds b that oppose the slip R (M p + c): |p_i| <= b_i, s_i = 0 where |p_i| < b_i, and
/// R_i s_i = -v_i p_i, v_i >= 0, where |p_i| = b_i.
template <int directions, class Scalar>
struct SlipProblem {
    using Turn = SlipTurn<directions, Scalar>;

    SlipEquations<directions, Scalar>& equations;
    std::size_t which;                                       ///< of the solutions
    typename SlipEquations<directions, Scalar>::Base& base;  ///< of c
    const ElementVectors<Scalar, directions>& constant;      ///< c
    const VectorX<Scalar>& bound;
    const Turn& turn;              ///< R
    const VectorX<Scalar>& reach;  ///< rho
    Scalar imposed;                ///< max |c|
    Turn* next = nullptr;          ///< of another problem, with the angles of the solution of this one
    bool has_next = false;         ///< that is solved even if nothing turns

    /// Whether there is another problem after this one. A point near a solution is enough to find its angles.
    bool leads_on(const SlipPoint<directions, Scalar>& point) const {
        return next != nullptr && (next->find(point.slip, point.roles) || has_next);
    }
};

}  // namespace rollbem::detail
