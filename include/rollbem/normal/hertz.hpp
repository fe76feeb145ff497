// Hertz's contacts of two bodies, a line or an ellipse: sizes, peak pressure, approach, the mean pressures of elements,
// and loads that vary, on a mesh that breathes with the contact or on a fixed one. In SI units.
#pragma once

#include "../detail/decl.hpp"

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

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
    CombinedBodies(const char* who, const ElasticBody& one, const ElasticBody& two);
};

}  // namespace detail

/// Two parallel cylinders pressed together: p_n(x) = p0 sqrt(1 - x^2/a^2) with a^2 = 4 P R / (pi E*),
/// p0 = 2 P / (pi a) and 1/E* = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2 (Hertz 1882).
///
/// \code
/// #include <rollbem/line.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const ElasticBody steel{.young_modulus = 2.1e11, .poisson_ratio = 0.28};
///     const HertzLine line({.load_per_width = 2.5e6, .combined_radius = 0.46, .body_1 = steel, .body_2 = steel});
///     return line.peak_pressure() > 2e8 && line.contact(12e-3).width() == 24e-3 ? 0 : 1;
/// }
/// \endcode
class HertzLine {
public:
    /// Makes the NormalLoad of a load per width P [N/m], for two cylinders with the radius and moduli of a HertzLine.
    ///
    /// \code
    /// #include <rollbem/line.hpp>
    ///
    /// int main() {
    ///     using namespace rollbem;
    ///     const ElasticBody steel{.young_modulus = 2.1e11, .poisson_ratio = 0.28};
    ///     const HertzLine line({.load_per_width = 2.5e6, .combined_radius = 0.46, .body_1 = steel, .body_2 = steel});
    ///     const auto hertz = HertzLine::Load::breathing(line, cosine_mesh(20));
    ///     NormalLoad load = hertz.at(2.5e6);
    ///     if (hertz.set(2.6e6, load) != Status::ok) return 1;  // no allocation
    ///     return load.half_length > line.half_length() ? 0 : 1;
    /// }
    /// \endcode
    ///
    /// A step under the load has the derivative by P tangent_by_load + half_length_rate(P) * tangent_by_half_length.
    class Load {
    public:
        /// The mesh follows the contact: half-length a(P), the shape of the pressures constant.
        static Load breathing(const HertzLine& line, const Mesh<double>& mesh) {
            return Load(line, mesh, std::nullopt);
        }

        /// The mesh covers -half_length ... half_length [m], with the contact in its middle. Elements at the edges of
        /// the contact may be partly covered; each carries its exact mean pressure. Throws std::invalid_argument unless
        /// 0 < half_length < inf.
        static Load fixed(const HertzLine& line, const Mesh<double>& mesh, double half_length);

        bool breathes() const { return !fixed_; }

        /// a [m] of the contact under P [N/m] >= 0.
        double half_length(double load_per_width) const;

        /// d NormalLoad::half_length / dP [m^2/N]: da/dP if the mesh breathes, 0 if it is fixed.
        double half_length_rate(double load_per_width) const;

        /// Sets pressures, their derivatives with respect to P, and the half-length of the mesh. A fixed mesh without
        /// load, P = 0, has no pressure. The status is invalid_load, which a step under the resulting `load` also
        /// returns, if P is negative or not finite, if a fixed mesh does not cover the contact, or if P = 0 on a mesh
        /// that breathes: it would have no length.
        Status set(double load_per_width, NormalLoad& load) const noexcept;

        /// A new load, which set() can overwrite. Throws std::invalid_argument if the status of set() is not ok.
        NormalLoad at(double load_per_width) const;

    private:
        Load(const HertzLine& line, const Mesh<double>& mesh, const std::optional<double>& half_length);

        Eigen::Index size() const { return mesh_.size(); }

        // Sets the load of a contact of half-length a on a fixed mesh. At constant x, dp_n/dP = 1/(pi sqrt(a^2 - x^2)).
        void cover(double load_per_width, double a, NormalLoad& load) const noexcept;

        double load_per_width_, half_length_;  // of the line
        Mesh<double> mesh_;
        ArrayX<double> mean_;
        std::optional<double> fixed_;  // half-length of a fixed mesh [m]
    };

    /// Hertz's pressure p0 sqrt(1 - x^2/a^2) as a PressureLaw.
    struct Pressure {
        double peak = 1;  ///< p0 [Pa]

        double operator()(double x_over_a) const { return peak * std::sqrt((1 - x_over_a) * (1 + x_over_a)); }
        ArrayX<double> operator()(const Mesh<double>& mesh) const;
    };

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
    Pressure pressure() const { return {peak_pressure()}; }

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

namespace detail {

/// Pressures of elements [Pa], and their derivatives with respect to the load [Pa/N].
struct ElementPressures {
    ArrayX<double> mean, rate;
};

}  // namespace detail

/// Two smooth bodies pressed together: p_n = p0 sqrt(1 - x^2/a^2 - y^2/b^2), N = 2 pi a b p0/3 (Hertz 1882; Johnson,
/// Contact Mechanics, 1985, section 4.2). Half-spaces: a and b small against all radii.
///
/// \code
/// #include <rollbem/patch.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const ElasticBody steel{.young_modulus = 2.1e11, .poisson_ratio = 0.28};
///     const double flat = std::numeric_limits<double>::infinity();
///     const HertzEllipse ellipse(
///         {.load = 80e3, .radii_1 = {0.46, flat}, .radii_2 = {flat, 0.3}, .body_1 = steel, .body_2 = steel});
///     return ellipse.contact().a_over_b() > 1 && ellipse.peak_pressure() > 1e9 ? 0 : 1;
/// }
/// \endcode
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

    /// Makes the NormalLoad of a load N [N] for the bodies of a HertzEllipse, whose axes must lie along x and y, as
    /// after HertzEllipse::along_rolling().
    ///
    /// \code
    /// #include <rollbem/patch.hpp>
    ///
    /// int main() {
    ///     using namespace rollbem;
    ///     const ElasticBody steel{.young_modulus = 2.1e11, .poisson_ratio = 0.28};
    ///     const double flat = std::numeric_limits<double>::infinity();
    ///     const HertzEllipse ellipse(
    ///         {.load = 80e3, .radii_1 = {0.46, flat}, .radii_2 = {flat, 0.3}, .body_1 = steel, .body_2 = steel});
    ///     const PatchContact contact = ellipse.contact();
    ///     const auto hertz = HertzEllipse::Load::breathing(ellipse, contact, patch_mesh(contact, 8, 8));
    ///     NormalLoad load = hertz.at(80e3);
    ///     return hertz.set(85e3, load) == Status::ok && load.half_width > contact.half_width() ? 0 : 1;
    /// }
    /// \endcode
    ///
    /// A step under the load has the derivative by N tangent_by_load + half_length_rate(N) * tangent_by_half_length +
    /// half_width_rate(N) * tangent_by_half_width.
    class Load {
    public:
        /// The mesh, made for `contact`, follows the ellipse: semi-axes a(N) and b(N), the shape of the pressures
        /// constant. Throws std::invalid_argument for an outline, or if the axes of the ellipse do not lie along x and
        /// y.
        static Load breathing(const HertzEllipse& ellipse, const PatchContact& contact, const PatchMesh<double>& mesh) {
            return Load(ellipse, contact, mesh, false);
        }

        /// The mesh covers `contact`, the largest ellipse, with the present one in its middle. Throws
        /// std::invalid_argument for an outline, or if the axes of the ellipse do not lie along x and y.
        static Load fixed(const HertzEllipse& ellipse, const PatchContact& contact, const PatchMesh<double>& mesh) {
            return Load(ellipse, contact, mesh, true);
        }

        bool breathes() const { return !fixed_; }

        /// a and b [m] of the ellipse under N [N] >= 0.
        SemiAxes semi_axes(double load) const;

        /// Derivatives of the semi-axes of the mesh by N [m/N]: 0 if it is fixed.
        double half_length_rate(double load) const { return fixed_ ? 0 : semi_axes(load).half_length / (3 * load); }
        double half_width_rate(double load) const { return fixed_ ? 0 : semi_axes(load).half_width / (3 * load); }

        /// Sets pressures, which carry N exactly, their derivatives with respect to N, and the semi-axes of the mesh. A
        /// fixed mesh without load, N = 0, has no pressure. The status is invalid_load, which a step under the
        /// resulting `load` also returns, if N is negative or not finite, if a fixed mesh does not cover the ellipse,
        /// or if N = 0 on a mesh that follows it: it would have no size. It is unresolved, with all of `result` set, if
        /// the ellipse under N > 0 is smaller than least_resolved() of a fixed mesh. The work on a fixed mesh is an
        /// integral for each element.
        Status set(double load, NormalLoad& result) const noexcept { return set(load, semi_axes(load), result); }

        /// Sets pressures for other bodies, radii or load; the status is also invalid_load if their axes do not lie
        /// along x and y.
        Status set(const HertzEllipse& ellipse, NormalLoad& result) const noexcept;

        /// A new load, which set() can overwrite. Throws std::invalid_argument if the status of set() is invalid_load.
        NormalLoad at(double load) const;

    private:
        Load(const HertzEllipse& ellipse, const PatchContact& contact, const PatchMesh<double>& mesh, bool fixed);

        Eigen::Index size() const { return shape_.size(); }

        Status set(double load, const SemiAxes& ellipse, NormalLoad& result) const noexcept;

        bool is_covered(const SemiAxes& ellipse) const;

        Status cover(double load, const SemiAxes& ellipse, NormalLoad& result) const noexcept;

        double load_;       // of the ellipse
        SemiAxes ellipse_;  // its semi-axes
        SemiAxes axes_;     // semi-axes for which the mesh was made
        SemiAxes least_;    // smallest semi-axes that a fixed mesh resolves
        std::vector<PatchMesh<double>::Rectangle> elements_;
        ArrayX<double> shape_;  // pressures for N = a b = 1
        bool fixed_;
    };

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
    /// contact(), HertzEllipse::Load and CreepForceTable; see rolling_ellipse(), which has its derivatives.
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
    Pressures pressures(const std::vector<PatchMesh<double>::Rectangle>& elements) const;

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
ArrayX<double> hertz_pressures(const PatchContact& contact, const std::vector<PatchMesh<double>::Rectangle>& elements,
                               double load);

/// The mean pressures [Pa] of the elements of the patch's mesh.
ArrayX<double> hertz_pressures(const PatchContact& contact, const PatchMesh<double>& mesh, double load);

/// The smallest ellipse [m] that the fixed mesh of a contact resolves, three strips wide and three elements long in the
/// middle of the mesh. On narrower ellipses forces are too large (docs/patch.md).
SemiAxes least_resolved(const PatchContact& contact, const PatchMesh<double>& mesh);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/hertz.ipp"
#endif
