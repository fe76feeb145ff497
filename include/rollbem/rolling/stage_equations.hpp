// The equations of one stage of rolling of any system: one direction or both, on a line or a patch, at constant
// semi-axes or while they vary. What problems in the time domain share, with friction and without.
#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>

#include <Eigen/Core>

#include "../scene/semi_axes.hpp"
#include "../status.hpp"
#include "../system/element_blocks.hpp"
#include "../system/rolling_system.hpp"
#include "../types.hpp"
#include "shape_equations.hpp"
#include "stage.hpp"

namespace rollbem::detail {

/// The number of columns of the unknowns.
template <class System>
inline constexpr int columns_of = 1;
template <class Scalar>
inline constexpr int columns_of<ElementSystem<Scalar, 2>> = 2;

/// What tractions along direction e cause along d.
template <class Scalar>
Influence<Scalar> influence(const RollingSystem<Scalar>& system, std::size_t, std::size_t) {
    return influence(system);
}
template <class Scalar>
Influence<Scalar> influence(const ElementSystem<Scalar, 2>& system, std::size_t d, std::size_t e) {
    const Elements<Scalar>& elements = system.elements();
    return {system.G(d, e), system.G_prime(d, e), array_map(elements.areas), array_map(elements.x),
            system.log_strength(d).value_or(Scalar(0))};
}

/// The equations of a stage where the length alone may vary, as in LengthScale. They refer to the system.
///
/// For Chebyshev states the unknowns are the coefficients of u for a = 1, and represent the traction that causes it,
/// whatever a is. Their equations are again those of the tau method: both sides of the equation are polynomials of degree
/// at most m, and the tau method lets them differ by a multiple of T_m, which vanishes at the m Chebyshev points; m
/// equations at these points allow exactly that difference. The T_m in U itself also vanishes there.
template <class System>
class LineEquations {
public:
    using Scalar = typename System::Scalar;
    using Stage = RollingStage<Scalar>;
    static constexpr int columns = columns_of<System>;

    LineEquations(const System& system, const Stage& present) : stage(present), system_(system) {}

    const Stage stage;

    template <class Block>
    void fill(std::size_t d, std::size_t e, Block&& M) const {
        along(d, e).fill_stage_matrix(stage, M);
    }
    template <class Tractions, class Result>
    void find_displacements(const Tractions& p, Result&& U) const {
        find_scaled(LengthScale<Scalar>::at(stage.half_length), p, U);
        if constexpr (columns == 2) {
            if (!system_.coupled()) return;
            for (Eigen::Index d = 0; d < 2; ++d) {
                const auto direction = static_cast<std::size_t>(d);
                U.col(d).noalias() += stage.half_length * system_.G(direction, 1 - direction) * p.col(1 - d);
            }
        }
    }
    /// What find_growth needs of the start of the step.
    template <class Tractions, class Result>
    void find_start(const SemiAxes<Scalar>&, const Tractions& old, Result&& start) const {
        start.noalias() = system_.G() * old;
    }
    /// The change of U since the start of the step at constant unknowns, in one direction.
    template <class Tractions, class Start, class Result>
    void find_growth(const SemiAxes<Scalar>& from, const Tractions& old, const Start& start, Result&& growth) const {
        growth = start;
        along(0, 0).rescale(LengthScale<Scalar>::growth(from.half_length, stage.half_length), old.col(0), growth);
    }
    template <class Tractions, class Scratch, class Result>
    void add_travel(const Tractions& p, Scratch&& scratch, Result&& sum) const {
        const Influence<Scalar> own = along(0, 0);
        scratch.noalias() = own.G_prime * p;
        if (stage.growth != 0) {
            sum.array() += (stage.distance + stage.growth * own.points) * scratch.array();
        } else {
            sum += stage.distance * scratch;
        }
    }
    template <class Tractions, class Scratch, class Result>
    void add_displacement_rates(Axis, Scalar factor, const Tractions& p, Scratch&& scratch, Result&& sum) const {
        find_scaled(LengthScale<Scalar>::rate(stage.half_length), p, scratch);
        sum += factor * scratch;
    }
    template <class Tractions, class Scratch, class Result>
    void add_rates(Axis axis, Scalar part, Scalar progress, const Tractions& p, Scratch&& scratch, Result&& sum) const {
        add_displacement_rates(axis, progress, p, scratch, sum);
        for (Eigen::Index d = 0; d < p.cols(); ++d) {
            const Influence<Scalar> own = along(static_cast<std::size_t>(d), static_cast<std::size_t>(d));
            scratch.col(d).noalias() = own.G_prime * p.col(d);
            sum.col(d).array() -= part * own.points * scratch.col(d).array();
        }
    }

private:
    Influence<Scalar> along(std::size_t d, std::size_t e) const { return influence(system_, d, e); }

    template <class Tractions, class Result>
    void find_scaled(const LengthScale<Scalar>& scale, const Tractions& p, Result&& U) const {
        for (Eigen::Index d = 0; d < p.cols(); ++d) {
            const auto direction = static_cast<std::size_t>(d);
            along(direction, direction).find_displacement(scale, p.col(d), U.col(d));
        }
    }

    const System& system_;
};

/// Calls use(equations) with those of a stage of the system.
template <class System, class Scalar, class Use>
void with_equations(const System& system, const RollingStage<Scalar>& stage, const Use& use) {
    if constexpr (columns_of<System> == 2) {
        if (system.shapes()) {
            use(ShapeEquations<Scalar>(*system.shapes(), system.a_over_b(), stage));
            return;
        }
    }
    use(LineEquations<System>(system, stage));
}

/// Displacements in all directions at these semi-axes.
template <class System, class Scalar, class Vectors>
void find_displacements(const System& system, const SemiAxes<Scalar>& axes, const Vectors& p, Vectors& U) {
    with_equations(system, RollingStage<Scalar>::resting(axes),
                   [&](const auto& equations) { equations.find_displacements(p, U); });
}

/// The semi-axes of a contact in its own.
template <class Scalar>
inline constexpr SemiAxes<Scalar> contact_axes{1, 1};

/// The ellipses of a patch whose semi-axes may vary, else null.
template <class Scalar>
const ShapeSet<Scalar>* shapes_of(const RollingSystem<Scalar>&) {
    return nullptr;
}
template <class Scalar>
const ShapeSet<Scalar>* shapes_of(const ElementSystem<Scalar, 2>& system) {
    return system.shapes().get();
}
/// Whether the a/b of a patch may change, or may not although its size may.
template <class System>
bool changes_shape(const System& system) {
    return shapes_of(system) != nullptr && !shapes_of(system)->is_single();
}
template <class System>
bool keeps_shape(const System& system) {
    return shapes_of(system) != nullptr && shapes_of(system)->is_single();
}

template <class Scalar>
bool can_breathe(const RollingSystem<Scalar>& system) {
    return system.log_strength() && system.points();
}
template <class Scalar>
bool can_breathe(const ElementSystem<Scalar, 2>& system) {
    return system.shapes() || (system.log_strength(0) && system.log_strength(1) && !system.coupled());
}

/// Whether the semi-axes of a contact can change from `from` to `to`, in its own, while it rolls by `distance` in a_0: ok
/// or needs_fixed_mesh. Where the half-length changes by `distance` or more an edge overtakes the particles, and the
/// equations of elements that move with the edge are no longer upwind. On a line the half-width is 1. `shapes` unless
/// null are those of a patch whose a/b is `a_over_b` at its own semi-axes.
template <class Scalar>
StepStatus check_growth(bool can_breathe, Scalar half_length_limit, const ShapeSet<Scalar>* shapes, Scalar a_over_b,
                        Scalar distance, const SemiAxes<Scalar>& from, const SemiAxes<Scalar>& to) {
    if (from == contact_axes<Scalar> && to == contact_axes<Scalar>) return StepStatus::ok;
    const auto covers = [&](const SemiAxes<Scalar>& axes) {
        return shapes == nullptr || shapes->covers(a_over_b * axes.half_length / axes.half_width);
    };
    const bool possible = can_breathe && to.half_length < half_length_limit && covers(from) && covers(to) &&
                          (from == to || std::abs(to.half_length - from.half_length) < distance);
    return possible ? StepStatus::ok : StepStatus::needs_fixed_mesh;
}
template <class System, class Scalar>
StepStatus check_growth(const System& system, Scalar distance, const SemiAxes<Scalar>& from,
                        const SemiAxes<Scalar>& to) {
    Scalar a_over_b = 1;
    if constexpr (columns_of<System> == 2) a_over_b = system.a_over_b();
    return check_growth(can_breathe(system), system.half_length_limit(), shapes_of(system), a_over_b, distance, from,
                        to);
}

}  // namespace rollbem::detail
