// Checks whether a scheme's forces can be right: the proof that its equations dissipate energy, and, where it fails,
// whether tractions of steady rolling oppose the creepage. Internal.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../types.hpp"

namespace rollbem {

/// Whether S = -(W A + (W A)^T)/2 is positive definite beyond rounding, W the elements' areas (widths on a line). A is
/// G' with the unknowns of each direction one after the other, or any matrix of a step with this sign.
/// In steady rolling, G' p = creepage, p^T S p is the work of the creepage: if S is positive definite, the force
/// opposes the creepage. Friction, slip = creepage - A p with |p_i| bounded, then has exactly one solution for any
/// bounds, as it is strongly monotone in the inner product of the areas. The converse does not hold: patches much
/// longer than wide may have the right force though S is indefinite. One Cholesky decomposition.
template <class Scalar>
bool is_dissipative(MatrixX<Scalar> A, const ArrayX<Scalar>& areas) {
    const Eigen::Index size = A.rows();
    const ArrayX<Scalar> root = areas.sqrt().replicate(size / areas.size(), 1), inverse = root.inverse();
    const Scalar rounding =
        static_cast<Scalar>(size) * std::numeric_limits<Scalar>::epsilon() * A.cwiseAbs().maxCoeff();
    // W^-1/2 S W^-1/2 in the lower triangle: its eigenvalues do not depend on the grading of the mesh
    for (Eigen::Index j = 0; j < size; ++j) {
        const Eigen::Index after = size - j - 1;
        A.col(j).tail(after + 1).array() *= root.tail(after + 1) * (-inverse[j] / 2);
        A.col(j).tail(after).array() -= A.row(j).tail(after).transpose().array() * inverse.tail(after) * (root[j] / 2);
        A(j, j) = 2 * A(j, j) - rounding;
    }
    const Eigen::LLT<Eigen::Ref<MatrixX<Scalar>>> cholesky(A);
    return cholesky.info() == Eigen::Success;
}

}  // namespace rollbem

namespace rollbem::detail {

/// Largest share of the traction that may assist the creepage; with a larger share, a solution is not an approximation.
/// Schemes whose tractions converge stay at 0, except for oscillations at alpha_T below 0.1 on coarse meshes; the share
/// of others grows with the number of elements. alpha_T = 0 with alpha_L > 0 lies in between, by oscillations that
/// average out in c11 (docs/measured.md).
inline constexpr double largest_assisting_share = 0.05;

/// Largest assisting share for a patch: elements many times longer than wide let tractions oscillate, where forces are
/// still right (docs/measured.md).
inline constexpr double largest_assisting_share_of_patch = 0.25;

/// Share, in [0, 1], of the traction that assists a positive creepage: the positive part of the sum of |p| dx. With
/// collocation points at or behind the elements' centres, or more than one width ahead of them, the residual is small
/// and the condition good, but the singularity lies at the wrong edge or has a higher order: c11 is 0, -1 or 3 times
/// the exact one.
template <class Scalar, class Traction>
Scalar assisting_share(const Traction& traction, const ArrayX<Scalar>& widths) {
    Scalar assisting = 0, all = 0;
    for (Eigen::Index i = 0; i < traction.size(); ++i) {
        assisting += widths[i] * (std::max)(traction[i], Scalar(0));
        all += widths[i] * std::abs(traction[i]);
    }
    return assisting > 0 ? assisting / all : Scalar(0);
}

template <class Scalar, class Traction>
bool opposes_creepage(const Traction& traction, const ArrayX<Scalar>& widths,
                      double allowed = largest_assisting_share) {
    const Scalar share = assisting_share<Scalar>(traction, widths);
    return is_finite(share) && share <= Scalar(allowed);
}

}  // namespace rollbem::detail

#ifdef ROLLBEM_COMPILED
namespace rollbem {
extern template bool is_dissipative<double>(MatrixX<double>, const ArrayX<double>&);
}  // namespace rollbem
#endif
