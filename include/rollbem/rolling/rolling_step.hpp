// RollingStep: the input of a step or of steady rolling, the same for all models.
#pragma once

#include "../scene/rigid_motion.hpp"

namespace rollbem {

/// The load of a step, or none: the state's load then remains.
template <class Load_>
class GivenLoad {
public:
    using Load = Load_;

    GivenLoad() = default;
    GivenLoad(const Load& load) : load_(&load) {}  // NOLINT: implicit on purpose
    GivenLoad(const Load&&) = delete;

    explicit operator bool() const { return load_ != nullptr; }
    const Load& operator*() const { return *load_; }
    const Load* operator->() const { return load_; }

private:
    const Load* load_ = nullptr;
};

/// One step: the distance rolled, the motion of the bodies meanwhile, and the load at its end. The load varies linearly
/// from the state's load; without one the state's load remains. A model's `Load` is a GivenLoad with friction, the
/// half-length or the semi-axes in full adhesion. Written in braces:
///
///     model.advance(now, {dq, creepage}, next, workspace);
///     model.advance(now, {{dq, duration}, Motion::linear(start, end), load}, next, workspace);
///     model.advance(now, {0, Motion::shift(shift)}, next, workspace);  // without rolling
///
/// Steady rolling takes the motion at the end of such a step, its load, and its speed if friction depends on slip:
///
///     model.steady(now, {.motion = creepage}, next, workspace);
///     model.steady(now, {Travel::at_speed(V), creepage, load}, next, workspace);
template <class Motion_, class Load_>
struct RollingStep {
    using Motion = Motion_;
    using Load = Load_;

    Travel travel{};
    Motion motion;
    Load load{};
};

}  // namespace rollbem
