// B of Eq. (19) fitted by least squares to the integral of Eq. (20), as the paper obtains it: GSL quadrature with the
// logarithm and the root singularities in the weight. Independent of the closed form in monomial.hpp.
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <new>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <gsl/gsl_blas.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_linalg.h>

#include "../closed_form/carter.hpp"
#include "../detail/require.hpp"

namespace rollbem::reference {

namespace detail {

using rollbem::detail::require;

/// GSL's QAWS on one interval: weight (x-lower)^alpha (upper-x)^beta, times ln(x-lower) or ln(upper-x) on request.
class SingularQuadrature {
public:
    SingularQuadrature() : workspace_(gsl_integration_workspace_alloc(limit), &gsl_integration_workspace_free) {
        if (!workspace_) {
            throw std::bad_alloc();
        }
    }

    template <typename Function>
    double integrate(const Function& function, double lower, double upper, double alpha, double beta, bool lower_log,
                     bool upper_log) const {
        const std::unique_ptr<gsl_integration_qaws_table, decltype(&gsl_integration_qaws_table_free)> table(
            gsl_integration_qaws_table_alloc(alpha, beta, lower_log ? 1 : 0, upper_log ? 1 : 0),
            &gsl_integration_qaws_table_free);
        if (!table) {
            throw std::bad_alloc();
        }
        gsl_function integrand{};
        integrand.function = [](double x, void* data) { return (*static_cast<const Function*>(data))(x); };
        integrand.params = const_cast<Function*>(&function);  // GSL's interface lacks const; it is only read
        double result = 0;
        double error = 0;
        const int status = gsl_integration_qaws(&integrand, lower, upper, table.get(), 1e-13, 1e-12, limit,
                                                workspace_.get(), &result, &error);
        if (status != GSL_SUCCESS && !(error < 1e-10)) {
            throw std::runtime_error(std::string("reference::fitted_displacement_matrix: GSL: ") +
                                     gsl_strerror(status));
        }
        return result;
    }

private:
    static constexpr std::size_t limit = 200;
    std::unique_ptr<gsl_integration_workspace, decltype(&gsl_integration_workspace_free)> workspace_;
};

}  // namespace detail

/// U_j(x)/a of Eq. (20) for P_j = x^j/sqrt(1-x^2), G = 1, -1 < x < 1, by adaptive quadrature. Throws
/// std::invalid_argument unless degree >= 0, -1 < x/a < 1, 0 <= poisson_ratio <= 0.5 and 0 < aspect < inf;
/// std::runtime_error if GSL fails.
inline double monomial_displacement(int degree, double x_over_a, double poisson_ratio, double aspect) {
    plane_lambda(poisson_ratio, aspect);  // checks both
    detail::require(degree >= 0, "reference::monomial_displacement", "degree", degree, "be at least 0");
    detail::require(std::abs(x_over_a) < 1, "reference::monomial_displacement", "x/a", x_over_a, "lie in (-1, 1)");
    const detail::SingularQuadrature quadrature;
    const double x = x_over_a;
    const double level = 2 * (1 - poisson_ratio) * std::log(2 * aspect) + 2 * poisson_ratio;
    const auto left = [degree](double t) { return std::pow(t, degree) / std::sqrt(1 - t); };
    const auto right = [degree](double t) { return std::pow(t, degree) / std::sqrt(1 + t); };
    const double logarithm = quadrature.integrate(left, -1, x, -0.5, 0, false, true) +
                             quadrature.integrate(right, x, 1, 0, -0.5, true, false);
    const double moment = quadrature.integrate(left, -1, x, -0.5, 0, false, false) +
                          quadrature.integrate(right, x, 1, 0, -0.5, false, false);
    return (level * moment - 2 * (1 - poisson_ratio) * logarithm) / std::numbers::pi;
}

/// B, (order+1) x (order+1) and lower triangular: each row is fitted to monomial_displacement at 2 (order + 1)
/// Chebyshev points by least squares. The loss of digits grows with the condition of the monomials, about 2.4^order:
/// useful up to order 20 or so. Throws std::invalid_argument unless order >= 0, 0 <= poisson_ratio <= 0.5 and
/// 0 < aspect < inf; std::runtime_error if GSL fails.
inline Eigen::MatrixXd fitted_displacement_matrix(int order, double poisson_ratio, double aspect) {
    detail::require(order >= 0, "reference::fitted_displacement_matrix", "order", order, "be at least 0");
    const int count = 2 * (order + 1);
    const auto points = static_cast<std::size_t>(count), unknowns = points / 2;
    std::vector<double> x(points), powers(points * unknowns), scales(unknowns), displacement(points);
    for (std::size_t i = 0; i < points; ++i) {
        x[i] = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.5) / count);
        for (std::size_t l = 0; l < unknowns; ++l) powers[i * unknowns + l] = std::pow(x[i], l);
    }
    // the factors for the first powers are a part of those for all
    gsl_matrix_view QR = gsl_matrix_view_array(powers.data(), points, unknowns);
    gsl_vector_view tau = gsl_vector_view_array(scales.data(), unknowns);
    gsl_linalg_QR_decomp(&QR.matrix, &tau.vector);
    Eigen::MatrixXd b = Eigen::MatrixXd::Zero(order + 1, order + 1);
    for (int j = 0; j <= order; ++j) {
        for (std::size_t i = 0; i < points; ++i) {
            displacement[i] = monomial_displacement(j, x[i], poisson_ratio, aspect);
        }
        gsl_vector_view right = gsl_vector_view_array(displacement.data(), points);
        gsl_linalg_QR_QTvec(&QR.matrix, &tau.vector, &right.vector);
        const std::size_t size = static_cast<std::size_t>(j) + 1;
        const gsl_matrix_view R = gsl_matrix_submatrix(&QR.matrix, 0, 0, size, size);
        gsl_vector_view row = gsl_vector_subvector(&right.vector, 0, size);
        gsl_blas_dtrsv(CblasUpper, CblasNoTrans, CblasNonUnit, &R.matrix, &row.vector);
        for (int l = 0; l <= j; ++l) b(j, l) = displacement[static_cast<std::size_t>(l)];
    }
    return b;
}

}  // namespace rollbem::reference
