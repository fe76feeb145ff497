// Bodies of scene/rigid_motion.hpp. Internal.
#pragma once

#include "../rigid_motion.hpp"

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../status.hpp"
#include "../creepage.hpp"

namespace rollbem {

template <class Value_>
inline auto RigidMotion<Value_>::with_rows(const RowsView& start, const RowsView& end) const -> RigidMotion {
    RigidMotion motion = *this;
    motion.row_count_ = start.rows() == end.rows() ? start.rows() : invalid;
    motion.start_rows_ = start.data();
    motion.end_rows_ = end.data();
    return motion;
}

template <class Value_>
inline Status RigidMotion<Value_>::check(double dq, Eigen::Index row_count) const noexcept {
    const bool possible = is_shift() ? dq >= 0 : dq >= detail::negligible<double>;
    if (!detail::is_finite(dq) || !possible) return Status::invalid_step;
    return check_rows(row_count);
}

template <class Value_>
inline Status RigidMotion<Value_>::check_rows(Eigen::Index row_count) const noexcept {
    if (has_rows() && row_count_ != row_count) return Status::invalid_step;
    const bool finite = detail::is_finite(start_) && detail::is_finite(end_) &&
                        (!has_rows() || (detail::all_finite(start_rows()) && detail::all_finite(end_rows())));
    return finite ? Status::ok : Status::not_finite;
}

}  // namespace rollbem
