// The equations s = M p - B of one stage of rolling, for one direction of creepage, on a contact whose length may vary.
// Independent of friction and units.
#pragma once

#include "../../detail/language.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Core>

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

/// Whether the half-length of a contact can change from `from` to `to` while it rolls by `distance`, all in a_0: ok or
/// needs_fixed_mesh. For |to - from| >= distance an edge overtakes the particles, and the equations of elements that
/// move with the edge are no longer upwind.
template <class Scalar>
StepStatus check_growth(const RollingSystem<Scalar>& system, Scalar distance, Scalar from, Scalar to) {
    const bool breathes = from != 1 || to != 1;
    if (breathes && !system.log_strength()) return StepStatus::needs_fixed_mesh;
    const bool possible = from == to || std::abs(to - from) < distance;
    return possible ? StepStatus::ok : StepStatus::needs_fixed_mesh;
}

/// M = a (G - S ln(a) 1 w^T) - (distance + growth zeta) G', row by row, with zeta the collocation points.
template <class Scalar>
void fill_stage_matrix(const RollingSystem<Scalar>& system, const RollingStage<Scalar>& stage, MatrixX<Scalar>& M) {
    if (!stage.varies()) {
        M = system.G() - stage.distance * system.G_prime();
        return;
    }
    const Scalar a = stage.half_length, common = a * *system.log_strength() * std::log(a);
    const ArrayX<Scalar>& zeta = *system.points();
    for (Eigen::Index j = 0; j < M.cols(); ++j) {
        const Scalar column = common * system.weights()[j];
        M.col(j).array() = a * system.G().col(j).array() - column -
                           (stage.distance + stage.growth * zeta) * system.G_prime().col(j).array();
    }
}

/// U = a (G p - S ln(a) (w.p) 1), the displacement caused by tractions p in a contact of half-length a.
template <class Scalar>
void find_displacement(const RollingSystem<Scalar>& system, Scalar half_length, const VectorX<Scalar>& p,
                       VectorX<Scalar>& U) {
    U.noalias() = system.G() * p;
    if (half_length == 1) return;
    const Scalar common = *system.log_strength() * std::log(half_length) * system.weights().matrix().dot(p);
    U.array() = half_length * (U.array() - common);
}

/// dU/da at constant tractions, from U itself: U/a - S (w.p) 1. For systems that can breathe.
template <class Scalar>
void find_displacement_rate(const RollingSystem<Scalar>& system, Scalar half_length, const VectorX<Scalar>& p,
                            const VectorX<Scalar>& U, VectorX<Scalar>& rate) {
    const Scalar common = *system.log_strength() * system.weights().matrix().dot(p);
    rate.array() = U.array() / half_length - common;
}

}  // namespace rollbem::detail
