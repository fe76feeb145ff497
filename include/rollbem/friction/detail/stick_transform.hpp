// Tractions of the sticking and slip of the slipping elements, by one matrix-vector product.
#pragma once

#include <algorithm>
#include <limits>

#include <Eigen/Core>

#include "../../types.hpp"
#include "stick_equations.hpp"

namespace rollbem::detail {

/// Principal pivot transform of s = M p + c with s = 0 for the sticking elements S and p = 0 for the others, L: p_S =
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
