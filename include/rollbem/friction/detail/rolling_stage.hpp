// The equations s = M p - U of one stage of rolling on a contact whose length may vary. Independent of friction and
// units.
#pragma once

#include "../../detail/language.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

#include <Eigen/Core>

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

/// Motion and growth of the contact in a stage. Lengths in a_0, the half-length for which the system was assembled.
template <class Scalar>
struct RollingStage {
    Scalar distance;         ///< rolled in the stage
    Scalar half_length = 1;  ///< a at its end
    Scalar growth = 0;       ///< change of the half-length that belongs to the stage, |growth| < distance

    /// A stage that takes `part` of a step and ends within it; the step rolls by `dq` while the half-length varies
    /// linearly.
    static RollingStage within(Scalar part, Scalar dq, Scalar from, Scalar to) {
        return {part * dq, from + part * (to - from), part * (to - from)};
    }
    /// A stage that ends with the step.
    static RollingStage last(Scalar part, Scalar dq, Scalar from, Scalar to) {
        return {part * dq, to, part * (to - from)};
    }

    bool varies() const { return half_length != 1 || growth != 0; }
    friend bool operator==(const RollingStage&, const RollingStage&) = default;
};

/// Position of a stage in its step, for quantities that vary linearly during the step.
template <class Scalar>
struct StagePlace {
    Scalar part;      ///< share of the step that the stage takes
    Scalar progress;  ///< share of the step that is done at the end of the stage
};

/// What tractions along direction e cause along direction d.
template <class Scalar>
struct Influence {
    const MatrixX<Scalar>&G, &G_prime;
    const ArrayX<Scalar>& areas;
    const ArrayX<Scalar>& points;         // x/a of the equations; empty if unknown
    std::optional<Scalar> log_strength;  // S, see RollingSystem

    /// M = a (G - S ln(a) 1 w^T) - (distance + growth zeta) G', row by row, with zeta the collocation points.
    void fill_stage_matrix(const RollingStage<Scalar>& stage, MatrixX<Scalar>& M) const {
        if (!stage.varies()) {
            M = G - stage.distance * G_prime;
            return;
        }
        const Scalar a = stage.half_length, common = a * *log_strength * std::log(a);
        for (Eigen::Index j = 0; j < M.cols(); ++j) {
            M.col(j).array() = a * G.col(j).array() - common * areas[j] -
                               (stage.distance + stage.growth * points) * G_prime.col(j).array();
        }
    }

    /// U = a (G p - S ln(a) (w.p) 1), the displacement caused by tractions p in a contact of half-length a.
    template <class Traction, class Displacement>
    void find_displacement(Scalar a, const Traction& p, Displacement&& U) const {
        U.noalias() = G * p;
        if (a == 1) return;
        const Scalar common = *log_strength * std::log(a) * areas.matrix().dot(p);
        U.array() = a * (U.array() - common);
    }

    /// dU/da at constant tractions, from U itself: U/a - S (w.p) 1. For systems that can breathe.
    template <class Traction, class Displacement>
    void find_displacement_rate(Scalar a, const Traction& p, Displacement&& U) const {
        const Scalar common = *log_strength * areas.matrix().dot(p);
        U.array() = U.array() / a - common;
    }
};

template <class Scalar>
Influence<Scalar> influence(const ElementSystem<Scalar>& system, std::size_t = 0, std::size_t = 0) {
    return {system.G(), system.G_prime(), system.elements().areas, system.elements().x, system.log_strength()};
}
template <class Scalar>
Influence<Scalar> influence(const ElementSystem<Scalar, 2>& system, std::size_t d, std::size_t e) {
    return {system.G(d, e), system.G_prime(d, e), system.elements().areas, system.elements().x, system.log_strength(d)};
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
        influence(system, direction, direction).find_displacement(a, p.col(d), U.col(d));
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
        const Influence<Scalar> own = influence(system, direction, direction);
        own.find_displacement(a, p.col(d), U.col(d));
        own.find_displacement_rate(a, p.col(d), U.col(d));
    }
    sum += factor * U;
}

}  // namespace rollbem::detail
