// Bodies of normal/profile.hpp. Internal.
#pragma once

#include "../profile.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../detail/polyline.hpp"

namespace rollbem {

ROLLBEM_DECL Profile::Profile(Eigen::ArrayXd y, Eigen::ArrayXd z, Use use)
    : values_{std::move(y), std::move(z)}, piece_(use == Use::piece) {
    const Eigen::Index n = values_[0].size();
    constexpr double least = 1e-100;  // least distance: squares and inverses of distances stay numbers
    detail::require(n >= 4, "Profile", "number of points", n, "be at least 4");
    detail::require(values_[1].size() == n, "Profile", "number of z", values_[1].size(), "equal the number of y");
    for (Eigen::Index i = 0; i < n; ++i) {
        check(i, detail::is_finite(values_[0][i]) && detail::is_finite(values_[1][i]), "be finite");
        if (i == 0) continue;
        check(i, length_of_step(i) > least, "differ from the one before it");
        check(i, length_of_step(i) < 1 / least, "lie within 1e100 of the one before it");
    }
    const Eigen::ArrayXd turns = detail::turns_at(values_[0], values_[1]);
    for (Eigen::Index i = 0; i < n; ++i) {
        check(i, std::abs(turns[i]) <= detail::fold, "not turn the curve back, by more than 150 degrees");
    }
    knots_ = detail::lengths_along(values_[0], values_[1]);
    detail::require(detail::is_finite(length()), "Profile", "length", length(), "be finite");
    corners_ = detail::corners_of(knots_, turns);
    for (std::size_t k = 0; k < 2; ++k) bends_[k] = detail::spline_bends(knots_, values_[k], corners_);
    detail::require(values_[0][n - 1] != values_[0][0], "Profile", "y from one end to the other",
                    values_[0][n - 1] - values_[0][0], "differ from 0");
    if (values_[0][n - 1] < values_[0][0]) reverse();
}

ROLLBEM_DECL auto Profile::at(double s) const noexcept -> Point {
    const double* const inner = knots_.data() + 1;
    const Eigen::Index i = std::upper_bound(inner, inner + knots_.size() - 2, s) - inner;
    const double h = knots_[i + 1] - knots_[i], t = (s - knots_[i]) / h, u = 1 - t;
    Point point;
    for (std::size_t k = 0; k < 2; ++k) {
        const double from = values_[k][i], to = values_[k][i + 1], b = bends_[k][i], c = bends_[k][i + 1];
        const double value = u * from + t * to + h * h / 6 * ((u * u - 1) * u * b + (t * t - 1) * t * c);
        (k == 0 ? point.y : point.z) = value;
        point.slope[k] = (to - from) / h + h / 6 * ((1 - 3 * u * u) * b + (3 * t * t - 1) * c);
        point.bend[k] = u * b + t * c;
    }
    return point;
}

ROLLBEM_DECL Profile Profile::moved(double angle, double dy, double dz) const {
    detail::require_finite("Profile::moved", "angle", angle);
    detail::require_finite("Profile::moved", "dy", dy);
    detail::require_finite("Profile::moved", "dz", dz);
    const double c = std::cos(angle), s = std::sin(angle);
    Profile result = *this;
    result.values_ = {c * y() - s * z() + dy, s * y() + c * z() + dz};
    result.bends_ = {c * bends_[0] - s * bends_[1], s * bends_[0] + c * bends_[1]};
    return result;
}

ROLLBEM_DECL Profile Profile::mirrored() const {
    Profile result = *this;
    result.values_[0] *= -1;
    result.bends_[0] *= -1;
    result.reverse();
    return result;
}

ROLLBEM_DECL Profile Profile::smoothed(double wave_length) const {
    detail::require_positive("Profile::smoothed", "wave_length", wave_length);
    std::array<Eigen::ArrayXd, 2> smooth = detail::smooth_curve(knots_, corners_, values_, wave_length);
    return {std::move(smooth[0]), std::move(smooth[1]), piece_ ? Use::piece : Use::rail};
}

ROLLBEM_DECL void Profile::check(Eigen::Index i, bool holds, const char* rule) {
    if (holds) return;
    std::string text = "be that of a point that must ";
    text += rule;
    detail::require(false, "Profile", "number of the point", i + 1, text.c_str());
}

ROLLBEM_DECL void Profile::reverse() {
    for (std::size_t k = 0; k < 2; ++k) {
        values_[k] = values_[k].reverse().eval();
        bends_[k] = bends_[k].reverse().eval();
    }
    knots_ = length() - Eigen::ArrayXd(knots_.reverse());
    for (Eigen::Index& corner : corners_) corner = size() - 1 - corner;
    std::reverse(corners_.begin(), corners_.end());
}

}  // namespace rollbem
