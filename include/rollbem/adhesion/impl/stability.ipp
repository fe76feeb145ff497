// Bodies of adhesion/stability.hpp. Internal.
#pragma once

#include "../stability.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/Jacobi>
#include <Eigen/LU>

#include "../../detail/finite.hpp"
#include "../../detail/reciprocal_condition.hpp"
#include "../detail/decay_proof.hpp"

namespace rollbem {

ROLLBEM_DECL StabilityResult::Count count_unstable(const RollingSystem<double>& system) {
    StabilityResult::Count result;
    result.n = system.size();
    const Eigen::PartialPivLU<MatrixX<double>> lu(system.G_prime());
    result.rcond = detail::reciprocal_condition(lu, detail::one_norm(system.G_prime()));
    result.status = Status::ill_conditioned;
    if (!detail::is_finite(result.rcond) || !(result.rcond > double(detail::least_rcond_of_G_prime))) return result;
    const MatrixX<double> M = lu.solve(system.G());
    if (!detail::all_finite(M)) return result;
    const Eigen::EigenSolver<MatrixX<double>> solver(M, false);
    if (solver.info() != Eigen::Success || !detail::all_finite(solver.eigenvalues())) return result;
    for (const std::complex<double>& mu : solver.eigenvalues()) {
        if (mu.real() > 0) ++result.unstable_count;
        const double size = std::abs(mu);
        result.flattest_cosine = (std::max)(result.flattest_cosine, size > 0 ? mu.real() / size : 0.0);
    }
    result.status = Status::ok;
    return result;
}

ROLLBEM_DECL double StabilityResult::unstable_fraction() const {
    return static_cast<double>(unstable_count) / static_cast<double>(std::max<Eigen::Index>(alpha.size(), 1));
}

ROLLBEM_DECL auto StabilityResult::eigenvalues() const -> VectorX<std::complex<double>> {
    VectorX<std::complex<double>> nu(alpha.size());
    for (Eigen::Index k = 0; k < nu.size(); ++k) {
        nu[k] = beta[k] > 0 ? alpha[k] / beta[k] : std::complex<double>(std::numeric_limits<double>::infinity());
    }
    return nu;
}

}  // namespace rollbem

namespace rollbem::detail {

/// Largest singular value.
inline double two_norm(const MatrixX<double>& A) {
    MatrixX<double> square(A.cols(), A.cols());
    square.noalias() = A.transpose() * A;
    const Eigen::SelfAdjointEigenSolver<MatrixX<double>> solver(square, Eigen::EigenvaluesOnly);
    return std::sqrt((std::max)(solver.eigenvalues()[A.cols() - 1], 0.0));
}

/// The pair (S, T) of a real QZ decomposition of (G', G): T is triangular, and S is triangular except for 2 x 2 blocks.
struct QuasiTriangularPair {
    MatrixX<double> S, T;

    bool is_pair(Eigen::Index i) const { return i + 1 < S.rows() && S(i + 1, i) != 0; }
};

/// Eigenvalue alpha / beta, beta >= 0, that starts at diagonal entry i; of a pair, the one with positive imaginary
/// part. Where S has a 2 x 2 block, QZ makes T diagonal.
inline std::pair<std::complex<double>, double> eigenvalue_at(const QuasiTriangularPair& pair, Eigen::Index i) {
    const auto& [S, T] = pair;
    if (!pair.is_pair(i)) {
        const double beta = T(i, i);
        return {beta < 0 ? -S(i, i) : S(i, i), std::abs(beta)};
    }
    // (S - nu T) is singular: nu is an eigenvalue of S diag(b, a) / (a b) with T = diag(a, b)
    const double a = T(i, i), b = T(i + 1, i + 1);
    const double half_difference = (S(i, i) * b - S(i + 1, i + 1) * a) / 2;
    const double mean = (S(i, i) * b + S(i + 1, i + 1) * a) / 2;
    const double square = half_difference * half_difference + S(i, i + 1) * a * S(i + 1, i) * b;
    const double beta = a * b;
    return {{beta < 0 ? -mean : mean, std::sqrt(std::abs(square))}, std::abs(beta)};
}

/// Makes the 2 x 2 blocks triangular by complex rotations, the eigenvalue with positive imaginary part first.
inline void triangularise(const QuasiTriangularPair& pair, MatrixX<std::complex<double>>& S,
                          MatrixX<std::complex<double>>& T) {
    using Complex = std::complex<double>;
    S = pair.S.template cast<Complex>();
    T = pair.T.template cast<Complex>();
    for (Eigen::Index i = 0; i + 1 < S.rows(); ++i) {
        if (!pair.is_pair(i)) continue;
        const auto [alpha, beta] = eigenvalue_at(pair, i);
        // the second row of (beta S - alpha T) v = 0 gives v, which becomes the first column
        Eigen::JacobiRotation<Complex> rotation;
        const Complex first = beta * S(i + 1, i + 1) - alpha * T(i + 1, i + 1);
        const Complex second = -beta * S(i + 1, i);
        const double length = std::hypot(std::abs(first), std::abs(second));
        Eigen::Matrix<Complex, 2, 2> Z;
        Z << first / length, -std::conj(second) / length, second / length, std::conj(first) / length;
        S.template middleCols<2>(i) = (S.template middleCols<2>(i) * Z).eval();
        T.template middleCols<2>(i) = (T.template middleCols<2>(i) * Z).eval();
        rotation.makeGivens(T(i, i), T(i + 1, i));
        S.applyOnTheLeft(i, i + 1, rotation.adjoint());
        T.applyOnTheLeft(i, i + 1, rotation.adjoint());
        S(i + 1, i) = T(i + 1, i) = 0;
    }
}

/// Finds StabilityResult::uncertainty. Right and left vectors v, w of the triangular pair follow by substitution,
/// separately for each eigenvalue: two spectra need not be matched, and no ill-conditioned matrix of vectors is
/// inverted. Since v ends and w starts at entry i of the eigenvalue, where both are 1, y^H G x = T_ii / (|v| |w|).
inline VectorX<double> uncertainty_of_eigenvalues(const QuasiTriangularPair& pair, double norm_G_prime, double norm_G) {
    using Complex = std::complex<double>;
    const Eigen::Index n = pair.S.rows();
    const double epsilon = std::numeric_limits<double>::epsilon();
    const double infinity = std::numeric_limits<double>::infinity();
    MatrixX<Complex> S, T;
    triangularise(pair, S, T);
    VectorX<double> uncertainty(n);
    MatrixX<Complex> shifted(n, n);
    VectorX<Complex> v(n), w(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const auto [alpha, beta] = eigenvalue_at(pair, i);
        for (Eigen::Index j = 0; j < n; ++j) {
            shifted.col(j).head(j + 1) = beta * S.col(j).head(j + 1) - alpha * T.col(j).head(j + 1);
        }
        // close eigenvalues: a smallest pivot in place of zero, as rounding could have produced it
        const double rounding = epsilon * (beta * norm_G_prime + std::abs(alpha) * norm_G);
        for (Eigen::Index j = 0; j < n; ++j) {
            if (std::abs(shifted(j, j)) < rounding) shifted(j, j) = rounding;
        }
        const Eigen::Index after = n - 1 - i;
        v.head(i) = -shifted.col(i).head(i);
        shifted.topLeftCorner(i, i).template triangularView<Eigen::Upper>().solveInPlace(v.head(i));
        w.tail(after) = -shifted.row(i).tail(after).adjoint();
        shifted.bottomRightCorner(after, after)
            .template triangularView<Eigen::Upper>()
            .adjoint()
            .solveInPlace(w.tail(after));
        const double lengths = std::hypot(1.0, v.head(i).norm()) * std::hypot(1.0, w.tail(after).norm());
        const double bound =
            beta > 0 ? static_cast<double>(n) * (rounding / beta) * (lengths / std::abs(T(i, i))) : infinity;
        uncertainty[i] = is_nan(bound) ? infinity : bound;  // overflow in v or w
        if (pair.is_pair(i)) {
            uncertainty[i + 1] = uncertainty[i];
            ++i;
        }
    }
    return uncertainty;
}

inline StabilityResult find_eigenvalues(const RollingSystem<double>& system, bool settle_signs) {
    const Eigen::Index n = system.size();
    StabilityResult result;
    result.n = result.uncertain_count = n;
    QuasiTriangularPair pair;
    const double largest_slope = system.G_prime().cwiseAbs().maxCoeff();
    if (!(largest_slope >= negligible<double>)) {  // QZ, whose tolerances vanish, would not end
        result.status = Status::ill_conditioned;
        return result;
    }
    {
        const Eigen::RealQZ<MatrixX<double>> qz(system.G_prime(), system.G(), false);
        result.status = qz.info() == Eigen::Success ? Status::ok : Status::ill_conditioned;
        if (result.status != Status::ok) return result;
        pair = {qz.matrixS(), qz.matrixT()};
    }
    result.alpha.resize(n);
    result.beta.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const auto [alpha, beta] = eigenvalue_at(pair, i);
        result.alpha[i] = alpha;
        result.beta[i] = beta;
        if (!pair.is_pair(i)) continue;
        ++i;
        result.alpha[i] = std::conj(alpha);
        result.beta[i] = beta;
    }

    if (!all_finite(result.alpha) || !all_finite(result.beta)) {
        result.status = Status::not_finite;
        return result;
    }

    const double infinity = std::numeric_limits<double>::infinity();
    result.spectral_abscissa = -std::numeric_limits<double>::infinity();
    double largest = 0, smallest = infinity, slowest = infinity;
    for (const std::complex<double>& nu : result.eigenvalues()) {
        result.spectral_radius = (std::max)(result.spectral_radius, std::abs(nu));
        slowest = (std::min)(slowest, std::abs(nu));
        largest = (std::max)(largest, std::abs(nu.real()));
        smallest = (std::min)(smallest, std::abs(nu.real()));
        if (!is_finite(nu.real())) continue;
        result.spectral_abscissa = (std::max)(result.spectral_abscissa, static_cast<double>(nu.real()));
        if (nu.real() > 0) ++result.unstable_count;
    }
    result.stiffness_ratio = largest / smallest;
    if (!settle_signs) return result;

    const double norm_G_prime = two_norm(system.G_prime()), norm_G = two_norm(system.G());
    result.uncertainty = uncertainty_of_eigenvalues(pair, norm_G_prime, norm_G);
    for (Eigen::Index k = 0; k < n; ++k) {
        if (!(result.beta[k] > 0)) continue;
        const double growth = result.alpha[k].real() / result.beta[k];
        if (std::abs(growth) > result.uncertainty[k]) --result.uncertain_count;
        if (growth > result.uncertainty[k]) ++result.settled_unstable_count;
    }
    const double middle = std::sqrt(slowest * result.spectral_radius);
    if (result.uncertain_count > 0 && result.unstable_count == 0 && is_finite(middle) && middle > 0) {
        result.decay_proved = all_decay(system, middle, norm_G_prime, norm_G);
    }
    return result;
}

}  // namespace rollbem::detail

namespace rollbem {

ROLLBEM_DECL StabilityResult solve_stability(const RollingSystem<double>& system) {
    return detail::find_eigenvalues(system, false);
}

ROLLBEM_DECL double condition_number(const MatrixX<double>& A) {
    const MatrixX<double> inverse = Eigen::PartialPivLU<MatrixX<double>>(A).inverse();
    if (!detail::all_finite(inverse)) return std::numeric_limits<double>::infinity();
    return detail::two_norm(A) * detail::two_norm(inverse);
}

ROLLBEM_DECL StabilityResult judge_stability(const RollingSystem<double>& system) {
    return detail::find_eigenvalues(system, true);
}

ROLLBEM_DECL StabilityVerdict judge_stability(const ElementSystem<double, 2>& system) {
    if (system.coupled()) return judge_stability(system.joined());
    const auto direction = [&](std::size_t d) -> StabilityVerdict {
        return judge_stability(RollingSystem<double>(system.G(d, d), system.G_prime(d, d), system.elements().areas));
    };
    return direction(0) + direction(1);
}

ROLLBEM_DECL StabilityVerdict judge_stability(const std::vector<RollingSystem<double>>& subsystems) {
    StabilityVerdict all{.spectral_abscissa = -std::numeric_limits<double>::infinity(), .status = Status::ok};
    for (const RollingSystem<double>& subsystem : subsystems) all = all + judge_stability(subsystem);
    return all;
}

}  // namespace rollbem
