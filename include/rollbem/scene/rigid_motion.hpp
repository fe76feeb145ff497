// What the bodies do relative to each other, as rigid bodies, while the contact rolls on.
#pragma once

#include "../detail/language.hpp"

#include "../detail/finite.hpp"
#include "../status.hpp"

namespace rollbem {

/// Motion during one step. The same for both directions of creepage: which one it is, is the kernel's business.
template <class Scalar>
class RigidMotion {
public:
    /// The same creepage xi [-] all the way.
    RigidMotion(Scalar creepage) : start_(creepage), end_(creepage) {}  // NOLINT: a number is meant to convert

    /// Creepage [-] that varies linearly along the way.
    static RigidMotion linear(Scalar start, Scalar end) { return {start, end, Kind::linear}; }

    /// Rigid shift xi dq [m] of body 1 against body 2, even along the way: needs no division by a speed that may
    /// vanish, and is allowed with dq = 0.
    static RigidMotion shift(Scalar shift) { return {shift, shift, Kind::shift}; }

    bool is_shift() const { return kind_ == Kind::shift; }
    bool is_linear() const { return kind_ == Kind::linear; }  ///< made by linear(), whatever the values
    Scalar start() const { return start_; }                   ///< creepage at the start [-], or the shift [m]
    Scalar end() const { return end_; }                       ///< creepage at the end [-], or the shift [m]

    /// Whether it can go with a distance rolled of dq, in any unit: ok, invalid_step or not_finite.
    StepStatus check(Scalar dq) const noexcept {
        if (!detail::is_finite(dq) || !(is_shift() ? dq >= 0 : dq > 0)) return StepStatus::invalid_step;
        return detail::is_finite(start_) && detail::is_finite(end_) ? StepStatus::ok : StepStatus::not_finite;
    }

private:
    enum class Kind { constant, linear, shift };

    RigidMotion(Scalar start, Scalar end, Kind kind) : start_(start), end_(end), kind_(kind) {}

    Scalar start_, end_;
    Kind kind_ = Kind::constant;
};

}  // namespace rollbem
