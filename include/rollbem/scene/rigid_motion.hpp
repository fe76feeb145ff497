// How far the contact rolls in a step, and the relative rigid-body motion of the two bodies meanwhile.
#pragma once

#include "../detail/finite.hpp"
#include "../status.hpp"
#include "creepage.hpp"

namespace rollbem {

namespace detail {

template <class Value>
struct NumberOf {
    using type = Value;
};
template <class Scalar>
struct NumberOf<Creepage<Scalar>> {
    using type = Scalar;
};

}  // namespace detail

/// Distance and duration of one step. Only friction that depends on the velocity of slip needs the duration; everything
/// else takes a plain dq.
template <class Scalar = double>
struct Travel {
    Scalar dq;        ///< distance rolled [m], positive; 0 for a rigid shift without rolling
    Scalar duration;  ///< [s], positive
};

namespace detail {

/// A Travel whose duration does not matter: a plain dq will do.
template <class Scalar>
struct UntimedTravel : rollbem::Travel<Scalar> {
    UntimedTravel(rollbem::Travel<Scalar> travel) : rollbem::Travel<Scalar>(travel) {}  // NOLINT: implicit on purpose
    UntimedTravel(Scalar distance) : rollbem::Travel<Scalar>{distance, 0} {}            // NOLINT: implicit on purpose
};

}  // namespace detail

/// Motion during one step. Value_ is a number for creepage in one direction (the direction is that of the kernel), and
/// Creepage<Scalar> for both.
template <class Value_>
class RigidMotion {
public:
    using Value = Value_;
    using Scalar = typename detail::NumberOf<Value>::type;

    /// Constant creepage xi [-].
    RigidMotion(Value creepage) : start_(creepage), end_(creepage) {}  // NOLINT: implicit on purpose

    /// Creepage [-] that varies linearly over the step.
    static RigidMotion linear(Value start, Value end) { return {start, end, Kind::linear}; }

    /// Rigid shift xi dq [m] of body 1 relative to body 2, uniform over the step: it needs no division by a speed that
    /// may vanish, and dq = 0 is allowed.
    static RigidMotion shift(Value shift) { return {shift, shift, Kind::shift}; }

    bool is_shift() const { return kind_ == Kind::shift; }
    bool is_linear() const { return kind_ == Kind::linear; }  ///< made by linear(), whatever the values
    Value start() const { return start_; }                    ///< creepage at the start [-], or the shift [m]
    Value end() const { return end_; }                        ///< creepage at the end [-], or the shift [m]

    /// Whether it can be used with a distance rolled dq, in any unit: ok, invalid_step or not_finite.
    StepStatus check(Scalar dq) const noexcept {
        if (!detail::is_finite(dq) || !(is_shift() ? dq >= 0 : dq > 0)) return StepStatus::invalid_step;
        return detail::is_finite(start_) && detail::is_finite(end_) ? StepStatus::ok : StepStatus::not_finite;
    }

private:
    enum class Kind { constant, linear, shift };

    RigidMotion(Value start, Value end, Kind kind) : start_(start), end_(end), kind_(kind) {}

    Value start_, end_;
    Kind kind_ = Kind::constant;
};

}  // namespace rollbem
