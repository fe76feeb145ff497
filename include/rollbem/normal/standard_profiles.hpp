// Profiles of standards, by their formulas: the wheel S1002; the rails UIC 60, 60E1 and 54E1.
#pragma once

#include "../detail/decl.hpp"

#include <cmath>

#include <Eigen/Core>

#include "profile.hpp"

namespace rollbem {

namespace detail {

inline constexpr double usual_cant = 0.02499479361892016;

}  // namespace detail

/// The wheel S1002 (EN 13715), from the flange's back to 60 mm outside the tape circle; tape circle at y = 0.
Profile s1002();

/// The rail UIC 60 (UIC 861; by the centres of its arcs, which join at 10.50 and 25.99 mm from the middle), canted
/// inwards, towards negative y, by `cant` [rad], its highest point at y = z = 0; the profiles below likewise.
Profile rail_uic60(double cant = detail::usual_cant);

/// The rail 60E1 (EN 13674-1; joints 20.456 and 52.053 mm apart).
Profile rail_60e1(double cant = detail::usual_cant);

/// The rail 54E1 (EN 13674-1; joints 20.024 and 49.727 mm apart).
Profile rail_54e1(double cant = detail::usual_cant);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/standard_profiles.ipp"
#endif
