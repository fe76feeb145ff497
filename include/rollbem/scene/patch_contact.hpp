// PatchContact: the contact area and material of rolling contact in three dimensions: an ellipse or any outline, shear
// modulus G and Poisson's ratio nu, checked once on construction.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "../detail/require.hpp"
#include "outline.hpp"

namespace rollbem {

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
