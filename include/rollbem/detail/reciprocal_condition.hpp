// Distance of a matrix from singularity, estimated from its factors; decides whether a solution can be trusted. One
// estimate for all problems.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "array_functions.hpp"

namespace rollbem::detail {

/// Largest sum of absolute values of a column.
template <class Derived>
typename Derived::RealScalar one_norm(const Eigen::MatrixBase<Derived>& A) {
    return A.cwiseAbs().colwise().sum().maxCoeff();
}

/// Largest sum of absolute values of a column of a real matrix.
template <class Scalar>
requires(!Eigen::NumTraits<Scalar>::IsComplex) Scalar
    one_norm(const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& A) {
    Scalar largest = 0;
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
        largest = (std::max)(largest, sum_of_magnitudes(A.data() + j * A.rows(), A.rows()));
    }
    return largest;
}

/// Overwrites x with the solution y of A^T y = x.
template <class Factors>
void solve_transposed(const Factors& lu, Eigen::Matrix<typename Factors::Scalar, Eigen::Dynamic, 1>& x) {
    const Eigen::Index n = x.size();
    const auto& A = lu.matrixLU();
    const auto column = [&](Eigen::Index k) { return A.data() + k * A.outerStride(); };
    for (Eigen::Index k = 0; k < n; ++k) x[k] = (x[k] - dot(column(k), x.data(), k)) / column(k)[k];
    for (Eigen::Index k = n - 1; k >= 0; --k) x[k] -= dot(column(k) + k + 1, x.data() + k + 1, n - k - 1);
    const Eigen::Matrix<typename Factors::Scalar, Eigen::Dynamic, 1> permuted = x;
    const auto& places = lu.permutationP().indices();
    for (Eigen::Index k = 0; k < n; ++k) x[k] = permuted[places[k]];
}

/// Estimate of 1 / (|A| |A^-1|) in the 1-norm of a real A from its factors, never too small and rarely much too large:
/// Higham, ACM Trans. Math. Softw. 14 (1988) 381-396. The same steps as in Eigen's rcond().
template <class Factors>
typename Factors::Scalar estimated_condition(const Factors& lu, typename Factors::Scalar norm) {
    using Scalar = typename Factors::Scalar;
    using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
    const Eigen::Index n = lu.rows();
    if (norm == 0) return 0;
    if (n == 1) return 1;
    const auto solve = [&](Vector& x) {
        const Vector solution = lu.solve(x);
        x = solution;
        return sum_of_magnitudes(x.data(), n);
    };
    Vector v(n), sign(n);
    for (Eigen::Index i = 0; i < n; ++i) v[i] = 1 / static_cast<Scalar>(n);
    Scalar bound = solve(v);
    Eigen::Index largest = -1;
    for (int k = 0; k < 4; ++k) {
        bool same_signs = k > 0;
        for (Eigen::Index i = 0; i < n; ++i) {
            const Scalar sign_i = v[i] < 0 ? Scalar(-1) : Scalar(1);
            same_signs = same_signs && sign_i == sign[i];
            sign[i] = sign_i;
        }
        if (same_signs) break;
        v = sign;
        solve_transposed(lu, v);
        Eigen::Index next = 0;
        for (Eigen::Index i = 1; i < n; ++i) {
            if (std::abs(v[i]) > std::abs(v[next])) next = i;
        }
        if (next == largest) break;
        for (Eigen::Index i = 0; i < n; ++i) v[i] = i == next ? Scalar(1) : Scalar(0);
        const Scalar improved = solve(v);
        const bool better = improved > bound;
        bound = improved;
        if (!better) break;
        largest = next;
    }
    for (Eigen::Index i = 0; i < n; ++i) {
        const Scalar size = 1 + static_cast<Scalar>(i) / static_cast<Scalar>(n - 1);
        v[i] = i % 2 == 0 ? size : -size;
    }
    bound = (std::max)(bound, 2 * solve(v) / static_cast<Scalar>(3 * n));
    return bound == 0 ? Scalar(0) : 1 / bound / norm;
}

/// Estimate of 1 / (|A| |A^-1|) in the 1-norm from the factors of an LU decomposition with partial pivoting and
/// norm = |A|. Eigen's own estimates |A^-1| from a few vectors, which two equal rows of A can escape; 1 / (last pivot)
/// is an entry of A^-1 and reveals them. A pivot that vanishes before the last would leave NaN in the vectors, and an
/// estimate of 1.
template <class Factors>
typename Factors::RealScalar reciprocal_condition(const Factors& lu, typename Factors::RealScalar norm) {
    using Scalar = typename Factors::RealScalar;
    const Eigen::Index last = lu.matrixLU().rows() - 1;
    for (Eigen::Index k = 0; k < last; ++k) {
        if (lu.matrixLU()(k, k) == typename Factors::Scalar(0)) return 0;
    }
    Scalar estimate = 0;
    if constexpr (Eigen::NumTraits<typename Factors::Scalar>::IsComplex) {
        estimate = lu.rcond();
    } else {
        estimate = estimated_condition(lu, norm);
    }
    return std::min<Scalar>(estimate, std::abs(lu.matrixLU()(last, last)) / norm);
}

/// Below this rcond(G') no result is taken from G'^-1 G: it could have lost more than four digits.
inline constexpr double least_rcond_of_G_prime = 1e-4;

}  // namespace rollbem::detail

#ifdef ROLLBEM_COMPILED
namespace rollbem {
extern template double detail::reciprocal_condition<Eigen::PartialPivLU<Eigen::MatrixXd>>(
    const Eigen::PartialPivLU<Eigen::MatrixXd>&, double);
}  // namespace rollbem
#endif
