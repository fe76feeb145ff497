// Forces of a wheelset that rolls on real rails: friction on each patch, the pitch rate of free rolling, and the
// balance of the vertical loads, which normal forces and friction carry together.
#pragma once

#include "../detail/decl.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "../scene/mirror.hpp"
#include "../status.hpp"
#include "patch_force.hpp"
#include "wheelset_on_track.hpp"

namespace rollbem {

/// Motion and loads of a wheelset.
struct WheelsetRolling {
    WheelsetPosition position;
    std::array<double, 2> loads{1e5, 1e5};  ///< vertical, left and right [N]
    WheelsetOnTrack::Free free = WheelsetOnTrack::Free::height_and_roll;
    WheelsetSpeeds speeds{};
    /// Whether the pitch rate is found instead of taken from the speeds: the longitudinal creepages of both wheels'
    /// largest patches add up to zero, or, if only one wheel touches, its creepage is zero. A torque is left over.
    bool free_pitch = true;
    /// The longitudinal force of friction on the wheelset [N], along x, in place of a pitch rate; about 0 for a
    /// wheelset without a drive. It takes several solutions of friction.
    std::optional<double> force{};
    /// Whether friction's vertical share, which is large on a flange, counts in the loads; otherwise normal forces
    /// alone carry them.
    bool loads_include_friction = true;
};

struct WheelsetForces {
    WheelsetOnTrack::Contacts contacts;
    double pitch_rate =
        std::numeric_limits<double>::quiet_NaN();    ///< [rad/s]; NaN if no wheel touches, or none has the force
    std::array<std::vector<PatchForce>, 2> patches;  ///< friction of the patches, in the order of the contacts
    /// Wrenches of the rails on each wheel and on both, in track axes; moments are about the middle of the axle. Zero
    /// where there is no contact; NaN if friction has no result.
    std::array<Wrench, 2> on_wheel;
    Wrench on_wheelset;
    int rounds = 0;  ///< number of rounds of contacts and friction in turn
};

/// The forces of a rolling wheelset. Loads are vertical, carried by normal forces and friction together: contacts and
/// friction are found in turn until they carry the loads to 1e-6. With loads_include_friction = false contacts carry
/// the loads without friction. Allocates. Statuses name the failure, `contacts.status` and those of the patches:
///
/// - `unbalanced`: the wheel does not carry its load after 40 rounds;
/// - `load_not_reached`: friction holds the wheel up;
/// - `unbalanced`, with the forces of the pressures alone: the wheel does not roll (patch_force);
/// - `unbalanced`: the longitudinal force lies in a jump, where the grids of the contacts change;
/// - `no_solution` of patches: no creepage of up to 20 % gives the longitudinal force.
WheelsetForces rolling_forces(const WheelsetOnTrack& wheelset, const WheelsetRolling& rolling,
                              const RollingFriction& friction, WheelsetOnTrack::Workspace& workspace,
                              const WheelOnRail::Options& options = {});

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/wheelset_forces.ipp"
#endif
