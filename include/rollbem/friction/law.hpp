// Coulomb's law of friction on the elements of a mesh.
#pragma once

#include "../detail/language.hpp"

#include <cstdint>

#include <Eigen/Core>

#include "../detail/fingerprint.hpp"
#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../types.hpp"

namespace rollbem {

/// Coulomb's law |p| <= mu p_n on the elements of a mesh. Where they slip, p = -mu p_n sign(s).
template <class Scalar>
struct CoulombFriction {
    Scalar friction_coefficient;     ///< mu [-], finite and not negative
    ArrayX<Scalar> normal_pressure;  ///< p_n [Pa], mean over each of the mesh's n elements, trailing to leading edge;
                                     ///< finite, not negative, not all zero
};

namespace detail {

/// The law for the unknown elements (the first `count` of the mesh). Throws std::invalid_argument if it is invalid.
template <class Scalar>
CoulombFriction<Scalar> checked_friction(const char* who, const CoulombFriction<Scalar>& friction,
                                         Eigen::Index mesh_size, Eigen::Index count) {
    require(count >= 1, who, "number of unknown elements", count, "be at least 1");
    require(is_finite(friction.friction_coefficient) && friction.friction_coefficient >= 0, who, "friction_coefficient",
            friction.friction_coefficient, "be finite and not negative");
    require(friction.normal_pressure.size() == mesh_size, who, "length of normal_pressure",
            friction.normal_pressure.size(), "equal the number of elements");
    for (Eigen::Index i = 0; i < mesh_size; ++i) {
        require(is_finite(friction.normal_pressure[i]) && friction.normal_pressure[i] >= 0, who, "normal_pressure",
                friction.normal_pressure[i], "be finite and not negative");
    }
    require(friction.normal_pressure.maxCoeff() > 0, who, "largest normal_pressure",
            friction.normal_pressure.maxCoeff(), "be positive");
    return {friction.friction_coefficient, friction.normal_pressure.head(count)};
}

/// Includes the pressures: a state of another model would otherwise continue under the pressures of that model.
template <class Scalar>
std::uint64_t fingerprint_of_law(const CoulombFriction<Scalar>& friction) {
    Fingerprint fingerprint;
    fingerprint.add(friction.normal_pressure);
    return fingerprint.value();
}

}  // namespace detail

}  // namespace rollbem
