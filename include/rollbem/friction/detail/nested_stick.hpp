// The equations of a friction problem in one direction with the sticking elements eliminated; cheap where the set of
// sticking elements changes by few elements at a time.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "../../detail/array_functions.hpp"
#include "../../detail/finite.hpp"
#include "../../detail/in_place_lu.hpp"
#include "../../types.hpp"
#include "roles.hpp"
#include "slip_matrix.hpp"

namespace rollbem::detail {

/// The equations s = M p + c with s_S = 0, where S are the elements that stick, listed from the leading edge to the
/// trailing edge. Normally M_SS is eliminated without pivoting, one element at a time, and the inverses of both
/// triangles are stored. A longer list that begins with a shorter one contains the shorter one's factors: a border that
/// moves at the end of the list costs O(n^2) per element, with the same result as a new factorisation. If a pivot is
/// small or a multiplier large, LU with pivoting takes over. Results depend on M and the roles alone, to the last bit.
class NestedStick : public RoleLists {
public:
    using Vector = VectorX<double>;
    using Matrix = MatrixX<double>;
    using M = SlipMatrix<1>;

    /// The constants c themselves; null: zero.
    struct Base {
        explicit Base(Index) {}
        void forget() { constant = nullptr; }

        const Vectors<1>* constant = nullptr;
    };

    explicit NestedStick(const M& matrix)
        : RoleLists(matrix.size()),
          lower_(Matrix::Zero(whole_blocks(matrix.size()), matrix.size())),
          upper_(lower_),
          pivoted_(matrix.size(), matrix.size()),
          right_(Vector::Zero(lower_.rows())),
          solution_(right_),
          row_(right_),
          stuck_(Vector::Zero(matrix.size())),
          column_(stuck_),
          placed_(stuck_),
          product_(stuck_),
          swaps_(static_cast<std::size_t>(matrix.size())),
          nested_(swaps_.size()) {}

    /// Eliminates the elements that stick, with a nearby matrix where M_SS is singular; false if both fail.
    bool condense(M& matrix, const std::vector<Role>& roles) {
        if (are_of(matrix, roles)) return is_usable_;
        if (matrix_revision_ != matrix.revision()) {
            nested_count_ = 0;
            placed_.setZero();
            product_.setZero();
        }
        clear_stuck(stuck_);
        take(matrix, roles);
        together_ = stick_together();
        uses_pivoted_ = !extend(matrix.group(0));
        is_regular_ = !uses_pivoted_ || pivot(matrix, false);
        is_usable_ = is_regular_ || pivot(matrix, true);
        return is_usable_;
    }

    void find_base(const M&, const Vectors<1>* c, Base& base) const { base.constant = c; }

    /// Finds the tractions of S and the slip of all elements by products with M: the slip of S is the error of p.
    void complete(const M& matrix, const Base& base, Vectors<1>& p, Vectors<1>& s) {
        clear_stuck(p);
        is_loaded_ = !p.isZero(0);
        if (is_loaded_) place(matrix.group(0), p);
        complete_placed(matrix.group(0), base, p, s);
    }
    /// Keeps the tractions of the other elements in the last complete(), and M times them, for complete_again().
    void keep() { kept_ = {revision(), placement_, is_loaded_}; }
    bool keeps() const { return kept_.revision == revision() && kept_.placement == placement_; }
    /// complete() with the tractions kept, if keeps(); p need not hold them.
    void complete_again(const M& matrix, const Base& base, Vectors<1>& p, Vectors<1>& s) {
        is_loaded_ = kept_.is_loaded;
        if (is_loaded_) {
            std::copy_n(placed_.data(), p.size(), p.data());
        } else {
            p.setZero();
        }
        complete_placed(matrix.group(0), base, p, s);
    }

    /// Sets `target` to X_k C_kl Y_l for all sliding elements k and l.
    template <class Target>
    void form(const M& matrix, const Vectors<1>& X, const Vectors<1>& Y, Target&& target) {
        for (Index l = 0; l < sliding(); ++l) {
            column_ = matrix.group(0).col(other(l));
            stick(matrix.group(0), column_);
            for (Index k = 0; k < sliding(); ++k) target(k, l) = X[k] * column_[other(k)] * Y[l];
        }
    }

private:
    static std::size_t at(Index k) { return static_cast<std::size_t>(k); }

    Index listed(Index k) const { return (*this)[sticking() - 1 - k]; }
    void clear_stuck(Vectors<1>& values) const {
        for (Index k = 0; k < sticking(); ++k) values[listed(k)] = 0;
    }

    // Finds M p in product_, where it stays for the next call: roles and bounds seldom change.
    void place(const Matrix& A, const Vectors<1>& p) {
        if (same_bits(p, placed_)) return;
        ++placement_;
        placed_ = p;
        product_.noalias() = A * p;
    }
    // Completes p and s from product_, unless the other elements have no traction.
    void complete_placed(const Matrix& A, const Base& base, Vectors<1>& p, Vectors<1>& s) {
        if (base.constant == nullptr) {
            s.setZero();
            if (is_loaded_) s += product_;
        } else if (is_loaded_) {
            s = *base.constant + product_;
        } else {
            s = *base.constant;
        }
        stick(A, s);
        if (together_) {
            stuck(p) = stuck(stuck_);
        } else {
            for (Index k = 0; k < sticking(); ++k) p[listed(k)] = stuck_[listed(k)];
        }
    }
    // Finds the tractions of S, in stuck_, from the slip without them, and adds the slip that they cause.
    void stick(const Matrix& A, Vectors<1>& s) {
        const Index count = sticking();
        if (count == 0) return;
        if (together_) {
            right_.head(count) = stuck(s).reverse();
        } else {
            for (Index k = 0; k < count; ++k) right_[k] = s[listed(k)];
        }
        if (uses_pivoted_) {
            solve_in_place<double>(pivoted_.topLeftCorner(count, count), swaps_.data(), right_.head(count));
        } else {
            multiply_triangle<Triangle::lower>(lower_, count, right_, solution_);
            multiply_triangle<Triangle::upper>(upper_, count, solution_, right_);
        }
        if (together_) {
            stuck(stuck_) = -right_.head(count).reverse();
        } else {
            for (Index k = 0; k < count; ++k) stuck_[listed(k)] = -right_[k];
        }
        // the columns from the first to the last element of S
        const Index first = listed(count - 1), length = listed(0) - first + 1;
        s.noalias() += A.middleCols(first, length) * stuck_.segment(first, length);
    }
    // Extends the nested factors to the present list. With M = [A u; l a] and A = L U: y = L^-1 u, z = l U^-1,
    // d = a - z y; the inverse of L gains the row [-z L^-1, 1], the inverse of U the column [-U^-1 y; 1] / d.
    bool extend(const Matrix& A) {
        Index k = 0;
        while (k < sticking() && k < nested_count_ && nested_[at(k)] == listed(k)) ++k;
        for (nested_count_ = k; k < sticking(); ++k) {
            const Index own = listed(k);
            for (Index j = 0; j < k; ++j) right_[j] = A(nested_[at(j)], own);
            multiply_triangle<Triangle::lower>(lower_, k, right_, solution_);  // y
            for (Index j = 0; j < k; ++j) right_[j] = A(own, nested_[at(j)]);
            multiply_transposed<Triangle::upper>(upper_, k, right_, row_);  // z
            double pivot = A(own, own), scale = std::abs(pivot), multiplier = 0;
            for (Index j = 0; j < k; ++j) {
                pivot -= row_[j] * solution_[j];
                scale = (std::max)(scale, std::abs(right_[j]));
                multiplier = (std::max)(multiplier, std::abs(row_[j]));
            }
            const bool sound = std::abs(pivot) > least_pivot * scale && multiplier < largest_multiplier;
            if (!sound || !is_finite(pivot)) return false;
            multiply_transposed<Triangle::lower>(lower_, k, row_, right_);
            multiply_triangle<Triangle::upper>(upper_, k, solution_, row_);
            for (Index j = 0; j < k; ++j) {
                lower_(k, j) = -right_[j];
                upper_(j, k) = row_[j] / -pivot;
            }
            lower_(k, k) = 1;
            upper_(k, k) = 1 / pivot;
            nested_[at(k)] = own;
            nested_count_ = k + 1;
        }
        return true;
    }
    bool pivot(M& matrix, bool shifts) {
        const Index count = sticking();
        for (Index k = 0; k < count; ++k) {
            for (Index j = 0; j < count; ++j) pivoted_(j, k) = matrix.group(0)(listed(j), listed(k));
            if (shifts) pivoted_(k, k) += matrix.shift(listed(k));
        }
        factorise_in_place<double>(pivoted_.topLeftCorner(count, count), swaps_.data());
        return has_pivots(pivoted_, count);
    }

    // Bounds on the loss of accuracy of elimination without pivoting; its results are also verified against M.
    static constexpr double least_pivot = 1e-3;
    static constexpr double largest_multiplier = 10;

    Matrix lower_, upper_;  // inverse triangles of the nested factors, zero outside
    Matrix pivoted_;
    Vector right_, solution_, row_;
    Vector stuck_, column_;        // tractions of S, 0 for all others; slip by a traction of 1
    Vectors<1> placed_, product_;  // the last tractions, with 0 for S, and M times them
    std::vector<Index> swaps_;
    std::vector<Index> nested_;  // the elements in the nested factors
    Index nested_count_ = 0;
    bool uses_pivoted_ = false, together_ = false;
    bool is_loaded_ = false;       // the other elements have had tractions in the last complete()
    std::uint64_t placement_ = 1;  // changes with placed_ and product_
    struct {
        std::uint64_t revision = 0, placement = 0;
        bool is_loaded = false;
    } kept_;
};

}  // namespace rollbem::detail
