// Equality to the last bit, including NaN and the sign of zero.
#pragma once

#include <cstring>

#include <Eigen/Core>

#include <rollbem/friction/state.hpp>

namespace same_bits {

inline bool same(double one, double other) { return std::memcmp(&one, &other, sizeof one) == 0; }
template <class Derived>
bool same(const Eigen::DenseBase<Derived>& one, const Eigen::DenseBase<Derived>& other) {
    bool equal = one.rows() == other.rows() && one.cols() == other.cols();
    for (Eigen::Index i = 0; equal && i < one.size(); ++i) {
        equal = same(one(i % one.rows(), i / one.rows()), other(i % one.rows(), i / one.rows()));
    }
    return equal;
}
inline bool same(const rollbem::TangentialForce& one, const rollbem::TangentialForce& other) {
    return same(one.longitudinal, other.longitudinal) && same(one.lateral, other.lateral) &&
           same(one.moment, other.moment);
}
inline bool same(const rollbem::TangentialForce::ByCreepage& one, const rollbem::TangentialForce::ByCreepage& other) {
    return same(one.by_longitudinal, other.by_longitudinal) && same(one.by_lateral, other.by_lateral) &&
           same(one.by_spin, other.by_spin);
}
inline bool same(const rollbem::FrictionState& one, const rollbem::FrictionState& other) {
    return same(one.traction, other.traction) && same(one.unrotated_traction, other.unrotated_traction) &&
           one.zones == other.zones && same(one.normal_pressure, other.normal_pressure) &&
           same(one.half_length, other.half_length) && same(one.half_width, other.half_width) &&
           one.system == other.system && same(one.friction_coefficient, other.friction_coefficient) &&
           same(one.solver.stage_coefficient, other.solver.stage_coefficient);
}
inline bool same(const rollbem::FrictionStep& one, const rollbem::FrictionStep& other) {
    return same(one.force, other.force) && same(one.tangent, other.tangent) &&
           same(one.tangent_by_load, other.tangent_by_load) &&
           same(one.tangent_by_half_length, other.tangent_by_half_length) && same(one.slip_work, other.slip_work) &&
           same(one.jump_work, other.jump_work) && same(one.complementarity_residual, other.complementarity_residual) &&
           one.stick_count == other.stick_count && one.rounds == other.rounds && one.path_points == other.path_points &&
           one.status == other.status;
}

}  // namespace same_bits
