// Whether tractions of steady rolling can be an approximation at all: in full adhesion all of them oppose the creepage.
// No user includes this by itself.
#pragma once

#include "../../detail/language.hpp"

#include <algorithm>
#include <cmath>

#include "../../detail/finite.hpp"
#include "../../status.hpp"
#include "../../types.hpp"

namespace rollbem::detail {

/// More than this share of the traction on the wrong side, and a solution is no approximation. Schemes whose tractions
/// converge stay at 0 but for zigzags at alpha_T below 0.1 on coarse meshes; others reach 0.3 to 1 with the number of
/// elements. Between the two, at 0.14 to 0.27, lies alpha_T = 0 with alpha_L > 0: zigzags that c11 averages out.
inline constexpr double largest_assisting_share = 0.05;

/// Share, in [0, 1], of the traction that pushes with a positive creepage: the part above zero of the sum of |p| dx.
/// With the collocation points on or behind the elements' centres, or more than one width ahead of them, a small
/// residual and a good condition come with the singularity at the wrong edge, or one of a higher order: c11 of 0, -1 or
/// 3 times the exact one.
template <class Scalar, class Traction>
Scalar assisting_share(const Traction& traction, const ArrayX<Scalar>& widths) {
    Scalar assisting = 0, all = 0;
    for (Eigen::Index i = 0; i < traction.size(); ++i) {
        assisting += widths[i] * std::max(traction[i], Scalar(0));
        all += widths[i] * std::abs(traction[i]);
    }
    return assisting > 0 ? assisting / all : Scalar(0);
}

template <class Scalar, class Traction>
bool opposes_creepage(const Traction& traction, const ArrayX<Scalar>& widths) {
    const Scalar share = assisting_share<Scalar>(traction, widths);
    return is_finite(share) && share <= Scalar(largest_assisting_share);
}

}  // namespace rollbem::detail
