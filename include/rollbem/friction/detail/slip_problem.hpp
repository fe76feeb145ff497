// What a search for stick and slip is given: the conditions, and the equations with the sticking elements eliminated.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include <Eigen/Core>

#include "../../types.hpp"
#include "../state.hpp"
#include "condensed_slip.hpp"
#include "nested_stick.hpp"
#include "roles.hpp"
#include "sliding.hpp"
#include "slip_matrix.hpp"
#include "turned_slip.hpp"

namespace rollbem::detail {

/// M and what is kept for its two solutions, first with slip as it is, then with slip turned; with one direction there
/// is one. Usually both have the same roles, and then share the condensed equations. All memory is allocated by the
/// constructor.
template <int directions, class Scalar>
struct SlipEquations {
    using Condensed = ByDirections<directions, NestedStick<Scalar>, CondensedSlip<Scalar>>;
    using Base = typename Condensed::Base;

    SlipEquations(Eigen::Index n, bool coupled)
        : matrix(n, coupled), condensed(make<Condensed>(matrix)), base(make<Base>(n)), sliding(make_sliding(n)) {}

    /// Null if the equations of the sticking elements cannot be solved.
    Condensed* condense(std::size_t which, const Roles<directions, Scalar>& roles) {
        Condensed* at = &condensed[which];
        if constexpr (directions == 2) {
            Condensed& other = condensed[1 - which];
            if (!at->holds(matrix, roles.of) && other.holds(matrix, roles.of)) {
                if (which == 0) {  // the other one would be overwritten
                    std::swap(*at, other);
                } else {
                    at = &other;
                }
            }
        }
        return at->condense(matrix, roles.of) ? at : nullptr;
    }

    SlipMatrix<directions, Scalar> matrix;
    std::array<Condensed, directions> condensed;
    std::array<Base, directions> base;
    std::array<Sliding<Scalar>, directions == 2 ? 2 : 0> sliding;

private:
    static auto make_sliding(Eigen::Index n) {
        if constexpr (directions == 1) {
            return std::array<Sliding<Scalar>, 0>{};
        } else {
            return make<Sliding<Scalar>>(n);
        }
    }
    template <class Part, class Argument>
    static std::array<Part, directions> make(const Argument& argument) {
        if constexpr (directions == 1) {
            return {Part(argument)};
        } else {
            return {Part(argument), Part(argument)};
        }
    }
};

/// Tractions p within the bounds b that oppose the slip R (M p + c): |p_i| <= b_i, s_i = 0 where |p_i| < b_i, and
/// R_i s_i = -v_i p_i, v_i >= 0, where |p_i| = b_i.
template <int directions, class Scalar>
struct SlipProblem {
    SlipEquations<directions, Scalar>& equations;
    std::size_t which;                                       ///< of the two solutions
    typename SlipEquations<directions, Scalar>::Base& base;  ///< of c
    const ElementVectors<Scalar, directions>& constant;      ///< c
    const VectorX<Scalar>& bound;
    const SlipTurn<directions, Scalar>& turn;  ///< R
    const VectorX<Scalar>& reach;              ///< rho
    Scalar imposed;                            ///< max |c|
};

/// A solution, or a point on the way to one.
template <int directions, class Scalar>
struct SlipPoint {
    explicit SlipPoint(Eigen::Index n)
        : roles(n), traction(ElementVectors<Scalar, directions>::Zero(n, directions)), slip(traction) {}

    Roles<directions, Scalar> roles;
    ElementVectors<Scalar, directions> traction, slip;
};

}  // namespace rollbem::detail
