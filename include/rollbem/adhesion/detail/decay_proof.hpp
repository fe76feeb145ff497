// The proof that all modes of a system decay. Internal.
#pragma once

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "../../system/rolling_system.hpp"
#include "../../types.hpp"

namespace rollbem::detail {

/// Whether all eigenvalues have Re(nu) < 0 for every perturbation of G' and G by n eps of their norms; `middle` is
/// about the geometric mean of |nu|. Single eigenvalues may be too ill-conditioned to tell, y^H G x being small.
///
/// The step A = (G - tau G')^-1 (G + tau G') of the trapezoidal rule has the eigenvalues (1 + tau nu)/(1 - tau nu),
/// inside the unit circle if and only if all Re(nu) < 0. The proof is an energy p^T Y p that each step diminishes: Y
/// and R = Y - A^T Y A are both positive definite, R by more than rounding. Y, the sum of |A^j p|^2 until powers are
/// small, is found by doubling their number; its accuracy does not matter.
inline bool all_decay(const RollingSystem<double>& system, double middle, double norm_G_prime, double norm_G) {
    using Matrix = MatrixX<double>;
    const Eigen::Index n = system.size();
    const double tau = 1 / middle;
    const Matrix identity = Matrix::Identity(n, n);
    const Matrix inverse = Eigen::PartialPivLU<Matrix>(system.G() - tau * system.G_prime()).inverse();
    const Matrix A = 2 * (inverse * system.G()) - identity;
    Matrix Y = identity, power = A, product;
    int doublings = 0;
    for (double size = power.norm(); !(size < 0.5); size = power.norm()) {
        // the slowest mode that rounding leaves inside the unit circle has decayed by then
        if (++doublings > std::numeric_limits<double>::digits + 10) return false;
        if (!(size < 1 / std::sqrt(std::numeric_limits<double>::epsilon()))) return false;
        product.noalias() = Y * power;
        Y.noalias() += power.transpose() * product;
        product.noalias() = power * power;
        power.swap(product);
    }
    product.noalias() = Y * A;
    Matrix R = Y;
    R.noalias() -= A.transpose() * product;
    const double rounding = static_cast<double>(n) * std::numeric_limits<double>::epsilon(), size = A.norm();
    const double of_A = rounding * inverse.norm() * (norm_G + tau * norm_G_prime) * (1 + size);
    R.diagonal().array() -= 2 * Y.norm() * size * (rounding * size + of_A);
    return Eigen::LLT<Matrix>(Y).info() == Eigen::Success && Eigen::LLT<Matrix>(R).info() == Eigen::Success;
}

}  // namespace rollbem::detail
