// Hertz's elliptic contact of two bodies with any principal radii: semi-axes, peak pressure and approach, and the mean
// pressures of rectangular elements under the same or another load. In SI units.
#pragma once

#include "../detail/decl.hpp"

#include <numbers>
#include <vector>

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
    HertzEllipse along_rolling() const;

    /// The contact that rolls along a, with the combined constants of HertzLine::contact. Throws std::invalid_argument
    /// if the ellipse is turned from the rolling direction: then use along_rolling().
    PatchContact contact() const;

    /// The same bodies under another load [N]: a, b and p0 vary as its cube root, the approach as its square. Throws
    /// std::invalid_argument unless the load, sizes and peak pressure are positive and finite.
    HertzEllipse under(double load) const;

    /// d a/dN, d b/dN [m/N] and d approach/dN [m/N].
    double half_length_rate() const { return a_ / (3 * load_); }
    double half_width_rate() const { return b_ / (3 * load_); }
    double approach_rate() const { return 2 * approach_ / (3 * load_); }

    /// Mean pressures of elements in coordinates along the axes a and b, scaled so that they carry the load exactly:
    /// elements within the ellipse, cut by it or beyond it. Throws std::invalid_argument if a rectangle has no area,
    /// or unless they cover nine tenths of the load.
    Pressures pressures(const std::vector<Rectangle<double>>& elements) const;

private:
    static double curvature(double radius, const char* name);

    // Loads, radii and moduli may be so large or small that sizes or pressures overflow.
    void check() const;

    double load_, a_ = 0, b_ = 0, approach_ = 0, turn_ = 0;
    detail::CombinedBodies bodies_;
};

/// Mean pressures [Pa] of elements that cover an elliptic patch, whether they end on its edge or beyond, under the load
/// N [N], which they carry exactly: p_n = 3 N/(2 pi a b) sqrt(1 - x^2/a^2 - y^2/b^2). Throws std::invalid_argument for
/// an outline, unless the load is positive and finite and the elements cover nine tenths of it, or if one has no area.
ArrayX<double> hertz_pressures(const PatchContact& contact, const std::vector<Rectangle<double>>& elements,
                               double load);

/// The mean pressures [Pa] of the elements of the patch's mesh.
ArrayX<double> hertz_pressures(const PatchContact& contact, const PatchMesh<double>& mesh, double load);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/hertz_ellipse.ipp"
#endif
