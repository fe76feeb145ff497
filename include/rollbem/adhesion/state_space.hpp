// A contact in full adhesion as linear ordinary differential equations, for programs with their own integrators,
// linearisation or controller design: StateSpace, dimensionless, and StateSpaceSI of a contact at a speed.
#pragma once

#include <limits>
#include <string>
#include <type_traits>

#include <Eigen/LU>

#include "../assembly/rolling_system.hpp"
#include "../detail/finite.hpp"
#include "../detail/reciprocal_condition.hpp"
#include "../detail/require.hpp"
#include "../scene/contact.hpp"
#include "../spectral/chebyshev.hpp"
#include "../types.hpp"

namespace rollbem {

/// d x/d(q/a) = A x + B v, C x + D v = -forces: the k inputs are creepages, the outputs forces over a G per unit width
/// (of a patch G a b), as of the system from which it was made; q = V t is the distance rolled, x are its unknowns,
/// x = 0 at rest. The coefficients at s, in V/a, are C (s I - A)^-1 B + D; c11 if k = 1.
template <class Scalar>
struct StateSpace {
    MatrixX<Scalar> A;     ///< n x n
    MatrixX<Scalar> B, C;  ///< n x k, k x n
    MatrixX<Scalar> D;     ///< k x k; zero, but for a reduced system
};

/// dx/dt = A x + B xi, F = C x + D xi: the input is creepage [-], the output force [N] on body 1 over the width 2b,
/// negative for positive creepage. The states remain dimensionless (Chebyshev states: displacement coefficients over a;
/// elements: p/G).
template <class Scalar>
struct StateSpaceSI {
    MatrixX<Scalar> A;  ///< n x n [1/s]
    MatrixX<Scalar> B;  ///< n x 1 [1/s]
    MatrixX<Scalar> C;  ///< 1 x n [N]
    MatrixX<Scalar> D;  ///< 1 x 1 [N]; zero, but for a reduced system
};

/// For any system: A = G^-1 G', B = -G^-1 inputs, C = -outputs^T. Throws std::invalid_argument, naming rcond(G), if G
/// is singular to working precision (rcond <= 100 n eps). Elements with alpha_L = 0 approach that for n above about
/// 150.
template <class Scalar>
StateSpace<Scalar> state_space(const RollingSystem<Scalar>& system) {
    const Eigen::Index n = system.size();
    const Eigen::PartialPivLU<MatrixX<Scalar>> lu(system.G());
    const Scalar rcond = detail::reciprocal_condition(lu, detail::one_norm(system.G()));
    const Scalar least = 100 * static_cast<Scalar>(n) * std::numeric_limits<Scalar>::epsilon();
    const std::string rule =
        "exceed " + detail::to_text(least) + ": G is singular to working precision, and cannot be inverted";
    detail::require(detail::is_finite(rcond) && rcond > least, "state_space", "rcond of G", rcond, rule.c_str());
    return {.A = lu.solve(system.G_prime()),
            .B = -lu.solve(system.inputs()),
            .C = -system.outputs().transpose(),
            .D = MatrixX<Scalar>::Zero(system.input_count(), system.input_count())};
}

/// For Chebyshev states: without an inverse, B = -e_0.
template <class Scalar>
StateSpace<Scalar> state_space(const ChebyshevSystem<Scalar>& system) {
    const Eigen::Index m = system.size();
    StateSpace<Scalar> result{.A = system.rates(),
                              .B = MatrixX<Scalar>::Zero(m, 1),
                              .C = -system.outputs().transpose(),
                              .D = MatrixX<Scalar>::Zero(1, 1)};
    result.B(0, 0) = -1;
    return result;
}

/// For a kernel and a number of states: 8 states are exact to rounding if nothing changes within a contact length.
/// Throws std::invalid_argument unless there is at least one state, the half-width is finite, b/a >= 0.001 and, for a
/// plane kernel, Lambda > 0.
template <LineKernel Kernel>
StateSpace<typename Kernel::Scalar> state_space(const Chebyshev& method, const Kernel& kernel) {
    return state_space(rolling_system(method, kernel));
}

/// In SI units, for a contact that rolls at `speed` V [m/s]: A V/a, B V/a, -2b a G C, -2b a G D. Throws
/// std::invalid_argument unless V is positive and finite and the contact's half-width is finite.
template <class Scalar>
StateSpaceSI<Scalar> in_si(const StateSpace<Scalar>& dimensionless, const Contact<Scalar>& contact,
                           std::type_identity_t<Scalar> speed) {
    detail::require_positive("in_si", "speed", speed);
    detail::require_finite("in_si", "half_width", contact.half_width());
    const Scalar rate = speed / contact.half_length();
    const Scalar force = -2 * contact.half_width() * contact.half_length() * contact.shear_modulus();
    return {.A = rate * dimensionless.A,
            .B = rate * dimensionless.B,
            .C = force * dimensionless.C,
            .D = force * dimensionless.D};
}

}  // namespace rollbem
