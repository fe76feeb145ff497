// Steady rolling with full adhesion: G' p = xi, Eq. (15), and the creep coefficient c11 of Eq. (30).
// Builds G' alone and factorises it in place.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include <Eigen/LU>

#include "../assembly/influence.hpp"
#include "../assembly/rolling_system.hpp"
#include "../detail/array_functions.hpp"
#include "../detail/finite.hpp"
#include "../detail/reciprocal_condition.hpp"
#include "../discretisation/mesh.hpp"
#include "../discretisation/scheme.hpp"
#include "../elasticity/line_kernel.hpp"
#include "../rolling/consistency.hpp"
#include "../scene/contact.hpp"
#include "../status.hpp"
#include "../system/contact_fit.hpp"

namespace rollbem {

/// Solution of a steady problem; for unit creepage dimensionless, with a = G = xi = 1. Creepage, tractions and force act
/// along the kernel's direction: with a lateral kernel c11 is c22.
template <class Scalar>
struct SteadySolution {
    VectorX<Scalar> traction;    ///< p on body 1 [Pa], trailing to leading, against the creepage
    Scalar force_per_width = 0;  ///< F_bar = -a G c11 xi [N/m], Eq. (30)
    Scalar c11 = 0;              ///< creep coefficient [-]; see steady_c11 and steady_c22 for b >> a
    Scalar residual = 0;         ///< |G' p - xi| / (|G'| |p| + |xi|) in the maximum norm [-]
    Scalar rcond = 0;            ///< estimate of 1 / (|G'| |G'^-1|) in the 1-norm [-]
    Status status = Status::not_finite;
};

namespace detail {

template <class Scalar>
struct FactorisedSteady {
    SteadySolution<Scalar> solution;  ///< without residual and status
    Scalar norm;                      ///< |G'| in the maximum norm
    bool finite;                      ///< whether G' and the tractions are
};

/// Factorises G' in place and solves G' p = 1.
template <class Scalar>
FactorisedSteady<Scalar> factorise_steady(MatrixX<Scalar>& G_prime, const ArrayX<Scalar>& widths) {
    const Eigen::Index n = G_prime.rows();
    FactorisedSteady<Scalar> result;
    SteadySolution<Scalar>& solution = result.solution;
    VectorX<Scalar> row_sums(n), ones(n);
    for (Eigen::Index l = 0; l < n; ++l) {
        row_sums[l] = 0;
        ones[l] = 1;
    }
    for (Eigen::Index m = 0; m < n; ++m) {
        for (Eigen::Index l = 0; l < n; ++l) row_sums[l] += std::abs(G_prime(l, m));
    }
    result.norm = row_sums.maxCoeff();
    const Scalar norm_1 = one_norm(G_prime);
    const Eigen::PartialPivLU<Eigen::Ref<MatrixX<Scalar>>> lu(G_prime);
    solution.traction = lu.solve(ones);
    solution.force_per_width = dot(widths.data(), solution.traction.data(), n);
    solution.c11 = -solution.force_per_width;
    result.finite = all_finite(row_sums) && all_finite(solution.traction) && is_finite(solution.c11);
    if (!result.finite) return result;
    solution.rcond = reciprocal_condition(lu, norm_1);
    return result;
}

/// The solution with residual and status. `product` is the original G' times the tractions.
template <class Scalar>
SteadySolution<Scalar> judge_steady(FactorisedSteady<Scalar> factorised, const ArrayX<Scalar>& widths,
                                    const VectorX<Scalar>& product) {
    const Eigen::Index n = widths.size();
    SteadySolution<Scalar> solution = std::move(factorised.solution);
    Scalar largest_residual = 0, largest_traction = 0;
    for (Eigen::Index l = 0; l < n; ++l) {
        largest_residual = (std::max)(largest_residual, std::abs(product[l] - 1));
        largest_traction = (std::max)(largest_traction, std::abs(solution.traction[l]));
    }
    solution.residual = all_finite(product) ? largest_residual / (factorised.norm * largest_traction + 1)
                                            : std::numeric_limits<Scalar>::infinity();
    const Scalar rounding = static_cast<Scalar>(n) * std::numeric_limits<Scalar>::epsilon();
    const bool trusted = is_finite(solution.rcond) && solution.rcond > 100 * rounding && is_finite(solution.residual) &&
                         solution.residual <= 100 * rounding;
    solution.status = !trusted                                              ? Status::ill_conditioned
                      : opposes_creepage<Scalar>(solution.traction, widths) ? Status::ok
                                                                            : Status::assists_creepage;
    return solution;
}

/// Factorises G' in place and solves G' p = 1. product(p) is the original G' times p.
template <class Scalar, class Product>
SteadySolution<Scalar> solve_steady_in_place(MatrixX<Scalar>& G_prime, const ArrayX<Scalar>& widths,
                                             const Product& product) {
    FactorisedSteady<Scalar> factorised = factorise_steady(G_prime, widths);
    if (!factorised.finite) return std::move(factorised.solution);
    const VectorX<Scalar> original_times_p = product(factorised.solution.traction);
    return judge_steady(std::move(factorised), widths, original_times_p);
}

/// Up to this number of unknowns a copy of G' gives the residual; above it, computing the rows of G' again costs less
/// than a tenth of the LU decomposition and saves half the memory.
inline constexpr Eigen::Index largest_copied_G_prime = 1000;

}  // namespace detail

/// Solves G' p = 1 for any G' (in units of 1/G) and the widths of its elements (in units of a). G' is passed by value:
/// the factors overwrite it, and a copy gives the residual. Throws std::invalid_argument unless G' is square with as
/// many columns as there are widths.
template <class Scalar>
SteadySolution<Scalar> solve_steady(MatrixX<Scalar> G_prime, const ArrayX<Scalar>& widths) {
    const Eigen::Index n = G_prime.rows();
    detail::require(n > 0 && G_prime.cols() == n, "solve_steady", "number of columns of G_prime", G_prime.cols(),
                    "be positive and equal the number of rows");
    detail::require(widths.size() == n, "solve_steady", "number of widths", widths.size(),
                    "equal the number of columns of G_prime");
    const MatrixX<Scalar> original = G_prime;
    return detail::solve_steady_in_place<Scalar>(
        G_prime, widths, [&](const VectorX<Scalar>& p) -> VectorX<Scalar> { return original * p; });
}

/// The same for a system of one input; see solve_steady_response for several. Unknowns that are not tractions
/// take the place of these, and the status is then never assists_creepage.
template <class Scalar>
SteadySolution<Scalar> solve_steady(const RollingSystem<Scalar>& system) {
    detail::require_single_input("solve_steady", system);
    SteadySolution<Scalar> solution = solve_steady<Scalar>(system.G_prime(), system.weights());
    if (solution.status == Status::assists_creepage && !system.unknowns_are_tractions()) solution.status = Status::ok;
    return solution;
}

namespace detail {

template <class Scalar, RollingScheme<Scalar> Scheme, ElementKernel Kernel>
SteadySolution<Scalar> solve_steady_on(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
    const SchemeRows<Scalar> rows = scheme_rows(scheme, Quantity::slope, mesh);
    const KernelView<Scalar> view(kernel);
    const ArrayX<Scalar> widths = segment(mesh.widths(), 0, rows.unknown_count);
    MatrixX<Scalar> G_prime = influence_matrix<Scalar>(mesh, rows, view, Quantity::slope);
    if (widths.size() <= largest_copied_G_prime) return solve_steady<Scalar>(std::move(G_prime), widths);
    return solve_steady_in_place<Scalar>(G_prime, widths, [&](const VectorX<Scalar>& p) {
        return influence_product<Scalar>(mesh, rows, view, Quantity::slope, p);
    });
}

}  // namespace detail

/// Assembles and solves for unit creepage, dimensionless (a = G = 1), by a RollingScheme and with an ElementKernel. Above
/// 1000 elements the memory is that of one matrix and a multiple of n (for Galerkin by quadrature two matrices). Throws
/// std::invalid_argument if the scheme does not fit the mesh.
template <class Scalar, class Scheme, class Kernel>
SteadySolution<Scalar> solve_steady(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
    return detail::solve_steady_on(mesh, scheme, kernel);  // checks the concepts, for short messages of the compiler
}

/// Steady rolling of a contact at a creepage along the direction of one of its kernels (positive creepage, negative
/// traction). `traction` has an entry for each of the mesh's n elements, 0 for those without an unknown. Throws
/// std::invalid_argument if the scheme does not fit the mesh or the kernel's b/a is not the contact's; a creepage or a
/// result that is not finite gives Status::not_finite.
template <class Scalar, RollingScheme<Scalar> Scheme, ElementKernel Kernel>
SteadySolution<Scalar> solve_steady(const Contact<Scalar>& contact, const Mesh<Scalar>& mesh, const Scheme& scheme,
                                    const Kernel& kernel, std::type_identity_t<Scalar> creepage) {
    detail::require_same_aspect("solve_steady", contact, detail::aspect_of<Scalar>(kernel));
    SteadySolution<Scalar> solution = solve_steady(mesh, scheme, kernel);
    solution.traction *= contact.shear_modulus() * creepage;
    solution.traction.conservativeResizeLike(VectorX<Scalar>::Zero(mesh.size()));
    solution.force_per_width = -contact.half_length() * contact.shear_modulus() * solution.c11 * creepage;
    const bool finite = detail::all_finite(solution.traction) && detail::is_finite(solution.force_per_width);
    if (!detail::is_finite(creepage) || !finite) solution.status = Status::not_finite;
    return solution;
}

/// The same at a longitudinal creepage, strip kernel.
template <class Scalar, RollingScheme<Scalar> Scheme>
SteadySolution<Scalar> solve_steady(const Contact<Scalar>& contact, const Mesh<Scalar>& mesh, const Scheme& scheme,
                                    std::type_identity_t<Scalar> creepage) {
    return solve_steady(contact, mesh, scheme, StripKernel<Scalar>::longitudinal(contact), creepage);
}

}  // namespace rollbem
