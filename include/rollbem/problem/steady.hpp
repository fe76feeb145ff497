// Steady rolling with full adhesion: G' p = xi, Eq. (15), and the creep coefficient c11 of Eq. (30).
// Builds G' alone and factorises it in place.
#pragma once

#include "../detail/language.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <type_traits>
#include <utility>

#include <Eigen/LU>

#include "../assembly/influence.hpp"
#include "../detail/finite.hpp"
#include "../detail/reciprocal_condition.hpp"
#include "../discretisation/mesh.hpp"
#include "../discretisation/scheme.hpp"
#include "../elasticity/line_kernel.hpp"
#include "../scene/contact.hpp"
#include "adhesion.hpp"
#include "status.hpp"

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

namespace detail {

/// Factorises G' in place and solves G' p = 1. product(p) is the original G' times p.
template <class Scalar>
UnitSteadySolution<Scalar> solve_steady_in_place(
    Eigen::Ref<MatrixX<Scalar>> G_prime, const ArrayX<Scalar>& widths,
    const std::function<VectorX<Scalar>(const VectorX<Scalar>&)>& product) {
    const Eigen::Index n = G_prime.rows();
    UnitSteadySolution<Scalar> solution;
    ArrayX<Scalar> row_sums = ArrayX<Scalar>::Zero(n);
    for (Eigen::Index m = 0; m < n; ++m) row_sums += G_prime.col(m).array().abs();
    const Scalar norm = row_sums.maxCoeff(), norm_1 = one_norm(G_prime);
    const Eigen::PartialPivLU<Eigen::Ref<MatrixX<Scalar>>> lu(G_prime);
    solution.traction = lu.solve(VectorX<Scalar>::Ones(n));
    solution.c11 = -(widths * solution.traction.array()).sum();
    if (!all_finite(row_sums) || !all_finite(solution.traction) || !is_finite(solution.c11)) return solution;
    solution.residual = (product(solution.traction).array() - 1).abs().maxCoeff() /
                        (norm * solution.traction.cwiseAbs().maxCoeff() + 1);
    solution.rcond = reciprocal_condition(lu, norm_1);
    const Scalar rounding = static_cast<Scalar>(n) * std::numeric_limits<Scalar>::epsilon();
    const bool trusted = is_finite(solution.rcond) && solution.rcond > 100 * rounding && is_finite(solution.residual) &&
                         solution.residual <= 100 * rounding;
    solution.status = !trusted                                              ? Status::ill_conditioned
                      : opposes_creepage<Scalar>(solution.traction, widths) ? Status::ok
                                                                            : Status::inconsistent;
    return solution;
}

/// Unknowns up to which a copy of G' gives the residual; above, computing its rows anew costs less than a tenth of LU
/// and saves half the memory.
inline constexpr Eigen::Index largest_copied_G_prime = 1000;

}  // namespace detail

/// Solves G' p = 1 for any G' (in units of 1/G) and the widths of its elements (in units of a). Takes G' by value: the
/// factors overwrite it; a copy gives the residual. Throws std::invalid_argument unless G' is square with as many
/// columns as there are widths.
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

/// Assembles and solves for unit creepage, dimensionless (a = G = 1). Above 1000 elements the memory is that of one
/// matrix and a multiple of n (for Galerkin by quadrature two matrices). Throws as assemble_G_prime does.
template <class Scalar, class Scheme, LineKernel Kernel>
UnitSteadySolution<Scalar> solve_steady(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
    const ArrayX<Scalar> widths = unknown_widths(mesh, scheme);
    MatrixX<Scalar> G_prime = assemble_G_prime(mesh, scheme, kernel);
    if (widths.size() <= detail::largest_copied_G_prime) return solve_steady<Scalar>(std::move(G_prime), widths);
    return detail::solve_steady_in_place<Scalar>(
        G_prime, widths, [&](const VectorX<Scalar>& p) { return detail::G_prime_times(mesh, scheme, kernel, p); });
}

/// Steady rolling of a contact at a longitudinal creepage (positive creepage, negative traction), strip kernel.
/// Throws as assemble_G_prime does; a creepage, or a result, that is not finite gives Status::not_finite.
template <class Scalar, class Scheme>
SteadySolution<Scalar> solve_steady(const Contact<Scalar>& contact, const Mesh<Scalar>& mesh, const Scheme& scheme,
                                    std::type_identity_t<Scalar> creepage) {
    const UnitSteadySolution<Scalar> unit = solve_steady(mesh, scheme, StripKernel<Scalar>::longitudinal(contact));
    SteadySolution<Scalar> solution;
    solution.traction.setZero(mesh.size());
    solution.traction.head(unit.traction.size()) = contact.shear_modulus() * creepage * unit.traction;
    solution.force_per_width = -contact.half_length() * contact.shear_modulus() * unit.c11 * creepage;
    solution.c11 = unit.c11;
    solution.residual = unit.residual;
    solution.rcond = unit.rcond;
    const bool finite = detail::all_finite(solution.traction) && detail::is_finite(solution.force_per_width);
    solution.status = detail::is_finite(creepage) && finite ? unit.status : Status::not_finite;
    return solution;
}

#ifdef ROLLBEM_INSTANCES  // compiled once for all programs of this project
extern template UnitSteadySolution<double> detail::solve_steady_in_place<double>(
    Eigen::Ref<MatrixX<double>>, const ArrayX<double>&, const std::function<VectorX<double>(const VectorX<double>&)>&);
#endif

}  // namespace rollbem
