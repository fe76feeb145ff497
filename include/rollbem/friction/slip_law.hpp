// Friction that depends on the velocity of slip, mu_s(v), with or without memory. SI units.
#pragma once

#include "../detail/language.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../types.hpp"

namespace rollbem {

/// A friction law: the coefficient mu [-] as a continuous function of the slip velocity v >= 0 [m/s], finite and not
/// negative. It is called in every step and must neither throw nor allocate. In time, a law that rises steeply from
/// mu_s(0), such as a regularised Coulomb law within a few mm/s, needs a memory: without one many steps end with
/// StepStatus::no_solution. Steady rolling does not need it.
template <class Law, class Scalar = double>
concept SlipLaw = requires(const Law& law, Scalar velocity) {
    { law(velocity) } -> std::convertible_to<Scalar>;
};

/// mu_k + (mu_0 - mu_k) 2^(-v/v_half).
template <class Scalar = double>
struct ExponentialFall {
    Scalar mu_0, mu_k;     ///< mu at rest and at high velocity [-]
    Scalar half_velocity;  ///< v_half [m/s], at which mu is halfway between mu_0 and mu_k

    Scalar operator()(Scalar velocity) const noexcept {
        return mu_k + (mu_0 - mu_k) * std::exp2(-velocity / half_velocity);
    }
};

/// mu_k + (mu_0 - mu_k) / (1 + v/v_half).
template <class Scalar = double>
struct RationalFall {
    Scalar mu_0, mu_k, half_velocity;  ///< as in ExponentialFall

    Scalar operator()(Scalar velocity) const noexcept { return mu_k + (mu_0 - mu_k) / (1 + velocity / half_velocity); }
};

/// mu_0 - (mu_0 - mu_k) v/(2 v_half) for v < 2 v_half, mu_k beyond.
template <class Scalar = double>
struct LinearFall {
    Scalar mu_0, mu_k, half_velocity;  ///< as in ExponentialFall

    Scalar operator()(Scalar velocity) const noexcept {
        return mu_k + (mu_0 - mu_k) * std::max(Scalar(0), 1 - velocity / (2 * half_velocity));
    }
};

/// Memory of the friction coefficient. The coefficient of a particle follows d mu/dt = -(max(v, v_0)/d) (mu - mu_s(v));
/// a particle enters the contact with mu_s(0). Without memory mu = mu_s(v), and several solutions may exist.
template <class Scalar = double>
struct SlipMemory {
    Scalar distance = 0;        ///< d [m], 0 for no memory
    Scalar least_velocity = 0;  ///< v_0 [m/s]: v_0/d is the rate of relaxation during stick

    /// Weight of the old mu after a time [s] at a velocity [m/s], by implicit Euler.
    Scalar kept(Scalar velocity, Scalar duration) const noexcept {
        return distance > 0 ? distance / (distance + duration * std::max(velocity, least_velocity)) : Scalar(0);
    }
};

namespace detail {

/// Throws std::invalid_argument if the memory is out of range or mu_s(0) is negative or not finite.
template <class Scalar, SlipLaw<Scalar> Law>
void check_slip_law(const char* who, const Law& law, const SlipMemory<Scalar>& memory) {
    const Scalar at_rest = law(Scalar(0));
    require(is_finite(at_rest) && at_rest >= 0, who, "friction coefficient at rest", at_rest,
            "be finite and not negative");
    require(is_finite(memory.distance) && memory.distance >= 0, who, "distance of the memory", memory.distance,
            "be finite and not negative");
    require(is_finite(memory.least_velocity) && memory.least_velocity >= 0, who, "least_velocity of the memory",
            memory.least_velocity, "be finite and not negative");
}

}  // namespace detail

}  // namespace rollbem
