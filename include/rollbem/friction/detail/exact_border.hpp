// Steady rolling by the exact border, if a single border separates slip behind it from stick ahead of it.
// Dimensionless, a = G = 1. Internal.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../elasticity/kernel_concepts.hpp"
#include "angular_points.hpp"
#include "border_search.hpp"
#include "law_violation.hpp"
#include "pressure_scan.hpp"
#include "stick_zone.hpp"
#include "stick_zone_problem.hpp"

namespace rollbem::detail {

/// An exact solution for solve_stick_border, for creepage >= 0.
template <class Scalar>
struct ExactBorder {
    StickZone<Scalar> zone;
    Scalar force, force_error, tangent;
    Scalar residual;  // violation of the law
    Eigen::Index coefficients, unknowns;
};

/// Empty if the pressure jumps, the force does not converge to `tolerance` or the law is violated.
template <class Scalar, class Kernel>
std::optional<ExactBorder<Scalar>> find_exact_border(const Kernel& kernel, const std::function<Scalar(Scalar)>& bound,
                                                     const PressureScan<Scalar>& scan, PointsOfLevels<Scalar>& levels,
                                                     Scalar creepage, int& evaluations) {
    const SmoothSplit<Scalar> split = kernel.smooth_split();
    if (scan.jumps || !(split.strength > 0) || !(split.distance >= least_distance<Scalar>)) return std::nullopt;

    StickZoneProblem<Scalar, Kernel, std::function<Scalar(Scalar)>> problem(kernel, bound);
    const auto [y, point, settled_to, rule] = settle_border(problem, levels, split, creepage, scan.load, evaluations);
    if (!is_finite(settled_to) || !is_finite(point.tangent)) return std::nullopt;

    const StickZone<Scalar>& zone = problem.zone(y < 2 ? point.creepage : creepage, rule);
    const LawCheck<Scalar> law = check_law(levels, std::max(scan.level, levels.of(*rule.points)), zone, bound,
                                           scan.largest, creepage, [&](Scalar x) { return kernel.smooth_slope(x); });
    const Scalar error = settled_to + law.force;
    const Scalar tolerance = std::max(Scalar(1e-6), 64 * std::numeric_limits<Scalar>::epsilon()) * scan.load;
    const bool holds =
        is_finite(law.force) && is_finite(law.residual) && error <= tolerance && law.residual <= Scalar(0.01);
    if (!holds) return std::nullopt;
    return ExactBorder<Scalar>{zone,         point.force,         error,        point.tangent,
                               law.residual, rule.points->size(), rule.unknowns};
}

}  // namespace rollbem::detail
