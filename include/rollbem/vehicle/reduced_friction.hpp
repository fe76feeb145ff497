// ReducedFriction: creep forces on wet or dirty rails, from the forces of a table by two factors and a falling
// coefficient of friction.
#pragma once

#include "../detail/language.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../scene/creepage.hpp"
#include "../scene/force.hpp"
#include "../scene/patch_contact.hpp"
#include "../status.hpp"
#include "creep_force_table.hpp"

namespace rollbem {

/// Friction on wet, dirty or dry rails, after O. Polach, Creep forces in simulations of traction vehicles running on
/// adhesion limit, Wear 258 (2005) 992-1000. His coefficient falls with the magnitude w [m/s] of the slip velocity,
///
///     mu(w) = mu_0 ((1 - A) exp(-B w) + A),    w = V sqrt(xi^2 + eta^2 + phi^2 (a^2 + b^2)/5),
///
/// and is the same all over the contact; here w is the root of the mean square of the rigid slip under Hertz's
/// pressure, which adds spin. His force for a gradient eps [-] of the tangential stress is mu N p(eps; k_A, k_S), with
///
///     p(eps; k_A, k_S) = 2/pi (k_A eps/(1 + (k_A eps)^2) + atan(k_S eps)).
///
/// Clean contacts have k_A = k_S = 1. Their slope at rest, 4/pi mu N, must be the linear law's, so that eps = pi/4 |X|
/// with |X| = linear_force_size()/(mu N). All forces of the table, at mu(w), are multiplied by
///
///     r(eps) = p(eps; k_A, k_S)/p(eps; 1, 1).
///
/// So r scales the part of mu N by which a result differs from Polach's. At rest r = (k_A + k_S)/2, whatever mu is; in
/// full sliding r = 1 - 2/pi (1/k_S - 1/k_A)/eps, that is, forces rise to mu(w) N as slowly as his. A factor of the
/// creepages could not do this, because the table is in full sliding from a finite |X| on. As r <= 1, forces oppose
/// slip and remain within mu N wherever the table's forces do.
///     const ReducedFriction wet({.adhesion_factor = 0.3, .slip_factor = 0.1, .friction_ratio = 0.4, .fall = 0.2});
///     const ReducedFriction::Force now = wet.look_up(table, contact, 0.3, load, speed, {xi, eta, phi});
class ReducedFriction {
public:
    struct Parameters {
        double adhesion_factor = 1;  ///< k_A [-], of the area of adhesion
        double slip_factor = 1;      ///< k_S [-], of the area of slip, 0 < k_S <= k_A <= 1
        double friction_ratio = 1;   ///< A [-], mu at infinite slip velocity over mu_0, 0 to 1
        double fall = 0;             ///< B [s/m], not negative; ExponentialFall has v_half = log(2)/B, mu_k = A mu_0
    };

    /// Throws std::invalid_argument if a parameter is out of its bounds.
    explicit ReducedFriction(const Parameters& parameters) : p_(parameters) {
        constexpr const char* name = "ReducedFriction";
        detail::require(p_.adhesion_factor > 0 && p_.adhesion_factor <= 1, name, "adhesion_factor", p_.adhesion_factor,
                        "lie in (0, 1]");
        detail::require(p_.slip_factor > 0 && p_.slip_factor <= p_.adhesion_factor, name, "slip_factor", p_.slip_factor,
                        "be positive and at most adhesion_factor");
        detail::require(p_.friction_ratio >= 0 && p_.friction_ratio <= 1, name, "friction_ratio", p_.friction_ratio,
                        "lie in [0, 1]");
        detail::require_not_negative(name, "fall", p_.fall);
    }

    /// Result of a look-up. Tangents by creepage, load, a and b hold at constant speed and mu_0; the tangent by the
    /// friction coefficient is by mu_0. Status not_finite also if the speed is not finite, invalid_step if it is
    /// negative.
    struct Force : TabulatedForce {
        TangentialForce<double> tangent_by_speed;                                ///< [N s/m], [N s]
        double friction_coefficient = std::numeric_limits<double>::quiet_NaN();  ///< mu(w) [-]
    };

    const Parameters& parameters() const { return p_; }

    /// Look-up as CreepForceTable::look_up, with mu_0 and the speed V [m/s] at which the wheel rolls. Exact tangents;
    /// allocates nothing.
    Force look_up(const CreepForceTable& table, const PatchContact<double>& contact, double mu_0, double load,
                  double speed, const Creepage<double>& creepage) const noexcept {
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

        const CreepForceTable::LinearForce linear = table.linear_force_size(contact, creepage);
        // without friction the contact slides; 1e100 is far in full sliding, and 1e-100 is rest
        const double eps = (std::min)(std::numbers::pi / 4 * linear.value / (mu * load), 1e100);
        const bool slides = !(mu * load > 0);
        const Law reduced = law(eps, p_.adhesion_factor, p_.slip_factor), full = law(eps, 1, 1);
        const bool rests = !(eps > 1e-100) && !slides;
        const double r = slides ? 1 : rests ? (p_.adhesion_factor + p_.slip_factor) / 2 : reduced.value / full.value;
        // derivative of r by log(eps); even in eps, so that at rest it is 0
        const double bend = slides || rests ? 0 : eps * (reduced.slope - r * full.slope) / full.value;
        const TangentialForce<double> bent = bend * clean.force;
        const auto bent_over = [&](double by) {
            return bend != 0 ? TangentialForce<double>{bent.longitudinal / by, bent.lateral / by, bent.moment / by}
                             : TangentialForce<double>{0, 0, 0};
        };
        const TangentialForce<double> by_mu = r * clean.tangent_by_friction_coefficient + bent_over(-mu);
        const double by_slip = -p_.fall * speed * mu_0 * left;  // derivative of mu
        const auto tangent = [&](const TangentialForce<double>& by, double of_linear, double of_slip) {
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

private:
    /// pi/2 p and its derivative by eps.
    struct Law {
        double value, slope;
    };
    static Law law(double eps, double k_A, double k_S) noexcept {
        const double x = k_A * eps, y = k_S * eps, q = 1 / (1 + x * x);
        return {x * q + std::atan(y), k_A * q * (2 * q - 1) + k_S / (1 + y * y)};
    }

    Parameters p_;
};

}  // namespace rollbem
