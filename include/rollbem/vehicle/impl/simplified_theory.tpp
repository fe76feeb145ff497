// Bodies of vehicle/simplified_theory.hpp. Internal.
#pragma once

#include "../simplified_theory.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"

namespace rollbem::detail {

inline void require_mesh(const char* who, const SimplifiedTheory::Mesh& mesh) {
    require(mesh.strips >= 3, who, "number of strips", mesh.strips, "be at least 3");
    require(mesh.elements >= 1, who, "number of elements", mesh.elements, "be at least 1");
}

}  // namespace rollbem::detail

namespace rollbem {

inline SimplifiedTheory::SimplifiedTheory(const PatchContact& contact, const CreepCoefficients<double>& coefficients,
                                          double friction_coefficient, double load, const SimplifiedTheory::Mesh& mesh)
    : contact_(contact), c_(coefficients), mesh_(mesh), mu_(friction_coefficient) {
    const char* const who = "SimplifiedTheory";
    detail::require(contact.outline() == nullptr, who, "contact", "outline", "be an ellipse");
    detail::require_positive(who, "c11", c_.c11);
    detail::require_positive(who, "c22", c_.c22);
    detail::require_positive(who, "c23", c_.c23);
    detail::require_positive(who, "friction_coefficient", mu_);
    detail::require_positive(who, "load", load);
    detail::require_mesh(who, mesh);
    peak_ = 3 * load / (2 * std::numbers::pi * contact.half_length() * contact.half_width());
}

inline auto SimplifiedTheory::flexibility() const -> Flexibility {
    const double a = contact_.half_length(), G = contact_.shear_modulus();
    return {8 * a / (3 * c_.c11 * G), 8 * a / (3 * c_.c22 * G),
            std::numbers::pi * a * std::sqrt(contact_.a_over_b()) / (4 * c_.c23 * G)};
}

inline auto SimplifiedTheory::one_flexibility(const Creepage& at) const -> Flexibility {
    const Flexibility L = flexibility();
    const std::array<double, 3> weight{std::abs(at.longitudinal), std::abs(at.lateral),
                                       contact_.c() * std::abs(at.spin)};
    const double size = std::hypot(weight[0], weight[1], weight[2]);
    const double mean = (weight[0] * L.longitudinal + weight[1] * L.lateral + weight[2] * L.spin) / size;
    return {mean, mean, mean};
}

inline bool SimplifiedTheory::is_in_range(const Creepage& at) const {
    const Flexibility L = flexibility();
    const double a = contact_.half_length(), b = contact_.half_width(), xi = std::abs(at.longitudinal),
                 eta = std::abs(at.lateral), phi = std::abs(at.spin);
    return detail::is_finite(2 * a * (xi / L.longitudinal + eta / L.lateral + phi * (a + b) / L.spin)) &&
           detail::is_finite(xi + eta + contact_.c() * phi);
}

inline double SimplifiedTheory::half_circle(double x, double half_length) {
    if (!(half_length > 0)) return 0;
    const double over = std::clamp(x / half_length, -1.0, 1.0);
    return half_length * half_length / 2 * (over * std::sqrt((1 - over) * (1 + over)) + std::asin(over));
}

inline double SimplifiedTheory::elliptic(double ahead, double behind, double half_length) const {
    return mu_ * peak_ / contact_.half_length() * (half_circle(ahead, half_length) - half_circle(behind, half_length)) /
           (ahead - behind);
}

inline double SimplifiedTheory::bound(double ahead, double behind, double half_length) const {
    if (mesh_.bound == SimplifiedTheory::Bound::elliptic) return elliptic(ahead, behind, half_length);
    const double a = contact_.half_length(), mean = (ahead * ahead + ahead * behind + behind * behind) / 3;
    return mu_ * peak_ * 4 / 3 * (half_length * half_length - mean) / (a * a);
}

inline auto SimplifiedTheory::stick_zone(const Creepage& at, double y) const -> StickZone {
    const double pi = std::numbers::pi, unit = contact_.shear_modulus() / (2 * mu_ * peak_), a = contact_.half_length();
    const double psi = unit * 3 * contact_.c() * c_.c23 * at.spin / pi, rest = (1 - psi) * (1 + psi);
    const double along =
                     unit * 4 / (pi * pi) * c_.c11 * at.longitudinal - psi * y / (a * (1 - contact_.poisson_ratio())),
                 across = unit * 4 / (pi * pi) * c_.c22 * at.lateral;
    if (!(rest > 1e-9) || !detail::is_finite(across)) return {2 * a, {}, {}};
    const double slip = (std::hypot(across, std::sqrt(rest) * along) + psi * across) / rest;
    if (!(slip > 0)) return {0, {0, psi}, {0, 0}};  // spin alone, in the middle strip
    const std::array<double, 2> outer{along / slip, across / slip + psi};
    return {a * slip, outer, {outer[0], outer[1] - psi}};
}

inline void SimplifiedTheory::slide(const Creepage& at, const Flexibility& L, double step, double mu_p,
                                    SimplifiedTheory::Element& element) const {
    const std::array<double, 2> compliance{L.longitudinal, L.lateral};
    const double x = element.x + step / 2;
    const std::array<double, 2> rate{at.longitudinal / L.longitudinal - at.spin * element.y / L.spin,
                                     at.lateral / L.lateral + at.spin * x / L.spin};
    std::array<double, 2> trial;
    for (std::size_t k = 0; k < 2; ++k) trial[k] = element.traction[k] - step * rate[k];
    const double size = std::hypot(trial[0], trial[1]);
    element.slips = size > mu_p;
    const double kept = element.slips ? mu_p / size : 1;
    for (std::size_t k = 0; k < 2; ++k) {
        element.traction[k] = kept * trial[k];
        element.slip[k] = compliance[k] * (element.traction[k] - trial[k]) / step;
    }
}

inline void SimplifiedTheory::stick_or_slip(const StickZone& zone, const Strip& strip, double ahead,
                                            SimplifiedTheory::Element& element) const {
    const double behind = 2 * element.x - ahead, p = elliptic(ahead, behind, strip.half_length);
    element.slips = !zone.holds(element.x, strip);
    if (element.slips) {
        const double size = std::hypot(element.traction[0], element.traction[1]);
        for (double& component : element.traction) component *= size > 0 ? p / size : 0;
        return;
    }
    const double inner = elliptic(ahead - zone.slip, behind - zone.slip, strip.half_length - zone.slip);
    for (std::size_t k = 0; k < 2; ++k) element.traction[k] = zone.inner[k] * inner - zone.outer[k] * p;
    element.slip = {};
}

template <class Visitor>
SimplifiedTheory::Force SimplifiedTheory::solve(const Creepage& creepage, bool by_strips, Visitor&& visit) const {
    if (!is_in_range(creepage)) return {};
    TangentialForce force{0, 0, 0};
    const double turn = std::numbers::pi / mesh_.strips;
    for (int j = 0; j < mesh_.strips; ++j) {
        // angles of equal size on the unit circle make sums over strips exact for smooth functions
        const double angle = (j + 0.5) * turn - std::numbers::pi / 2;
        const Strip strip{contact_.half_width() * std::sin(angle), contact_.half_length() * std::cos(angle)};
        const StickZone zone = by_strips ? stick_zone(creepage, strip.y) : StickZone{};
        const double length = 2 * strip.half_length / mesh_.elements;
        SimplifiedTheory::Element by_fastsim{j,  0,  strip.y, length * contact_.half_width() * std::cos(angle) * turn,
                                             {}, {}, false};
        Flexibility L = flexibility();
        for (int i = 0; i < mesh_.elements; ++i) {
            const double ahead = strip.half_length - i * length, step = i > 0 ? length : length / 2;
            by_fastsim.x = ahead - length / 2;
            const double mu_p = bound(ahead, ahead - length, strip.half_length);
            slide(creepage, L, step, mu_p, by_fastsim);
            if (i == 0 && by_strips && by_fastsim.slips) {
                L = one_flexibility(creepage);
                by_fastsim.traction = {};
                slide(creepage, L, step, mu_p, by_fastsim);
            }
            SimplifiedTheory::Element element = by_fastsim;
            if (by_strips) stick_or_slip(zone, strip, ahead, element);
            const double f_x = element.area * element.traction[0], f_y = element.area * element.traction[1];
            force = force + TangentialForce{f_x, f_y, element.x * f_y - element.y * f_x};
            visit(std::as_const(element));
        }
    }
    if (!detail::is_finite(force.longitudinal + force.lateral + force.moment)) return {};
    return {force, Status::ok};
}

}  // namespace rollbem
