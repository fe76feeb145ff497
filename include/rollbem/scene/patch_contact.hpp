// Contact patches: semi-axes, outlines, the ellipse that replaces a turned one, and PatchContact, the shape and
// material of a patch.
#pragma once

#include "../detail/decl.hpp"

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../types.hpp"

namespace rollbem {

/// Semi-axes in metres, or over the semi-axes of a contact.
struct SemiAxes {
    struct AlongRolling;  // semi-axes with derivatives, below

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

/// Semi-axes a', b' along x and y, with their derivatives.
struct SemiAxes::AlongRolling {
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
SemiAxes::AlongRolling rolling_ellipse(const SemiAxes& turned, double turn) noexcept;

/// Shape and material of a contact patch between two equal half-spaces. x is the rolling direction, y lies across it
/// and z points into body 2, so that x, y, z are right-handed.
///
/// \code
/// #include <rollbem/patch.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const PatchContact contact({6e-3, 4e-3, 8.2e10, 0.28});  // a, b [m], G [Pa], nu
///     const auto steady = solve_steady(contact, patch_mesh(contact, 8, 8), NodeDifference{Nodes::chebyshev});
///     return creep_coefficients(contact, steady).c11 > 3 ? 0 : 1;  // Kalker's c11
/// }
/// \endcode
///
/// Invariant: 1e-120 <= a <= 1e60, 0 < b, G < inf, 0 <= nu <= 0.5, and a/b and its inverse are
/// finite.
class PatchContact {
public:
    /// The edges of a contact area over y, linear between the given lines y = const. Creepages, spin and moment refer
    /// to the origin of its coordinates.
    ///
    /// \code
    /// #include <rollbem/patch.hpp>
    ///
    /// int main() {
    ///     using namespace rollbem;
    ///     const Eigen::Array2d y(0, 0.01), trailing(-0.005, 0), leading(0.005, 0);  // a triangle [m]
    ///     const PatchContact contact(PatchContact::Outline(y, trailing, leading), 8.2e10, 0.28);
    ///     return contact.half_length() > 0 ? 0 : 1;  // the radius of the circle of equal area [m]
    /// }
    /// \endcode
    ///
    /// Invariant: at least two lines, all numbers finite, y strictly increasing, trailing < leading; on the first and
    /// the last line both may be equal (a tip). The area is positive and finite.
    class Outline {
    public:
        /// y, x of the trailing and x of the leading edge of each line [m, or any unit of length]. Throws
        /// std::invalid_argument, with the number of the line from 1, if they break the invariant.
        Outline(ArrayX<double> y, ArrayX<double> trailing, ArrayX<double> leading);

        const ArrayX<double>& y() const { return y_; }
        double low() const { return y_[0]; }               ///< smallest y
        double high() const { return y_[y_.size() - 1]; }  ///< largest y
        double area() const { return area_; }

        /// x of an edge at low() <= y <= high().
        double trailing(double y) const { return at(trailing_, y); }
        double leading(double y) const { return at(leading_, y); }

    private:
        static void check(Eigen::Index line, const char* quantity, double value, bool holds, const char* rule);

        double at(const ArrayX<double>& edge, double y) const;

        ArrayX<double> y_, trailing_, leading_;
        double area_ = 0;
    };

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

#ifndef ROLLBEM_COMPILED
#include "impl/patch_contact.ipp"
#endif
