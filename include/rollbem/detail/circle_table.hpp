// Cosines of equally spaced angles, for sums of Chebyshev polynomials at Chebyshev points.
#pragma once

#include "language.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <Eigen/Core>

namespace rollbem::detail {

/// Cosines and sines of k pi/(2 count): the circle in 4 count equal steps.
template <class Scalar>
class CircleTable {
public:
    explicit CircleTable(Eigen::Index count) : cosines_(static_cast<std::size_t>(4 * count)), quarter_(count) {
        const Scalar step = std::numbers::pi_v<Scalar> / static_cast<Scalar>(2 * count);
        for (Eigen::Index k = 0; k <= count; ++k) {  // the smaller of two angles: small cosines keep their digits
            const Scalar value = 2 * k <= count ? std::cos(static_cast<Scalar>(k) * step)
                                                : std::sin(static_cast<Scalar>(count - k) * step);
            set(k, value);
            set(2 * count - k, -value);
            set(2 * count + k, -value);
            if (k > 0) set(4 * count - k, value);
        }
    }

    Eigen::Index size() const { return 4 * quarter_; }
    Scalar cosine(Eigen::Index k) const { return cosines_[static_cast<std::size_t>(k)]; }  ///< 0 <= k < size()
    Scalar sine(Eigen::Index k) const { return cosine(k >= quarter_ ? k - quarter_ : k + 3 * quarter_); }

private:
    void set(Eigen::Index k, Scalar value) { cosines_[static_cast<std::size_t>(k)] = value; }

    std::vector<Scalar> cosines_;
    Eigen::Index quarter_;
};

}  // namespace rollbem::detail
