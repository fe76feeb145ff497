// The proof that equations dissipate energy: force opposes creepage, and steady friction has exactly one solution.
#pragma once

#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "../types.hpp"

namespace rollbem {

/// Whether S = -(W A + (W A)^T)/2 is positive definite beyond rounding, W the elements' areas (widths on a line). A is
/// G' with the unknowns of each direction one after the other, or any matrix of a step with this sign.
///
/// In steady rolling, G' p = creepage, p^T S p is the work of the creepage: if S is positive definite, the force opposes
/// the creepage. Friction, slip = creepage - A p with |p_i| bounded, then has exactly one solution whatever the bounds,
/// as it is strongly monotone in the inner product of the areas. The converse does not hold: patches 20 times longer
/// than wide may have the right force though S is indefinite. One Cholesky decomposition.
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
