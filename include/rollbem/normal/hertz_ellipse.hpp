// Hertz's elliptic contact of two bodies with any principal radii: semi-axes, peak pressure and approach, and the mean
// pressures of rectangular elements under the same or another load. In SI units.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <type_traits>
#include <vector>

#include "../detail/finite.hpp"
#include "../detail/gauss_legendre.hpp"
#include "../detail/require.hpp"
#include "../discretisation/patch_mesh.hpp"
#include "../scene/patch_contact.hpp"
#include "../scene/rolling_ellipse.hpp"
#include "../types.hpp"
#include "hertz.hpp"

namespace rollbem {

namespace detail {

/// Pressures of elements [Pa], and their derivatives with respect to the load [Pa/N].
struct ElementPressures {
    ArrayX<double> mean, rate;
};

/// Complete elliptic integrals of the modulus e = sqrt(1 - kappa^2), by the arithmetic-geometric mean (Abramowitz &
/// Stegun 17.6): K, D = (K - E)/e^2, B = K - D and C = (D - B)/e^2, all without cancellation as e tends to 0.
struct EllipticIntegrals {
    double K, D, B, C;

    /// 0 < kappa <= 1, kappa = b/a of an ellipse with the longer semi-axis a.
    explicit EllipticIntegrals(double kappa) {
        // 1 - E/K = sum of 2^(n-1) c_n^2, c_0 = e; half_sum is the sum without its first term, over e^4
        double mean = (1 + kappa) / 2, geometric = std::sqrt(kappa), c = (1 - kappa) / 2;
        double term = 1 / (4 * (1 + kappa) * (1 + kappa)), sum = term;
        while (c > std::numeric_limits<double>::epsilon() * mean) {
            const double next = (mean + geometric) / 2;
            geometric = std::sqrt(mean * geometric);
            mean = next;
            term *= 2 * (c / (4 * mean)) * (c / (4 * mean));
            c = c * c / (4 * mean);
            sum += term;
        }
        const double e_squared = (1 - kappa) * (1 + kappa);
        K = std::numbers::pi / (2 * mean);
        C = 2 * K * sum;
        D = (K + e_squared * C) / 2;
        B = (K - e_squared * C) / 2;
    }
};

/// kappa = (shorter over longer semi-axis) for the ratio q of the smaller to the larger principal curvature, 0 < q <=
/// 1: q = kappa^2 D/B. Newton's method for ln kappa, whose slope lies between 1.5 and 2.
inline double ellipse_of_curvatures(double q) {
    double log_kappa = std::log(q) * 0.6;
    for (int step = 0; step < 60; ++step) {
        const double kappa = std::exp(log_kappa);
        const EllipticIntegrals at(kappa);
        const double excess = 2 * log_kappa + std::log(at.D / at.B / q);
        const double change = excess / (1 + at.C / at.D + kappa * kappa * at.C / at.B);
        log_kappa = (std::min)(log_kappa - change, 0.0);
        if (std::abs(change) <= 4 * std::numeric_limits<double>::epsilon() * (1 + std::abs(log_kappa))) break;
    }
    return std::exp(log_kappa);
}

/// Integrals over a rectangle, in units of both semi-axes, of sqrt(1 - r^2) and of 1/sqrt(1 - r^2) inside r = 1: in
/// closed form along x, by Gauss's rule in y between the points where the circle cuts its sides.
inline std::array<double, 2> integrate_hemisphere(const Rectangle<double>& unit) {
    static const QuadratureRule<double> rule = gauss_legendre<double>(12);
    std::array<double, 6> ends = {unit.y_1, unit.y_2, 0, 0, 0, 0};
    for (std::size_t k = 0; k < 2; ++k) {
        const double x = k == 0 ? unit.x_1 : unit.x_2;
        ends[2 + 2 * k] = std::sqrt((std::max)((1 - x) * (1 + x), 0.0));
        ends[3 + 2 * k] = -ends[2 + 2 * k];
    }
    for (double& y : ends) y = std::clamp(y, (std::max)(unit.y_1, -1.0), (std::min)(unit.y_2, 1.0));
    std::sort(ends.begin(), ends.end());
    std::array<double, 2> integrals{0, 0};
    for (std::size_t part = 0; part + 1 < ends.size(); ++part) {
        const double width = ends[part + 1] - ends[part];
        if (!(width > 0)) continue;
        for (Eigen::Index k = 0; k < rule.nodes.size(); ++k) {
            // with y = 3 u^2 - 2 u^3 the root of the integrand at a cut becomes smooth
            const double u = (1 + rule.nodes[k]) / 2;
            const double y = ends[part] + width * u * u * (3 - 2 * u);
            const double weight = rule.weights[k] / 2 * width * 6 * u * (1 - u);
            const double chord = std::sqrt((1 - y) * (1 + y));
            const double x_1 = std::clamp(unit.x_1, -chord, chord), x_2 = std::clamp(unit.x_2, -chord, chord);
            const auto height = [&](double x) { return std::sqrt((chord - x) * (chord + x)); };
            const double h_1 = height(x_1), h_2 = height(x_2);
            const double angle = std::atan2(x_2, h_2) - std::atan2(x_1, h_1);
            integrals[0] += weight * (x_2 * h_2 - x_1 * h_1 + chord * chord * angle) / 2;
            integrals[1] += weight * angle;
        }
    }
    return integrals;
}

/// The share of a Hertzian load on an element, and the load times its derivative with respect to the load.
inline std::array<double, 2> hertz_share(double a, double b, const Rectangle<double>& element) {
    const auto [height, inverse] =
        integrate_hemisphere({element.x_1 / a, element.x_2 / a, element.y_1 / b, element.y_2 / b});
    // in units of the load: volumes of the unit hemisphere, whose total is 2 pi/3; p = p0 sqrt(1 - r^2), where 1/r and
    // p0 grow as the cube root of the load: N dp/dN = p0/(3 sqrt(1 - r^2))
    constexpr double per_volume = 3 * std::numbers::inv_pi / 2;
    return {per_volume * height, per_volume / 3 * inverse};
}

/// Sets mean pressures of elements under a load on semi-axes a, b, scaled so that the elements carry it exactly, and
/// their derivatives with respect to the load; returns the share of the load that they cover. Pressures are sized
/// already.
inline double set_ellipse_pressures(double a, double b, double load, const std::vector<Rectangle<double>>& elements,
                                    ArrayX<double>& mean, ArrayX<double>& rate) {
    double carried = 0, growing = 0;
    for (Eigen::Index i = 0; i < mean.size(); ++i) {
        const Rectangle<double>& element = elements[static_cast<std::size_t>(i)];
        const double area = (element.x_2 - element.x_1) * (element.y_2 - element.y_1);
        const auto [share, growth] = hertz_share(a, b, element);
        carried += share;
        growing += growth;
        mean[i] = share / area;
        rate[i] = growth / area;
    }
    // N s_i/sum s, and its derivative with respect to N where ds_i/dN = (growth_i - s_i)/N
    rate = rate / carried + mean * (1 - growing / carried) / carried;
    mean *= load / carried;
    return carried;
}

// Elements that cover less of the load do not cover the contact.
inline constexpr double least_share = 9.0 / 10;

/// HertzEllipse::pressures for semi-axes a, b and a load.
inline ElementPressures ellipse_pressures(double a, double b, double load,
                                          const std::vector<Rectangle<double>>& elements) {
    for (const Rectangle<double>& element : elements) {
        const double area = (element.x_2 - element.x_1) * (element.y_2 - element.y_1);
        require(is_finite(area) && element.x_1 < element.x_2 && element.y_1 < element.y_2, "HertzEllipse",
                "area of an element", area, "be positive and finite");
    }
    const Eigen::Index count = static_cast<Eigen::Index>(elements.size());
    ElementPressures result{ArrayX<double>(count), ArrayX<double>(count)};
    const double carried = set_ellipse_pressures(a, b, load, elements, result.mean, result.rate);
    require(carried >= least_share, "HertzEllipse", "share of the load on the elements", carried,
            "be at least 0.9: they must cover the contact");
    require(all_finite(result.mean) && all_finite(result.rate), "HertzEllipse", "largest pressure",
            result.mean.maxCoeff(), "be finite, as must be its derivative by the load");
    return result;
}

}  // namespace detail

/// Two smooth bodies pressed together: p_n = p0 sqrt(1 - x^2/a^2 - y^2/b^2), N = 2 pi a b p0/3 (Hertz 1882; Johnson,
/// Contact Mechanics, 1985, section 4.2). Half-spaces: a and b small against all radii.
class HertzEllipse {
public:
    /// Principal radii of curvature of a surface at the contact [m]: positive if convex, negative if concave, infinite
    /// if flat, never zero.
    struct Radii {
        double rolling;  ///< radius in the plane of the rolling direction x
        double lateral;  ///< radius in the plane across it
    };

    struct Parameters {
        double load;         ///< N [N], positive
        Radii radii_1;       ///< radii of the wheel
        Radii radii_2;       ///< radii of the rail
        double angle = 0;    ///< turn of the planes of radii_2 about z, from x to y [rad]
        ElasticBody body_1;  ///< wheel
        ElasticBody body_2;  ///< rail
    };

    using Pressures = detail::ElementPressures;

    /// Throws std::invalid_argument naming the parameter that is out of range, or if the bodies do not separate in all
    /// directions: both principal curvatures of the gap must be positive.
    explicit HertzEllipse(const Parameters& parameters);

    double load() const { return load_; }          ///< N [N]
    double half_length() const { return a_; }      ///< a [m], the semi-axis within 45 degrees of the rolling direction
    double half_width() const { return b_; }       ///< b [m]
    double approach() const { return approach_; }  ///< approach of distant points of both bodies [m]
    /// Angle by which the axis a is turned from the rolling direction x towards y [rad], in [-pi/4, pi/4]; 0 if the
    /// principal planes of both bodies agree, or for a circle.
    double turn() const { return turn_; }
    double peak_pressure() const { return 3 * load_ / (2 * std::numbers::pi * a_ * b_); }  ///< p0 [Pa]

    /// The ellipse of the same load, area and pressures that rolls along its axis a. It replaces a turned ellipse in
    /// contact(), HertzPatchLoad and CreepForceTable; see rolling_ellipse(), which has its derivatives.
    HertzEllipse along_rolling() const {
        HertzEllipse other = *this;
        const SemiAxes axes = rolling_ellipse({a_, b_}, turn_).axes;
        other.a_ = axes.half_length;
        other.b_ = axes.half_width;
        other.turn_ = 0;
        return other;
    }

    /// The contact that rolls along a, with the combined constants of HertzLine::contact. Throws std::invalid_argument
    /// if the ellipse is turned from the rolling direction: then use along_rolling().
    PatchContact contact() const {
        detail::require(std::abs(turn_) <= std::sqrt(std::numeric_limits<double>::epsilon()), "HertzEllipse", "turn",
                        turn_, "be 0: a PatchContact rolls along one of its axes; take along_rolling()");
        return PatchContact({a_, b_, bodies_.shear_modulus, bodies_.poisson_ratio});
    }

    /// The same bodies under another load [N]: a, b and p0 vary as its cube root, the approach as its square. Throws
    /// std::invalid_argument unless the load, sizes and peak pressure are positive and finite.
    HertzEllipse under(double load) const {
        detail::require_positive("HertzEllipse", "load", load);
        HertzEllipse other = *this;
        const double scale = std::cbrt(load / load_);
        other.load_ = load;
        other.a_ *= scale;
        other.b_ *= scale;
        other.approach_ *= scale * scale;
        other.check();
        return other;
    }

    /// d a/dN, d b/dN [m/N] and d approach/dN [m/N].
    double half_length_rate() const { return a_ / (3 * load_); }
    double half_width_rate() const { return b_ / (3 * load_); }
    double approach_rate() const { return 2 * approach_ / (3 * load_); }

    /// Mean pressures of elements in coordinates along the axes a and b, scaled so that they carry the load exactly:
    /// elements within the ellipse, cut by it or beyond it. Throws std::invalid_argument if a rectangle has no area,
    /// or unless they cover nine tenths of the load.
    Pressures pressures(const std::vector<Rectangle<double>>& elements) const {
        return detail::ellipse_pressures(a_, b_, load_, elements);
    }

private:
    static double curvature(double radius, const char* name) {
        detail::require(!detail::is_nan(radius) && radius != 0, "HertzEllipse", name, radius,
                        "be a number other than 0 (infinite if flat, negative if concave)");
        return detail::is_finite(radius) ? 1 / radius : 0.0;
    }

    // Loads, radii and moduli may be so large or small that sizes or pressures overflow.
    void check() const {
        detail::require_positive("HertzEllipse", "shorter semi-axis", (std::min)(a_, b_));
        detail::require_positive("HertzEllipse", "longer semi-axis", (std::max)(a_, b_));
        detail::require_positive("HertzEllipse", "peak pressure", peak_pressure());
        detail::require_positive("HertzEllipse", "growth of the axes with the load",
                                 (std::max)(half_length_rate(), half_width_rate()));
    }

    double load_, a_ = 0, b_ = 0, approach_ = 0, turn_ = 0;
    detail::CombinedBodies bodies_;
};

inline HertzEllipse::HertzEllipse(const Parameters& parameters)
    : load_(parameters.load), bodies_("HertzEllipse", parameters.body_1, parameters.body_2) {
    detail::require_positive("HertzEllipse", "load", load_);
    detail::require_finite("HertzEllipse", "angle", parameters.angle);
    const double x_1 = curvature(parameters.radii_1.rolling, "radii_1.rolling"),
                 y_1 = curvature(parameters.radii_1.lateral, "radii_1.lateral"),
                 x_2 = curvature(parameters.radii_2.rolling, "radii_2.rolling"),
                 y_2 = curvature(parameters.radii_2.lateral, "radii_2.lateral");
    const double cosine = std::cos(parameters.angle), sine = std::sin(parameters.angle);
    const double xx = x_1 + x_2 * cosine * cosine + y_2 * sine * sine;
    const double yy = y_1 + x_2 * sine * sine + y_2 * cosine * cosine;
    const double xy = (x_2 - y_2) * sine * cosine;
    // principal curvatures of the gap; the smaller by the determinant, so that a long ellipse keeps its digits
    const double larger = (xx + yy) / 2 + std::hypot((xx - yy) / 2, xy);
    const double smaller = xy == 0 ? (std::min)(xx, yy) : yy * (xx / larger) - xy * (xy / larger);
    detail::require(larger > 0 && smaller > 0, "HertzEllipse", "smaller principal curvature of the gap", smaller,
                    "be positive");
    const bool across = xx < yy;  // the larger curvature, and with it the shorter axis
    turn_ = std::atan2(across ? -2 * xy : 2 * xy, std::abs(xx - yy)) / 2;

    const double kappa = detail::ellipse_of_curvatures((std::min)(smaller / larger, 1.0));
    const detail::EllipticIntegrals integrals(kappa);
    const double pi = std::numbers::pi;
    const double longer = std::cbrt(3 * load_ * bodies_.compliance * integrals.D / (pi * smaller)),
                 shorter = kappa * longer;
    a_ = across ? longer : shorter;
    b_ = across ? shorter : longer;
    approach_ = 3 * load_ * bodies_.compliance * integrals.K / (2 * pi * longer);
    check();
}

/// Mean pressures [Pa] of elements that cover an elliptic patch, whether they end on its edge or beyond, under the load
/// N [N], which they carry exactly: p_n = 3 N/(2 pi a b) sqrt(1 - x^2/a^2 - y^2/b^2). Throws std::invalid_argument for
/// an outline, unless the load is positive and finite and the elements cover nine tenths of it, or if one has no area.
inline ArrayX<double> hertz_pressures(const PatchContact& contact, const std::vector<Rectangle<double>>& elements,
                                      std::type_identity_t<double> load) {
    detail::require(!contact.outline(), "hertz_pressures", "number of lines of an outline",
                    contact.outline() ? contact.outline()->y().size() : 0, "be 0: Hertz's contact is an ellipse");
    detail::require_positive("hertz_pressures", "load", load);
    return detail::ellipse_pressures(contact.half_length(), contact.half_width(), load, elements).mean;
}

/// The mean pressures [Pa] of the elements of the patch's mesh.
inline ArrayX<double> hertz_pressures(const PatchContact& contact, const PatchMesh<double>& mesh,
                                      std::type_identity_t<double> load) {
    return hertz_pressures(contact, mesh.rectangles(contact.half_length()), load);
}

}  // namespace rollbem
