// Bodies of adhesion/response.hpp. Internal.
#pragma once

#include "../response.hpp"

#include <algorithm>
#include <complex>
#include <limits>
#include <type_traits>
#include <utility>

#include <Eigen/LU>

#include "../../detail/finite.hpp"
#include "../../detail/reciprocal_condition.hpp"
#include "../../detail/require.hpp"
#include "../../status.hpp"
#include "../../system/detail/dissipation.hpp"
#include "../../system/detail/response_parts.hpp"
#include "../../system/response.hpp"
#include "../../system/rolling_system.hpp"
#include "../../types.hpp"

namespace rollbem::detail {

/// Sets Status::assists_creepage unless the tractions of steady rolling oppose the creepage.
template <class Value>
void judge_tractions(const MatrixX<typename Response<Value>::Scalar>& steady,
                     const ArrayX<typename Response<Value>::Scalar>& widths, Response<Value>& response);

template <class Scalar>
void require_equations(const MatrixX<Scalar>& G_prime);

template <class Scalar>
void require_growth(const char* who, const std::complex<Scalar>& s);

/// The divisor of equations in G' - s G that prevents overflow for any finite s.
template <class Scalar>
Scalar equation_scale(const std::complex<Scalar>& s) {
    return (std::max)({Scalar(1), std::abs(s.real()), std::abs(s.imag())});
}

/// Solves (G' - s G) p = inputs, without judging the tractions of steady rolling.
template <class Scalar>
Response<std::complex<Scalar>> solve_growing(const RollingSystem<Scalar>& system, const std::complex<Scalar>& s);

template <class Value, class Scalar>
Factorised<Value> factorise(MatrixX<Value>& A, const MatrixX<Scalar>& inputs, const MatrixX<Scalar>& outputs) {
    const Eigen::Index n = A.rows();
    Response<Value> response;
    VectorX<Scalar> row_sums = VectorX<Scalar>::Zero(n), magnitudes(n);
    Scalar norm_1 = 0;
    for (Eigen::Index j = 0; j < n; ++j) {
        magnitudes = A.col(j).cwiseAbs();
        row_sums += magnitudes;
        norm_1 = (std::max)(norm_1, magnitudes.sum());
    }
    const Eigen::PartialPivLU<Eigen::Ref<MatrixX<Value>>> lu(A);
    response.unknowns.resize(n, inputs.cols());
    for (Eigen::Index j = 0; j < inputs.cols(); ++j) {
        response.unknowns.col(j) = lu.solve(inputs.col(j).template cast<Value>());
    }
    response.coefficients.noalias() = -(outputs.transpose().template cast<Value>() * response.unknowns);
    const bool finite = all_finite(row_sums) && all_finite(response.unknowns) && all_finite(response.coefficients);
    if (finite) response.rcond = reciprocal_condition(lu, norm_1);
    return {std::move(response), row_sums.maxCoeff(), finite};
}

template <class Value, class Scalar>
Response<Value> judge(Factorised<Value> factorised, MatrixX<Value> product, const MatrixX<Scalar>& inputs) {
    Response<Value> response = std::move(factorised.response);
    if (!factorised.finite) return response;
    product -= inputs;
    const Scalar size = factorised.norm * response.unknowns.cwiseAbs().maxCoeff() + inputs.cwiseAbs().maxCoeff();
    response.residual =
        all_finite(product) ? product.cwiseAbs().maxCoeff() / size : std::numeric_limits<Scalar>::infinity();
    const int allowed = Eigen::NumTraits<Value>::IsComplex ? 1 : 100;
    response.status = trust(product.rows(), response.rcond, response.residual, allowed);
    return response;
}

template <class Value, class Scalar>
Response<Value> solve_copied(MatrixX<Value> A, const MatrixX<Scalar>& inputs, const MatrixX<Scalar>& outputs) {
    const MatrixX<Value> original = A;
    Factorised<Value> factorised = factorise(A, inputs, outputs);
    MatrixX<Value> product = original * factorised.response.unknowns;
    return judge(std::move(factorised), std::move(product), inputs);
}

template <class Value>
void judge_tractions(const MatrixX<typename Response<Value>::Scalar>& steady,
                     const ArrayX<typename Response<Value>::Scalar>& widths, Response<Value>& response) {
    if (response.status == Status::ok && !opposes_creepage<typename Response<Value>::Scalar>(steady.col(0), widths)) {
        response.status = Status::assists_creepage;
    }
}

template <class Scalar>
void require_equations(const MatrixX<Scalar>& G_prime) {
    require(G_prime.rows() > 0 && G_prime.cols() == G_prime.rows(), "solve_steady", "number of columns of G_prime",
            G_prime.cols(), "be positive and equal the number of rows");
}

template <class Scalar>
void require_growth(const char* who, const std::complex<Scalar>& s) {
    require_finite(who, "Re(s)", s.real());
    require_finite(who, "Im(s)", s.imag());
}

template <class Scalar>
Response<std::complex<Scalar>> solve_growing(const RollingSystem<Scalar>& system, const std::complex<Scalar>& s) {
    const Scalar scale = equation_scale(s);
    MatrixX<std::complex<Scalar>> A(system.size(), system.size());
    A.real() = system.G_prime() / scale - (s.real() / scale) * system.G();
    A.imag() = -(s.imag() / scale) * system.G();
    return solve_copied<std::complex<Scalar>, Scalar>(std::move(A), system.inputs() / scale, system.outputs());
}

}  // namespace rollbem::detail

namespace rollbem {

template <class Scalar>
Response<Scalar> solve_steady(MatrixX<Scalar> G_prime, const MatrixX<Scalar>& inputs, const MatrixX<Scalar>& outputs) {
    detail::require_equations(G_prime);
    const Eigen::Index n = G_prime.rows();
    detail::require(inputs.rows() == n, "solve_steady", "number of rows of inputs", inputs.rows(),
                    "equal the number of rows of G_prime");
    detail::require(outputs.rows() == n, "solve_steady", "number of rows of outputs", outputs.rows(),
                    "equal the number of rows of G_prime");
    return detail::solve_copied<Scalar, Scalar>(std::move(G_prime), inputs, outputs);
}

template <class Scalar>
Response<Scalar> solve_steady(MatrixX<Scalar> G_prime, const ArrayX<Scalar>& widths) {
    detail::require_equations(G_prime);
    detail::require(widths.size() == G_prime.cols(), "solve_steady", "number of widths", widths.size(),
                    "equal the number of columns of G_prime");
    const MatrixX<Scalar> ones = MatrixX<Scalar>::Ones(widths.size(), 1), outputs = widths.matrix();
    Response<Scalar> response = solve_steady<Scalar>(std::move(G_prime), ones, outputs);
    detail::judge_tractions(response.unknowns, widths, response);
    return response;
}

template <class Scalar>
Response<Scalar> solve_steady(const RollingSystem<Scalar>& system) {
    Response<Scalar> response = solve_steady<Scalar>(system.G_prime(), system.inputs(), system.outputs());
    if (system.unknowns_are_tractions()) {
        detail::judge_tractions(response.unknowns, system.weights(), response);
    }
    return response;
}

template <class Scalar>
Response<std::complex<Scalar>> solve_response(const RollingSystem<Scalar>& system,
                                              std::type_identity_t<std::complex<Scalar>> s) {
    detail::require_growth("solve_response", s);
    Response<std::complex<Scalar>> response = detail::solve_growing(system, s);
    if (response.status == Status::ok && system.unknowns_are_tractions()) {
        const MatrixX<Scalar> steady = system.G_prime().partialPivLu().solve(system.inputs().leftCols(1));
        detail::judge_tractions(steady, system.weights(), response);
    }
    return response;
}

}  // namespace rollbem
