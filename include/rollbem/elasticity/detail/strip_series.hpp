// Taylor series of the strip kernel's slope, by recurrence. Internal.
#pragma once

#include "../../detail/language.hpp"

#include <algorithm>

#include <Eigen/Core>

namespace rollbem::detail {

/// The series of x g'(x)/(-2b/pi) = c1/r + c2 x^2/r^3 of the strip about a few points at once, few enough for
/// registers: the series of y = 1/r and z = 1/r^3 follow from (r^2) y' + x y = 0 and (r^2) z' + 3 x z = 0, scaled by
/// x^k so that no power overflows.
template <class Scalar>
class StripSeries {
public:
    static constexpr Eigen::Index size = 8;

    /// Expands about `count` <= size points x with r = sqrt(x^2 + b^2).
    StripSeries(const Scalar* x, const Scalar* r, Eigen::Index count) {
        for (Eigen::Index j = 0; j < size; ++j) {
            const Eigen::Index i = (std::min)(j, count - 1);
            square_[j] = x[i] * x[i];
            kappa_[j] = square_[j] / (r[i] * r[i]);
            y_[j] = y_over_x_[j] = 1 / r[i];
            z_[j] = y_[j] * y_[j] * y_[j];
        }
    }

    /// Coefficient k times `factor`, k = 0, 1, 2 ... in turn.
    void next(Eigen::Index k, Scalar factor, Scalar c1, Scalar c2, Scalar* coefficient) {
        const Scalar i = static_cast<Scalar>(k);
        for (Eigen::Index j = 0; j < size; ++j) {
            const Scalar x_times_z = square_[j] * (z_[j] + z_before_[j]);
            coefficient[j] = factor * (c1 * y_over_x_[j] + c2 * x_times_z);
            const Scalar y_next = -kappa_[j] * ((2 * i + 1) * y_[j] + i * y_before_[j]) / (i + 1);
            const Scalar z_next = -kappa_[j] * ((2 * i + 3) * z_[j] + (i + 2) * z_before_[j]) / (i + 1);
            y_before_[j] = y_[j];
            y_[j] = y_next;
            z_before_[j] = z_[j];
            z_[j] = z_next;
            y_over_x_[j] = y_next - y_over_x_[j];
        }
    }

private:
    Scalar square_[size], kappa_[size], y_[size], z_[size];
    Scalar y_before_[size] = {}, z_before_[size] = {};
    Scalar y_over_x_[size];  // series of x y/(x + tau), times x
};

}  // namespace rollbem::detail
