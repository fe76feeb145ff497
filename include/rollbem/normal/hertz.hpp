// Hertz's contacts of two bodies, a line or an ellipse: sizes, peak pressure, approach, the mean pressures of elements,
// and loads that vary, on a mesh that breathes with the contact or on a fixed one. In SI units.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <type_traits>
#include <vector>

#include "../detail/angle_minus_sine.hpp"
#include "../detail/finite.hpp"
#include "../detail/gauss_legendre.hpp"
#include "../detail/require.hpp"
#include "../discretisation/mesh.hpp"
#include "../discretisation/patch_mesh.hpp"
#include "../scene/contact.hpp"
#include "../scene/patch_contact.hpp"
#include "../status.hpp"
#include "../types.hpp"
#include "load.hpp"

namespace rollbem {

/// An elastic body. Invariant: 0 < young_modulus < inf, 0 <= poisson_ratio <= 0.5.
struct ElasticBody {
    double young_modulus;  ///< E [Pa]
    double poisson_ratio;  ///< nu [-]

    double shear_modulus() const { return young_modulus / (2 * (1 + poisson_ratio)); }  ///< G [Pa]
};

namespace detail {

/// 1/G = (1/G_1 + 1/G_2)/2 and nu/G = (nu_1/G_1 + nu_2/G_2)/2 (Kalker), and 1/E* = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2.
struct CombinedBodies {
    double shear_modulus, poisson_ratio, compliance = 0;

    /// Throws std::invalid_argument, naming `who`, if a body breaks its invariant.
    CombinedBodies(const char* who, const ElasticBody& one, const ElasticBody& two) {
        for (const ElasticBody& body : {one, two}) {
            require_positive(who, "young_modulus", body.young_modulus);
            require_poisson_ratio(who, body.poisson_ratio);
            compliance += (1 - body.poisson_ratio) * (1 + body.poisson_ratio) / body.young_modulus;
        }
        const double compliance_1 = 1 / one.shear_modulus(), compliance_2 = 1 / two.shear_modulus();
        const double mean = (compliance_1 + compliance_2) / 2;
        shear_modulus = 1 / mean;
        poisson_ratio = (one.poisson_ratio * compliance_1 + two.poisson_ratio * compliance_2) / 2 / mean;
    }
};

}  // namespace detail

inline ArrayX<double> mean_hertz_pressure(const Mesh<double>& mesh);

/// Hertz's pressure p0 sqrt(1 - x^2/a^2) as a PressureLaw.
struct HertzPressure {
    double peak = 1;  ///< p0 [Pa]

    double operator()(double x_over_a) const { return peak * std::sqrt((1 - x_over_a) * (1 + x_over_a)); }
    ArrayX<double> operator()(const Mesh<double>& mesh) const { return peak * mean_hertz_pressure(mesh); }
};

/// Two parallel cylinders pressed together: p_n(x) = p0 sqrt(1 - x^2/a^2) with a^2 = 4 P R / (pi E*),
/// p0 = 2 P / (pi a) and 1/E* = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2 (Hertz 1882).
class HertzLine {
public:
    struct Parameters {
        double load_per_width;   ///< P [N/m], positive
        double combined_radius;  ///< R [m], 1/R = 1/R_1 + 1/R_2; positive (a concave radius is negative)
        ElasticBody body_1;      ///< wheel
        ElasticBody body_2;      ///< rail or road
    };

    /// Throws std::invalid_argument naming the parameter that is out of range.
    explicit HertzLine(const Parameters& parameters)
        : parameters_(parameters), bodies_("HertzLine", parameters.body_1, parameters.body_2) {
        detail::require_positive("HertzLine", "load_per_width", parameters.load_per_width);
        detail::require_positive("HertzLine", "combined_radius", parameters.combined_radius);
        half_length_ = std::sqrt(4 / std::numbers::pi * parameters.load_per_width * parameters.combined_radius *
                                 bodies_.compliance);
        detail::require_positive("HertzLine", "half_length", half_length_);
        detail::require_positive("HertzLine", "peak pressure", peak_pressure());
    }

    /// The line contact with a = 1 and p0 = `peak`, under P = pi/2 peak. Throws std::invalid_argument unless peak is
    /// positive and finite.
    static HertzLine dimensionless(double peak = 1) {
        const ElasticBody body{.young_modulus = 4 * peak, .poisson_ratio = 0};
        return HertzLine(
            {.load_per_width = std::numbers::pi / 2 * peak, .combined_radius = 1, .body_1 = body, .body_2 = body});
    }

    double load_per_width() const { return parameters_.load_per_width; }  ///< P [N/m]
    double half_length() const { return half_length_; }                   ///< a [m]
    double peak_pressure() const {                                        ///< p0 [Pa]
        return 2 / std::numbers::pi * parameters_.load_per_width / half_length_;
    }

    /// Exact mean pressure of each element of a mesh [Pa]: the pressures carry the load P on any mesh.
    ArrayX<double> mean_pressure(const Mesh<double>& mesh) const;

    /// The pressure at every point, p0 sqrt(1 - x^2) with x in units of a.
    HertzPressure pressure() const { return {peak_pressure()}; }

    /// The contact of half-width b [m] (infinite for steady problems) with the combined constants
    /// 1/G = (1/G_1 + 1/G_2)/2 and nu/G = (nu_1/G_1 + nu_2/G_2)/2 (Kalker). If the bodies are elastically dissimilar,
    /// the pressure itself causes slip, which the tangential theory neglects. Throws std::invalid_argument unless
    /// half_width > 0.
    Contact contact(double half_width) const {
        return Contact({half_length_, half_width, bodies_.shear_modulus, bodies_.poisson_ratio});
    }

private:
    Parameters parameters_;
    detail::CombinedBodies bodies_;
    double half_length_;
};

namespace detail {

/// A part of the interval -1 ... 1: the distances of its two ends from -1 (trailing) and from 1 (leading), and its
/// width.
struct UnitStretch {
    double trailing_1, leading_1;
    double trailing_2, leading_2;
    double width;
};

/// Integrals over a part of the interval of sqrt(1 - x^2) and of 1/sqrt(1 - x^2); the second is the angle of the part,
/// pi in total.
struct SemicircleIntegrals {
    double area, angle;
};

/// The integrals without cancellation at the edges: with x = -cos(theta), mean m and half difference h of theta, the
/// area is (h - sin h) + sin(h) (1 - cos(h) cos(2m)), a sum of positive terms.
inline SemicircleIntegrals integrate_semicircle(const UnitStretch& stretch) {
    // sines and cosines of theta/2 at both ends are square roots of half the distances from the ends of the contact
    const double sine_1 = std::sqrt(stretch.trailing_1 / 2), cosine_1 = std::sqrt(stretch.leading_1 / 2);
    const double sine_2 = std::sqrt(stretch.trailing_2 / 2), cosine_2 = std::sqrt(stretch.leading_2 / 2);
    const double sine_mean = sine_2 * cosine_1 + cosine_2 * sine_1;
    const double sine_half = stretch.width / (2 * sine_mean);
    const double cosine_half = cosine_1 * cosine_2 + sine_1 * sine_2;
    const double half = std::atan2(sine_half, cosine_half);
    const double half_minus_sine = angle_minus_sine(half, sine_half);
    // 1 - cos(h) cos(2m) = (1 - cos h) + 2 cos(h) sin^2 m
    const double versine = sine_half * sine_half / (1 + cosine_half);
    return {half_minus_sine + sine_half * (versine + 2 * cosine_half * sine_mean * sine_mean), 2 * half};
}

}  // namespace detail

/// Mean of sqrt(1 - x^2) over each element of a mesh (lengths in units of a): Hertz's pressure over its peak.
inline ArrayX<double> mean_hertz_pressure(const Mesh<double>& mesh) {
    const Eigen::Index n = mesh.size();
    const auto& trailing = mesh.edges_from_trailing();
    const auto& leading = mesh.edges_from_leading();
    ArrayX<double> mean(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const double width = mesh.widths()[i];
        mean[i] = detail::integrate_semicircle({trailing[i], leading[i], trailing[i + 1], leading[i + 1], width}).area /
                  width;
    }
    return mean;
}

inline ArrayX<double> HertzLine::mean_pressure(const Mesh<double>& mesh) const {
    return peak_pressure() * mean_hertz_pressure(mesh);
}

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

/// Makes the NormalLoad of a load per width P [N/m], for two cylinders with the radius and moduli of a HertzLine.
///
///     const HertzLoad hertz = HertzLoad::breathing(line, mesh);
///     NormalLoad load = hertz.at(line.load_per_width());
///     hertz.set(load_per_width, load);                                   // no allocation
///     const auto step = model.advance(now, {dq, motion, load}, next, workspace);
///     const auto by_load =
///         step.tangent_by_load + hertz.half_length_rate(load_per_width) * step.tangent_by_half_length;
class HertzLoad {
public:
    /// The mesh follows the contact: half-length a(P), the shape of the pressures constant.
    static HertzLoad breathing(const HertzLine& line, const Mesh<double>& mesh) {
        return HertzLoad(line, mesh, std::nullopt);
    }

    /// The mesh covers -half_length ... half_length [m], with the contact in its middle. Elements at the edges of the
    /// contact may be partly covered; each carries its exact mean pressure. Throws std::invalid_argument unless
    /// 0 < half_length < inf.
    static HertzLoad fixed(const HertzLine& line, const Mesh<double>& mesh, double half_length) {
        detail::require_positive("HertzLoad", "half_length", half_length);
        return HertzLoad(line, mesh, half_length);
    }

    bool breathes() const { return !fixed_; }

    /// a [m] of the contact under P [N/m] >= 0.
    double half_length(double load_per_width) const {
        return line_.half_length() * std::sqrt(load_per_width / line_.load_per_width());
    }

    /// d NormalLoad::half_length / dP [m^2/N]: da/dP if the mesh breathes, 0 if it is fixed.
    double half_length_rate(double load_per_width) const {
        return fixed_ ? 0.0 : half_length(load_per_width) / (2 * load_per_width);
    }

    /// Sets pressures, their derivatives with respect to P, and the half-length of the mesh. A fixed mesh without load,
    /// P = 0, has no pressure. The status is invalid_load, which a step under the resulting `load` also returns, if P
    /// is negative or not finite, if a fixed mesh does not cover the contact, or if P = 0 on a mesh that breathes: it
    /// would have no length.
    Status set(double load_per_width, NormalLoad& load) const noexcept {
        const double a = half_length(load_per_width);
        const bool possible = detail::is_finite(load_per_width) && detail::is_finite(a) && load_per_width >= 0 &&
                              (fixed_ ? a <= *fixed_ * (1 + 4 * std::numeric_limits<double>::epsilon()) : a > 0);
        const bool sized = load.normal_pressure.size() == size() && load.pressure_rate.size() == size();
        load.half_length = possible && sized ? fixed_.value_or(a) : std::numeric_limits<double>::quiet_NaN();
        if (!possible || !sized) return Status::invalid_load;
        if (fixed_) {
            cover(load_per_width, a, load);
        } else {
            const double peak = 2 / std::numbers::pi * load_per_width / a;
            load.normal_pressure = peak * mean_;
            load.pressure_rate = peak / (2 * load_per_width) * mean_;
        }
        return Status::ok;
    }

    /// A new load, which set() can overwrite. Throws std::invalid_argument if the status of set() is not ok.
    NormalLoad at(double load_per_width) const {
        NormalLoad load{ArrayX<double>::Zero(size()), 0, ArrayX<double>::Zero(size())};
        const Status status = set(load_per_width, load);
        detail::require(
            status == Status::ok, "HertzLoad", "load_per_width", load_per_width,
            breathes() ? "be positive and finite" : "be finite, not negative, and have a contact that the mesh covers");
        return load;
    }

private:
    HertzLoad(const HertzLine& line, const Mesh<double>& mesh, const std::optional<double>& half_length)
        : line_(line), mesh_(mesh), mean_(mean_hertz_pressure(mesh)), fixed_(half_length) {}

    Eigen::Index size() const { return mesh_.size(); }

    // Sets the load of a contact of half-length a on a fixed mesh. At constant x, dp_n/dP = 1/(pi sqrt(a^2 - x^2)).
    void cover(double load_per_width, double a, NormalLoad& load) const noexcept {
        const double radius = a / *fixed_,
                     beside = 1 - radius;  // half-length of the contact, and length of the mesh beyond it, over the
                                           // mesh's half-length
        const double peak_times_a = 2 / std::numbers::pi * load_per_width;
        const auto& trailing = mesh_.edges_from_trailing();
        const auto& leading = mesh_.edges_from_leading();
        for (Eigen::Index i = 0; i < size(); ++i) {
            const detail::UnitStretch element{trailing[i] - beside, leading[i] - beside, trailing[i + 1] - beside,
                                              leading[i + 1] - beside, mesh_.widths()[i]};
            const detail::SemicircleIntegrals integrals =
                radius > 0 ? integrate_covered(element, radius) : integrate_beginning(element);
            const double width = *fixed_ * mesh_.widths()[i];
            load.normal_pressure[i] = peak_times_a * integrals.area / width;
            load.pressure_rate[i] = integrals.angle / (std::numbers::pi * width);
        }
    }

    // Integrals of a contact of zero length in the middle of the mesh: it lies in one element, or on the edge between
    // two.
    static detail::SemicircleIntegrals integrate_beginning(const detail::UnitStretch& element) {
        const auto angle = [](double trailing, double leading) {
            const double pi = std::numbers::pi;
            return trailing < leading ? 0.0 : trailing > leading ? pi : pi / 2;
        };
        return {0, angle(element.trailing_2, element.leading_2) - angle(element.trailing_1, element.leading_1)};
    }

    // Integrals over the part of an element inside a contact of half-length `radius`. The distances are measured from
    // the ends of the contact, and negative where the element extends beyond it.
    static detail::SemicircleIntegrals integrate_covered(const detail::UnitStretch& element, double radius) {
        if (element.trailing_2 <= 0 || element.leading_1 <= 0) return {0, 0};
        const bool begins = element.trailing_1 < 0, ends = element.leading_2 < 0;
        const double whole = 2 * radius;
        const double width = begins && ends ? whole
                             : begins       ? element.trailing_2
                             : ends         ? element.leading_1
                                            : element.width;
        return detail::integrate_semicircle({(std::max)(element.trailing_1, 0.0) / radius,
                                             (std::min)(element.leading_1, whole) / radius,
                                             (std::min)(element.trailing_2, whole) / radius,
                                             (std::max)(element.leading_2, 0.0) / radius, width / radius});
    }

    HertzLine line_;
    Mesh<double> mesh_;
    ArrayX<double> mean_;
    std::optional<double> fixed_;  // half-length of a fixed mesh [m]
};

/// The smallest ellipse [m] that the fixed mesh of a contact resolves, three strips wide and three elements long in the
/// middle of the mesh. On narrower ellipses forces are too large (docs/patch.md).
inline SemiAxes least_resolved(const PatchContact& contact, const PatchMesh<double>& mesh) {
    const auto half_of_three = [](const auto& lower, const auto& upper) {
        const Eigen::Index count = lower.size(), first = std::max<Eigen::Index>((count - 3) / 2, 0);
        return (upper[(std::min)(first + 3, count) - 1] - lower[first]) / 2;
    };
    const ArrayX<double> edges = mesh.along().edges();
    const Eigen::Index n = mesh.elements_per_strip();
    const double a = contact.half_length(), rounding = 1 - 8 * std::numeric_limits<double>::epsilon();
    return {a * rounding * half_of_three(edges.head(n), edges.tail(n)),
            a * rounding * half_of_three(mesh.lower(), mesh.upper())};
}

/// Makes the NormalLoad of a load N [N] for the bodies of a HertzEllipse, whose axes must lie along x and y, as after
/// HertzEllipse::along_rolling().
///
///     const HertzPatchLoad hertz = HertzPatchLoad::breathing(ellipse, contact, mesh);
///     NormalLoad load = hertz.at(ellipse.load());
///     hertz.set(N, load);                                       // no allocation
///     const auto step = model.advance(now, {dq, motion, load}, next, workspace);
///     const auto by_load = step.tangent_by_load + hertz.half_length_rate(N) * step.tangent_by_half_length +
///                          hertz.half_width_rate(N) * step.tangent_by_half_width;
///     hertz.set(HertzEllipse(radii), load);  // other radii
class HertzPatchLoad {
public:
    /// The mesh, made for `contact`, follows the ellipse: semi-axes a(N) and b(N), the shape of the pressures constant.
    /// Throws std::invalid_argument for an outline, or if the axes of the ellipse do not lie along x and y.
    static HertzPatchLoad breathing(const HertzEllipse& ellipse, const PatchContact& contact,
                                    const PatchMesh<double>& mesh) {
        return HertzPatchLoad(ellipse, contact, mesh, false);
    }

    /// The mesh covers `contact`, the largest ellipse, with the present one in its middle. Throws
    /// std::invalid_argument for an outline, or if the axes of the ellipse do not lie along x and y.
    static HertzPatchLoad fixed(const HertzEllipse& ellipse, const PatchContact& contact,
                                const PatchMesh<double>& mesh) {
        return HertzPatchLoad(ellipse, contact, mesh, true);
    }

    bool breathes() const { return !fixed_; }

    /// a and b [m] of the ellipse under N [N] >= 0.
    SemiAxes semi_axes(double load) const {
        const double scale = std::cbrt(load / ellipse_.load());
        return {scale * ellipse_.half_length(), scale * ellipse_.half_width()};
    }

    /// Derivatives of the semi-axes of the mesh by N [m/N]: 0 if it is fixed.
    double half_length_rate(double load) const { return fixed_ ? 0 : semi_axes(load).half_length / (3 * load); }
    double half_width_rate(double load) const { return fixed_ ? 0 : semi_axes(load).half_width / (3 * load); }

    /// Sets pressures, which carry N exactly, their derivatives with respect to N, and the semi-axes of the mesh. A
    /// fixed mesh without load, N = 0, has no pressure. The status is invalid_load, which a step under the resulting
    /// `load` also returns, if N is negative or not finite, if a fixed mesh does not cover the ellipse, or if N = 0 on
    /// a mesh that follows it: it would have no size. It is unresolved, with all of `result` set, if the ellipse under
    /// N > 0 is smaller than least_resolved() of a fixed mesh. The work on a fixed mesh is an integral for each
    /// element.
    Status set(double load, NormalLoad& result) const noexcept { return set(load, semi_axes(load), result); }

    /// Sets pressures for other bodies, radii or load; the status is also invalid_load if their axes do not lie along x
    /// and y.
    Status set(const HertzEllipse& ellipse, NormalLoad& result) const noexcept {
        const double load = ellipse.turn() == 0 ? ellipse.load() : std::numeric_limits<double>::quiet_NaN();
        return set(load, {ellipse.half_length(), ellipse.half_width()}, result);
    }

    /// A new load, which set() can overwrite. Throws std::invalid_argument if the status of set() is invalid_load.
    NormalLoad at(double load) const {
        NormalLoad result{ArrayX<double>::Zero(size()), 0, ArrayX<double>::Zero(size())};
        const Status status = set(load, result);
        detail::require(
            status != Status::invalid_load, "HertzPatchLoad", "load", load,
            breathes() ? "be positive and finite" : "be finite, not negative, and have a contact that the mesh covers");
        return result;
    }

private:
    HertzPatchLoad(const HertzEllipse& ellipse, const PatchContact& contact, const PatchMesh<double>& mesh, bool fixed)
        : ellipse_(ellipse),
          axes_{contact.half_length(), contact.half_width()},
          least_(least_resolved(contact, mesh)),
          elements_(mesh.rectangles(contact.half_length())),
          shape_(hertz_pressures(contact, mesh, 1) * (contact.half_length() * contact.half_width())),
          fixed_(fixed) {
        detail::require(ellipse.turn() == 0, "HertzPatchLoad", "turn of the ellipse", ellipse.turn(),
                        "be 0: strips lie along x; take along_rolling()");
    }

    Eigen::Index size() const { return shape_.size(); }

    Status set(double load, const SemiAxes& ellipse, NormalLoad& result) const noexcept {
        const bool sized = result.normal_pressure.size() == size() && result.pressure_rate.size() == size();
        const bool possible = sized && detail::is_finite(load) &&
                              (fixed_ ? load >= 0 && is_covered(ellipse) : load > 0 && detail::are_positive(ellipse));
        const SemiAxes& axes = fixed_ ? axes_ : ellipse;
        result.half_length = possible ? axes.half_length : std::numeric_limits<double>::quiet_NaN();
        result.half_width = axes.half_width;
        if (!possible) return Status::invalid_load;
        if (fixed_) return cover(load, ellipse, result);
        const double mean = load / axes.half_length / axes.half_width;
        result.normal_pressure = mean * shape_;
        result.pressure_rate = mean / (3 * load) * shape_;
        return Status::ok;
    }

    bool is_covered(const SemiAxes& ellipse) const {
        constexpr double rounding = 1 + 4 * std::numeric_limits<double>::epsilon();
        return ellipse.half_length <= axes_.half_length * rounding && ellipse.half_width <= axes_.half_width * rounding;
    }

    Status cover(double load, const SemiAxes& ellipse, NormalLoad& result) const noexcept {
        // without load, a contact far smaller than any element in the middle
        const double beginning = std::numeric_limits<double>::epsilon();
        const double a = (std::max)(ellipse.half_length, beginning * axes_.half_length),
                     b = (std::max)(ellipse.half_width, beginning * axes_.half_width);
        const double share =
            detail::set_ellipse_pressures(a, b, load, elements_, result.normal_pressure, result.pressure_rate);
        if (share >= detail::least_share) {
            const bool resolved = a >= least_.half_length && b >= least_.half_width;
            return resolved || load == 0 ? Status::ok : Status::unresolved;
        }
        result.half_length = std::numeric_limits<double>::quiet_NaN();
        return Status::invalid_load;
    }

    HertzEllipse ellipse_;
    SemiAxes axes_;   // semi-axes for which the mesh was made
    SemiAxes least_;  // smallest semi-axes that a fixed mesh resolves
    std::vector<Rectangle<double>> elements_;
    ArrayX<double> shape_;  // pressures for N = a b = 1
    bool fixed_;
};

}  // namespace rollbem
