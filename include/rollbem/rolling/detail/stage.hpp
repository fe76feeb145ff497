// One stage of a step of rolling on a contact whose length may vary: the system scales with the length, and nothing is
// assembled again. Independent of friction and units. Internal.
#pragma once

#include <cmath>

#include <Eigen/Core>

#include "../../scene/patch_contact.hpp"
#include "../../system/rolling_system.hpp"
#include "../../types.hpp"

namespace rollbem::detail {

/// A semi-axis at the end of a step, by which derivatives are taken.
enum class Axis { half_length, half_width };

/// The place of a stage in its step. Quantities that vary linearly during the step have covered the share `progress` of
/// their change.
struct StagePlace {
    double part;             ///< share of the step taken by the stage
    double progress;         ///< share of the step completed at the end of the stage
    bool is_second = false;  ///< whether it starts from U + ratio() (U_1 - U); the first stage starts from U and leads
                             ///< to U_1

    double ratio() const { return (1 - part) / part; }
    bool is_last() const { return progress == 1; }
};

/// Motion and growth of the contact in a stage. Lengths in a_0, the half-length for which the system was assembled.
struct RollingStage {
    double distance = 0;                  ///< distance rolled in the stage
    double half_length = 1;               ///< a at the end of the stage
    double growth = 0;                    ///< change of the half-length in the stage, |growth| < distance
    double half_width = 1, widening = 0;  ///< half-width of a patch and its change, in the half-width of the contact
    bool steady = false;                  ///< steady rolling, in which tractions do not change: no distance

    /// A stage of a step that rolls by `dq` while the semi-axes vary linearly.
    static RollingStage of(const StagePlace& place, double dq, const SemiAxes& from, const SemiAxes& to) {
        const double part = place.part;
        const auto at = [&](double start, double end) {
            return place.is_last() ? end : start + place.progress * (end - start);
        };
        return {part * dq, at(from.half_length, to.half_length), part * (to.half_length - from.half_length),
                at(from.half_width, to.half_width), part * (to.half_width - from.half_width)};
    }

    /// A state without a step, at these semi-axes.
    static RollingStage resting(const SemiAxes& axes) {
        return {.distance = 0, .half_length = axes.half_length, .half_width = axes.half_width};
    }
    /// Steady rolling at these semi-axes.
    static RollingStage steadily(const SemiAxes& axes) {
        RollingStage stage = resting(axes);
        stage.steady = true;
        return stage;
    }
    SemiAxes axes() const { return {half_length, half_width}; }

    bool varies() const { return half_length != 1 || growth != 0; }
    friend bool operator==(const RollingStage&, const RollingStage&) = default;
};

/// Dependence of the kernel's matrix on the half-length: linear G - logarithmic S 1 w^T. M(a) is `at`: with x = a zeta
/// and the kernel C - S ln|x|, U = M(a) p = a (G - S ln(a) 1 w^T) p. The length adds a constant to the logarithm, which
/// displaces the whole contact uniformly and has no slope: dU/dx = G' p.
struct LengthScale {
    double linear, logarithmic;

    static LengthScale at(double a) { return {a, a == 1 ? 0.0 : a * std::log(a)}; }
    /// dM/da
    static LengthScale rate(double a) { return {1, std::log(a) + 1}; }
    /// M(to) - M(from), without cancellation.
    static LengthScale growth(double from, double to) {
        const double change = to - from;
        return {change, change * std::log(from) + to * std::log1p(change / from)};
    }
};

/// Matrices from tractions along one direction to displacement and slope along one direction.
struct Influence {
    using Array = Eigen::Map<const ArrayX<double>>;

    const MatrixX<double>&G, &G_prime;
    Array weights;
    Array points;           // x/a of the equations; empty if unknown
    double log_strength{};  // S, see RollingSystem; 0 if the length cannot vary

    /// M(a) - (distance + growth zeta) G', row by row, with zeta the points.
    template <class Block>
    void fill_stage_matrix(const RollingStage& stage, Block&& M) const {
        if (!stage.varies()) {
            M = G - stage.distance * G_prime;
            return;
        }
        const LengthScale scale = LengthScale::at(stage.half_length);
        const double common = scale.logarithmic * log_strength;
        for (Eigen::Index j = 0; j < M.cols(); ++j) {
            M.col(j).array() = scale.linear * G.col(j).array() - common * weights[j] -
                               (stage.distance + stage.growth * points) * G_prime.col(j).array();
        }
    }

    /// Finds the displacement due to tractions p at this scale.
    template <class Traction, class Displacement>
    void find_displacement(const LengthScale& scale, const Traction& p, Displacement&& U) const {
        U.noalias() = G * p;
        rescale(scale, p, U);
    }

    /// Finds the displacement due to tractions p at this scale, where `U` holds G p.
    template <class Traction, class Displacement>
    void rescale(const LengthScale& scale, const Traction& p, Displacement&& U) const {
        if (scale.linear == 1 && scale.logarithmic == 0) return;
        const double common = scale.logarithmic == 0 ? 0.0 : scale.logarithmic * log_strength * weights.matrix().dot(p);
        U.array() = scale.linear * U.array() - common;
    }
};

inline Eigen::Map<const ArrayX<double>> array_map(const ArrayX<double>& array) { return {array.data(), array.size()}; }

/// The influence matrices of a system with one creepage.
inline Influence influence(const RollingSystem<double>& system) {
    const auto& points = system.points();
    return {system.G(),
            system.G_prime(),
            system.weights(),
            {points ? points->data() : nullptr, points ? points->size() : 0},
            system.log_strength().value_or(0.0)};
}

}  // namespace rollbem::detail
