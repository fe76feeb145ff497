// Controllability Gramians of triangular systems by Hammarling's method, for balanced reduction. Internal.
#pragma once

#include <cmath>
#include <complex>

#include <Eigen/Core>

#include "../../types.hpp"

namespace rollbem::detail {

/// The upper triangular U of X = U U^H, where T X + X T^H + B B^H = 0, for an upper triangular n x n T whose
/// eigenvalues have negative real parts, and an n x k B. The factor is found without forming X, whose rounding would
/// hide all singular values below the square root of eps: Hammarling, IMA J. Numer. Anal. 2 (1982) 303-323.
///
/// Split off the last row and column of each matrix:
///
///     T = [T_1 t; 0 tau],   U = [U_1 u; 0 upsilon],   B = [B_1; b^H],   alpha = sqrt(-2 Re tau),   w = b/|b|.
///
/// The equation gives upsilon = |b|/alpha and (T_1 + conj(tau)) u = -(upsilon t + alpha B_1 w). The same equation
/// remains for T_1 and U_1, with B_1 - alpha u w^H in place of B_1.
inline MatrixX<std::complex<double>> gramian_factor(const MatrixX<std::complex<double>>& T,
                                                    MatrixX<std::complex<double>> B) {
    using Complex = std::complex<double>;
    MatrixX<Complex> U = MatrixX<Complex>::Zero(T.rows(), T.cols());
    for (Eigen::Index j = T.rows() - 1; j >= 0; --j) {
        const double size = B.row(j).norm();
        if (size == 0) continue;  // u = 0 solves the equation
        const Complex tau = T(j, j);
        const double alpha = std::sqrt(-2 * tau.real()), upsilon = size / alpha;
        VectorX<Complex> u = -upsilon * T.col(j).head(j);
        for (Eigen::Index k = 0; k < B.cols(); ++k) u -= alpha / size * std::conj(B(j, k)) * B.col(k).head(j);
        for (Eigen::Index i = j - 1; i >= 0; --i) {
            u[i] /= T(i, i) + std::conj(tau);
            u.head(i) -= u[i] * T.col(i).head(i);
        }
        for (Eigen::Index k = 0; k < B.cols(); ++k) B.col(k).head(j) -= alpha / size * B(j, k) * u;
        U.col(j).head(j) = u;
        U(j, j) = upsilon;
    }
    return U;
}

}  // namespace rollbem::detail
