// Chebyshev states in full adhesion as linear ordinary differential equations.
#pragma once

#include "../adhesion/state_space.hpp"
#include "../types.hpp"
#include "chebyshev.hpp"

namespace rollbem {

/// The state space of Chebyshev states: without an inverse, B = -e_0.
inline StateSpace state_space(const ChebyshevSystem<double>& system) {
    const Eigen::Index m = system.size();
    StateSpace result{.A = system.rates(),
                      .B = MatrixX<double>::Zero(m, 1),
                      .C = -system.outputs().transpose(),
                      .D = MatrixX<double>::Zero(1, 1)};
    result.B(0, 0) = -1;
    return result;
}

/// The state space of a kernel with a number of states: 8 states are exact to rounding if nothing changes within a
/// contact length. Throws std::invalid_argument unless there is at least one state, the half-width is finite, b/a >=
/// 0.001 and, for a plane kernel, Lambda > 0.
template <LineKernel Kernel>
StateSpace state_space(const Chebyshev& method, const Kernel& kernel) {
    return state_space(rolling_system(method, kernel));
}

}  // namespace rollbem
