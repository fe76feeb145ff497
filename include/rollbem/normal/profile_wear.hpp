// Worn profiles: material taken off a wheel or a rail along its normals, the area between two profiles, and the sizes
// by which EN 15313 and maintenance judge them.
#pragma once

#include "../detail/decl.hpp"

#include <array>
#include <vector>

#include <Eigen/Core>

#include "profile.hpp"

namespace rollbem {

/// Ranges of y [m] of a reference that do not wear: of a wheel the steep part of the flange's back, and the tread more
/// than 35 mm outside the tape circle, which is at y = `tape`; of a rail both sides from 20 mm below the top on. Throws
/// std::invalid_argument if the reference has no such part.
std::vector<std::array<double, 2>> unworn_parts(const Profile& reference, Profile::Use body, double tape = 0);

/// The profile with a straight line of this length [m] at each end: the sides of a standard rail go on below its
/// points. Throws std::invalid_argument unless the length is positive and finite.
Profile extended(const Profile& profile, double length);

/// The motion that brings a profile onto the reference in these parts, ranges of the reference's y, without or with an
/// angle. It is robust: what is worn within the parts does not move it as long as more of their length lies on the
/// reference under this motion than under any other (Tukey's biweight from the best motion that a few places fix).
/// Throws std::invalid_argument unless every part has points of both profiles, and together they fix the motion.
Profile::Alignment align(const Profile& profile, const Profile& reference,
                         const std::vector<std::array<double, 2>>& parts, bool turns = false);

/// The same curve with further points on it, so that neighbours are at most `spacing` [m] apart. Throws
/// std::invalid_argument unless the spacing is at least 1e-6 m and finite.
Profile refined(const Profile& profile, double spacing);

/// The profile without the material of this depth [m] at each of its points, measured along its normals: off a wheel
/// upwards, off a rail downwards. A corner moves to where both its sides meet. The number of points stays, and so do
/// the shares of the length at which they lie between corners. Throws std::invalid_argument unless depths are finite,
/// not negative and as many as points, `body` is a wheel or a rail, and the curve does not fold, as it does at depths
/// beyond its radius.
Profile worn(const Profile& profile, const Eigen::ArrayXd& depth, Profile::Use body);

/// The profile without the material of this area per length [m] of the profile, in the places of its points: worn() by
/// such depths that area_between() is the sum of the areas, each over the length from midway to the point before to
/// midway to the point behind. Throws as worn().
Profile worn_by_area(const Profile& profile, const Eigen::ArrayXd& area_per_length, Profile::Use body);

/// An area per length [m] at a profile's points, spread along it over the reach r [m]: the solution d of d - r^2 d'' =
/// area, without a flux at the ends. Waves of length w are damped by 1/(1 + (2 pi r/w)^2), the sum over
/// lengths_at_points() stays, and nothing becomes negative. Throws std::invalid_argument unless r is positive and
/// finite.
Eigen::ArrayXd spread(const Profile& profile, const Eigen::ArrayXd& area_per_length, double reach);

/// The lengths that belong to the points of a profile [m], from midway to the point before to midway to the next.
Eigen::ArrayXd lengths_at_points(const Profile& profile);

/// The area between two splines, closed at their ends by straight lines [m^2]; positive where `after` is worn.
double area_between(const Profile& before, const Profile& after, Profile::Use body);

/// The depth [m] of a worn profile below the curve before, at the points of the worn one.
Eigen::ArrayXd depth_between(const Profile& before, const Profile& after, Profile::Use body);

/// The sizes of a right wheel whose origin lies `tape_offset` [m] from the back of its flange.
Profile::FlangeSizes flange_sizes(const Profile& wheel, double tape_offset = 0.07);

/// What is missing of a rail's head, on the side at this depth [m] below its top.
Profile::RailWear rail_wear(const Profile& before, const Profile& after, double depth);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/profile_wear.ipp"
#endif
