// Hertz's line contact of two cylinders: half-length, peak pressure, and the mean pressure of elements. The normal part
// of a friction problem; in SI units.
#pragma once

#include "../detail/decl.hpp"

#include <cmath>
#include <numbers>

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
    CombinedBodies(const char* who, const ElasticBody& one, const ElasticBody& two);
};

}  // namespace detail

/// Hertz's pressure p0 sqrt(1 - x^2/a^2) as a PressureLaw.
struct HertzPressure {
    double peak = 1;  ///< p0 [Pa]

    double operator()(double x_over_a) const { return peak * std::sqrt((1 - x_over_a) * (1 + x_over_a)); }
    ArrayX<double> operator()(const Mesh<double>& mesh) const;
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
    explicit HertzLine(const Parameters& parameters);

    /// The line contact with a = 1 and p0 = `peak`, under P = pi/2 peak. Throws std::invalid_argument unless peak is
    /// positive and finite.
    static HertzLine dimensionless(double peak = 1);

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

/// Mean of sqrt(1 - x^2) over each element of a mesh (lengths in units of a): Hertz's pressure over its peak.
ArrayX<double> mean_hertz_pressure(const Mesh<double>& mesh);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/hertz.ipp"
#endif
