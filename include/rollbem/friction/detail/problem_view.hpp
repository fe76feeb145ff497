// What a search for stick and slip reads: s = A p + c, |p_i| <= b_i, and R_i s_i opposes p_i where |p_i| = b_i.
#pragma once

#include <cstddef>

#include "roles.hpp"
#include "slip_matrix.hpp"
#include "slip_rotation.hpp"

namespace rollbem::detail {

/// References to values that the caller owns, made on the stack for one search.
template <int directions>
struct ProblemView {
    SlipMatrix<directions>& matrix;            ///< A
    const Vectors<directions>& constant;       ///< c
    const VectorX<double>& bound;              ///< b
    const SlipRotation<directions>& rotation;  ///< R
    const VectorX<double>& projection_step;    ///< rho, step of the projection
    double imposed;                            ///< max |c_i|
    std::size_t history;                       ///< index of c in StageProblem::constant
};

}  // namespace rollbem::detail
