// LU with partial pivoting in memory that the caller owns, for steps that must not allocate. Eigen's decomposition
// keeps its permutation on the heap, or has a different type for every bound on the size.
#pragma once

#include "language.hpp"

#include <utility>

#include <Eigen/Core>

namespace rollbem::detail {

template <class Scalar>
using MatrixRef = Eigen::Ref<Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>>;
template <class Scalar>
using VectorRef = Eigen::Ref<Eigen::Matrix<Scalar, Eigen::Dynamic, 1>>;

/// Overwrites the n x n matrix A with its factors; whole rows are swapped, row k with row swaps[k] >= k. If A is
/// singular, solutions contain infinities or NaN.
template <class Scalar>
void factorise_in_place(MatrixRef<Scalar> A, Eigen::Index* swaps) {
    const Eigen::Index n = A.rows();
    for (Eigen::Index k = 0; k < n; ++k) {
        const Eigen::Index rest = n - k - 1;
        Eigen::Index pivot = 0;
        A.col(k).tail(rest + 1).cwiseAbs().maxCoeff(&pivot);
        swaps[k] = k + pivot;
        if (pivot != 0) A.row(k).swap(A.row(k + pivot));
        A.col(k).tail(rest) /= A(k, k);
        for (Eigen::Index j = k + 1; j < n; ++j) A.col(j).tail(rest) -= A(k, j) * A.col(k).tail(rest);
    }
}

/// Overwrites x with the solution y of A y = x, where A and swaps come from factorise_in_place.
template <class Scalar>
void solve_in_place(const MatrixRef<Scalar>& A, const Eigen::Index* swaps, VectorRef<Scalar> x) {
    const Eigen::Index n = A.rows();
    for (Eigen::Index k = 0; k < n; ++k) std::swap(x[k], x[swaps[k]]);
    for (Eigen::Index k = 0; k < n; ++k) x.tail(n - k - 1) -= x[k] * A.col(k).tail(n - k - 1);
    for (Eigen::Index k = n - 1; k >= 0; --k) {
        x[k] /= A(k, k);
        x.head(k) -= x[k] * A.col(k).head(k);
    }
}

/// The inverse of the matrix whose factors factorise_in_place has left in A and swaps.
template <class Scalar>
void invert_factors(const MatrixRef<Scalar>& A, const Eigen::Index* swaps, MatrixRef<Scalar> inverse) {
    const Eigen::Index n = A.rows();
    inverse.setIdentity();
    // column by column of the factors, which are read once; L^-1 is triangular
    for (Eigen::Index k = 0; k < n; ++k) {
        const Eigen::Index rest = n - k - 1;
        for (Eigen::Index j = 0; j <= k; ++j) inverse.col(j).tail(rest) -= inverse(k, j) * A.col(k).tail(rest);
    }
    for (Eigen::Index k = n - 1; k >= 0; --k) {
        inverse.row(k) /= A(k, k);
        for (Eigen::Index j = 0; j < n; ++j) inverse.col(j).head(k) -= inverse(k, j) * A.col(k).head(k);
    }
    for (Eigen::Index k = n - 1; k >= 0; --k) inverse.col(k).swap(inverse.col(swaps[k]));
}

}  // namespace rollbem::detail
