// Bodies of normal/profile.hpp. Internal.
#pragma once

#include "../profile.hpp"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../detail/highest_place.hpp"
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

namespace rollbem::detail {

/// z [mm] of the tread and flange of S1002 at y [mm], EN 13715.
inline double s1002_height(double y) {
    const auto polynomial = [y](std::initializer_list<double> from_highest) {
        double sum = 0;
        for (const double c : from_highest) sum = sum * y + c;
        return sum;
    };
    const auto arc = [y](double centre, double radius) {
        return std::sqrt(radius * radius - (y - centre) * (y - centre));
    };
    if (y >= 32.15796) return 1.364323640 - y / 15;
    if (y >= -26) {
        return polynomial({2.646656573e-13, -5.957839843e-12, 5.309217349e-15, -1.562379023e-8, 5.844240864e-8,
                           -2.810427944e-5, 1.565681624e-3, -3.358537058e-2, 0});
    }
    if (y >= -35) {
        return polynomial({-2.252755540e-7, -4.687195829e-5, -4.169739389e-3, -2.054332446e-1, -6.051367875,
                           -1.065501873e2, -1.038384026e3, -4.320221063e3});
    }
    if (y >= -38.426669071) return 16.446 - arc(-26.210665, 13);
    if (y >= -39.763574) return -93.576667419 - 2.747477419 * y;
    if (y >= -49.662510381) return 8.834924130 + arc(-58.558326413, 20);
    if (y >= -62.764705882) return 16 + arc(-55, 12);
    return 9.519259302 + arc(-49.5, 20.5);
}

/// The head of a rail before it is canted [mm]. From the middle outwards: arcs of radius 300, 80 and 13, tangent to
/// each other at the joints, and a side 1:20 tangent to the last arc.
class RailHead {
public:
    struct Arc {
        double y, z, radius;  // centre, and radius
        double height(double at) const { return z - std::sqrt(radius * radius - (at - y) * (at - y)); }
    };

    RailHead(const Arc& arc_80, const Arc& arc_13)
        : arc_80_(arc_80), arc_13_(arc_13), joint_80_(joint(crown, arc_80)), joint_13_(joint(arc_80, arc_13)) {}

    /// The head of a rail from the half-widths at both joints.
    static RailHead joined_at(double joint_80, double joint_13) {
        const Arc arc_80 = beyond(crown, joint_80, 80);
        return {arc_80, beyond(arc_80, joint_13, 13)};
    }

    /// z at y.
    double operator()(double y) const {
        const double x = std::abs(y);
        if (x <= joint_80_) return crown.height(x);
        if (x <= joint_13_) return arc_80_.height(x);
        if (x <= side_) return arc_13_.height(x);
        return arc_13_.height(side_) + 20 * (x - side_);
    }

private:
    // Where arcs are tangent, their centres and the joint lie on one line.
    static double joint(const Arc& in, const Arc& out) {
        return in.y + in.radius * (out.y - in.y) / std::hypot(out.y - in.y, out.z - in.z);
    }
    static Arc beyond(const Arc& arc, double joint, double radius) {
        const double share = radius / arc.radius, z = arc.height(joint);
        return {joint + share * (arc.y - joint), z + share * (arc.z - z), radius};
    }

    static constexpr Arc crown{0, 300, 300};
    Arc arc_80_, arc_13_;
    double joint_80_, joint_13_;
    double side_ = arc_13_.y + 13 * std::cos(std::atan(0.05));  // y of the point where the arc has the slope of the
                                                                // side
};

/// The curve z(y) by points at most `step` apart along it; mm in, m out.
template <class Height>
Profile sampled(double from, double to, double step, const Height& height) {
    std::vector<double> y{from}, z{height(from)};
    while (y.back() < to) {
        double dy = step;
        while (std::hypot(dy, height((std::min)(y.back() + dy, to)) - z.back()) > 1.01 * step && dy > 1e-6) dy *= 0.9;
        y.push_back((std::min)(y.back() + dy, to));
        z.push_back(height(y.back()));
    }
    const auto map = [](const std::vector<double>& values) {
        return Eigen::ArrayXd(1e-3 * Eigen::Map<const Eigen::ArrayXd>(values.data(), Eigen::Index(values.size())));
    };
    return {map(y), map(z)};
}

/// A rail of this half-width [mm], canted, its highest point at y = z = 0.
inline Profile canted_rail(const RailHead& head, double half_width, double cant) {
    const Profile canted = sampled(-half_width, half_width, 0.1, head).moved(-cant, 0, 0);
    const Profile::Point top = canted.at(highest_place(canted));
    return canted.moved(0, -top.y, -top.z);
}

}  // namespace rollbem::detail

namespace rollbem {

ROLLBEM_DECL Profile s1002() { return detail::sampled(-69.95, 60, 0.1, detail::s1002_height); }

ROLLBEM_DECL Profile rail_uic60(double cant) {
    return detail::canted_rail({{7.7, 80.1348, 80}, {23.0162, 14.9090, 13}}, 36.2, cant);
}

ROLLBEM_DECL Profile rail_60e1(double cant) {
    return detail::canted_rail(detail::RailHead::joined_at(10.228, 26.0265), 36.2, cant);
}

ROLLBEM_DECL Profile rail_54e1(double cant) {
    return detail::canted_rail(detail::RailHead::joined_at(10.012, 24.8635), 35.2, cant);
}

}  // namespace rollbem
