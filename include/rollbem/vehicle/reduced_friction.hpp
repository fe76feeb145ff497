// ReducedFriction: creep forces on wet or dirty rails, from the forces of a table by two factors and a falling
// coefficient of friction.
#pragma once

#include "../detail/decl.hpp"

#include <cmath>
#include <limits>

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
/// with |X| = saturation_parameter()/(mu N). All forces of the table, at mu(w), are multiplied by
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
    explicit ReducedFriction(const Parameters& parameters);

    /// Result of a look-up. Tangents by creepage, load, a and b hold at constant speed and mu_0; the tangent by the
    /// friction coefficient is by mu_0. Status not_finite also if the speed is not finite, invalid_step if it is
    /// negative.
    struct Force : TabulatedForce {
        TangentialForce tangent_by_speed;                                        ///< [N s/m], [N s]
        double friction_coefficient = std::numeric_limits<double>::quiet_NaN();  ///< mu(w) [-]
    };

    const Parameters& parameters() const { return p_; }

    /// Look-up as CreepForceTable::look_up, with mu_0 and the speed V [m/s] at which the wheel rolls. Exact tangents;
    /// allocates nothing.
    Force look_up(const CreepForceTable& table, const PatchContact& contact, double mu_0, double load, double speed,
                  const Creepage& creepage) const noexcept;

private:
    /// pi/2 p and its derivative by eps.
    struct Law {
        double value, slope;
    };
    static Law law(double eps, double k_A, double k_S) noexcept;

    Parameters p_;
};

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/reduced_friction.ipp"
#endif
