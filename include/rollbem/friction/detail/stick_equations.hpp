// The equations of the sticking elements: M(S, S) x = r for a set S that changes by few elements at a time.
// Results depend on M and S alone, to the last bit, not on earlier sets.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../detail/in_place_lu.hpp"
#include "../../types.hpp"

namespace rollbem::detail {

/// Factors of M(S, S), with S listed from the leading edge to the trailing edge. Normally M(S, S) is eliminated without
/// pivoting, one element at a time, and the inverses of both triangles are stored. The factors of a list are the
/// leading part of those of any longer list that begins with it: a border that moves at the end of the list costs
/// O(n^2) per element, and the result is the same as that of a new factorisation. If a pivot is small or a multiplier
/// large, LU with pivoting takes over. All memory is allocated by the constructor.
template <class Scalar>
class StickEquations {
public:
    using Index = Eigen::Index;
    using Vector = VectorX<Scalar>;
    using Matrix = MatrixX<Scalar>;

    explicit StickEquations(Index n)
        : matrix_(n, n),
          lower_(Matrix::Zero(n, n)),
          upper_(Matrix::Zero(n, n)),
          pivoted_(n, n),
          right_(n),
          solution_(n),
          row_(n),
          swaps_(static_cast<std::size_t>(n)),
          list_(static_cast<std::size_t>(n)),
          nested_list_(static_cast<std::size_t>(n)),
          pivoted_list_(static_cast<std::size_t>(n)) {}

    Index size() const { return matrix_.rows(); }
    const Matrix& matrix() const { return matrix_; }

    /// M, to be filled with new entries; invalidates the factors.
    Matrix& new_matrix() {
        nested_count_ = 0;
        pivoted_count_ = -1;
        ++revision_;
        return matrix_;
    }

    /// Exchanges everything but the matrix.
    void exchange_factors(StickEquations& other) {
        std::swap(*this, other);
        matrix_.swap(other.matrix_);
    }

    /// Factorises for the elements with stick = 1. False if M(S, S) is singular to working precision.
    bool factorise(const Vector& stick) {
        Index count = 0;
        bool same = true;
        for (Index i = size() - 1; i >= 0; --i) {
            if (stick[i] == 0) continue;
            same = same && count < count_ && list_[at(count)] == i;
            list_[at(count++)] = i;
        }
        same = same && count == count_ && !uses_pivoted_;
        count_ = count;
        uses_pivoted_ = false;
        if (!same || nested_count_ < count_) {
            ++revision_;
            if (!extend()) return pivot();
        }
        return true;
    }

    /// Switches to LU with pivoting for the present S, if the other factors are not accurate enough.
    bool pivot() {
        if (!std::exchange(uses_pivoted_, true)) ++revision_;
        bool kept = pivoted_count_ == count_;
        for (Index k = 0; kept && k < count_; ++k) kept = pivoted_list_[at(k)] == list_[at(k)];
        if (kept) return pivoted_finite_;
        for (Index k = 0; k < count_; ++k) {
            pivoted_list_[at(k)] = list_[at(k)];
            for (Index j = 0; j < count_; ++j) pivoted_(j, k) = matrix_(list_[at(j)], list_[at(k)]);
        }
        pivoted_count_ = count_;
        factorise_in_place<Scalar>(pivoted_.topLeftCorner(count_, count_), swaps_.data());
        pivoted_finite_ = true;
        for (Index k = 0; k < count_; ++k) {
            pivoted_finite_ = pivoted_finite_ && is_finite(pivoted_(k, k)) && pivoted_(k, k) != 0;
        }
        return pivoted_finite_;
    }
    bool uses_pivoted() const { return uses_pivoted_; }

    /// x with M(S, S) x_S = right_S and zeros outside S.
    void solve(const Vector& right, Vector& x) {
        for (Index k = 0; k < count_; ++k) right_[k] = right[list_[at(k)]];
        if (uses_pivoted_) {
            solve_in_place<Scalar>(pivoted_.topLeftCorner(count_, count_), swaps_.data(), right_.head(count_));
            solution_.head(count_) = right_.head(count_);
        } else {
            multiply(lower_, count_, right_, solution_);
            multiply(upper_, count_, solution_, right_);
            solution_.head(count_) = right_.head(count_);
        }
        x.setZero();
        for (Index k = 0; k < count_; ++k) x[list_[at(k)]] = solution_[k];
    }

    Index count() const { return count_; }                ///< elements of S
    Index listed(Index k) const { return list_[at(k)]; }  ///< the k-th of them, from the leading edge
    /// Overwrites x, one entry per element of S in the order of the list, with M(S, S)^-1 x.
    void solve_listed(VectorRef<Scalar> x) {
        if (uses_pivoted_) {
            solve_in_place<Scalar>(pivoted_.topLeftCorner(count_, count_), swaps_.data(), x);
        } else {
            solution_.head(count_).noalias() = lower_.topLeftCorner(count_, count_) * x;
            x.noalias() = upper_.topLeftCorner(count_, count_) * solution_.head(count_);
        }
    }

    /// Column k of M(S, S)^-1 in the order of the list, from the factors without pivoting.
    void find_inverse_column(Index k, Vector& column) const {
        const Index rest = count_ - k;
        column.head(count_).noalias() = upper_.block(0, k, count_, rest) * lower_.col(k).segment(k, rest);
    }

    /// Changes whenever M, S or the kind of factors changes.
    unsigned long revision() const { return revision_; }

private:
    static std::size_t at(Index k) { return static_cast<std::size_t>(k); }

    static void multiply(const Matrix& A, Index count, const Vector& x, Vector& y) {
        y.head(count).noalias() = A.topLeftCorner(count, count) * x.head(count);
    }

    // Extends the nested factors to the present list. With M = [A u; l a] and A = L U: y = L^-1 u, z = l U^-1,
    // d = a - z y; the inverse of L gains the row [-z L^-1, 1], that of U the column [-U^-1 y; 1] / d.
    bool extend() {
        Index k = 0;
        while (k < count_ && k < nested_count_ && nested_list_[at(k)] == list_[at(k)]) ++k;
        for (nested_count_ = k; k < count_; ++k) {
            const Index own = list_[at(k)];
            for (Index j = 0; j < k; ++j) right_[j] = matrix_(nested_list_[at(j)], own);
            multiply(lower_, k, right_, solution_);  // y
            for (Index j = 0; j < k; ++j) right_[j] = matrix_(own, nested_list_[at(j)]);
            row_.head(k).noalias() = upper_.topLeftCorner(k, k).transpose() * right_.head(k);  // z
            Scalar pivot = matrix_(own, own), scale = std::abs(pivot), multiplier = 0;
            for (Index j = 0; j < k; ++j) {
                pivot -= row_[j] * solution_[j];
                scale = (std::max)(scale, std::abs(right_[j]));
                multiplier = (std::max)(multiplier, std::abs(row_[j]));
            }
            const bool sound = std::abs(pivot) > least_pivot * scale && multiplier < largest_multiplier;
            if (!sound || !is_finite(pivot)) return false;
            right_.head(k).noalias() = lower_.topLeftCorner(k, k).transpose() * row_.head(k);
            multiply(upper_, k, solution_, row_);
            for (Index j = 0; j < k; ++j) {
                lower_(k, j) = -right_[j];
                upper_(j, k) = row_[j] / -pivot;
            }
            lower_(k, k) = 1;
            upper_(k, k) = 1 / pivot;
            nested_list_[at(k)] = own;
            nested_count_ = k + 1;
        }
        return true;
    }

    // Bounds on the loss of accuracy of elimination without pivoting; its results are also verified against M.
    static constexpr Scalar least_pivot = Scalar(1e-3);
    static constexpr Scalar largest_multiplier = 10;

    Matrix matrix_;
    Matrix lower_, upper_;  // inverse triangles of the nested factors, zero outside
    Matrix pivoted_;
    Vector right_, solution_, row_;
    std::vector<Index> swaps_;
    std::vector<Index> list_, nested_list_, pivoted_list_;
    Index count_ = 0;           // elements of list_
    Index nested_count_ = 0;    // elements in the nested factors
    Index pivoted_count_ = -1;  // elements in the pivoted factors; -1: none
    bool uses_pivoted_ = false, pivoted_finite_ = false;
    unsigned long revision_ = 0;
};

/// Tractions of the sticking and slip of the slipping elements, by one matrix-vector product: the principal pivot
/// transform of s = M p + c with s = 0 for the sticking elements S and p = 0 for the others, L: p_S =
/// -M(S, S)^-1 c_S and s_L = c_L - M(L, S) M(S, S)^-1 c_S. Depends on M and S alone, to the last bit. All memory is
/// allocated by the constructor.
template <class Scalar>
class StickTransform {
public:
    using Index = Eigen::Index;
    using Vector = VectorX<Scalar>;

    explicit StickTransform(Index n)
        : matrix_(MatrixX<Scalar>::Zero(n, n)), listed_(n), column_(Vector::Zero(n)), slip_(n) {}

    /// Computes the matrix for the present factors unless it is up to date; costs about |S| matrix-vector products. The
    /// factors must be those without pivoting.
    void make(StickEquations<Scalar>& equations) {
        if (revision_ == equations.revision()) return;
        revision_ = equations.revision();
        const Index count = equations.count();
        if (count == 0) return;
        Index first = equations.size(), last = 0;
        for (Index k = 0; k < count; ++k) {
            first = (std::min)(first, equations.listed(k));
            last = (std::max)(last, equations.listed(k));
        }
        const Index length = last - first + 1;
        column_.setZero();
        for (Index k = 0; k < count; ++k) {
            equations.find_inverse_column(k, listed_);
            for (Index j = 0; j < count; ++j) column_[equations.listed(j)] = listed_[j];
            slip_.noalias() = equations.matrix().middleCols(first, length) * column_.segment(first, length);
            for (Index j = 0; j < count; ++j) slip_[equations.listed(j)] = listed_[j];
            matrix_.col(k) = -slip_;
        }
    }

    /// p of the sticking elements, s - c of the others.
    void apply(const StickEquations<Scalar>& equations, const Vector& constant, Vector& result) {
        const Index count = equations.count();
        for (Index k = 0; k < count; ++k) listed_[k] = constant[equations.listed(k)];
        result.noalias() = matrix_.leftCols(count) * listed_.head(count);
    }

private:
    MatrixX<Scalar> matrix_;  // column k belongs to the k-th element in the list of the equations
    Vector listed_, column_, slip_;
    unsigned long revision_ = (std::numeric_limits<unsigned long>::max)();
};

}  // namespace rollbem::detail
