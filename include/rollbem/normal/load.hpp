// The normal load at one instant: the pressures of the elements and the length of the contact. Plain data; a step of
// friction takes the load at its end.
#pragma once

#include <Eigen/Core>

#include "../detail/finite.hpp"
#include "../status.hpp"
#include "../types.hpp"

namespace rollbem {

namespace detail {

/// Whether all values are pressures: finite and not negative.
inline bool all_pressures(const ArrayX<double>& values) noexcept {
    return all_finite(values) && (values.size() == 0 || !(values.minCoeff() < 0));
}

}  // namespace detail

/// The normal load of a contact at one instant. The user keeps and overwrites it, so that no step allocates. Elements
/// without pressure carry no traction: contact may come and go element by element, and all pressures may be zero.
struct NormalLoad {
    /// p_n [Pa], the mean of each of the mesh's elements, trailing to leading; finite, not negative, zero where there
    /// is no contact.
    ArrayX<double> normal_pressure;
    double half_length = 0;  ///< a [m] of the contact that the mesh covers, positive and finite
    /// d p_n / d load of each element at constant half-length, for the tangent with respect to the load, in any unit of
    /// load. May be empty if this tangent is not needed.
    ArrayX<double> pressure_rate;
    /// b [m] of an elliptic patch, positive and finite. 0 stands for the state's half-width, only where it cannot have
    /// changed: on a line contact, and on a patch whose half-length equals the state's.
    double half_width = 0;

    /// Whether the load fits a mesh of `element_count` elements: ok or invalid_load.
    Status check(Eigen::Index element_count) const noexcept {
        const bool sized = normal_pressure.size() == element_count &&
                           (pressure_rate.size() == 0 || pressure_rate.size() == element_count);
        const bool valid = sized && detail::is_finite(half_length) && half_length > 0 &&
                           detail::is_finite(half_width) && half_width >= 0 && detail::all_pressures(normal_pressure) &&
                           detail::all_finite(pressure_rate);
        return valid ? Status::ok : Status::invalid_load;
    }
};

}  // namespace rollbem
