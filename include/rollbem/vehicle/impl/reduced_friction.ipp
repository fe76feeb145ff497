// Bodies of vehicle/reduced_friction.hpp. Internal.
#pragma once

#include "../reduced_friction.hpp"

#include <algorithm>
#include <numbers>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../detail/finite_force.hpp"

namespace rollbem {

ROLLBEM_DECL ReducedFriction::ReducedFriction(const Parameters& parameters) : p_(parameters) {
    constexpr const char* name = "ReducedFriction";
    detail::require(p_.adhesion_factor > 0 && p_.adhesion_factor <= 1, name, "adhesion_factor", p_.adhesion_factor,
                    "lie in (0, 1]");
    detail::require(p_.slip_factor > 0 && p_.slip_factor <= p_.adhesion_factor, name, "slip_factor", p_.slip_factor,
                    "be positive and at most adhesion_factor");
    detail::require(p_.friction_ratio >= 0 && p_.friction_ratio <= 1, name, "friction_ratio", p_.friction_ratio,
                    "lie in [0, 1]");
    detail::require_not_negative(name, "fall", p_.fall);
}

ROLLBEM_DECL auto ReducedFriction::look_up(const CreepForceTable& table, const PatchContact& contact, double mu_0,
                                           double load, double speed, const Creepage& creepage) const noexcept
    -> Force {
    Force result;
    if (!detail::is_finite(speed) || !detail::is_finite(creepage)) return result;
    result.status = Status::invalid_step;
    if (speed < 0) return result;
    const auto& [xi, eta, phi] = creepage;
    const double a = contact.half_length(), b = contact.half_width();
    const double arm = std::hypot(a, b) / std::sqrt(5.0), slip = std::hypot(xi, eta, arm * phi);
    const double left = (1 - p_.friction_ratio) * std::exp(-p_.fall * speed * slip);
    const double part = left + p_.friction_ratio, mu = mu_0 * part;
    const TabulatedForce clean = table.look_up(contact, mu, load, creepage);
    static_cast<TabulatedForce&>(result) = clean;
    if (clean.status != Status::ok) return result;
    result.friction_coefficient = mu;

    const CreepForceTable::LinearForce linear = table.saturation_parameter(contact, creepage);
    // without friction the contact slides; 1e100 is far in full sliding, and 1e-100 is rest
    const double eps = (std::min)(std::numbers::pi / 4 * linear.value / (mu * load), 1e100);
    const bool slides = !(mu * load > 0);
    const Law reduced = law(eps, p_.adhesion_factor, p_.slip_factor), full = law(eps, 1, 1);
    const bool rests = !(eps > 1e-100) && !slides;
    const double r = slides ? 1 : rests ? (p_.adhesion_factor + p_.slip_factor) / 2 : reduced.value / full.value;
    // derivative of r by log(eps); even in eps, so that at rest it is 0
    const double bend = slides || rests ? 0 : eps * (reduced.slope - r * full.slope) / full.value;
    const TangentialForce bent = bend * clean.force;
    const auto bent_over = [&](double by) {
        return bend != 0 ? TangentialForce{bent.longitudinal / by, bent.lateral / by, bent.moment / by}
                         : TangentialForce{0, 0, 0};
    };
    const TangentialForce by_mu = r * clean.tangent_by_friction_coefficient + bent_over(-mu);
    const double by_slip = -p_.fall * speed * mu_0 * left;  // derivative of mu
    const auto tangent = [&](const TangentialForce& by, double of_linear, double of_slip) {
        return r * by + (bend != 0 ? of_linear / linear.value : 0) * bent + (by_slip * of_slip) * by_mu;
    };
    const auto per_slip = [&](double of) { return slip > 0 ? of / slip : 0; };
    const double turn = per_slip(arm * phi), per_size = phi * turn / (5 * arm);
    const auto& [by_xi, by_eta, by_phi] = linear.by_creepage;
    result.force = r * clean.force;
    result.tangent = {tangent(clean.tangent.by_longitudinal, by_xi, per_slip(xi)),
                      tangent(clean.tangent.by_lateral, by_eta, per_slip(eta)),
                      tangent(clean.tangent.by_spin, by_phi, arm * turn)};
    result.tangent_by_load = r * clean.tangent_by_load + bent_over(-load);
    result.tangent_by_friction_coefficient = part * by_mu;
    result.tangent_by_half_length = tangent(clean.tangent_by_half_length, linear.by_half_length, per_size * a);
    result.tangent_by_half_width = tangent(clean.tangent_by_half_width, linear.by_half_width, per_size * b);
    result.tangent_by_speed = (-p_.fall * slip * mu_0 * left) * by_mu;
    const auto& [x, y, moment] = result.tangent_by_speed;
    return detail::is_finite(result) && detail::is_finite(x + y + moment) ? result : Force{};
}

ROLLBEM_DECL auto ReducedFriction::law(double eps, double k_A, double k_S) noexcept -> Law {
    const double x = k_A * eps, y = k_S * eps, q = 1 / (1 + x * x);
    return {x * q + std::atan(y), k_A * q * (2 * q - 1) + k_S / (1 + y * y)};
}

}  // namespace rollbem
