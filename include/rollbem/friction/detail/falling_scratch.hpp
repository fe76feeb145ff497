// The memory behind a workspace of friction that falls with slip, besides that of constant friction.
#pragma once

#include "../../detail/language.hpp"

#include <array>

#include <Eigen/Core>

#include "../../types.hpp"
#include "falling_set.hpp"

namespace rollbem::detail {

/// For one direction or two, as `Slip` says. All is allocated by the constructor.
template <class Slip>
struct FallingScratch {
    using Vector = VectorX<typename Slip::Scalar>;

    explicit FallingScratch(Eigen::Index n)
        : set(n),
          friction(Vector::Zero(n)),
          duration(friction),
          before(friction),
          rise(friction),
          change(friction),
          bound(friction),
          path_change(friction),
          before_change(friction) {
        carried_change.fill(friction);
    }

    FallingSet<Slip> set;
    Vector friction;  // mu of the present stage
    Vector duration, before;
    Vector rise;           // of mu in the first stage, along the particles' paths
    Vector change;         // d mu by what the last tangent was taken by
    Vector bound;          // its d bound while mu stays
    Vector path_change;    // d before by the half-length, which moves the paths of the particles
    Vector before_change;  // d before by what the tangent is taken by
    std::array<Vector, Slip::parameters> carried_change;  // d rise by that, in the first stage
};

}  // namespace rollbem::detail
