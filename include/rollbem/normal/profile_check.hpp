// Checks whether a profile can be a wheel or a rail.
#pragma once

#include "../detail/decl.hpp"

#include "profile.hpp"

namespace rollbem {

/// Throws std::invalid_argument, with the fault and its remedy, unless the profile can be a whole right wheel. Pieces
/// pass.
///
/// - Width: 90 to 180 mm.
/// - Flange: its crown (largest z) lies 25 to 65 mm inside the tape circle, at z >= 10 mm.
/// - Tape circle: |z| < 2 mm there; it lies 70 mm from the flange's back, and the profile's origin `tape_offset` [m].
void require_wheel(const Profile& wheel, double tape_offset);

/// Throws std::invalid_argument, with the fault and its remedy, unless the profile can be a whole rail: 30 to 200 mm
/// wide, its top (least z) within 10 mm of z = 0 and higher than both ends. Pieces pass.
void require_rail(const Profile& rail);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/profile_check.ipp"
#endif
