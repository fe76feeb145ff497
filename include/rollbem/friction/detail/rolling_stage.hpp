// The equations s = M p - U of one stage of rolling, for one direction or two. Independent of friction and units.
#pragma once

#include "../../detail/language.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

#include <Eigen/Core>

#include "../../adhesion/detail/rolling_stage.hpp"
#include "../../assembly/element_blocks.hpp"
#include "../../assembly/rolling_system.hpp"
#include "../../status.hpp"
#include "../../types.hpp"

namespace rollbem::detail {

// Alexander's method with two stages (1977): each stage takes sdirk2_part of the step. The second starts from
// U + sdirk2_ratio (U_1 - U), with U_1 the displacement at the end of the first; the slip of the step is sdirk2_ratio
// times that of the first stage plus that of the second.
template <class Scalar>
inline constexpr Scalar sdirk2_part = 1 - std::numbers::sqrt2_v<Scalar> / 2;
template <class Scalar>
inline constexpr Scalar sdirk2_ratio = 1 + std::numbers::sqrt2_v<Scalar>;  // (1 - part)/part

/// Position of a stage in its step, for quantities that vary linearly during the step.
template <class Scalar>
struct StagePlace {
    Scalar part;      ///< share of the step that the stage takes
    Scalar progress;  ///< share of the step that is done at the end of the stage
};

template <class Scalar>
Influence<Scalar> influence(const ElementSystem<Scalar>& system, std::size_t, std::size_t) {
    return influence(system);
}
/// What tractions along direction e cause along direction d.
template <class Scalar>
Influence<Scalar> influence(const ElementSystem<Scalar, 2>& system, std::size_t d, std::size_t e) {
    const Elements<Scalar>& elements = system.elements();
    return {system.G(d, e), system.G_prime(d, e), array_map(elements.areas), array_map(elements.x),
            system.log_strength(d).value_or(Scalar(0))};
}

template <class Scalar>
bool can_breathe(const ElementSystem<Scalar>& system) {
    return system.log_strength().has_value();
}
template <class Scalar>
bool can_breathe(const ElementSystem<Scalar, 2>& system) {
    return system.log_strength(0) && system.log_strength(1) && !system.coupled();
}

/// Whether the half-length of a contact can change from `from` to `to` while it rolls by `distance`, all in a_0: ok or
/// needs_fixed_mesh. For |to - from| >= distance an edge overtakes the particles, and the equations of elements that
/// move with the edge are no longer upwind.
template <class System, class Scalar>
StepStatus check_growth(const System& system, Scalar distance, Scalar from, Scalar to) {
    const bool breathes = from != 1 || to != 1;
    if (breathes && !can_breathe(system)) return StepStatus::needs_fixed_mesh;
    const bool possible = from == to || std::abs(to - from) < distance;
    return possible ? StepStatus::ok : StepStatus::needs_fixed_mesh;
}

/// Displacements in all directions, for coupled blocks the sum of what both cause.
template <class System, class Scalar, class Vectors>
void find_displacements(const System& system, Scalar a, const Vectors& p, Vectors& U) {
    for (Eigen::Index d = 0; d < p.cols(); ++d) {
        const auto direction = static_cast<std::size_t>(d);
        influence(system, direction, direction).find_displacement(LengthScale<Scalar>::at(a), p.col(d), U.col(d));
        if constexpr (Vectors::ColsAtCompileTime == 2) {
            if (system.coupled()) U.col(d).noalias() += a * system.G(direction, 1 - direction) * p.col(1 - d);
        }
    }
}

/// Adds `factor` times dU/da at constant tractions to `sum`; U is scratch. For systems that can breathe.
template <class System, class Scalar, class Vectors>
void add_displacement_rates(const System& system, Scalar a, Scalar factor, const Vectors& p, Vectors& U, Vectors& sum) {
    for (Eigen::Index d = 0; d < p.cols(); ++d) {
        const auto direction = static_cast<std::size_t>(d);
        influence(system, direction, direction).find_displacement(LengthScale<Scalar>::rate(a), p.col(d), U.col(d));
    }
    sum += factor * U;
}

}  // namespace rollbem::detail
