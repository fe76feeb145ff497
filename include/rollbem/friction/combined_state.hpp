// What a friction problem with longitudinal and lateral creepage carries from step to step: plain data.
#pragma once

#include "../detail/language.hpp"

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "../types.hpp"

namespace rollbem {

/// What an element does. Where it slips, |p| = mu p_n and p is against the slip.
enum class CombinedZone : signed char { stick, slip };

/// One vector an element: longitudinal in column 0, lateral in column 1.
template <class Scalar>
using ElementVectors = Eigen::Matrix<Scalar, Eigen::Dynamic, 2>;

/// All that the next step or solution needs of the past. A copy is a checkpoint; written to a file and read back, it
/// goes on to the last bit as if nothing had happened.
template <class Scalar_>
struct CombinedFrictionState {
    using Scalar = Scalar_;

    ElementVectors<Scalar> traction;  ///< p on body 1 of each unknown element [Pa], trailing to leading
    std::vector<CombinedZone> zones;  ///< what each element does; after a step, at its end
    /// p_n [Pa] of each unknown element and a [m] of the contact that it lives under: what a step without a load keeps.
    ArrayX<Scalar> normal_pressure;
    Scalar half_length = 0;
    std::uint64_t system = 0;  ///< fingerprint() of the model that the state belongs to
};

}  // namespace rollbem
