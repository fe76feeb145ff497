// Types of the arguments and results of models of one direction of creepage or of two: numbers, or vectors with spin
// and moment.
#pragma once

#include <limits>
#include <type_traits>

#include <Eigen/Core>

#include "../types.hpp"
#include "creepage.hpp"
#include "force.hpp"

namespace rollbem::detail {

/// The first type with one direction, the second with two.
template <int directions, class One, class Two>
using ByDirections = std::conditional_t<directions == 1, One, Two>;

template <int directions, class Scalar>
using CreepageAlong = ByDirections<directions, Scalar, Creepage<Scalar>>;
template <int directions, class Scalar>
using ForceAlong = ByDirections<directions, Scalar, TangentialForce<Scalar>>;
template <int directions, class Scalar>
using TangentAlong = ByDirections<directions, Scalar, CreepageTangent<Scalar>>;

/// The number of creepages and of forces; with two directions spin and the moment are the third.
template <int directions>
inline constexpr int input_count = directions == 1 ? 1 : 3;
/// Numbers for all creepages or forces, in the order longitudinal, lateral, spin.
template <int directions, class Scalar>
using InputVector = Eigen::Matrix<Scalar, input_count<directions>, 1, Eigen::DontAlign>;
template <int directions, class Scalar>
using InputMatrix = Eigen::Matrix<Scalar, input_count<directions>, input_count<directions>, Eigen::DontAlign>;

template <class Scalar>
InputVector<1, Scalar> in_order(const Scalar& creepage) {
    return InputVector<1, Scalar>::Constant(creepage);
}
template <class Scalar>
InputVector<2, Scalar> in_order(const Creepage<Scalar>& creepage) {
    return {creepage.longitudinal, creepage.lateral, creepage.spin};
}

template <int directions, class Scalar>
ForceAlong<directions, Scalar> force_along(const InputVector<directions, Scalar>& in_order) {
    if constexpr (directions == 1) {
        return in_order[0];
    } else {
        return {in_order[0], in_order[1], in_order[2]};
    }
}

/// A number that is NaN until computed.
template <class Scalar>
inline constexpr Scalar unknown = std::numeric_limits<Scalar>::quiet_NaN();

/// A force or tangent that is NaN until computed.
template <class Value>
Value nothing() {
    if constexpr (std::is_floating_point_v<Value>) {
        return unknown<Value>;
    } else {
        return {};
    }
}

/// The entry of a step's tangent for the creepage with this index.
template <class Scalar>
Scalar& by_creepage(Scalar& tangent, std::size_t) {
    return tangent;
}
template <class Scalar>
TangentialForce<Scalar>& by_creepage(CreepageTangent<Scalar>& tangent, std::size_t creepage) {
    return creepage == 0 ? tangent.by_longitudinal : creepage == 1 ? tangent.by_lateral : tangent.by_spin;
}

}  // namespace rollbem::detail
