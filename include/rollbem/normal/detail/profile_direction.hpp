// The direction of a wheel's or a rail's points, up or down, as far as their shape determines it.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "polyline.hpp"

namespace rollbem::detail {

/// The height over the tread of the highest point, in the direction sign z, that is not an end of the curve [m]: the
/// flange, if this is its side. The tread is the height at which most of the width lies.
inline double crest(const Eigen::ArrayXd& y, const Eigen::ArrayXd& z, double sign) {
    Eigen::Index top = 0;
    (sign * z).maxCoeff(&top);
    const Eigen::ArrayXd s = lengths_along(y, z);
    if (s[top] < 2e-3 || s[s.size() - 1] - s[top] < 2e-3) return 0;
    // the median over the width, each step weighted by its share of it
    std::vector<std::pair<double, double>> heights;
    double width = 0, half = 0;
    for (Eigen::Index i = 1; i < y.size(); ++i) {
        heights.emplace_back(sign * (z[i] + z[i - 1]) / 2, std::abs(y[i] - y[i - 1]));
        width += heights.back().second;
    }
    std::sort(heights.begin(), heights.end());
    for (const auto& [height, share] : heights) {
        half += share;
        if (half >= width / 2) return sign * z[top] - height;
    }
    return 0;
}

/// Whether a wheel's flange is at negative z: a crest of at least 10 mm, twice as high as the crest on the other side.
inline bool flange_points_up(const Eigen::ArrayXd& y, const Eigen::ArrayXd& z) {
    const double up = crest(y, z, -1);
    return up > 10e-3 && up > 2 * crest(y, z, 1);
}

/// Whether a side of a rail ends at the largest value of sign z, at least 5 mm from the other extreme: the curve is
/// steep from there to half the height.
inline bool has_side(const Eigen::ArrayXd& y, const Eigen::ArrayXd& z, double sign) {
    Eigen::Index top = 0;
    const double most = (sign * z).maxCoeff(&top), middle = (most + (sign * z).minCoeff()) / 2;
    const Eigen::ArrayXd s = lengths_along(y, z);
    const bool at_first = s[top] < 2e-3, at_last = s[s.size() - 1] - s[top] < 2e-3;
    if (most - middle < 2.5e-3 || at_first == at_last) return false;
    Eigen::Index i = top;
    while (sign * z[i] > middle) i += at_first ? 1 : -1;
    return std::abs(z[i] - z[top]) > std::abs(y[i] - y[top]);
}

/// Whether a rail's sides go to negative z. Grooved and guarded rails may have no side that shows it.
inline bool sides_point_up(const Eigen::ArrayXd& y, const Eigen::ArrayXd& z) {
    return has_side(y, z, -1) && !has_side(y, z, 1);
}

}  // namespace rollbem::detail
