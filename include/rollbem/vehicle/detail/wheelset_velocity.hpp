// The rigid motion of a wheelset on its track, and its slip in a plane of contact.
#pragma once

#include <array>
#include <cmath>

#include "../../scene/wheelset.hpp"

namespace rollbem::detail {

/// Sine and cosine of an angle.
template <class Number>
struct SineCosine {
    Number sine, cosine;
};
inline SineCosine<double> sine_cosine(double angle) { return {std::sin(angle), std::cos(angle)}; }

/// Velocity of the wheelset as a rigid body, in track axes. Number is double, or dual for derivatives.
template <class Number>
class WheelsetVelocity {
public:
    /// Speeds in the sense of WheelsetSpeeds.
    struct Speeds {
        Number forward, pitch_rate, lateral, vertical, roll_rate, yaw_rate;
    };

    WheelsetVelocity(const Speeds& speeds, const SineCosine<Number>& roll, const SineCosine<Number>& yaw)
        : middle_{speeds.forward, speeds.lateral, speeds.vertical} {
        const Number level = speeds.pitch_rate * yaw.cosine;  // component of the pitch rate that is level, across the
                                                              // track
        turn_ = {speeds.roll_rate - speeds.pitch_rate * yaw.sine, level * roll.cosine,
                 speeds.yaw_rate + level * roll.sine};
    }

    const std::array<Number, 3>& middle() const { return middle_; }  ///< velocity at the middle of the axle [m/s]
    const std::array<Number, 3>& turn() const { return turn_; }      ///< angular velocity about x, y, z [rad/s]

    /// Velocity at a point given by its arm from the middle of the axle [m/s].
    std::array<Number, 3> at(const std::array<Number, 3>& arm) const {
        const auto& [r_x, r_y, r_z] = arm;
        const auto& [w_x, w_y, w_z] = turn_;
        return {middle_[0] + w_y * r_z - w_z * r_y, middle_[1] + w_z * r_x - w_x * r_z,
                middle_[2] + w_x * r_y - w_y * r_x};
    }
    /// Slip along x and along s = (0, cosine, sine) [m/s], and angular velocity about n = (0, -sine, cosine) [rad/s].
    std::array<Number, 3> slip(const std::array<Number, 3>& arm, const Number& sine, const Number& cosine) const {
        const std::array<Number, 3> v = at(arm);
        return {v[0], v[1] * cosine + v[2] * sine, turn_[2] * cosine - turn_[1] * sine};
    }

private:
    std::array<Number, 3> middle_, turn_;
};

inline WheelsetVelocity<double> velocity_of(const WheelsetPosition& at, const WheelsetSpeeds& speeds) {
    return {{speeds.forward, speeds.pitch_rate, speeds.lateral, speeds.vertical, speeds.roll_rate, speeds.yaw_rate},
            sine_cosine(at.roll),
            sine_cosine(at.yaw)};
}

}  // namespace rollbem::detail
