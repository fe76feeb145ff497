// Bodies of normal/hertz_ellipse.hpp. Internal.
#pragma once

#include "../hertz_ellipse.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../detail/ellipse_pressures.hpp"
#include "../detail/elliptic_integrals.hpp"

namespace rollbem {

namespace detail {

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

ROLLBEM_DECL HertzEllipse HertzEllipse::along_rolling() const {
    HertzEllipse other = *this;
    const SemiAxes axes = rolling_ellipse({a_, b_}, turn_).axes;
    other.a_ = axes.half_length;
    other.b_ = axes.half_width;
    other.turn_ = 0;
    return other;
}

ROLLBEM_DECL auto HertzEllipse::contact() const -> PatchContact {
    detail::require(std::abs(turn_) <= std::sqrt(std::numeric_limits<double>::epsilon()), "HertzEllipse", "turn", turn_,
                    "be 0: a PatchContact rolls along one of its axes; take along_rolling()");
    return PatchContact({a_, b_, bodies_.shear_modulus, bodies_.poisson_ratio});
}

ROLLBEM_DECL HertzEllipse HertzEllipse::under(double load) const {
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

ROLLBEM_DECL auto HertzEllipse::pressures(const std::vector<Rectangle<double>>& elements) const -> Pressures {
    return detail::ellipse_pressures(a_, b_, load_, elements);
}

ROLLBEM_DECL double HertzEllipse::curvature(double radius, const char* name) {
    detail::require(!detail::is_nan(radius) && radius != 0, "HertzEllipse", name, radius,
                    "be a number other than 0 (infinite if flat, negative if concave)");
    return detail::is_finite(radius) ? 1 / radius : 0.0;
}

ROLLBEM_DECL void HertzEllipse::check() const {
    detail::require_positive("HertzEllipse", "shorter semi-axis", (std::min)(a_, b_));
    detail::require_positive("HertzEllipse", "longer semi-axis", (std::max)(a_, b_));
    detail::require_positive("HertzEllipse", "peak pressure", peak_pressure());
    detail::require_positive("HertzEllipse", "growth of the axes with the load",
                             (std::max)(half_length_rate(), half_width_rate()));
}

ROLLBEM_DECL HertzEllipse::HertzEllipse(const Parameters& parameters)
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

ROLLBEM_DECL ArrayX<double> hertz_pressures(const PatchContact& contact, const std::vector<Rectangle<double>>& elements,
                                            double load) {
    detail::require(!contact.outline(), "hertz_pressures", "number of lines of an outline",
                    contact.outline() ? contact.outline()->y().size() : 0, "be 0: Hertz's contact is an ellipse");
    detail::require_positive("hertz_pressures", "load", load);
    return detail::ellipse_pressures(contact.half_length(), contact.half_width(), load, elements).mean;
}

ROLLBEM_DECL ArrayX<double> hertz_pressures(const PatchContact& contact, const PatchMesh<double>& mesh, double load) {
    return hertz_pressures(contact, mesh.rectangles(contact.half_length()), load);
}

}  // namespace rollbem
