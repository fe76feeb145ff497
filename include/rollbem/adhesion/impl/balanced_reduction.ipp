// Bodies of adhesion/balanced_reduction.hpp. Internal.
#pragma once

#include "../balanced_reduction.hpp"

#include <algorithm>
#include <complex>
#include <limits>
#include <string>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../detail/gramian.hpp"

namespace rollbem::detail {

/// Whether the eigenvalues, the diagonal of a Schur form T of A, have negative real parts: ok if rounding of A cannot
/// change that, else unstable or ill_conditioned.
inline Status decay_status(const MatrixX<std::complex<double>>& T) {
    const double rounding = static_cast<double>(T.rows()) * std::numeric_limits<double>::epsilon() * T.norm();
    const double largest = T.diagonal().real().maxCoeff();
    if (!all_finite(T)) return Status::not_finite;
    return largest > rounding ? Status::unstable : largest >= -rounding ? Status::ill_conditioned : Status::ok;
}

/// A real n x n factor M of the Gramian X = M M^T, X = (Z U) (Z U)^H; its columns decrease.
inline MatrixX<double> real_factor(const MatrixX<std::complex<double>>& Z, const MatrixX<std::complex<double>>& U) {
    const Eigen::Index n = Z.rows();
    const MatrixX<double> Z_re = Z.real(), Z_im = Z.imag(), U_re = U.real(), U_im = U.imag();
    MatrixX<double> parts(n, 2 * n);  // X is real, and therefore Re(Z U) Re(Z U)^T + Im(Z U) Im(Z U)^T
    parts.leftCols(n).noalias() = Z_re * U_re;
    parts.leftCols(n).noalias() -= Z_im * U_im;
    parts.rightCols(n).noalias() = Z_re * U_im;
    parts.rightCols(n).noalias() += Z_im * U_re;
    const Eigen::ColPivHouseholderQR<MatrixX<double>> qr(parts.transpose());
    MatrixX<double> factor = MatrixX<double>::Zero(n, n);
    for (Eigen::Index j = 0; j < n; ++j) {
        factor.row(qr.colsPermutation().indices()[j]).head(j + 1) = qr.matrixQR().col(j).head(j + 1);
    }
    return factor;
}

/// The number of columns above rounding of a matrix whose columns decrease.
inline Eigen::Index numerical_rank(const MatrixX<double>& factor) {
    return (factor.colwise().norm().array() > std::numeric_limits<double>::epsilon() * factor.norm()).count();
}

/// Z^H B for real B.
inline MatrixX<std::complex<double>> transformed(const MatrixX<std::complex<double>>& Z, const MatrixX<double>& B) {
    const MatrixX<double> Z_re = Z.real(), Z_im = Z.imag();
    MatrixX<std::complex<double>> result(B.rows(), B.cols());
    result.real() = Z_re.transpose() * B;
    result.imag() = -Z_im.transpose() * B;
    return result;
}

/// Hankel singular values above rounding, decreasing, and for each a direction in V (columns) and W (rows) of the
/// balanced states x = V z, z = W x.
struct Balance {
    Status status;  ///< ok, not_finite, or ill_conditioned where there are none
    ArrayX<double> sigma{};
    MatrixX<double> V{}, W{};
};

/// Balances a state space with the Schur form A = Z T Z^H, by the square-root method.
inline Balance balance(const StateSpace& space, const MatrixX<std::complex<double>>& Z,
                       const MatrixX<std::complex<double>>& T) {
    using Matrix = MatrixX<double>;
    using ComplexMatrix = MatrixX<std::complex<double>>;
    const ComplexMatrix inputs = transformed(Z, space.B);
    Matrix M_c = real_factor(Z, gramian_factor(T, inputs));
    // T^H Y + Y T + C^H C = 0 is an equation of the same kind with rows and columns in reverse order
    const ComplexMatrix outputs = transformed(Z, space.C.transpose()).colwise().reverse();
    const ComplexMatrix reversed = gramian_factor(T.adjoint().reverse(), outputs);
    Matrix M_o = real_factor(Z, reversed.colwise().reverse());

    if (!is_finite(M_c.norm() * M_o.norm())) return {.status = Status::not_finite};
    const Eigen::Index rank = (std::max)(numerical_rank(M_c), numerical_rank(M_o));
    M_c.conservativeResize(Eigen::NoChange, rank);
    M_o.conservativeResize(Eigen::NoChange, rank);
    const Matrix product = M_o.transpose() * M_c;
    if (product.norm() == 0) return {.status = Status::ill_conditioned};
    const Eigen::JacobiSVD<Matrix, Eigen::NoQRPreconditioner> svd(product, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const ArrayX<double> sigma = svd.singularValues();
    const double rounding = static_cast<double>(space.A.rows()) * std::numeric_limits<double>::epsilon() * sigma[0];
    const Eigen::Index count = (sigma > rounding).count();
    const VectorX<double> scale = sigma.head(count).sqrt().inverse().matrix();
    return {.status = Status::ok,
            .sigma = sigma.head(count),
            .V = M_c * svd.matrixV().leftCols(count) * scale.asDiagonal(),
            .W = (M_o * svd.matrixU().leftCols(count) * scale.asDiagonal()).transpose()};
}

/// Reduces a state space to the states that the columns of V span and the rows of W measure, while all other states
/// follow without delay: A^-1 is restricted to V, along the null space of W, and inverted again.
inline StateSpace residualised(const StateSpace& space, const MatrixX<double>& V, const MatrixX<double>& W) {
    using Matrix = MatrixX<double>;
    const Eigen::PartialPivLU<Matrix> lu(space.A);
    const Matrix inverse_B = lu.solve(space.B), inverse_V = lu.solve(V), output = space.C * inverse_V;
    // W V is the identity but for rounding; solving with it makes the projection exact
    const Eigen::PartialPivLU<Matrix> along(W * V);
    const Eigen::PartialPivLU<Matrix> inverse_A(along.solve(W * inverse_V));
    StateSpace reduced;
    reduced.A = inverse_A.inverse();
    reduced.B = inverse_A.solve(along.solve(W * inverse_B));
    reduced.C = output * reduced.A;
    reduced.D = space.D - space.C * inverse_B + output * reduced.B;
    return reduced;
}

/// Throws std::invalid_argument unless the matrices fit together and all entries are finite.
inline void require_state_space(const char* who, const StateSpace& space) {
    const Eigen::Index n = space.A.rows();
    require(n >= 1, who, "number of rows of A", n, "be at least 1");
    require(space.A.cols() == n, who, "number of columns of A", space.A.cols(), "equal its number of rows");
    require(space.B.rows() == n, who, "number of rows of B", space.B.rows(), "equal the number of rows of A");
    require(space.C.cols() == n, who, "number of columns of C", space.C.cols(), "equal the number of columns of A");
    require(space.D.rows() == space.C.rows(), who, "number of rows of D", space.D.rows(),
            "equal the number of rows of C");
    require(space.D.cols() == space.B.cols(), who, "number of columns of D", space.D.cols(),
            "equal the number of columns of B");
    require_finite(who, "A", space.A);
    require_finite(who, "B", space.B);
    require_finite(who, "C", space.C);
    require_finite(who, "D", space.D);
}

}  // namespace rollbem::detail

namespace rollbem {

ROLLBEM_DECL BalancedReduction balanced_reduction(const StateSpace& space, Eigen::Index states) {
    detail::require_state_space("balanced_reduction", space);
    const Eigen::Index n = space.A.rows();
    const std::string rule = "lie in [1, " + detail::to_text(n) + "], the number of states there are";
    detail::require(states >= 1 && states <= n, "balanced_reduction", "states", states, rule.c_str());

    BalancedReduction result;
    const Eigen::ComplexSchur<MatrixX<double>> schur(space.A);
    result.status = schur.info() == Eigen::Success ? detail::decay_status(schur.matrixT()) : Status::ill_conditioned;
    if (result.status != Status::ok) return result;
    const detail::Balance balance = detail::balance(space, schur.matrixU(), schur.matrixT());
    result.status = balance.status;
    if (result.status != Status::ok) return result;
    const Eigen::Index count = balance.sigma.size(), K = (std::min)(states, count);
    result.hankel_singular_values = balance.sigma;
    result.error_bound = 2 * balance.sigma.tail(count - K).sum();
    const StateSpace reduced = detail::residualised(space, balance.V.leftCols(K), balance.W.topRows(K));
    result.status = detail::decay_status(Eigen::ComplexSchur<MatrixX<double>>(reduced.A, false).matrixT());
    if (result.status == Status::ok) result.space = reduced;
    return result;
}

}  // namespace rollbem
