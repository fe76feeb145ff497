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
#include "../scene/contact.hpp"
#include "../status.hpp"
#include "detail/consistency.hpp"

namespace rollbem {

/// Solution of a steady problem for unit creepage, dimensionless.
template <class Scalar>
struct UnitSteadySolution {
    VectorX<Scalar> traction;  ///< p / (G xi) of every unknown element, trailing
                               ///< to leading [-]; negative
    Scalar c11 = 0;            ///< creep coefficient -F_bar / (a G xi) [-], Eq. (30)
    Scalar residual = 0;       ///< |G' p - xi| / (|G'| |p| + |xi|) in the maximum norm [-]
    Scalar rcond = 0;          ///< estimate of 1 / (|G'| |G'^-1|) in the 1-norm [-]
    Status status = Status::not_finite;
};

/// Solution of a steady problem in the units of the contact's parameters.
template <class Scalar>
struct SteadySolution {
    VectorX<Scalar> traction;    ///< p on body 1 of each of the mesh's n elements
                                 ///< [Pa], trailing to leading
    Scalar force_per_width = 0;  ///< F_bar = -a G c11 xi [N/m], Eq. (30)
    Scalar c11 = 0;              ///< creep coefficient [-]
    Scalar residual = 0;         ///< as in UnitSteadySolution
    Scalar rcond = 0;            ///< as in UnitSteadySolution
    Status status = Status::not_finite;
};

/// Solution of a steady problem under lateral creepage, in the units of the contact's parameters.
template <class Scalar>
struct LateralSteadySolution {
    VectorX<Scalar> traction;    ///< q along y on body 1 of each of the mesh's n elements
                                 ///< [Pa], trailing to leading
    Scalar force_per_width = 0;  ///< F_y = -a G c22 xi_y [N/m]
    Scalar c22 = 0;              ///< lateral creep coefficient [-]; pi/2 for b >> a, see steady_c22
    Scalar residual = 0;         ///< as in UnitSteadySolution
    Scalar rcond = 0;            ///< as in UnitSteadySolution
    Status status = Status::not_finite;
};

namespace detail {

template <class Scalar>
struct FactorisedSteady {
    UnitSteadySolution<Scalar> solution;  ///< without residual and status
    Scalar norm;                          ///< |G'| in the maximum norm
    bool finite;                          ///< whether G' and the tractions are
};

/// Factorises G' in place and solves G' p = 1.
template <class Scalar>
FactorisedSteady<Scalar> factorise_steady(MatrixX<Scalar>& G_prime, const ArrayX<Scalar>& widths) {
    const Eigen::Index n = G_prime.rows();
    FactorisedSteady<Scalar> result;
    UnitSteadySolution<Scalar>& solution = result.solution;
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
    solution.c11 = -dot(widths.data(), solution.traction.data(), n);
    result.finite = all_finite(row_sums) && all_finite(solution.traction) && is_finite(solution.c11);
    if (!result.finite) return result;
    solution.rcond = reciprocal_condition(lu, norm_1);
    return result;
}

/// The solution with residual and status. `product` is the original G' times the tractions.
template <class Scalar>
UnitSteadySolution<Scalar> judge_steady(FactorisedSteady<Scalar> factorised, const ArrayX<Scalar>& widths,
                                        const VectorX<Scalar>& product) {
    const Eigen::Index n = widths.size();
    UnitSteadySolution<Scalar> solution = std::move(factorised.solution);
    Scalar largest_residual = 0, largest_traction = 0;
    for (Eigen::Index l = 0; l < n; ++l) {
        largest_residual = std::max(largest_residual, std::abs(product[l] - 1));
        largest_traction = std::max(largest_traction, std::abs(solution.traction[l]));
    }
    solution.residual = all_finite(product) ? largest_residual / (factorised.norm * largest_traction + 1)
                                            : std::numeric_limits<Scalar>::infinity();
    const Scalar rounding = static_cast<Scalar>(n) * std::numeric_limits<Scalar>::epsilon();
    const bool trusted = is_finite(solution.rcond) && solution.rcond > 100 * rounding && is_finite(solution.residual) &&
                         solution.residual <= 100 * rounding;
    solution.status = !trusted                                              ? Status::ill_conditioned
                      : opposes_creepage<Scalar>(solution.traction, widths) ? Status::ok
                                                                            : Status::inconsistent;
    return solution;
}

/// Factorises G' in place and solves G' p = 1. product(p) is the original G' times p.
template <class Scalar, class Product>
UnitSteadySolution<Scalar> solve_steady_in_place(MatrixX<Scalar>& G_prime, const ArrayX<Scalar>& widths,
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
UnitSteadySolution<Scalar> solve_steady(MatrixX<Scalar> G_prime, const ArrayX<Scalar>& widths) {
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
/// take the place of these, and the status is then never inconsistent.
template <class Scalar>
UnitSteadySolution<Scalar> solve_steady(const RollingSystem<Scalar>& system) {
    detail::require_single_input("solve_steady", system);
    UnitSteadySolution<Scalar> solution = solve_steady<Scalar>(system.G_prime(), system.weights());
    if (solution.status == Status::inconsistent && !system.unknowns_are_tractions()) solution.status = Status::ok;
    return solution;
}

namespace detail {

template <class Scalar, RollingScheme<Scalar> Scheme, LineKernel Kernel>
UnitSteadySolution<Scalar> solve_steady_on(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
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

/// Assembles and solves for unit creepage, dimensionless (a = G = 1), by a RollingScheme and with a LineKernel. Above
/// 1000 elements the memory is that of one matrix and a multiple of n (for Galerkin by quadrature two matrices). Throws
/// std::invalid_argument if the scheme does not fit the mesh.
template <class Scalar, class Scheme, class Kernel>
UnitSteadySolution<Scalar> solve_steady(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
    return detail::solve_steady_on(mesh, scheme, kernel);  // checks the concepts, for short messages of the compiler
}

namespace detail {

/// A unit solution times a creepage, in the units of the contact; elements without an unknown carry no traction.
template <class Scalar>
SteadySolution<Scalar> steady_in_units(const Contact<Scalar>& contact, Eigen::Index elements,
                                       const UnitSteadySolution<Scalar>& unit, Scalar creepage) {
    SteadySolution<Scalar> solution;
    solution.traction.resize(elements);
    for (Eigen::Index i = 0; i < elements; ++i) {
        solution.traction[i] =
            i < unit.traction.size() ? contact.shear_modulus() * creepage * unit.traction[i] : Scalar(0);
    }
    solution.force_per_width = -contact.half_length() * contact.shear_modulus() * unit.c11 * creepage;
    solution.c11 = unit.c11;
    solution.residual = unit.residual;
    solution.rcond = unit.rcond;
    const bool finite = all_finite(solution.traction) && is_finite(solution.force_per_width);
    solution.status = is_finite(creepage) && finite ? unit.status : Status::not_finite;
    return solution;
}

}  // namespace detail

/// Steady rolling of a contact at a longitudinal creepage (positive creepage, negative traction), strip kernel. Throws
/// std::invalid_argument if the scheme does not fit the mesh; a creepage or a result that is not finite gives
/// Status::not_finite.
template <class Scalar, RollingScheme<Scalar> Scheme>
SteadySolution<Scalar> solve_steady(const Contact<Scalar>& contact, const Mesh<Scalar>& mesh, const Scheme& scheme,
                                    std::type_identity_t<Scalar> creepage) {
    return detail::steady_in_units<Scalar>(
        contact, mesh.size(), solve_steady(mesh, scheme, StripKernel<Scalar>::longitudinal(contact)), creepage);
}

/// The same at a lateral creepage: traction and force act along y, and the coefficient is c22.
template <class Scalar, RollingScheme<Scalar> Scheme>
LateralSteadySolution<Scalar> solve_steady_lateral(const Contact<Scalar>& contact, const Mesh<Scalar>& mesh,
                                                   const Scheme& scheme, std::type_identity_t<Scalar> creepage) {
    SteadySolution<Scalar> solution = detail::steady_in_units<Scalar>(
        contact, mesh.size(), solve_steady(mesh, scheme, StripKernel<Scalar>::lateral(contact)), creepage);
    return {std::move(solution.traction),
            solution.force_per_width,
            solution.c11,
            solution.residual,
            solution.rcond,
            solution.status};
}

}  // namespace rollbem
