// Profile: the section of a wheel or a rail, a smooth curve through points; and two of standards, by their formulas.
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

namespace rollbem {

/// A curve (y(s), z(s)) [m] by the length s along the polygon of its points, a cubic spline in both; y to the right, z
/// down. Of a wheel: the right one, z = 0 on the tape circle and the flange at negative y. Of a rail: z = 0 at its
/// highest point, and the inner side of the right one at negative y.
///
/// Invariant: at least 4 points, finite, from 1e-100 to 1e100 from one to the next, and the polygon turns by at most 90
/// degrees at each; y grows from the first to the last.
class Profile {
public:
    struct Point {
        double y, z;
        std::array<double, 2> slope, bend;  ///< d(y, z)/ds [-] and d2(y, z)/ds2 [1/m]
    };

    /// In the order of the curve, from either end. Throws std::invalid_argument if they break the invariant, naming the
    /// point by its number from 1.
    Profile(Eigen::ArrayXd y, Eigen::ArrayXd z) : values_{std::move(y), std::move(z)} {
        const Eigen::Index n = values_[0].size();
        constexpr double least = 1e-100;  // of distances: their squares and inverses are numbers
        detail::require(n >= 4, "Profile", "number of points", n, "be at least 4");
        detail::require(values_[1].size() == n, "Profile", "number of z", values_[1].size(), "equal that of y");
        for (Eigen::Index i = 0; i < n; ++i) {
            check(i, detail::is_finite(values_[0][i]) && detail::is_finite(values_[1][i]), "be finite");
            if (i == 0) continue;
            const double distance = std::hypot(step(0, i), step(1, i));
            check(i, distance > least, "differ from the one before it");
            check(i, distance < 1 / least, "lie within 1e100 of the one before it");
            if (i == 1) continue;
            check(i - 1, step(0, i) * step(0, i - 1) + step(1, i) * step(1, i - 1) >= 0,
                  "not turn the curve by more than 90 degrees");
        }
        if (values_[0][n - 1] < values_[0][0]) {
            for (Eigen::ArrayXd& of : values_) of.reverseInPlace();
        }
        knots_ = Eigen::ArrayXd::Zero(n);
        for (Eigen::Index i = 1; i < n; ++i) knots_[i] = knots_[i - 1] + std::hypot(step(0, i), step(1, i));
        detail::require(values_[0][n - 1] > values_[0][0], "Profile", "y from one end to the other",
                        values_[0][n - 1] - values_[0][0], "differ");
        for (std::size_t k = 0; k < 2; ++k) bends_[k] = second_derivatives(values_[k]);
    }

    double length() const { return knots_[knots_.size() - 1]; }
    Eigen::Index size() const { return knots_.size(); }     ///< number of points
    const Eigen::ArrayXd& s() const { return knots_; }      ///< of the points
    const Eigen::ArrayXd& y() const { return values_[0]; }  ///< of the points
    const Eigen::ArrayXd& z() const { return values_[1]; }  ///< of the points

    /// At 0 <= s <= length(); beyond, the spline of the last interval goes on.
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

    /// The same curve turned about the origin by `angle` [rad], from y towards z, and moved by (dy, dz) [m].
    Profile moved(double angle, double dy, double dz) const {
        const double c = std::cos(angle), s = std::sin(angle);
        return {c * y() - s * z() + dy, s * y() + c * z() + dz};
    }

    /// The smoothest curve that deviates from the points by `deviation` [m], root of the mean square, in y and z
    /// together: of all curves that do, it has the least integral of the squared second derivatives (Reinsch 1967).
    /// Throws std::invalid_argument unless the deviation is positive and finite. Returns the profile itself where even
    /// the straight line deviates less.
    Profile smoothed(double deviation) const;

private:
    static void check(Eigen::Index i, bool holds, const char* rule) {
        if (holds) return;
        std::string text = "be that of a point that must ";
        text += rule;
        detail::require(false, "Profile", "number of the point", i + 1, text.c_str());
    }
    double step(std::size_t k, Eigen::Index i) const { return values_[k][i] - values_[k][i - 1]; }

    // Of the spline through the values whose third derivative is the same on both sides of the second point, and of the
    // last but one.
    Eigen::ArrayXd second_derivatives(const Eigen::ArrayXd& f) const {
        const Eigen::Index n = f.size();
        Eigen::ArrayXd diagonal(n), upper(n), m = Eigen::ArrayXd::Zero(n);
        const auto h = [&](Eigen::Index i) { return knots_[i + 1] - knots_[i]; };
        // m_0 = m_1 - (h_0/h_1) (m_2 - m_1) and its mirror image, put into the equations of the inner points
        for (Eigen::Index i = 1; i < n - 1; ++i) {
            double lower = h(i - 1), here = 2 * (h(i - 1) + h(i)), above = h(i);
            if (i == 1) {
                const double r = h(0) / h(1);
                here += h(0) * (1 + r);
                above -= h(0) * r;
                lower = 0;
            }
            if (i == n - 2) {
                const double r = h(n - 2) / h(n - 3);
                here += h(n - 2) * (1 + r);
                lower -= h(n - 2) * r;
                above = 0;
            }
            const double right = 6 * ((f[i + 1] - f[i]) / h(i) - (f[i] - f[i - 1]) / h(i - 1));
            const double share = i == 1 ? 0 : lower / diagonal[i - 1];
            diagonal[i] = here - (i == 1 ? 0 : share * upper[i - 1]);
            upper[i] = above;
            m[i] = right - (i == 1 ? 0 : share * m[i - 1]);
        }
        for (Eigen::Index i = n - 2; i >= 1; --i) m[i] = (m[i] - upper[i] * m[i + 1]) / diagonal[i];
        m[0] = m[1] - h(0) / h(1) * (m[2] - m[1]);
        m[n - 1] = m[n - 2] + h(n - 2) / h(n - 3) * (m[n - 2] - m[n - 3]);
        return m;
    }

    std::array<Eigen::ArrayXd, 2> values_, bends_;  // y and z, and their second derivatives
    Eigen::ArrayXd knots_;
};

inline Profile Profile::smoothed(double deviation) const {
    detail::require_positive("Profile::smoothed", "deviation", deviation);
    const Eigen::Index n = size(), inner = n - 2;
    // (R + weight Q^T Q) gamma = Q^T f, smooth f = f - weight Q gamma: five diagonals
    const auto h = [&](Eigen::Index i) { return knots_[i + 1] - knots_[i]; };
    const auto q = [&](Eigen::Index row, Eigen::Index i) {  // of column i, which belongs to point i + 1
        return row == i ? 1 / h(i) : row == i + 1 ? -1 / h(i) - 1 / h(i + 1) : row == i + 2 ? 1 / h(i + 1) : 0.0;
    };
    std::array<Eigen::ArrayXd, 2> smooth;
    const auto deviates = [&](double weight) {
        Eigen::ArrayXXd band = Eigen::ArrayXXd::Zero(inner, 3);  // L D L^T: D, and two diagonals of L
        double square = 0;
        for (Eigen::Index i = 0; i < inner; ++i) {
            double a[3];  // the row to the right of the diagonal
            for (Eigen::Index k = 0; k < 3; ++k) {
                a[k] = k == 0 ? (h(i) + h(i + 1)) / 3 : k == 1 ? h(i + 1) / 6 : 0;
                for (Eigen::Index row = i + k; row < i + 3 && i + k < inner; ++row)
                    a[k] += weight * q(row, i) * q(row, i + k);
            }
            const double l1 = i >= 1 ? band(i - 1, 1) : 0, l2 = i >= 2 ? band(i - 2, 2) : 0;
            const double d1 = i >= 1 ? band(i - 1, 0) : 0, d2 = i >= 2 ? band(i - 2, 0) : 0;
            band(i, 0) = a[0] - l1 * l1 * d1 - l2 * l2 * d2;
            band(i, 1) = (a[1] - (i >= 1 ? band(i - 1, 1) * band(i - 1, 2) * d1 : 0)) / band(i, 0);
            band(i, 2) = a[2] / band(i, 0);
        }
        for (std::size_t k = 0; k < 2; ++k) {
            const Eigen::ArrayXd& f = values_[k];
            Eigen::ArrayXd g(inner);
            for (Eigen::Index i = 0; i < inner; ++i) {
                g[i] = (f[i + 2] - f[i + 1]) / h(i + 1) - (f[i + 1] - f[i]) / h(i);
                if (i >= 1) g[i] -= band(i - 1, 1) * g[i - 1];
                if (i >= 2) g[i] -= band(i - 2, 2) * g[i - 2];
            }
            g /= band.col(0);
            for (Eigen::Index i = inner - 1; i >= 0; --i) {
                if (i + 1 < inner) g[i] -= band(i, 1) * g[i + 1];
                if (i + 2 < inner) g[i] -= band(i, 2) * g[i + 2];
            }
            smooth[k] = f;
            for (Eigen::Index i = 0; i < inner; ++i) {
                for (Eigen::Index row = i; row < i + 3; ++row) smooth[k][row] -= weight * q(row, i) * g[i];
            }
            square += (smooth[k] - f).square().sum();
        }
        return std::sqrt(square / static_cast<double>(n));
    };
    double low = -60, high = 20;  // ln of the weight over the cube of the length
    const double cube = std::pow(length(), 3);
    if (deviates(cube * std::exp(high)) < deviation) return *this;
    for (int k = 0; k < 60; ++k) {
        const double middle = (low + high) / 2;
        (deviates(cube * std::exp(middle)) > deviation ? high : low) = middle;
    }
    deviates(cube * std::exp(low));
    return {smooth[0], smooth[1]};
}

namespace detail {

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

/// z [mm] of 60E1 (UIC 60) before it is canted.
inline double rail_60e1_height(double y) {
    const double x = std::abs(y);
    // where arcs touch, their centres and the joint lie on one line
    const auto joint = [](double x_1, double z_1, double r_1, double x_2, double z_2) {
        return x_1 + r_1 * (x_2 - x_1) / std::hypot(x_2 - x_1, z_2 - z_1);
    };
    const auto arc = [](double at, double centre_x, double centre_z, double radius) {
        return centre_z - std::sqrt(radius * radius - (at - centre_x) * (at - centre_x));
    };
    static constexpr double x_80 = 7.7, z_80 = 80.1348, x_13 = 23.0162, z_13 = 14.9090;
    if (x <= joint(0, 300, 300, x_80, z_80)) return arc(x, 0, 300, 300);
    if (x <= joint(x_80, z_80, 80, x_13, z_13)) return arc(x, x_80, z_80, 80);
    const double side = x_13 + 13 * std::cos(std::atan(0.05));  // where the arc has the slope of the side
    if (x <= side) return arc(x, x_13, z_13, 13);
    return arc(side, x_13, z_13, 13) + 20 * (x - side);
}

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

}  // namespace detail

/// The wheel S1002 (EN 13715), from the flange's back to 60 mm outside the tape circle; tape circle at y = 0.
inline Profile s1002() { return detail::sampled(-69.95, 60, 0.1, detail::s1002_height); }

/// The rail 60E1 (UIC 60), canted inwards, towards negative y, by `cant` [rad], its highest point at y = z = 0.
inline Profile rail_60e1(double cant = std::atan(1.0 / 40)) {
    const Profile canted = detail::sampled(-36.2, 36.2, 0.1, detail::rail_60e1_height).moved(-cant, 0, 0);
    // the highest point, where z' = 0
    double low = 0.3 * canted.length(), high = 0.7 * canted.length();
    for (int k = 0; k < 60; ++k) {
        const double middle = (low + high) / 2;
        (canted.at(middle).slope[1] < 0 ? low : high) = middle;
    }
    const Profile::Point top = canted.at(low);
    return canted.moved(0, -top.y, -top.z);
}

}  // namespace rollbem
