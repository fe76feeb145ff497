// Bodies of steady/steady.hpp. Internal.
#pragma once

#include "../steady.hpp"

#include <utility>

#include "../../adhesion/response.hpp"
#include "../../assembly/rolling_system.hpp"
#include "../../detail/array_functions.hpp"
#include "../../discretisation/mesh.hpp"
#include "../../discretisation/scheme.hpp"
#include "../../elasticity/line_kernel.hpp"
#include "../../types.hpp"

namespace rollbem {

namespace detail {

/// Up to this number of unknowns a copy of G' gives the residual. Above it, the rows of G' are computed again, which
/// costs little beside the LU decomposition and halves the memory.
inline constexpr Eigen::Index largest_copied_G_prime = 1000;

template <class Scalar, RollingScheme<Scalar> Scheme, LineKernel Kernel>
Response<Scalar> solve_steady_on(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
    const SchemeRows<Scalar> rows = scheme_rows(scheme, Quantity::slope, mesh);
    const KernelView<Scalar> view(kernel);
    const ArrayX<Scalar> widths = segment(mesh.widths(), 0, rows.unknown_count);
    MatrixX<Scalar> G_prime = influence_matrix<Scalar>(mesh, rows, view, Quantity::slope);
    if (widths.size() <= largest_copied_G_prime) return solve_steady<Scalar>(std::move(G_prime), widths);
    const MatrixX<Scalar> ones = MatrixX<Scalar>::Ones(widths.size(), 1), outputs = widths.matrix();
    Factorised<Scalar> factorised = factorise(G_prime, ones, outputs);
    const VectorX<Scalar> p = factorised.response.unknowns.col(0);
    Response<Scalar> response = judge<Scalar, Scalar>(
        std::move(factorised), influence_product<Scalar>(mesh, rows, view, Quantity::slope, p), ones);
    judge_tractions(response.unknowns, widths, response);
    return response;
}

}  // namespace detail

template <class Scalar, class Scheme, class Kernel>
Response<Scalar> solve_steady(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
    return detail::solve_steady_on(mesh, scheme, kernel);  // checks the concepts, for short messages of the compiler
}

}  // namespace rollbem
