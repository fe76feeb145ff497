// What distinguishes one direction of creepage from two: the solver for stick and slip, and the blocks of the matrices.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include <Eigen/Core>

#include "../../scene/creepage.hpp"
#include "../../system/element_blocks.hpp"
#include "../../system/rolling_system.hpp"
#include "../../types.hpp"
#include "../state.hpp"
#include "active_set.hpp"
#include "combined_solver.hpp"
#include "falling_slip.hpp"

namespace rollbem::detail {

template <int directions, class Scalar>
struct Directions {
    static_assert(directions == 1 || directions == 2);
    using Solver = ByDirections<directions, ActiveSet<Scalar>, CombinedSolver<Scalar>>;
    using Slip = ByDirections<directions, ActiveSetSlip<Scalar>, CombinedSlip<Scalar>>;
    using Value = ByDirections<directions, Scalar, Creepage<Scalar>>;
    using System = ElementSystem<Scalar, directions>;
    using Gradient = ByDirections<directions, MatrixX<Scalar>, DirectionBlocks<Scalar>>;  // G'

    static Solver solver(Eigen::Index n, bool coupled) {
        if constexpr (directions == 1) {
            return Solver(n);
        } else {
            return Solver(n, coupled);
        }
    }
};

/// G' of a system.
template <class Scalar>
const MatrixX<Scalar>& gradient(const ElementSystem<Scalar>& system) {
    return system.G_prime();
}
template <class Scalar>
const DirectionBlocks<Scalar>& gradient(const ElementSystem<Scalar, 2>& system) {
    return system.G_prime_blocks();
}

/// Whether tractions along one direction cause slip along the other.
template <class Scalar>
bool is_coupled(const MatrixX<Scalar>&) {
    return false;
}
template <class Scalar>
bool is_coupled(const DirectionBlocks<Scalar>& G_prime) {
    return G_prime[0][1].size() > 0;
}

}  // namespace rollbem::detail
