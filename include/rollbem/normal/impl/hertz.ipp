// Bodies of normal/hertz.hpp. Internal.
#pragma once

#include "../hertz.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../detail/ellipse_pressures.hpp"
#include "../detail/elliptic_integrals.hpp"
#include "../detail/semicircle.hpp"

namespace rollbem {

namespace detail {

ROLLBEM_DECL CombinedBodies::CombinedBodies(const char* who, const ElasticBody& one, const ElasticBody& two) {
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

}  // namespace detail

ROLLBEM_DECL ArrayX<double> HertzLine::Pressure::operator()(const Mesh<double>& mesh) const {
    return peak * mean_hertz_pressure(mesh);
}

ROLLBEM_DECL HertzLine::HertzLine(const Parameters& parameters)
    : parameters_(parameters), bodies_("HertzLine", parameters.body_1, parameters.body_2) {
    detail::require_positive("HertzLine", "load_per_width", parameters.load_per_width);
    detail::require_positive("HertzLine", "combined_radius", parameters.combined_radius);
    half_length_ =
        std::sqrt(4 / std::numbers::pi * parameters.load_per_width * parameters.combined_radius * bodies_.compliance);
    detail::require_positive("HertzLine", "half_length", half_length_);
    detail::require_positive("HertzLine", "peak pressure", peak_pressure());
}

ROLLBEM_DECL HertzLine HertzLine::dimensionless(double peak) {
    const ElasticBody body{.young_modulus = 4 * peak, .poisson_ratio = 0};
    return HertzLine(
        {.load_per_width = std::numbers::pi / 2 * peak, .combined_radius = 1, .body_1 = body, .body_2 = body});
}

ROLLBEM_DECL ArrayX<double> mean_hertz_pressure(const Mesh<double>& mesh) {
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

ROLLBEM_DECL ArrayX<double> HertzLine::mean_pressure(const Mesh<double>& mesh) const {
    return peak_pressure() * mean_hertz_pressure(mesh);
}

namespace detail {

/// HertzEllipse::pressures for semi-axes a, b and a load.
inline ElementPressures ellipse_pressures(double a, double b, double load,
                                          const std::vector<PatchMesh<double>::Rectangle>& elements) {
    for (const PatchMesh<double>::Rectangle& element : elements) {
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

ROLLBEM_DECL auto HertzEllipse::pressures(const std::vector<PatchMesh<double>::Rectangle>& elements) const
    -> Pressures {
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

ROLLBEM_DECL ArrayX<double> hertz_pressures(const PatchContact& contact,
                                            const std::vector<PatchMesh<double>::Rectangle>& elements, double load) {
    detail::require(!contact.outline(), "hertz_pressures", "number of lines of an outline",
                    contact.outline() ? contact.outline()->y().size() : 0, "be 0: Hertz's contact is an ellipse");
    detail::require_positive("hertz_pressures", "load", load);
    return detail::ellipse_pressures(contact.half_length(), contact.half_width(), load, elements).mean;
}

ROLLBEM_DECL ArrayX<double> hertz_pressures(const PatchContact& contact, const PatchMesh<double>& mesh, double load) {
    return hertz_pressures(contact, mesh.rectangles(contact.half_length()), load);
}

namespace detail {

/// Integrals of a contact of zero length in the middle of the mesh: it lies in one element, or on the edge between two.
inline SemicircleIntegrals integrate_beginning(const UnitStretch& element) {
    const auto angle = [](double trailing, double leading) {
        const double pi = std::numbers::pi;
        return trailing < leading ? 0.0 : trailing > leading ? pi : pi / 2;
    };
    return {0, angle(element.trailing_2, element.leading_2) - angle(element.trailing_1, element.leading_1)};
}

/// Integrals over the part of an element inside a contact of half-length `radius`. The distances are measured from the
/// ends of the contact, and negative where the element extends beyond it.
inline SemicircleIntegrals integrate_covered(const UnitStretch& element, double radius) {
    if (element.trailing_2 <= 0 || element.leading_1 <= 0) return {0, 0};
    const bool begins = element.trailing_1 < 0, ends = element.leading_2 < 0;
    const double whole = 2 * radius;
    const double width = begins && ends ? whole
                         : begins       ? element.trailing_2
                         : ends         ? element.leading_1
                                        : element.width;
    return integrate_semicircle(
        {(std::max)(element.trailing_1, 0.0) / radius, (std::min)(element.leading_1, whole) / radius,
         (std::min)(element.trailing_2, whole) / radius, (std::max)(element.leading_2, 0.0) / radius, width / radius});
}

}  // namespace detail

ROLLBEM_DECL HertzLine::Load::Load(const HertzLine& line, const Mesh<double>& mesh,
                                   const std::optional<double>& half_length)
    : load_per_width_(line.load_per_width()),
      half_length_(line.half_length()),
      mesh_(mesh),
      mean_(mean_hertz_pressure(mesh)),
      fixed_(half_length) {}

ROLLBEM_DECL double HertzLine::Load::half_length(double load_per_width) const {
    return half_length_ * std::sqrt(load_per_width / load_per_width_);
}

ROLLBEM_DECL double HertzLine::Load::half_length_rate(double load_per_width) const {
    return fixed_ ? 0.0 : half_length(load_per_width) / (2 * load_per_width);
}

ROLLBEM_DECL HertzLine::Load HertzLine::Load::fixed(const HertzLine& line, const Mesh<double>& mesh,
                                                    double half_length) {
    detail::require_positive("HertzLine::Load", "half_length", half_length);
    return HertzLine::Load(line, mesh, half_length);
}

ROLLBEM_DECL Status HertzLine::Load::set(double load_per_width, NormalLoad& load) const noexcept {
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

ROLLBEM_DECL auto HertzLine::Load::at(double load_per_width) const -> NormalLoad {
    NormalLoad load{ArrayX<double>::Zero(size()), 0, ArrayX<double>::Zero(size())};
    const Status status = set(load_per_width, load);
    detail::require(
        status == Status::ok, "HertzLine::Load", "load_per_width", load_per_width,
        breathes() ? "be positive and finite" : "be finite, not negative, and have a contact that the mesh covers");
    return load;
}

ROLLBEM_DECL void HertzLine::Load::cover(double load_per_width, double a, NormalLoad& load) const noexcept {
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
            radius > 0 ? detail::integrate_covered(element, radius) : detail::integrate_beginning(element);
        const double width = *fixed_ * mesh_.widths()[i];
        load.normal_pressure[i] = peak_times_a * integrals.area / width;
        load.pressure_rate[i] = integrals.angle / (std::numbers::pi * width);
    }
}

ROLLBEM_DECL SemiAxes least_resolved(const PatchContact& contact, const PatchMesh<double>& mesh) {
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

ROLLBEM_DECL auto HertzEllipse::Load::semi_axes(double load) const -> SemiAxes {
    const double scale = std::cbrt(load / load_);
    return {scale * ellipse_.half_length, scale * ellipse_.half_width};
}

ROLLBEM_DECL Status HertzEllipse::Load::set(const HertzEllipse& ellipse, NormalLoad& result) const noexcept {
    const double load = ellipse.turn() == 0 ? ellipse.load() : std::numeric_limits<double>::quiet_NaN();
    return set(load, {ellipse.half_length(), ellipse.half_width()}, result);
}

ROLLBEM_DECL auto HertzEllipse::Load::at(double load) const -> NormalLoad {
    NormalLoad result{ArrayX<double>::Zero(size()), 0, ArrayX<double>::Zero(size())};
    const Status status = set(load, result);
    detail::require(
        status != Status::invalid_load, "HertzEllipse::Load", "load", load,
        breathes() ? "be positive and finite" : "be finite, not negative, and have a contact that the mesh covers");
    return result;
}

ROLLBEM_DECL HertzEllipse::Load::Load(const HertzEllipse& ellipse, const PatchContact& contact,
                                      const PatchMesh<double>& mesh, bool fixed)
    : load_(ellipse.load()),
      ellipse_{ellipse.half_length(), ellipse.half_width()},
      axes_{contact.half_length(), contact.half_width()},
      least_(least_resolved(contact, mesh)),
      elements_(mesh.rectangles(contact.half_length())),
      shape_(hertz_pressures(contact, mesh, 1) * (contact.half_length() * contact.half_width())),
      fixed_(fixed) {
    detail::require(ellipse.turn() == 0, "HertzEllipse::Load", "turn of the ellipse", ellipse.turn(),
                    "be 0: strips lie along x; take along_rolling()");
}

ROLLBEM_DECL Status HertzEllipse::Load::set(double load, const SemiAxes& ellipse, NormalLoad& result) const noexcept {
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

ROLLBEM_DECL bool HertzEllipse::Load::is_covered(const SemiAxes& ellipse) const {
    constexpr double rounding = 1 + 4 * std::numeric_limits<double>::epsilon();
    return ellipse.half_length <= axes_.half_length * rounding && ellipse.half_width <= axes_.half_width * rounding;
}

ROLLBEM_DECL Status HertzEllipse::Load::cover(double load, const SemiAxes& ellipse, NormalLoad& result) const noexcept {
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

}  // namespace rollbem
