// The pitch rate of free rolling.
#pragma once

#include <cmath>
#include <cstddef>

#include "../../detail/finite.hpp"
#include "../../status.hpp"
#include "../wheelset_on_track.hpp"
#include "slip_velocity.hpp"

namespace rollbem::detail {

/// Pitch rate at which the longitudinal creepages of the largest patches of all wheels that touch add up to zero
/// [rad/s]. Slip is linear in the rate, and the velocity of rolling by which it is divided changes little from one
/// round to the next.
inline double free_pitch_rate(const WheelsetOnTrack& wheelset, const WheelsetOnTrack::Contacts& contacts,
                              WheelsetSpeeds speeds) {
    speeds.pitch_rate = 0;
    for (int round = 0; round < 20; ++round) {
        double sum = 0, growth = 0;  // sum of creepages, and its derivative at constant velocities of rolling
        for (const WheelsetOnTrack::Side side : WheelsetOnTrack::sides) {
            const WheelOnRail::Contact& wheel = contacts.wheels[std::size_t(side)];
            if (!has_numbers(wheel.status)) continue;
            const RailPatch& patch = wheel.patches[0];
            const WheelsetPosition at = contacts.seen(side);
            const double radius = wheelset.wheel(side).dimensions().radius;
            const auto slip = [&](const WheelsetSpeeds& of) {
                const WheelsetSpeeds seen = WheelsetOnTrack::seen_from(side, of);
                return SlipVelocity(patch, at, seen, radius).at_reference().longitudinal;
            };
            const double rolling = round > 0 ? std::abs(rolling_velocity_of(patch, speeds)) : 1;
            sum += slip(speeds) / rolling;
            growth += slip({.forward = 0, .pitch_rate = 1}) / rolling;
        }
        const double next = speeds.pitch_rate - sum / growth;
        if (!is_finite(next) || next == speeds.pitch_rate) break;
        speeds.pitch_rate = next;
    }
    return speeds.pitch_rate;
}

}  // namespace rollbem::detail
