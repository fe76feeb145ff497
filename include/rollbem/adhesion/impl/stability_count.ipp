// Bodies of adhesion/stability_count.hpp. Internal.
#pragma once

#include "../stability_count.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "../../detail/finite.hpp"
#include "../../detail/reciprocal_condition.hpp"

namespace rollbem {

ROLLBEM_DECL UnstableCount count_unstable(const RollingSystem<double>& system) {
    UnstableCount result;
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

}  // namespace rollbem
