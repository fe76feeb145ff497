// The alignment of a measured profile with another one on parts that do not wear.
#pragma once

#include "../detail/decl.hpp"

#include <array>
#include <vector>

#include "profile.hpp"

namespace rollbem {

/// Ranges of y [m] of a reference that do not wear: of a wheel the steep part of the flange's back, and the tread beyond
/// 35 mm outside the tape circle, at y = `tape`; of a rail both sides from 20 mm below the top on. Throws
/// std::invalid_argument if the reference has no such part.
std::vector<std::array<double, 2>> unworn_parts(const Profile& reference, Profile::Use body, double tape = 0);

/// The profile with a straight line of this length [m] at each end: the sides of a standard rail go on below its
/// points. Throws std::invalid_argument unless the length is positive and finite.
Profile extended(const Profile& profile, double length);

/// A rigid motion, Profile::moved(angle, dy, dz), and how well the moved profile fits.
struct Alignment {
    double angle, dy, dz;  ///< [rad], [m], [m]
    double residual;       ///< root mean square of the distances from the reference's parts that count [m]
    double share;          ///< of the parts' length that counts [-]: the rest is worn, or not measured
};

/// The motion that brings a profile onto the reference in these parts, ranges of the reference's y, without or with an
/// angle. It is robust: lengths of less than half of the parts that lie elsewhere do not move it (Tukey's biweight from
/// the least sum of distances). Throws std::invalid_argument unless every part has points of both profiles and together
/// they fix the motion.
Alignment align(const Profile& profile, const Profile& reference, const std::vector<std::array<double, 2>>& parts,
                bool turns = false);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/profile_alignment.ipp"
#endif
