// Contact patches: semi-axes, outlines, the ellipse that replaces a turned one, and PatchContact, the shape and
// material of a patch.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../types.hpp"

namespace rollbem {

/// Semi-axes in metres, or over the semi-axes of a contact.
struct SemiAxes {
    double half_length;  ///< a, in the rolling direction
    double half_width;   ///< b, across it

    friend bool operator==(const SemiAxes&, const SemiAxes&) = default;
};

namespace detail {

/// The semi-axes of a contact over themselves.
inline constexpr SemiAxes contact_axes{1, 1};

inline bool are_positive(const SemiAxes& axes) noexcept {
    return is_finite(axes.half_length) && axes.half_length > 0 && is_finite(axes.half_width) && axes.half_width > 0;
}

}  // namespace detail

/// The edges of a contact area over y, linear between the given lines y = const. Creepages, spin and moment refer to
/// the origin of its coordinates.
///
/// Invariant: at least two lines, all numbers finite, y strictly increasing, trailing < leading; on the first and the
/// last line both may be equal (a tip). The area is positive and finite.
class Outline {
public:
    /// y, x of the trailing and x of the leading edge of each line [m, or any unit of length]. Throws
    /// std::invalid_argument, with the number of the line from 1, if they break the invariant.
    Outline(ArrayX<double> y, ArrayX<double> trailing, ArrayX<double> leading)
        : y_(std::move(y)), trailing_(std::move(trailing)), leading_(std::move(leading)) {
        const Eigen::Index lines = y_.size();
        detail::require(lines >= 2, "Outline", "number of lines", lines, "be at least 2");
        detail::require(trailing_.size() == lines, "Outline", "number of trailing edges", trailing_.size(),
                        "equal the number of y");
        detail::require(leading_.size() == lines, "Outline", "number of leading edges", leading_.size(),
                        "equal the number of y");
        for (Eigen::Index i = 0; i < lines; ++i) {
            check(i, "y", y_[i], detail::is_finite(y_[i]), "be finite");
            check(i, "x_trailing", trailing_[i], detail::is_finite(trailing_[i]), "be finite");
            check(i, "x_leading", leading_[i], detail::is_finite(leading_[i]), "be finite");
            check(i, "y", y_[i], i == 0 || y_[i] > y_[i - 1], "be larger than on the line before it");
            check(i, "x_leading - x_trailing", leading_[i] - trailing_[i], leading_[i] >= trailing_[i],
                  "not be negative: the edges cross");
            check(i, "x_leading - x_trailing", leading_[i] - trailing_[i],
                  leading_[i] > trailing_[i] || i == 0 || i + 1 == lines,
                  "be positive except on the first and the last line");
        }
        for (Eigen::Index i = 1; i < lines; ++i) {
            area_ += (y_[i] - y_[i - 1]) * ((leading_[i] - trailing_[i]) + (leading_[i - 1] - trailing_[i - 1])) / 2;
        }
        detail::require_positive("Outline", "area", area_);
    }

    const ArrayX<double>& y() const { return y_; }
    double low() const { return y_[0]; }               ///< smallest y
    double high() const { return y_[y_.size() - 1]; }  ///< largest y
    double area() const { return area_; }

    /// x of an edge at low() <= y <= high().
    double trailing(double y) const { return at(trailing_, y); }
    double leading(double y) const { return at(leading_, y); }

private:
    static void check(Eigen::Index line, const char* quantity, double value, bool holds, const char* rule) {
        if (holds) return;
        const std::string name = std::string(quantity) + " of line " + detail::to_text(line + 1);
        detail::require(false, "Outline", name.c_str(), value, rule);
    }

    double at(const ArrayX<double>& edge, double y) const {
        const double* const inner = y_.data() + 1;
        const Eigen::Index j = std::upper_bound(inner, inner + y_.size() - 2, y) - y_.data();
        const double part = (y - y_[j - 1]) / (y_[j] - y_[j - 1]);
        return (1 - part) * edge[j - 1] + part * edge[j];
    }

    ArrayX<double> y_, trailing_, leading_;
    double area_ = 0;
};

/// Semi-axes a', b' along x and y, with their derivatives.
struct RollingEllipse {
    SemiAxes axes;            ///< a', b' [m]
    SemiAxes by_half_length;  ///< d a'/da, d b'/da [-]
    SemiAxes by_half_width;   ///< d a'/db, d b'/db [-]
    SemiAxes by_turn;         ///< d a'/d turn, d b'/d turn [m/rad]
};

/// The ellipse along x and y that replaces an ellipse whose axis a is turned from x towards y by `turn` [rad]. Both
/// have the same area, and the same ratio of their extents along x and y, sqrt(a^2 cos^2 + b^2 sin^2) and sqrt(a^2
/// sin^2 + b^2 cos^2), which is also the ratio of the roots of the second moments. Creepages and forces stay in rolling
/// axes. Without a turn the result is exactly the ellipse itself.
///
/// Rolling in the axes of the turned ellipse instead, with creepages turned into them and forces back, has larger
/// errors, as it turns the rolling direction as well: even a circle under spin would then get a longitudinal force. Two
/// forces due to the lack of symmetry are neglected here: along x by lateral creepage and spin, and across by
/// longitudinal creepage. They grow with the turn; docs/vehicle-measured.md has the errors.
inline RollingEllipse rolling_ellipse(const SemiAxes& turned, double turn) noexcept {
    const double a = turned.half_length, b = turned.half_width, cosine = std::cos(turn), sine = std::sin(turn);
    // extents over a and b
    const double along = std::hypot(cosine, b / a * sine), across = std::hypot(cosine, a / b * sine);
    const double scale = std::sqrt(along / across);
    RollingEllipse result{.axes = {a * scale, b / scale}, .by_half_length{}, .by_half_width{}, .by_turn{}};
    const auto [length, width] = result.axes;
    // a'^2 = a b e, e the ratio of the extents; derivatives of ln e by ln a (minus the derivative by ln b) and by the
    // turn
    const double x = cosine / along, y = sine / across;
    const double by_log_a = x * x - a / b * y * (a / b * y);
    const double slope = -(a / b - b / a) * sine * cosine * (b / a / (along * along) + a / b / (across * across));
    result.by_half_length = {length * (1 + by_log_a) / (2 * a), width * (1 - by_log_a) / (2 * a)};
    result.by_half_width = {length * (1 - by_log_a) / (2 * b), width * (1 + by_log_a) / (2 * b)};
    result.by_turn = {length * slope / 2, -width * slope / 2};
    return result;
}

/// Shape and material of a contact patch between two equal half-spaces. x is the rolling direction, y lies across it
/// and z points into body 2, so that x, y, z are right-handed.
///
/// Invariant: 1e-120 <= a <= 1e60, 0 < b, G < inf, 0 <= nu <= 0.5, and a/b and its inverse are
/// finite.
class PatchContact {
public:
    struct Parameters {
        double half_length;    ///< a [m], semi-axis in the rolling direction x
        double half_width;     ///< b [m], semi-axis across it
        double shear_modulus;  ///< G [Pa] of both (equal) bodies
        double poisson_ratio;  ///< nu [-]
    };

    /// An ellipse. Throws std::invalid_argument naming the parameter that breaks the invariant.
    explicit PatchContact(const Parameters& parameters) : parameters_(parameters) {
        const Parameters& p = parameters_;
        detail::require_half_length("PatchContact", p.half_length);
        detail::require_positive("PatchContact", "half_width", p.half_width);
        detail::require_positive("PatchContact", "shear_modulus", p.shear_modulus);
        detail::require_poisson_ratio("PatchContact", p.poisson_ratio);
        detail::require_positive("PatchContact", "half_length / half_width", a_over_b());
        detail::require_positive("PatchContact", "half_width / half_length", p.half_width / p.half_length);
    }

    /// Any outline, in metres. a and b are both the radius c of the circle of equal area.
    PatchContact(Outline outline, double shear_modulus, double poisson_ratio)
        : PatchContact(Parameters{radius_of(outline), radius_of(outline), shear_modulus, poisson_ratio}) {
        outline_ = std::make_shared<const Outline>(std::move(outline));
    }

    /// The ellipse with a = G = 1.
    static PatchContact dimensionless(double a_over_b, double poisson_ratio) {
        detail::require_positive("PatchContact", "a_over_b", a_over_b);
        return PatchContact(Parameters{1, 1 / a_over_b, 1, poisson_ratio});
    }

    double half_length() const { return parameters_.half_length; }  ///< a [m]; the unit of length of its systems
    double half_width() const { return parameters_.half_width; }    ///< b [m]
    double shear_modulus() const { return parameters_.shear_modulus; }
    double poisson_ratio() const { return parameters_.poisson_ratio; }
    double a_over_b() const { return parameters_.half_length / parameters_.half_width; }
    double c() const {  ///< sqrt(a b) [m]
        return std::sqrt(parameters_.half_length) * std::sqrt(parameters_.half_width);
    }
    const Outline* outline() const { return outline_.get(); }  ///< null for an ellipse

private:
    static double radius_of(const Outline& outline) { return std::sqrt(outline.area() / std::numbers::pi); }

    Parameters parameters_;
    std::shared_ptr<const Outline> outline_;
};

}  // namespace rollbem
