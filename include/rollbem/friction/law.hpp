// Friction laws on the elements of a mesh: a constant coefficient, or a coefficient that follows the slip velocity at
// once or, with a memory, gradually. SI units.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <functional>
#include <utility>

#include <Eigen/Core>

#include "../types.hpp"

namespace rollbem {

/// A friction law: the coefficient mu [-] as a continuous function of the slip velocity v >= 0 [m/s], finite and not
/// negative. It is called in every step and must neither throw nor allocate. In time, a law that rises steeply from
/// mu_s(0), such as a regularised Coulomb law within a few mm/s, needs a memory: without one many steps end with
/// Status::no_solution. Steady rolling does not need the memory.
template <class Law>
concept SlipLaw = requires(const Law& law, double velocity) {
    { law(velocity) } -> std::convertible_to<double>;
};

/// Friction that falls with the slip velocity v: mu = mu_k + (mu_0 - mu_k) 2^(-v/v_half).
struct ExponentialFall {
    double mu_0, mu_k;     ///< mu at rest and at high velocity [-]
    double half_velocity;  ///< v_half [m/s], at which mu is halfway between mu_0 and mu_k

    double operator()(double velocity) const noexcept {
        return mu_k + (mu_0 - mu_k) * std::exp2(-velocity / half_velocity);
    }
};

/// Friction on the elements of a mesh: |p| <= mu p_n; where an element slips, |p| = mu p_n and p opposes the slip. With
/// two directions, if the equations of the system hold half an element ahead of the elements' centres
/// (Elements::half_element_ahead), slip is rotated to its direction at the centres, where the tractions act. Results
/// are then of second order in 1/n; otherwise they are of first order where the direction of slip varies.
///
///     Friction{0.3, pressure}                              // Coulomb's law
///     Friction{ExponentialFall{0.3, 0.18, 0.1}, pressure}
struct Friction {
    /// The law of a model: a constant coefficient (Coulomb's law), for which no model asks for a speed or a duration,
    /// or any SlipLaw.
    class Law {
    public:
        Law(double mu) : at_rest_(mu) {}  // NOLINT: implicit on purpose
        template <SlipLaw Any>
        Law(Any law)  // NOLINT: implicit on purpose
            : of_slip_([own = std::move(law)](double v) -> double { return own(v); }), at_rest_(of_slip_(0)) {}

        bool is_constant() const { return !of_slip_; }
        double at_rest() const { return at_rest_; }                                ///< mu(0)
        const std::function<double(double)>& of_slip() const { return of_slip_; }  ///< mu(v); empty if it is constant

    private:
        std::function<double(double)> of_slip_;
        double at_rest_;
    };

    /// Memory of the friction coefficient. The coefficient of a particle follows d mu/dt = -(max(v, v_0)/d) (mu -
    /// mu_s(v)); a particle enters the contact with mu_s(0). Without memory mu = mu_s(v), and several solutions may
    /// exist. A constant coefficient ignores the memory.
    struct Memory {
        double distance = 0;        ///< d [m], 0 for no memory
        double least_velocity = 0;  ///< v_0 [m/s]: v_0/d is the rate of relaxation during stick

        /// Weight of the old mu after a time [s] at a velocity [m/s], by implicit Euler.
        double kept(double velocity, double duration) const noexcept {
            return distance > 0 ? distance / (distance + duration * (std::max)(velocity, least_velocity)) : 0.0;
        }
    };

    Law law;                         ///< mu [-], finite and not negative
    ArrayX<double> normal_pressure;  ///< p_n [Pa], mean over each of the mesh's n elements, trailing to leading edge;
                                     ///< finite, not negative, not all zero
    Memory memory{};
    /// Whether results include tangents; tangents left out are NaN. Leaving them out saves time with two directions and
    /// if mu depends on slip: for tangents each stage factorises a matrix of the slipping elements, at a cost of order
    /// n^3, unless the slip velocities equal the previous stage's.
    bool with_tangents = true;
};

}  // namespace rollbem
