// Bodies of normal/hertz.hpp. Internal.
#pragma once

#include "../hertz.hpp"

#include <cmath>
#include <numbers>

#include "../../detail/require.hpp"
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

ROLLBEM_DECL ArrayX<double> HertzPressure::operator()(const Mesh<double>& mesh) const {
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

}  // namespace rollbem
