// Types of the arguments and results of models of one direction of creepage or of two: numbers, or vectors with spin
// and moment. Internal.
#pragma once

#include <limits>
#include <type_traits>

#include <Eigen/Core>

#include "../creepage.hpp"

namespace rollbem::detail {

/// The first type with one direction, the second with two.
template <int directions, class One, class Two>
using ByDirections = std::conditional_t<directions == 1, One, Two>;

template <int directions>
using CreepageAlong = ByDirections<directions, double, Creepage>;
template <int directions>
using ForceAlong = ByDirections<directions, double, TangentialForce>;
template <int directions>
using TangentAlong = ByDirections<directions, double, TangentialForce::ByCreepage>;

/// The number of creepages and of forces; with two directions spin and the moment are the third.
template <int directions>
inline constexpr int input_count = directions == 1 ? 1 : 3;
/// Numbers for all creepages or forces, in the order longitudinal, lateral, spin.
template <int directions>
using InputVector = Eigen::Matrix<double, input_count<directions>, 1, Eigen::DontAlign>;
template <int directions>
using InputMatrix = Eigen::Matrix<double, input_count<directions>, input_count<directions>, Eigen::DontAlign>;

inline InputVector<1> in_order(const double& creepage) { return InputVector<1>::Constant(creepage); }
inline InputVector<2> in_order(const Creepage& creepage) {
    return {creepage.longitudinal, creepage.lateral, creepage.spin};
}

template <int directions>
ForceAlong<directions> force_along(const InputVector<directions>& in_order) {
    if constexpr (directions == 1) {
        return in_order[0];
    } else {
        return {in_order[0], in_order[1], in_order[2]};
    }
}

/// A number that is NaN until computed.
inline constexpr double not_computed = std::numeric_limits<double>::quiet_NaN();

/// A force or tangent that is NaN until computed.
template <class Value>
Value nothing() {
    if constexpr (std::is_floating_point_v<Value>) {
        return not_computed;
    } else {
        return {};
    }
}

/// The entry of a step's tangent for the creepage with this index.
inline double& by_creepage(double& tangent, std::size_t) { return tangent; }
inline TangentialForce& by_creepage(TangentialForce::ByCreepage& tangent, std::size_t creepage) {
    return creepage == 0 ? tangent.by_longitudinal : creepage == 1 ? tangent.by_lateral : tangent.by_spin;
}

}  // namespace rollbem::detail
