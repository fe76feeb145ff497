// Signs that the profile of a wheel may not be meant as it is read.
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "../../detail/require.hpp"

namespace rollbem::detail {

/// y of the back of a wheel's flange, if the curve reaches it: it falls by 2 mm within 1 mm of its least y.
inline std::optional<double> flange_back(const Eigen::ArrayXd& y, const Eigen::ArrayXd& z) {
    const double back = y.minCoeff();
    double least = INFINITY, most = -INFINITY;
    for (Eigen::Index i = 0; i < y.size(); ++i) {
        if (y[i] > back + 1e-3) continue;
        least = std::fmin(least, z[i]);
        most = std::fmax(most, z[i]);
    }
    return most - least >= 2e-3 ? std::optional(back) : std::nullopt;
}

/// The doubt whether the flange's back lies `tape_offset` [m] inside the origin, or "": more than 2 mm beside it.
inline std::string doubt_of_flange_back(const Eigen::ArrayXd& y, const Eigen::ArrayXd& z, double tape_offset) {
    const std::optional<double> back = flange_back(y, z);
    if (!back || std::abs(*back + tape_offset) <= 2e-3) return "";
    const auto rounded = [](double length) { return to_text(std::round(1e4 * length) / 1e4 + 0.0); };
    return "y of the flange's back = " + rounded(*back) + " m, which --tape-offset " + to_text(tape_offset) +
           " puts at " + rounded(-tape_offset) + " m: --tape-offset " + rounded(-*back) +
           " where the file has the whole flange";
}

}  // namespace rollbem::detail
