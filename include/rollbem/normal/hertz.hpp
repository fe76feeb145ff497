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
template <class Scalar>
struct ElasticBody {
    Scalar young_modulus;  ///< E [Pa]
    Scalar poisson_ratio;  ///< nu [-]

    Scalar shear_modulus() const { return young_modulus / (2 * (1 + poisson_ratio)); }  ///< G [Pa]
};

namespace detail {

/// 1/G = (1/G_1 + 1/G_2)/2 and nu/G = (nu_1/G_1 + nu_2/G_2)/2 (Kalker), and 1/E* = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2.
template <class Scalar>
struct CombinedBodies {
    Scalar shear_modulus, poisson_ratio, compliance = 0;

    /// Throws std::invalid_argument, naming `who`, if a body breaks its invariant.
    CombinedBodies(const char* who, const ElasticBody<Scalar>& one, const ElasticBody<Scalar>& two) {
        for (const ElasticBody<Scalar>& body : {one, two}) {
            require_positive(who, "young_modulus", body.young_modulus);
            require_poisson_ratio(who, body.poisson_ratio);
            compliance += (1 - body.poisson_ratio) * (1 + body.poisson_ratio) / body.young_modulus;
        }
        const Scalar compliance_1 = 1 / one.shear_modulus(), compliance_2 = 1 / two.shear_modulus();
        const Scalar mean = (compliance_1 + compliance_2) / 2;
        shear_modulus = 1 / mean;
        poisson_ratio = (one.poisson_ratio * compliance_1 + two.poisson_ratio * compliance_2) / 2 / mean;
    }
};

}  // namespace detail

template <class Scalar>
ArrayX<Scalar> mean_hertz_pressure(const Mesh<Scalar>& mesh);

/// Hertz's pressure p0 sqrt(1 - x^2/a^2) as a PressureLaw.
template <class Scalar_ = double>
struct HertzPressure {
    using Scalar = Scalar_;

    Scalar peak = 1;  ///< p0 [Pa]

    Scalar operator()(Scalar x_over_a) const { return peak * std::sqrt((1 - x_over_a) * (1 + x_over_a)); }
    ArrayX<Scalar> operator()(const Mesh<Scalar>& mesh) const { return peak * mean_hertz_pressure(mesh); }
};

/// Two parallel cylinders pressed together: p_n(x) = p0 sqrt(1 - x^2/a^2) with a^2 = 4 P R / (pi E*),
/// p0 = 2 P / (pi a) and 1/E* = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2 (Hertz 1882).
template <class Scalar_ = double>
class HertzLine {
public:
    using Scalar = Scalar_;

    struct Parameters {
        Scalar load_per_width;       ///< P [N/m], positive
        Scalar combined_radius;      ///< R [m], 1/R = 1/R_1 + 1/R_2; positive (a concave radius is negative)
        ElasticBody<Scalar> body_1;  ///< wheel
        ElasticBody<Scalar> body_2;  ///< rail or road
    };

    /// Throws std::invalid_argument naming the parameter that is out of range.
    explicit HertzLine(const Parameters& parameters)
        : parameters_(parameters), bodies_("HertzLine", parameters.body_1, parameters.body_2) {
        detail::require_positive("HertzLine", "load_per_width", parameters.load_per_width);
        detail::require_positive("HertzLine", "combined_radius", parameters.combined_radius);
        half_length_ = std::sqrt(4 / std::numbers::pi_v<Scalar> * parameters.load_per_width *
                                 parameters.combined_radius * bodies_.compliance);
        detail::require_positive("HertzLine", "half_length", half_length_);
        detail::require_positive("HertzLine", "peak pressure", peak_pressure());
    }

    /// The line contact with a = 1 and p0 = `peak`, under P = pi/2 peak. Throws std::invalid_argument unless peak is
    /// positive and finite.
    static HertzLine dimensionless(Scalar peak = 1) {
        const ElasticBody<Scalar> body{.young_modulus = 4 * peak, .poisson_ratio = 0};
        return HertzLine({.load_per_width = std::numbers::pi_v<Scalar> / 2 * peak,
                          .combined_radius = 1,
                          .body_1 = body,
                          .body_2 = body});
    }

    Scalar load_per_width() const { return parameters_.load_per_width; }  ///< P [N/m]
    Scalar half_length() const { return half_length_; }                   ///< a [m]
    Scalar peak_pressure() const {                                        ///< p0 [Pa]
        return 2 / std::numbers::pi_v<Scalar> * parameters_.load_per_width / half_length_;
    }

    /// Exact mean pressure of each element of a mesh [Pa]: the pressures carry the load P on any mesh.
    ArrayX<Scalar> mean_pressure(const Mesh<Scalar>& mesh) const;

    /// The pressure at every point, p0 sqrt(1 - x^2) with x in units of a.
    HertzPressure<Scalar> pressure() const { return {peak_pressure()}; }

    /// The contact of half-width b [m] (infinite for steady problems) with the combined constants
    /// 1/G = (1/G_1 + 1/G_2)/2 and nu/G = (nu_1/G_1 + nu_2/G_2)/2 (Kalker). If the bodies are elastically dissimilar,
    /// the pressure itself causes slip, which the tangential theory neglects. Throws std::invalid_argument unless
    /// half_width > 0.
    Contact<Scalar> contact(Scalar half_width) const {
        return Contact<Scalar>({half_length_, half_width, bodies_.shear_modulus, bodies_.poisson_ratio});
    }

private:
    Parameters parameters_;
    detail::CombinedBodies<Scalar> bodies_;
    Scalar half_length_;
};

namespace detail {

/// A part of the interval -1 ... 1: the distances of its two ends from -1 (trailing) and from 1 (leading), and its
/// width.
template <class Scalar>
struct UnitStretch {
    Scalar trailing_1, leading_1;
    Scalar trailing_2, leading_2;
    Scalar width;
};

/// Integrals over a part of the interval of sqrt(1 - x^2) and of 1/sqrt(1 - x^2); the second is the angle of the part,
/// pi in total.
template <class Scalar>
struct SemicircleIntegrals {
    Scalar area, angle;
};

/// The integrals without cancellation at the edges: with x = -cos(theta), mean m and half difference h of theta, the
/// area is (h - sin h) + sin(h) (1 - cos(h) cos(2m)), a sum of positive terms.
template <class Scalar>
SemicircleIntegrals<Scalar> integrate_semicircle(const UnitStretch<Scalar>& stretch) {
    // sines and cosines of theta/2 at both ends are square roots of half the distances from the ends of the contact
    const Scalar sine_1 = std::sqrt(stretch.trailing_1 / 2), cosine_1 = std::sqrt(stretch.leading_1 / 2);
    const Scalar sine_2 = std::sqrt(stretch.trailing_2 / 2), cosine_2 = std::sqrt(stretch.leading_2 / 2);
    const Scalar sine_mean = sine_2 * cosine_1 + cosine_2 * sine_1;
    const Scalar sine_half = stretch.width / (2 * sine_mean);
    const Scalar cosine_half = cosine_1 * cosine_2 + sine_1 * sine_2;
    const Scalar half = std::atan2(sine_half, cosine_half);
    const Scalar half_minus_sine = angle_minus_sine(half, sine_half);
    // 1 - cos(h) cos(2m) = (1 - cos h) + 2 cos(h) sin^2 m
    const Scalar versine = sine_half * sine_half / (1 + cosine_half);
    return {half_minus_sine + sine_half * (versine + 2 * cosine_half * sine_mean * sine_mean), 2 * half};
}

}  // namespace detail

/// Mean of sqrt(1 - x^2) over each element of a mesh (lengths in units of a): Hertz's pressure over its peak.
template <class Scalar>
ArrayX<Scalar> mean_hertz_pressure(const Mesh<Scalar>& mesh) {
    const Eigen::Index n = mesh.size();
    const auto& trailing = mesh.edges_from_trailing();
    const auto& leading = mesh.edges_from_leading();
    ArrayX<Scalar> mean(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const Scalar width = mesh.widths()[i];
        mean[i] =
            detail::integrate_semicircle<Scalar>({trailing[i], leading[i], trailing[i + 1], leading[i + 1], width})
                .area /
            width;
    }
    return mean;
}

template <class Scalar>
ArrayX<Scalar> HertzLine<Scalar>::mean_pressure(const Mesh<Scalar>& mesh) const {
    return peak_pressure() * mean_hertz_pressure(mesh);
}

}  // namespace rollbem
