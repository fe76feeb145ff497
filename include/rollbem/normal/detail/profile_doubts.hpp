// Signs that a profile may not be meant as it is read.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "../../detail/require.hpp"
#include "polyline.hpp"
#include "profile_cleaning.hpp"

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

/// Noise of points across their curve, as if that of one point were independent of the others.
struct PointNoise {
    double size = 0;      ///< standard deviation [m]
    double distance = 0;  ///< of neighbouring points [m]
    double slope = 0;     ///< size over distance

    /// Whether waves of twice the distance matter: those of amplitude A and length L that are pressed flat add
    /// pi E* A/L to the pressure, 100 MPa on steel.
    bool is_rough() const { return slope > 5e-4; }
};

/// The noise of half of the points is larger: what changes of the curvature from point to point tell. 0 of fewer than 9
/// points.
inline PointNoise median_noise(const Eigen::ArrayXd& y, const Eigen::ArrayXd& z) {
    const Eigen::Index n = y.size();
    if (n < 9) return {};
    const Eigen::ArrayXd s = lengths_along(y, z), turns = turns_at(y, z);
    const auto distance = [&](Eigen::Index i) { return (s[i + 1] - s[i - 1]) / 2; };
    const auto bend = [&](Eigen::Index i) { return turns[i] / distance(i); };
    // the fourth difference of independent numbers has 70 times their variance; medians of absolute values are 0.6745
    // standard deviations
    const double to_noise = 2 / (0.6745 * std::sqrt(70.0));
    std::vector<double> sizes, slopes, distances;
    for (Eigen::Index i = 2; i + 2 < n; ++i) {
        const double h = distance(i), change = std::abs(bend(i) - (bend(i - 1) + bend(i + 1)) / 2);
        slopes.push_back(to_noise * change * h);
        sizes.push_back(slopes.back() * h);
        distances.push_back(h);
    }
    const auto median = [](std::vector<double>& of) {
        const auto middle = of.begin() + std::ptrdiff_t(of.size() / 2);
        std::nth_element(of.begin(), middle, of.end());
        return *middle;
    };
    return {median(sizes), median(distances), median(slopes)};
}

/// The doubt whether waves of twice the distance of points are meant, or "", with the wave length to smooth by.
inline std::string doubt_of_roughness(const Eigen::ArrayXd& y, const Eigen::ArrayXd& z) {
    constexpr double bend = 3;  // of a rail's head [1/m]
    const PointNoise noise = median_noise(y, z);
    if (!noise.is_rough()) return "";
    // what smoothing over L leaves of the noise has the deviation size (2 distance/L)^(1/2), and L as its wave length
    const double pi = std::numbers::pi,
                 enough = std::pow(4 * pi * pi * noise.size * std::sqrt(2 * noise.distance) / bend, 0.4),
                 wave_length = std::clamp(enough, 4 * noise.distance, 0.1), unit = wave_length > 1e-3 ? 1e-3 : 1e-4;
    return "points " + in_mm(noise.distance) + " apart are rough by " + in_mm(noise.size) +
           ": each wave of these touches by itself: --smooth " + to_text(std::ceil(wave_length / unit) * unit);
}

}  // namespace rollbem::detail
