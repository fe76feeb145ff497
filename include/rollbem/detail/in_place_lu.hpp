// LU with partial pivoting, and products with triangles, in memory that the caller owns, for steps that must not
// allocate. Eigen's decomposition keeps its permutation on the heap, or has a different type for every bound on the
// size.
#pragma once

#include "language.hpp"

#include <algorithm>
#include <utility>

#include <Eigen/Core>

#include "finite.hpp"

namespace rollbem::detail {

template <class Scalar>
using MatrixRef = Eigen::Ref<Eigen::MatrixX<Scalar>>;
template <class Scalar>
using VectorRef = Eigen::Ref<Eigen::VectorX<Scalar>>;

/// target -= from u, where `from` are four columns of `count` numbers, `stride` apart: the target is read and written
/// once instead of four times. The loop takes small pieces of fixed size, because long expressions are not inlined by
/// -O2.
template <class Scalar>
void subtract_four(const Scalar* from, Eigen::Index stride, const Eigen::Matrix<Scalar, 4, 1>& u, Scalar* target,
                   Eigen::Index count) {
    constexpr Eigen::Index size = 8;
    using Piece = Eigen::Matrix<Scalar, size, 1>;
    Eigen::Index i = 0;
    for (; i + size <= count; i += size) {
        const auto column = [&](Eigen::Index k) { return Eigen::Map<const Piece>(from + k * stride + i); };
        Piece piece = Eigen::Map<const Piece>(target + i);
        piece -= u[0] * column(0);
        piece -= u[1] * column(1);
        piece -= u[2] * column(2);
        piece -= u[3] * column(3);
        Eigen::Map<Piece>(target + i) = piece;
    }
    for (; i < count; ++i) {
        for (Eigen::Index k = 0; k < 4; ++k) target[i] -= u[k] * from[k * stride + i];
    }
}

/// The products of four columns of `count` numbers, `stride` apart, with x.
template <class Scalar>
Eigen::Matrix<Scalar, 4, 1> dot_four(const Scalar* from, Eigen::Index stride, const Scalar* x, Eigen::Index count) {
    constexpr Eigen::Index size = 4;
    using Piece = Eigen::Matrix<Scalar, size, 1>;
    Piece sums[4] = {Piece::Zero(), Piece::Zero(), Piece::Zero(), Piece::Zero()};
    Eigen::Index i = 0;
    for (; i + size <= count; i += size) {
        const Piece piece = Eigen::Map<const Piece>(x + i);
        for (Eigen::Index k = 0; k < 4; ++k)
            sums[k] += Eigen::Map<const Piece>(from + k * stride + i).cwiseProduct(piece);
    }
    Eigen::Matrix<Scalar, 4, 1> result(sums[0].sum(), sums[1].sum(), sums[2].sum(), sums[3].sum());
    for (; i < count; ++i) {
        for (Eigen::Index k = 0; k < 4; ++k) result[k] += from[k * stride + i] * x[i];
    }
    return result;
}

enum class Triangle { lower, upper };

/// Number of rows that multiply_triangle() takes together; the least multiple of it that is no less than `count`.
inline constexpr Eigen::Index triangle_rows = 8;
inline Eigen::Index whole_blocks(Eigen::Index count) {
    return (count + triangle_rows - 1) / triangle_rows * triangle_rows;
}

/// The first `count` rows of y become A x, where A is triangular in its first `count` rows and columns. A, zero beside
/// its triangle, and y have whole_blocks() of rows; what follows in y is overwritten. The sum of a row goes by panels
/// of columns, as in Eigen's products of panels.
template <Triangle triangle, class Scalar>
void multiply_triangle(const Eigen::MatrixX<Scalar>& A, Eigen::Index count, const Eigen::VectorX<Scalar>& x,
                       Eigen::VectorX<Scalar>& y) {
    using Block = Eigen::Array<Scalar, triangle_rows, 1>;
    constexpr Eigen::Index panel = 16;
    for (Eigen::Index i = 0; i < count; i += triangle_rows) {
        const Eigen::Index last = triangle == Triangle::lower ? std::min(count, i + triangle_rows) : count;
        Block total = Block::Zero();
        for (Eigen::Index j = triangle == Triangle::lower ? 0 : i; j < last;) {
            const Eigen::Index end = std::min(last, (j / panel + 1) * panel);
            Block sum = Block::Zero();
            for (; j < end; ++j) sum += Eigen::Map<const Block>(&A(i, j)) * x[j];
            total += sum;
        }
        Eigen::Map<Block> rows(&y[i]);
        rows = total;
    }
}

/// y = A^T x of the same triangle, by four columns.
template <Triangle triangle, class Scalar>
void multiply_transposed(const Eigen::MatrixX<Scalar>& A, Eigen::Index count, const Eigen::VectorX<Scalar>& x,
                         Eigen::VectorX<Scalar>& y) {
    for (Eigen::Index j = 0; j < count; j += 4) {
        const Eigen::Index width = std::min<Eigen::Index>(4, count - j), row = triangle == Triangle::lower ? j : 0;
        const Eigen::Index height = (triangle == Triangle::lower ? count : j + width) - row;
        if (width == 4) {
            y.template segment<4>(j) = dot_four<Scalar>(&A(row, j), A.outerStride(), &x[row], height);
        } else {
            y.segment(j, width) = A.block(row, j, height, width).transpose().lazyProduct(x.segment(row, height));
        }
    }
}

/// Eliminates the first `count` of n unknowns in the n x n matrix A; rows are swapped whole, row k < count with row
/// k <= swaps[k] < count. With A = [A_11 A_12; A_21 A_22] this leaves the factors of P A_11 = L U, L^-1 P A_12, A_21
/// U^-1 and A_22 - A_21 A_11^-1 A_12, which contain infinities or NaN if A_11 is singular.
template <class Scalar>
void eliminate_in_place(MatrixRef<Scalar> A, Eigen::Index* swaps, Eigen::Index count) {
    const Eigen::Index n = A.rows();
    for (Eigen::Index first = 0, last = 0; first < count; first = last) {
        last = (std::min)(first + 4, count);
        for (Eigen::Index k = first; k < last; ++k) {
            const Eigen::Index rest = n - k - 1;
            Eigen::Index pivot = 0;
            A.col(k).segment(k, count - k).cwiseAbs().maxCoeff(&pivot);
            swaps[k] = k + pivot;
            if (pivot != 0) A.row(k).swap(A.row(k + pivot));
            A.col(k).tail(rest) /= A(k, k);
            for (Eigen::Index j = k + 1; j < last; ++j) A.col(j).tail(rest) -= A(k, j) * A.col(k).tail(rest);
        }
        for (Eigen::Index j = last; j < n; ++j) {
            if (last - first < 4) {
                for (Eigen::Index k = first; k < last; ++k)
                    A.col(j).tail(n - k - 1) -= A(k, j) * A.col(k).tail(n - k - 1);
                continue;
            }
            Eigen::Matrix<Scalar, 4, 1> u = A.col(j).template segment<4>(first);
            for (Eigen::Index k = 0; k < 3; ++k) u.tail(3 - k) -= u[k] * A.col(first + k).segment(first + k + 1, 3 - k);
            A.col(j).template segment<4>(first) = u;
            subtract_four<Scalar>(&A(last, first), A.outerStride(), u, &A(last, j), n - last);
        }
    }
}

/// Whether none of the first `count` pivots left by eliminate_in_place vanishes, and all are finite.
template <class Matrix>
bool has_pivots(const Matrix& A, Eigen::Index count) {
    for (Eigen::Index k = 0; k < count; ++k) {
        if (!is_finite(A(k, k)) || A(k, k) == 0) return false;
    }
    return true;
}

/// Overwrites the n x n matrix A with its factors. If A is singular, solutions contain infinities or NaN.
template <class Scalar>
void factorise_in_place(MatrixRef<Scalar> A, Eigen::Index* swaps) {
    eliminate_in_place<Scalar>(A, swaps, A.rows());
}

/// Overwrites the parts of x with L^-1 P x_1 and x_2 - A_21 A_11^-1 x_1, after eliminate_in_place.
template <class Scalar>
void eliminate_vector_in_place(const MatrixRef<Scalar>& A, const Eigen::Index* swaps, Eigen::Index count,
                               VectorRef<Scalar> x) {
    const Eigen::Index n = A.rows();
    for (Eigen::Index k = 0; k < count; ++k) std::swap(x[k], x[swaps[k]]);
    for (Eigen::Index first = 0, last = 0; first < count; first = last) {
        last = (std::min)(first + 4, count);
        const bool whole = last - first == 4;
        for (Eigen::Index k = first; k < last; ++k) {
            const Eigen::Index rest = (whole ? last : n) - k - 1;
            x.segment(k + 1, rest) -= x[k] * A.col(k).segment(k + 1, rest);
        }
        if (!whole || last == n) continue;
        subtract_four<Scalar>(&A(last, first), A.outerStride(), x.template segment<4>(first), &x[last], n - last);
    }
}

/// Overwrites the first part of x with U^-1 x_1, after eliminate_in_place.
template <class Scalar>
void substitute_in_place(const MatrixRef<Scalar>& A, Eigen::Index count, VectorRef<Scalar> x) {
    for (Eigen::Index last = count, first = 0; last > 0; last = first) {
        first = std::max<Eigen::Index>(last - 4, 0);
        for (Eigen::Index k = last - 1; k >= first; --k) {
            x[k] /= A(k, k);
            x.segment(first, k - first) -= x[k] * A.col(k).segment(first, k - first);
        }
        if (first > 0) subtract_four<Scalar>(&A(0, first), A.outerStride(), x.template segment<4>(first), &x[0], first);
    }
}

/// Overwrites x with the solution y of A y = x, where A and swaps come from factorise_in_place.
template <class Scalar>
void solve_in_place(const MatrixRef<Scalar>& A, const Eigen::Index* swaps, VectorRef<Scalar> x) {
    eliminate_vector_in_place<Scalar>(A, swaps, A.rows(), x);
    substitute_in_place<Scalar>(A, A.rows(), x);
}

/// Solves for each column of X, in pieces: Eigen's products copy parts of their arguments, and parts above 128 kB to
/// the heap, which steps must not touch.
template <class Scalar>
void solve_columns_in_place(const MatrixRef<Scalar>& A, const Eigen::Index* swaps, MatrixRef<Scalar> X) {
    constexpr Eigen::Index most = 64;
    const Eigen::Index n = A.rows();
    for (Eigen::Index left = 0; left < X.cols(); left += most) {
        auto columns = X.middleCols(left, (std::min)(most, X.cols() - left));
        for (Eigen::Index k = 0; k < n; ++k) {
            if (swaps[k] != k) columns.row(k).swap(columns.row(swaps[k]));
        }
        const auto subtract = [&](Eigen::Index from, Eigen::Index count, Eigen::Index first, Eigen::Index rest) {
            for (Eigen::Index j = 0; rest > 0 && j < columns.cols(); ++j) {
                columns.col(j).segment(first, rest).noalias() -=
                    A.block(first, from, rest, count) * columns.col(j).segment(from, count);
            }
        };
        for (Eigen::Index k = 0; k < n; k += most) {
            const Eigen::Index count = (std::min)(most, n - k);
            A.block(k, k, count, count)
                .template triangularView<Eigen::UnitLower>()
                .solveInPlace(columns.middleRows(k, count));
            subtract(k, count, k + count, n - k - count);
        }
        for (Eigen::Index last = n; last > 0;) {
            const Eigen::Index k = (last - 1) / most * most, count = last - k;
            A.block(k, k, count, count)
                .template triangularView<Eigen::Upper>()
                .solveInPlace(columns.middleRows(k, count));
            subtract(k, count, 0, k);
            last = k;
        }
    }
}

/// The inverse of the matrix whose factors factorise_in_place has left in A and swaps.
template <class Scalar>
void invert_factors(const MatrixRef<Scalar>& A, const Eigen::Index* swaps, MatrixRef<Scalar> inverse) {
    const Eigen::Index n = A.rows();
    inverse.setIdentity();
    // four columns of the factors at a time, which are read once; L^-1 is triangular
    for (Eigen::Index first = 0, last = 0; first < n; first = last) {
        last = (std::min)(first + 4, n);
        for (Eigen::Index j = 0; j < last; ++j) {
            Eigen::Matrix<Scalar, 4, 1> u = Eigen::Matrix<Scalar, 4, 1>::Zero();
            for (Eigen::Index k = first; k < last; ++k) {
                u[k - first] = inverse(k, j);
                const Eigen::Index rest = last - k - 1;
                inverse.col(j).segment(k + 1, rest) -= inverse(k, j) * A.col(k).segment(k + 1, rest);
            }
            if (last < n) subtract_four<Scalar>(&A(last, first), A.outerStride(), u, &inverse(last, j), n - last);
        }
    }
    for (Eigen::Index last = n, first = 0; last > 0; last = first) {
        first = std::max<Eigen::Index>(last - 4, 0);
        for (Eigen::Index j = 0; j < n; ++j) {
            Eigen::Matrix<Scalar, 4, 1> u = Eigen::Matrix<Scalar, 4, 1>::Zero();
            for (Eigen::Index k = last - 1; k >= first; --k) {
                u[k - first] = inverse(k, j) /= A(k, k);
                inverse.col(j).segment(first, k - first) -= inverse(k, j) * A.col(k).segment(first, k - first);
            }
            if (first > 0) subtract_four<Scalar>(&A(0, first), A.outerStride(), u, &inverse(0, j), first);
        }
    }
    for (Eigen::Index k = n - 1; k >= 0; --k) inverse.col(k).swap(inverse.col(swaps[k]));
}

}  // namespace rollbem::detail

#ifdef ROLLBEM_COMPILED
namespace rollbem {
extern template void detail::eliminate_in_place<double>(detail::MatrixRef<double>, Eigen::Index*, Eigen::Index);
extern template void detail::eliminate_vector_in_place<double>(const detail::MatrixRef<double>&, const Eigen::Index*,
                                                               Eigen::Index, detail::VectorRef<double>);
extern template void detail::substitute_in_place<double>(const detail::MatrixRef<double>&, Eigen::Index,
                                                         detail::VectorRef<double>);
extern template void detail::solve_columns_in_place<double>(const detail::MatrixRef<double>&, const Eigen::Index*,
                                                            detail::MatrixRef<double>);
extern template void detail::invert_factors<double>(const detail::MatrixRef<double>&, const Eigen::Index*,
                                                    detail::MatrixRef<double>);
}  // namespace rollbem
#endif
