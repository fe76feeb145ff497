// Points of the midpoint rule in an angle, doubled from level to level. Internal.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

#include <Eigen/Core>

#include "../../types.hpp"

namespace rollbem::detail {

/// The M points phi = (j + 1/2) pi/M of the midpoint rule in an angle, which are Gauss-Chebyshev points in its cosine.
template <class Scalar>
struct AngularPoints {
    ArrayX<Scalar> cosine, rise;  // cos(phi), and (1 + cos(phi))/2 without cancellation

    explicit AngularPoints(Eigen::Index M) : cosine(M), rise(M) {
        for (Eigen::Index j = 0; j < M; ++j) {
            const Scalar half = std::cos((Scalar(2 * j + 1) / Scalar(4 * M)) * std::numbers::pi_v<Scalar>);
            rise[j] = half * half;
            cosine[j] = 2 * rise[j] - 1;
        }
    }
    Eigen::Index size() const { return rise.size(); }
    /// Weight in the integral of a function of (1 + cos(phi))/2 = 0 ... 1.
    Scalar weight(Eigen::Index j) const {
        return std::sqrt(rise[j] * (1 - rise[j])) * std::numbers::pi_v<Scalar> / static_cast<Scalar>(size());
    }
};

/// The points of every level, computed on first use.
template <class Scalar>
class PointsOfLevels {
public:
    static constexpr int count = 9;  // 16, 32 ... 4096 points

    const AngularPoints<Scalar>& operator[](int level) {
        std::optional<AngularPoints<Scalar>>& points = points_[static_cast<std::size_t>(level)];
        if (!points) points.emplace(Eigen::Index(16) << level);
        return *points;
    }

    int of(const AngularPoints<Scalar>& points) const {
        int level = 0;
        while ((Eigen::Index(16) << level) < points.size()) ++level;
        return level;
    }

private:
    std::array<std::optional<AngularPoints<Scalar>>, count> points_;
};

}  // namespace rollbem::detail
