// Profile: the section of a wheel or a rail, a curve through points, smooth except at corners.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "detail/polyline.hpp"

namespace rollbem {

/// A curve (y(s), z(s)) [m] over the length s along the polygon of its points; y to the right, z down.
///
/// - Wheel: the right one, z = 0 on the tape circle and the flange at negative y.
/// - Rail: z = 0 at its highest point, and the inner side of the right rail at negative y.
///
/// It is a cubic spline in both, broken at corners: points where the polygon turns by more than 30 degrees, and by at
/// most 6 at every other point within 2 mm.
///
/// Invariant: at least 4 points, finite, from 1e-100 to 1e100 from one to the next, and the polygon turns by at most
/// 150 degrees at each; y grows from the first to the last (moved() keeps their order).
class Profile {
public:
    /// The use of the curve: a whole wheel, a whole rail, or a piece that need not look like either, such as rollers
    /// and cut-outs.
    enum class Use { wheel, rail, piece };

    struct Point {
        double y, z;
        std::array<double, 2> slope, bend;  ///< d(y, z)/ds [-] and d2(y, z)/ds2 [1/m]
    };

    /// Takes points in the order of the curve, from either end. Throws std::invalid_argument if they break the
    /// invariant, naming the point by its number from 1.
    Profile(Eigen::ArrayXd y, Eigen::ArrayXd z, Use use = Use::rail)
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

    double length() const { return knots_[knots_.size() - 1]; }
    Eigen::Index size() const { return knots_.size(); }     ///< number of points
    const Eigen::ArrayXd& s() const { return knots_; }      ///< s of the points
    const Eigen::ArrayXd& y() const { return values_[0]; }  ///< y of the points
    const Eigen::ArrayXd& z() const { return values_[1]; }  ///< z of the points
    /// The numbers of the points at corners, from 0 and growing.
    const std::vector<Eigen::Index>& corners() const { return corners_; }
    bool is_piece() const { return piece_; }

    /// The point at 0 <= s <= length(), beyond a corner if s is at one; outside, the spline of the last interval goes
    /// on.
    Point at(double s) const noexcept {
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

    /// The same curve turned about the origin by `angle` [rad], from y towards z, and moved by (dy, dz) [m]. Throws
    /// std::invalid_argument unless they are finite.
    Profile moved(double angle, double dy, double dz) const {
        detail::require_finite("Profile::moved", "angle", angle);
        detail::require_finite("Profile::moved", "dy", dy);
        detail::require_finite("Profile::moved", "dz", dz);
        const double c = std::cos(angle), s = std::sin(angle);
        Profile result = *this;
        result.values_ = {c * y() - s * z() + dy, s * y() + c * z() + dz};
        result.bends_ = {c * bends_[0] - s * bends_[1], s * bends_[0] + c * bends_[1]};
        return result;
    }

    /// The mirror image at y = 0: the right profile of a left one.
    Profile mirrored() const {
        Profile result = *this;
        result.values_[0] *= -1;
        result.bends_[0] *= -1;
        result.reverse();
        return result;
    }

    /// The profile without the noise of measurement, by a smoothing spline in y and z. Waves of `wave_length` [m] are
    /// halved, shorter waves are damped more (by the fourth power of the length), longer waves and corners stay. Throws
    /// std::invalid_argument unless the wave length is positive and finite.
    Profile smoothed(double wave_length) const {
        detail::require_positive("Profile::smoothed", "wave_length", wave_length);
        std::array<Eigen::ArrayXd, 2> smooth = detail::smooth_curve(knots_, corners_, values_, wave_length);
        return {std::move(smooth[0]), std::move(smooth[1]), piece_ ? Use::piece : Use::rail};
    }

private:
    static void check(Eigen::Index i, bool holds, const char* rule) {
        if (holds) return;
        std::string text = "be that of a point that must ";
        text += rule;
        detail::require(false, "Profile", "number of the point", i + 1, text.c_str());
    }
    double length_of_step(Eigen::Index i) const {
        return std::hypot(values_[0][i] - values_[0][i - 1], values_[1][i] - values_[1][i - 1]);
    }
    void reverse() {
        for (std::size_t k = 0; k < 2; ++k) {
            values_[k] = values_[k].reverse().eval();
            bends_[k] = bends_[k].reverse().eval();
        }
        knots_ = length() - Eigen::ArrayXd(knots_.reverse());
        for (Eigen::Index& corner : corners_) corner = size() - 1 - corner;
        std::reverse(corners_.begin(), corners_.end());
    }

    std::array<Eigen::ArrayXd, 2> values_, bends_;  // y and z, and their second derivatives
    Eigen::ArrayXd knots_;
    std::vector<Eigen::Index> corners_;
    bool piece_ = false;
};

namespace detail {

/// s of a profile's highest point, where z' = 0, between the neighbours of its highest given point.
inline double highest_place(const Profile& profile) {
    Eigen::Index top = 0;
    profile.z().minCoeff(&top);
    double low = profile.s()[(std::max)(top - 1, Eigen::Index(0))],
           high = profile.s()[(std::min)(top + 1, profile.size() - 1)];
    for (int k = 0; k < 60; ++k) {
        const double middle = (low + high) / 2;
        (profile.at(middle).slope[1] < 0 ? low : high) = middle;
    }
    return low;
}

}  // namespace detail

}  // namespace rollbem
