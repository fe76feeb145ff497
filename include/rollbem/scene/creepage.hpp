// Creepages of two directions with spin, forces with their moment and its derivatives, and Kalker's creep
// coefficients.
#pragma once

#include "../detail/language.hpp"

#include <limits>

#include "../detail/finite.hpp"

namespace rollbem {

/// Creepage of body 1 relative to body 2 as a vector, and spin. The rigid slip over the rolling velocity at (x, y) is
/// (longitudinal - spin y, lateral + spin x), with x and y from the middle of the contact or the origin of an outline.
/// A rigid shift has the same components as lengths and an angle. Positive components give negative forces and a
/// negative moment.
struct Creepage {
    double longitudinal = 0;  ///< along the rolling direction x [-]; of a shift [m]
    double lateral = 0;       ///< along y [-]; of a shift [m]
    double spin = 0;          ///< about the normal to the contact [1/m]; of a shift an angle [rad]

    friend bool operator==(const Creepage&, const Creepage&) = default;
};

namespace detail {

inline bool is_finite(const Creepage& creepage) {
    return is_finite(creepage.longitudinal) && is_finite(creepage.lateral) && is_finite(creepage.spin);
}

}  // namespace detail

/// A force in the plane of contact and its moment, or a derivative of them. NaN until computed.
struct TangentialForce {
    struct ByCreepage;  // its derivatives, below

    double longitudinal = std::numeric_limits<double>::quiet_NaN();
    double lateral = std::numeric_limits<double>::quiet_NaN();
    /// Moment about the normal through the middle of the contact (the origin of an outline), of tractions at the
    /// centres of their elements [N m], per unit width [N]. NaN if the system does not know the centres (ready
    /// matrices).
    double moment = std::numeric_limits<double>::quiet_NaN();

    friend TangentialForce operator*(double factor, const TangentialForce& force) {
        return {factor * force.longitudinal, factor * force.lateral, factor * force.moment};
    }
    friend TangentialForce operator+(const TangentialForce& one, const TangentialForce& other) {
        return {one.longitudinal + other.longitudinal, one.lateral + other.lateral, one.moment + other.moment};
    }
};

namespace detail {

/// Whether both components are finite; the moment may be unknown.
inline bool is_finite(const TangentialForce& force) {
    return is_finite(force.longitudinal) && is_finite(force.lateral);
}

}  // namespace detail

/// Derivatives of a force with respect to both creepages and spin [1/m]; for a rigid shift, to its angle [rad].
struct TangentialForce::ByCreepage {
    TangentialForce by_longitudinal, by_lateral, by_spin;

    friend TangentialForce::ByCreepage operator*(double factor, const TangentialForce::ByCreepage& tangent) {
        return {factor * tangent.by_longitudinal, factor * tangent.by_lateral, factor * tangent.by_spin};
    }
};

/// Kalker's creep coefficients: F_x = -G a b c11 xi, F_y = -G a b (c22 eta + c c23 phi),
/// M_z = -G a b c (c32 eta + c c33 phi) about the origin, with creepages xi, eta [-], spin phi [1/m] and c = sqrt(a b);
/// of an outline, c stands for a and b. In the limit of small elements c32 = -c23 if the patch is symmetric fore and
/// aft. Real for steady rolling, complex for harmonic creepage.
template <class Value>
struct CreepCoefficients {
    Value c11 = 0, c22 = 0, c23 = 0, c32 = 0, c33 = 0;
};

}  // namespace rollbem
