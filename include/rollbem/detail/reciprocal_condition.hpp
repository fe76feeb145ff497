// How near to singular a matrix is, by its factors: what decides whether a solution can be trusted.
// One estimate for all problems.
#pragma once

#include "language.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace rollbem::detail {

/// Largest sum of absolute values of a column.
template <class Derived>
typename Derived::RealScalar one_norm(const Eigen::MatrixBase<Derived>& A) {
    return A.cwiseAbs().colwise().sum().maxCoeff();
}

/// Estimate of 1 / (|A| |A^-1|) in the 1-norm from the factors of an LU decomposition with partial pivoting and
/// norm = |A|. Eigen's own takes |A^-1| from a few vectors, and two equal rows of A have no part in what it sees;
/// 1 / (last pivot) is an entry of A^-1 and sees them.
template <class Factors>
typename Factors::RealScalar reciprocal_condition(const Factors& lu, typename Factors::RealScalar norm) {
    const Eigen::Index last = lu.matrixLU().rows() - 1;
    return std::min<typename Factors::RealScalar>(lu.rcond(), std::abs(lu.matrixLU()(last, last)) / norm);
}

}  // namespace rollbem::detail
