// Forces of a contact in two directions, with their moment, and derivatives of them.
#pragma once

#include "../detail/language.hpp"

#include <limits>

namespace rollbem {

/// A force in the plane of contact and its moment, or a derivative of them. NaN until computed.
struct TangentialForce {
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

/// Derivatives of a force with respect to both creepages and spin [1/m]; for a rigid shift, to its angle [rad].
struct CreepageTangent {
    TangentialForce by_longitudinal, by_lateral, by_spin;

    friend CreepageTangent operator*(double factor, const CreepageTangent& tangent) {
        return {factor * tangent.by_longitudinal, factor * tangent.by_lateral, factor * tangent.by_spin};
    }
};

}  // namespace rollbem
