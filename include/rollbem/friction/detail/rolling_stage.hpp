// The equations s = M p - B of one stage of rolling, for one direction of creepage, on a contact whose length may vary.
// Knows neither friction nor units.
#pragma once

#include "../../detail/language.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Core>

#include "../../assembly/rolling_system.hpp"
#include "../../status.hpp"
#include "../../types.hpp"

namespace rollbem::detail {

// Alexander's two stages (1977): each takes sdirk2_part of the step. The second starts from U + sdirk2_ratio (U_1 - U),
// U_1 the displacement that the first has come to; the slip of a step is sdirk2_ratio times the first's and the
// second's.
template <class Scalar>
inline constexpr Scalar sdirk2_part = 1 - std::numbers::sqrt2_v<Scalar> / 2;
template <class Scalar>
inline constexpr Scalar sdirk2_ratio = 1 + std::numbers::sqrt2_v<Scalar>;  // (1 - part)/part

/// What a stage does to the contact. Lengths in a_0, the half-length that the system was made for.
template <class Scalar>
struct RollingStage {
    Scalar distance;         ///< rolled in the stage
    Scalar half_length = 1;  ///< a at its end
    Scalar growth = 0;       ///< part of the step's change of the half-length that the stage takes, |growth| < distance

    /// Of a step that rolls by `dq` while the half-length goes evenly from one value to another: a stage that takes
    /// `part` of it and ends within,
    static RollingStage within(Scalar part, Scalar dq, Scalar from, Scalar to) {
        return {part * dq, from + part * (to - from), part * (to - from)};
    }
    /// or with the step.
    static RollingStage last(Scalar part, Scalar dq, Scalar from, Scalar to) {
        return {part * dq, to, part * (to - from)};
    }

    bool varies() const { return half_length != 1 || growth != 0; }
    friend bool operator==(const RollingStage&, const RollingStage&) = default;
};

/// Whether a contact of half-length `from` can roll by `distance` and have the half-length `to` then, all in a_0: ok or
/// needs_fixed_mesh. Where |to - from| >= distance, an edge meets elements that have not rolled: the equations of an
/// element that moves with the edge are upwind no more.
template <class Scalar>
StepStatus check_growth(const RollingSystem<Scalar>& system, Scalar distance, Scalar from, Scalar to) {
    const bool breathes = from != 1 || to != 1;
    if (breathes && !system.log_strength()) return StepStatus::needs_fixed_mesh;
    const bool possible = from == to || std::abs(to - from) < distance;
    return possible ? StepStatus::ok : StepStatus::needs_fixed_mesh;
}

/// M = a (G - S ln(a) 1 w^T) - (distance + growth zeta) G', row by row, zeta the points of the equations.
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

/// U = a (G p - S ln(a) (w.p) 1), the displacement under tractions p of a contact of half-length a.
template <class Scalar>
void find_displacement(const RollingSystem<Scalar>& system, Scalar half_length, const VectorX<Scalar>& p,
                       VectorX<Scalar>& U) {
    U.noalias() = system.G() * p;
    if (half_length == 1) return;
    const Scalar common = *system.log_strength() * std::log(half_length) * system.weights().matrix().dot(p);
    U.array() = half_length * (U.array() - common);
}

/// dU/da under constant tractions, from U itself: U/a - S (w.p) 1. For systems that can breathe.
template <class Scalar>
void find_displacement_rate(const RollingSystem<Scalar>& system, Scalar half_length, const VectorX<Scalar>& p,
                            const VectorX<Scalar>& U, VectorX<Scalar>& rate) {
    const Scalar common = *system.log_strength() * system.weights().matrix().dot(p);
    rate.array() = U.array() / half_length - common;
}

}  // namespace rollbem::detail
