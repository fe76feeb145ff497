// The equations s = M p - U of one stage of rolling, for one direction or two. Independent of friction and units.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <type_traits>

#include <Eigen/Core>

#include "../../rolling/shape_influence.hpp"
#include "../../rolling/stage.hpp"
#include "../../scene/semi_axes.hpp"
#include "../../status.hpp"
#include "../../system/element_blocks.hpp"
#include "../../system/rolling_system.hpp"
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
    return system.shapes() || (system.log_strength(0) && system.log_strength(1) && !system.coupled());
}

/// The semi-axes of a contact in its own.
template <class Scalar>
inline constexpr SemiAxes<Scalar> contact_axes{1, 1};

/// Whether the a/b of a patch may change, or may not although its size may.
template <class System>
bool changes_shape([[maybe_unused]] const System& system) {
    if constexpr (requires { system.shapes(); }) return system.shapes() && !system.shapes()->is_single();
    return false;
}
template <class System>
bool keeps_shape([[maybe_unused]] const System& system) {
    if constexpr (requires { system.shapes(); }) return system.shapes() && system.shapes()->is_single();
    return false;
}

/// Whether the semi-axes of a contact can change from `from` to `to`, in its own, while it rolls by `distance` in a_0: ok
/// or needs_fixed_mesh. Where the half-length changes by `distance` or more an edge overtakes the particles, and the
/// equations of elements that move with the edge are no longer upwind. On a line the half-width is 1.
template <class System, class Scalar>
StepStatus check_growth(const System& system, Scalar distance, const SemiAxes<Scalar>& from,
                        const SemiAxes<Scalar>& to) {
    if (from == contact_axes<Scalar> && to == contact_axes<Scalar>) return StepStatus::ok;
    if (!can_breathe(system)) return StepStatus::needs_fixed_mesh;
    if constexpr (std::is_same_v<System, ElementSystem<Scalar, 2>>) {
        const auto covers = [&](const SemiAxes<Scalar>& axes) {
            return system.shapes()->covers(system.a_over_b() * axes.half_length / axes.half_width);
        };
        if (system.shapes() && !(covers(from) && covers(to))) return StepStatus::needs_fixed_mesh;
    }
    const bool possible = (from == to || std::abs(to.half_length - from.half_length) < distance) &&
                          to.half_length < system.half_length_limit();
    return possible ? StepStatus::ok : StepStatus::needs_fixed_mesh;
}

/// Displacements in all directions, for coupled blocks the sum of what both cause.
template <class System, class Scalar, class Vectors>
void find_displacements(const System& system, const SemiAxes<Scalar>& axes, const Vectors& p, Vectors& U) {
    if constexpr (Vectors::ColsAtCompileTime == 2) {
        if (system.shapes()) {
            ShapeInfluence<Scalar>(*system.shapes(), system.a_over_b(), axes).find_displacements(p, U);
            return;
        }
    }
    const Scalar a = axes.half_length;
    for (Eigen::Index d = 0; d < p.cols(); ++d) {
        const auto direction = static_cast<std::size_t>(d);
        influence(system, direction, direction).find_displacement(LengthScale<Scalar>::at(a), p.col(d), U.col(d));
        if constexpr (Vectors::ColsAtCompileTime == 2) {
            if (system.coupled()) U.col(d).noalias() += a * system.G(direction, 1 - direction) * p.col(1 - d);
        }
    }
}

/// Adds `factor` times dU/da at constant tractions to `sum`; U is scratch. For lines that can breathe.
template <class System, class Scalar, class Vectors>
void add_displacement_rates(const System& system, Scalar a, Scalar factor, const Vectors& p, Vectors& U, Vectors& sum) {
    for (Eigen::Index d = 0; d < p.cols(); ++d) {
        const auto direction = static_cast<std::size_t>(d);
        influence(system, direction, direction).find_displacement(LengthScale<Scalar>::rate(a), p.col(d), U.col(d));
    }
    sum += factor * U;
}

}  // namespace rollbem::detail
