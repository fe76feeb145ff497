// Hertz's line contact of two cylinders: half-length, peak pressure, and the mean pressure of elements. The normal part
// of a friction problem; in SI units.
#pragma once

#include <cmath>
#include <numbers>

#include "../detail/angle_minus_sine.hpp"
#include "../detail/require.hpp"
#include "../discretisation/mesh.hpp"
#include "../scene/contact.hpp"
#include "../types.hpp"

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

}  // namespace rollbem
