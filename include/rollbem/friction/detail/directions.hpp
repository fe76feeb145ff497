// What distinguishes one direction of creepage from two outside the solver: creepages, systems and the blocks of G'.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "../../detail/fingerprint.hpp"
#include "../../scene/creepage.hpp"
#include "../../system/element_blocks.hpp"
#include "../../system/rolling_system.hpp"
#include "../../types.hpp"
#include "../state.hpp"

namespace rollbem::detail {

template <int directions, class Scalar>
struct Directions {
    static_assert(directions == 1 || directions == 2);
    using Value = ByDirections<directions, Scalar, Creepage<Scalar>>;
    using System = ElementSystem<Scalar, directions>;
    using Gradient = ByDirections<directions, MatrixX<Scalar>, DirectionBlocks<Scalar>>;  // G'
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

/// The fingerprint of G' and the elements' areas, by which states are recognised.
template <class Scalar>
std::uint64_t fingerprint_of_steady(const MatrixX<Scalar>& G_prime, const ArrayX<Scalar>& areas) {
    Fingerprint fingerprint;
    fingerprint.add(G_prime);
    fingerprint.add(areas);
    return fingerprint.value();
}
template <class Scalar>
std::uint64_t fingerprint_of_steady(const DirectionBlocks<Scalar>& G_prime, const ArrayX<Scalar>& areas) {
    Fingerprint fingerprint;
    add_blocks(G_prime, fingerprint);
    fingerprint.add(areas);
    return fingerprint.value();
}

}  // namespace rollbem::detail
