// Whether tractions of steady rolling can be an approximation at all, where dissipation is not proved: in full adhesion
// all of them oppose the creepage. Internal.
#pragma once

#include <algorithm>
#include <cmath>

#include "../detail/finite.hpp"
#include "../status.hpp"
#include "../types.hpp"

namespace rollbem::detail {

/// If a larger share of the traction assists the creepage, a solution is not an approximation. Schemes whose tractions
/// converge stay at 0, except for oscillations at alpha_T below 0.1 on coarse meshes; others reach 0.3 to 1 as the
/// number of elements grows. In between, at 0.14 to 0.27, lies alpha_T = 0 with alpha_L > 0: oscillations that average
/// out in c11.
inline constexpr double largest_assisting_share = 0.05;

/// The same of a patch: elements many times longer than wide let tractions oscillate, to 0.18 where forces are right
/// within 1 %, from 0.4 on where they are wrong by 8 % and more.
inline constexpr double largest_assisting_share_of_patch = 0.25;

/// Share, in [0, 1], of the traction that assists a positive creepage: the positive part of the sum of |p| dx. With
/// collocation points at or behind the elements' centres, or more than one width ahead of them, the residual is small
/// and the condition good, but the singularity lies at the wrong edge or has a higher order: c11 is 0, -1 or 3 times
/// the exact one.
template <class Scalar, class Traction>
Scalar assisting_share(const Traction& traction, const ArrayX<Scalar>& widths) {
    Scalar assisting = 0, all = 0;
    for (Eigen::Index i = 0; i < traction.size(); ++i) {
        assisting += widths[i] * (std::max)(traction[i], Scalar(0));
        all += widths[i] * std::abs(traction[i]);
    }
    return assisting > 0 ? assisting / all : Scalar(0);
}

template <class Scalar, class Traction>
bool opposes_creepage(const Traction& traction, const ArrayX<Scalar>& widths,
                      double allowed = largest_assisting_share) {
    const Scalar share = assisting_share<Scalar>(traction, widths);
    return is_finite(share) && share <= Scalar(allowed);
}

}  // namespace rollbem::detail
