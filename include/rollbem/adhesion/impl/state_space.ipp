// Bodies of adhesion/state_space.hpp. Internal.
#pragma once

#include "../state_space.hpp"

#include <limits>
#include <string>

#include <Eigen/LU>

#include "../../detail/finite.hpp"
#include "../../detail/reciprocal_condition.hpp"
#include "../../detail/require.hpp"

namespace rollbem {

ROLLBEM_DECL StateSpace state_space(const RollingSystem<double>& system) {
    const Eigen::Index n = system.size();
    const Eigen::PartialPivLU<MatrixX<double>> lu(system.G());
    const double rcond = detail::reciprocal_condition(lu, detail::one_norm(system.G()));
    const double least = 100 * static_cast<double>(n) * std::numeric_limits<double>::epsilon();
    const std::string rule =
        "exceed " + detail::to_text(least) + ": G is singular to working precision, and cannot be inverted";
    detail::require(detail::is_finite(rcond) && rcond > least, "state_space", "rcond of G", rcond, rule.c_str());
    return {.A = lu.solve(system.G_prime()),
            .B = -lu.solve(system.inputs()),
            .C = -system.outputs().transpose(),
            .D = MatrixX<double>::Zero(system.input_count(), system.input_count())};
}

}  // namespace rollbem

namespace rollbem::detail {

inline StateSpace in_si(const StateSpace& dimensionless, double length, double width, double shear_modulus,
                        double speed) {
    require_positive("in_si", "speed", speed);
    const Eigen::Index k = dimensionless.B.cols();
    require(k == 1 || k == 3, "in_si", "number of inputs", k, "be 1, or 3 with spin");
    VectorX<double> arms = VectorX<double>::Ones(k);
    if (k == 3) arms[2] = length;
    const double rate = speed / length;
    const VectorX<double> forces = -width * length * shear_modulus * arms;
    return {.A = rate * dimensionless.A,
            .B = rate * dimensionless.B * arms.asDiagonal(),
            .C = forces.asDiagonal() * dimensionless.C,
            .D = forces.asDiagonal() * dimensionless.D * arms.asDiagonal()};
}

}  // namespace rollbem::detail

namespace rollbem {

ROLLBEM_DECL StateSpace in_si(const StateSpace& dimensionless, const Contact& contact, double speed) {
    detail::require_finite("in_si", "half_width", contact.half_width());
    return detail::in_si(dimensionless, contact.half_length(), 2 * contact.half_width(), contact.shear_modulus(),
                         speed);
}

ROLLBEM_DECL StateSpace in_si(const StateSpace& dimensionless, const PatchContact& contact, double speed) {
    return detail::in_si(dimensionless, contact.half_length(), contact.half_length(), contact.shear_modulus(), speed);
}

}  // namespace rollbem
