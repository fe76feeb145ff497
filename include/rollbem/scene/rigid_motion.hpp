// What the bodies do relative to each other, as rigid bodies, while the contact rolls on.
#pragma once

#include "../detail/language.hpp"

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

/// Motion during one step. Value_ is a number for one direction of creepage (which one it is, is the kernel's
/// business), and Creepage<Scalar> for both.
template <class Value_>
class RigidMotion {
public:
    using Value = Value_;
    using Scalar = typename detail::NumberOf<Value>::type;

    /// The same creepage xi [-] all the way.
    RigidMotion(Value creepage) : start_(creepage), end_(creepage) {}  // NOLINT: a creepage is meant to convert

    /// Creepage [-] that varies linearly along the way.
    static RigidMotion linear(Value start, Value end) { return {start, end, Kind::linear}; }

    /// Rigid shift xi dq [m] of body 1 against body 2, even along the way: needs no division by a speed that may
    /// vanish, and is allowed with dq = 0.
    static RigidMotion shift(Value shift) { return {shift, shift, Kind::shift}; }

    bool is_shift() const { return kind_ == Kind::shift; }
    bool is_linear() const { return kind_ == Kind::linear; }  ///< made by linear(), whatever the values
    Value start() const { return start_; }                    ///< creepage at the start [-], or the shift [m]
    Value end() const { return end_; }                        ///< creepage at the end [-], or the shift [m]

    /// Whether it can go with a distance rolled of dq, in any unit: ok, invalid_step or not_finite.
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
