// The velocity of a wheel on the rail at a patch.
#pragma once

#include <array>
#include <cmath>

#include "../wheelset_on_track.hpp"
#include "wheelset_velocity.hpp"

namespace rollbem::detail {

/// The velocity of the wheel on the rail at a point (x, s, n) of a patch's plane: along x, along s turned by `tilt`
/// into the plane's normal [m/s], and about the plane's normal [rad/s].
class SlipVelocity {
public:
    SlipVelocity(const RailPatch& patch, const WheelsetPosition& at, const WheelsetSpeeds& speeds, double radius)
        : patch_(patch), at_(at), radius_(radius), velocity_(velocity_of(at, speeds)) {}

    Creepage operator()(double x, double s, double n, double tilt) const {
        return at(patch_.place(x, s, n), patch_.angle + tilt);
    }
    Creepage at_reference() const { return at(creepage_place(patch_), patch_.angle); }

private:
    Creepage at(const std::array<double, 3>& place, double angle) const {
        const std::array<double, 3> arm{place[0], place[1] - at_.lateral, place[2] - (at_.height - radius_)};
        const auto slip = velocity_.slip(arm, std::sin(angle), std::cos(angle));
        const double sine = std::sin(patch_.angle), cosine = std::cos(patch_.angle);
        return {slip[0], slip[1], velocity_.turn()[2] * cosine - velocity_.turn()[1] * sine};
    }

    const RailPatch& patch_;
    const WheelsetPosition& at_;
    double radius_;
    WheelsetVelocity<double> velocity_;
};

}  // namespace rollbem::detail
