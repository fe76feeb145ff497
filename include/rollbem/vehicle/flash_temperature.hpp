// The flash temperature of a rolling contact: the heating of surfaces by friction in one passage.
#pragma once

#include "../detail/decl.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Core>

namespace rollbem {

/// Friction that falls with the temperature.
struct HotFriction {
    double coefficient;  ///< mu at and above `end` [-]
    double begin, end;   ///< temperatures above ambient between which mu falls or rises linearly [K]

    double at(double cold, double temperature) const {
        return cold + (coefficient - cold) * std::clamp((temperature - begin) / (end - begin), 0.0, 1.0);
    }
};

/// Thermal properties of both bodies, of one material. Each body takes half the heat of friction. Defaults are steel's.
struct Heating {
    double conductivity = 50;       ///< k [W/(m K)]
    double heat_capacity = 3.53e6;  ///< rho c, per volume [J/(m^3 K)]
    std::optional<HotFriction> friction{};

    double diffusivity() const { return conductivity / heat_capacity; }  ///< kappa [m^2/s]
    /// Whether heat stays below the point where it enters: V a is at least 10 kappa.
    bool passes_fast(double speed, double half_length) const { return speed * half_length >= 10 * diffusivity(); }
};

/// Temperatures above ambient [K] at the places `at` [m] of a strip of the contact, which material enters at the
/// leading edge: sqrt(kappa/(pi V))/k times the integral of q/2 (x') / sqrt(x' - x) over all x' ahead, exact for heat
/// per area q [W/m^2] that is uniform in each element. `edges` ascend from the trailing to the leading edge [m], one
/// more than `heat`; V [m/s] must be positive. Heat flows straight down, as in a half-space that passes fast (Carslaw
/// and Jaeger 1959; Heating::passes_fast).
Eigen::ArrayXd flash_temperature(const Eigen::ArrayXd& edges, const Eigen::ArrayXd& heat, const Eigen::ArrayXd& at,
                                 double speed, const Heating& heating);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/flash_temperature.ipp"
#endif
