// Response of a system to any number of creepages in full adhesion: steady, G' p = inputs, and to e^{st}, Eq. (16).
// All coefficients of a patch and its frequency response come from here.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <type_traits>

#include <Eigen/LU>

#include "../detail/finite.hpp"
#include "../detail/reciprocal_condition.hpp"
#include "../detail/require.hpp"
#include "../status.hpp"
#include "../system/rolling_system.hpp"
#include "../types.hpp"

namespace rollbem {

/// Unknowns and forces per unit of each of k creepages, dimensionless; Value is real for steady rolling, else complex.
template <class Value>
struct Response {
    using Scalar = typename Eigen::NumTraits<Value>::Real;

    MatrixX<Value> unknowns;      ///< n x k; of elements p / (G creepage) [-]
    MatrixX<Value> coefficients;  ///< k x k: entry (i, j) is minus force i per creepage j; c11 if k = 1 [-]
    Scalar residual = 0;          ///< |A p - inputs| / (|A| |p| + |inputs|) in the maximum norm, A = G' - s G [-]
    Scalar rcond = 0;             ///< estimate of 1 / (|A| |A^-1|) in the 1-norm [-]
    Status status = Status::not_finite;
};

namespace detail {

/// Solves A p = inputs. `allowed` is the least rcond in units of n eps.
template <class Value, class Scalar>
Response<Value> solve_response(const MatrixX<Value>& A, const MatrixX<Value>& inputs, const MatrixX<Scalar>& outputs,
                               Scalar allowed) {
    Response<Value> response;
    const MatrixX<Scalar> magnitudes = A.cwiseAbs();
    const Scalar norm = magnitudes.rowwise().sum().maxCoeff(), largest_input = inputs.cwiseAbs().maxCoeff();
    const Eigen::PartialPivLU<MatrixX<Value>> lu(A);
    response.unknowns.resize(inputs.rows(), inputs.cols());
    for (Eigen::Index j = 0; j < inputs.cols(); ++j) response.unknowns.col(j) = lu.solve(inputs.col(j));
    response.coefficients.noalias() = -(outputs.transpose().template cast<Value>() * response.unknowns);
    if (!all_finite(magnitudes) || !all_finite(response.unknowns) || !all_finite(response.coefficients)) {
        return response;
    }
    response.residual = (A * response.unknowns - inputs).cwiseAbs().maxCoeff() /
                        (norm * response.unknowns.cwiseAbs().maxCoeff() + largest_input);
    response.rcond = reciprocal_condition(lu, one_norm(magnitudes));
    const Scalar rounding = static_cast<Scalar>(A.rows()) * std::numeric_limits<Scalar>::epsilon();
    const bool trusted = is_finite(response.rcond) && response.rcond > allowed * rounding &&
                         is_finite(response.residual) && response.residual <= 100 * rounding;
    response.status = trusted ? Status::ok : Status::ill_conditioned;
    return response;
}

template <class Scalar>
void require_growth(const char* who, const std::complex<Scalar>& s) {
    require_finite(who, "Re(s)", s.real());
    require_finite(who, "Im(s)", s.imag());
}

/// The divisor of equations in G' - s G that prevents overflow for any finite s.
template <class Scalar>
Scalar equation_scale(const std::complex<Scalar>& s) {
    return (std::max)({Scalar(1), std::abs(s.real()), std::abs(s.imag())});
}

}  // namespace detail

/// Steady rolling: G' p = inputs, for ready matrices (G' n x n in units of 1/G, inputs and outputs n x k). Throws
/// std::invalid_argument if their sizes do not fit.
template <class Scalar>
Response<Scalar> solve_steady_response(const MatrixX<Scalar>& G_prime, const MatrixX<Scalar>& inputs,
                                       const MatrixX<Scalar>& outputs) {
    const Eigen::Index n = G_prime.rows();
    detail::require(n > 0 && G_prime.cols() == n, "solve_steady_response", "number of columns of G_prime",
                    G_prime.cols(), "be positive and equal the number of rows");
    detail::require(inputs.rows() == n, "solve_steady_response", "number of rows of inputs", inputs.rows(),
                    "equal that of G_prime");
    detail::require(outputs.rows() == n, "solve_steady_response", "number of rows of outputs", outputs.rows(),
                    "equal that of G_prime");
    return detail::solve_response<Scalar, Scalar>(G_prime, inputs, outputs, 100);
}

/// The same for a system.
template <class Scalar>
Response<Scalar> solve_steady_response(const RollingSystem<Scalar>& system) {
    return solve_steady_response(system.G_prime(), system.inputs(), system.outputs());
}

/// Response to creepages e^{st} for any complex s in units of V/a: (G' - s G) p = inputs; s = i omega a/V for harmonic
/// creepage. Throws std::invalid_argument if s is not finite.
template <class Scalar>
Response<std::complex<Scalar>> solve_response(const RollingSystem<Scalar>& system,
                                              std::type_identity_t<std::complex<Scalar>> s) {
    using Complex = std::complex<Scalar>;
    detail::require_growth("solve_response", s);
    const Scalar scale = detail::equation_scale(s);
    const Complex ratio(s.real() / scale, s.imag() / scale);
    MatrixX<Complex> A(system.size(), system.size());
    A.real() = system.G_prime() / scale - ratio.real() * system.G();
    A.imag() = -ratio.imag() * system.G();
    const MatrixX<Complex> inputs = (system.inputs() / scale).template cast<Complex>();
    return detail::solve_response<Complex, Scalar>(A, inputs, system.outputs(), 1);
}

}  // namespace rollbem
