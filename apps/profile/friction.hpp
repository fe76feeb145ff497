// Friction on the patches of profile_study: creepages, forces on the wheel, and the pitch rate of free rolling.
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include <rollbem/friction/friction.hpp>
#include <rollbem/status.hpp>
#include <rollbem/vehicle/wheelset_on_track.hpp>

namespace profile {

struct FrictionSettings {
    double mu, speed;        ///< [-], V [m/s]
    Eigen::Index n, strips;  ///< elements of a strip, strips
};

/// On a patch seen as that of a right wheel.
struct PatchForces {
    rollbem::Creepage<double> creepage;  ///< of the rail on the wheel, CONTACT's CKSI, CETA and CPHI
    double longitudinal = 0, lateral = 0,
           moment = 0;  ///< on the wheel [N, N, N m], the moment about the reference point
    double power = 0;   ///< that friction turns into heat [W]
    Eigen::Index elements = 0;
    rollbem::StepStatus status = rollbem::StepStatus::not_finite;
};

/// By steady rolling on the patch's own outline, under its own pressures.
PatchForces forces_on(const rollbem::RailPatch& patch, const rollbem::WheelsetPosition& at, double pitch_rate,
                      const rollbem::TrackDimensions& dimensions, const FrictionSettings& settings);

/// The largest patch of a wheel, and the wheel's position, as on the right.
struct Rolling {
    const rollbem::RailPatch& patch;
    rollbem::WheelsetPosition at;
};

/// At which the longitudinal creepages of both wheels add up to zero [rad/s].
double free_pitch_rate(const Rolling& left, const Rolling& right, double speed, double radius);

}  // namespace profile
