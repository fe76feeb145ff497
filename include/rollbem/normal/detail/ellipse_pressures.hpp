// Pressures of rectangular elements under Hertz's ellipse. Internal.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include "../../detail/gauss_legendre.hpp"
#include "../../discretisation/patch_mesh.hpp"
#include "../../types.hpp"

namespace rollbem::detail {

/// Integrals over a rectangle, in units of both semi-axes, of sqrt(1 - r^2) and of 1/sqrt(1 - r^2) inside r = 1: in
/// closed form along x, by Gauss's rule in y between the points where the circle cuts its sides.
inline std::array<double, 2> integrate_hemisphere(const PatchMesh<double>::Rectangle& unit) {
    static const QuadratureRule<double> rule = gauss_legendre<double>(12);
    std::array<double, 6> ends = {unit.y_1, unit.y_2, 0, 0, 0, 0};
    for (std::size_t k = 0; k < 2; ++k) {
        const double x = k == 0 ? unit.x_1 : unit.x_2;
        ends[2 + 2 * k] = std::sqrt((std::max)((1 - x) * (1 + x), 0.0));
        ends[3 + 2 * k] = -ends[2 + 2 * k];
    }
    for (double& y : ends) y = std::clamp(y, (std::max)(unit.y_1, -1.0), (std::min)(unit.y_2, 1.0));
    std::sort(ends.begin(), ends.end());
    std::array<double, 2> integrals{0, 0};
    for (std::size_t part = 0; part + 1 < ends.size(); ++part) {
        const double width = ends[part + 1] - ends[part];
        if (!(width > 0)) continue;
        for (Eigen::Index k = 0; k < rule.nodes.size(); ++k) {
            // with y = 3 u^2 - 2 u^3 the root of the integrand at a cut becomes smooth
            const double u = (1 + rule.nodes[k]) / 2;
            const double y = ends[part] + width * u * u * (3 - 2 * u);
            const double weight = rule.weights[k] / 2 * width * 6 * u * (1 - u);
            const double chord = std::sqrt((1 - y) * (1 + y));
            const double x_1 = std::clamp(unit.x_1, -chord, chord), x_2 = std::clamp(unit.x_2, -chord, chord);
            const auto height = [&](double x) { return std::sqrt((chord - x) * (chord + x)); };
            const double h_1 = height(x_1), h_2 = height(x_2);
            const double angle = std::atan2(x_2, h_2) - std::atan2(x_1, h_1);
            integrals[0] += weight * (x_2 * h_2 - x_1 * h_1 + chord * chord * angle) / 2;
            integrals[1] += weight * angle;
        }
    }
    return integrals;
}

/// The share of a Hertzian load on an element, and the load times its derivative with respect to the load.
inline std::array<double, 2> hertz_share(double a, double b, const PatchMesh<double>::Rectangle& element) {
    const auto [height, inverse] =
        integrate_hemisphere({element.x_1 / a, element.x_2 / a, element.y_1 / b, element.y_2 / b});
    // in units of the load: volumes of the unit hemisphere, whose total is 2 pi/3; p = p0 sqrt(1 - r^2), where 1/r and
    // p0 grow as the cube root of the load: N dp/dN = p0/(3 sqrt(1 - r^2))
    constexpr double per_volume = 3 * std::numbers::inv_pi / 2;
    return {per_volume * height, per_volume / 3 * inverse};
}

/// Sets mean pressures of elements under a load on semi-axes a, b, scaled so that the elements carry it exactly, and
/// their derivatives with respect to the load; returns the share of the load that they cover. Pressures are sized
/// already.
inline double set_ellipse_pressures(double a, double b, double load,
                                    const std::vector<PatchMesh<double>::Rectangle>& elements, ArrayX<double>& mean,
                                    ArrayX<double>& rate) {
    double carried = 0, growing = 0;
    for (Eigen::Index i = 0; i < mean.size(); ++i) {
        const PatchMesh<double>::Rectangle& element = elements[static_cast<std::size_t>(i)];
        const double area = (element.x_2 - element.x_1) * (element.y_2 - element.y_1);
        const auto [share, growth] = hertz_share(a, b, element);
        carried += share;
        growing += growth;
        mean[i] = share / area;
        rate[i] = growth / area;
    }
    // N s_i/sum s, and its derivative with respect to N where ds_i/dN = (growth_i - s_i)/N
    rate = rate / carried + mean * (1 - growing / carried) / carried;
    mean *= load / carried;
    return carried;
}

// Elements that cover less of the load do not cover the contact.
inline constexpr double least_share = 9.0 / 10;

}  // namespace rollbem::detail
