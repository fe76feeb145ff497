// Scratch memory for friction that falls with slip, in addition to that of constant friction.
#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

#include "../../types.hpp"
#include "falling_set.hpp"

namespace rollbem::detail {

/// Parameters of the tangents, as indices of what the first stage passes to the second: the creepages come first.
template <int directions>
struct TangentBy {
    static constexpr std::size_t creepages = directions == 1 ? 1 : 3;
    static constexpr std::size_t load = creepages, half_length = creepages + 1, half_width = creepages + 2;
    static constexpr std::size_t count = directions == 1 ? half_width : half_width + 1;
};

/// For one direction or two, depending on `Slip`. All memory is allocated by the constructor.
template <class Slip>
struct FallingScratch {
    using Vector = VectorX<typename Slip::Scalar>;

    explicit FallingScratch(Eigen::Index n)
        : set(n),
          friction(Vector::Zero(n)),
          duration(friction),
          before(friction),
          rise(friction),
          first_friction(friction),
          change(friction),
          bound(friction),
          path_change(friction),
          before_change(friction) {
        carried_change.fill(friction);
    }

    FallingSet<Slip> set;
    Vector friction;  // mu in the present stage
    Vector duration, before;
    Vector rise;            // change of mu in the first stage along the paths of the particles
    Vector first_friction;  // mu in the first of two stages
    Vector change;          // d mu of the last tangent
    Vector bound;           // d bound of the last tangent at constant mu
    Vector path_change;     // d before by the half-length, on which the paths of the particles depend
    Vector before_change;   // d before of the last tangent
    std::array<Vector, TangentBy<Slip::directions>::count> carried_change;  // d rise of each tangent
};

}  // namespace rollbem::detail
