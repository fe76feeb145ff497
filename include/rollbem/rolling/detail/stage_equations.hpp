// The equations of one stage of rolling of any system: one direction or both, on a line or a patch, at constant
// semi-axes or while they vary. Problems in the time domain share them, with friction and without. Internal.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <Eigen/Core>

#include "../../scene/patch_contact.hpp"
#include "../../status.hpp"
#include "../../system/detail/shape_set.hpp"
#include "../../system/rolling_system.hpp"
#include "../../types.hpp"
#include "stage.hpp"

namespace rollbem::detail {

/// The number of columns of the unknowns.
template <class System>
inline constexpr int columns_of = 1;
template <>
inline constexpr int columns_of<ElementSystem<double, 2>> = 2;

/// G' from tractions along direction e to slip along direction d.
inline const MatrixX<double>& slope(const RollingSystem<double>& system, std::size_t, std::size_t) {
    return system.G_prime();
}
inline const MatrixX<double>& slope(const ElementSystem<double, 2>& system, std::size_t d, std::size_t e) {
    return system.G_prime(d, e);
}
/// Whether tractions along one direction cause slip along the other.
inline bool is_coupled(const RollingSystem<double>&) { return false; }
inline bool is_coupled(const ElementSystem<double, 2>& system) { return system.coupled(); }

/// The rigid slip in each equation per creepage, and the forces per unknown; a moment is NaN where places are not
/// known.
inline const MatrixX<double>& inputs(const RollingSystem<double>& system) { return system.inputs(); }
inline MatrixX<double> inputs(const ElementSystem<double, 2>& system) { return rigid_slip(system.elements()); }
inline const MatrixX<double>& outputs(const RollingSystem<double>& system) { return system.outputs(); }
inline MatrixX<double> outputs(const ElementSystem<double, 2>& system) {
    MatrixX<double> weights = force_weights(system.elements());
    if (!system.elements().places_are_known()) weights.col(2).setConstant(std::numeric_limits<double>::quiet_NaN());
    return weights;
}

/// The block from tractions along direction e to direction d.
inline Influence influence(const RollingSystem<double>& system, std::size_t, std::size_t) { return influence(system); }
inline Influence influence(const ElementSystem<double, 2>& system, std::size_t d, std::size_t e) {
    const Elements<double>& elements = system.elements();
    return {system.G(d, e), system.G_prime(d, e), array_map(elements.areas), array_map(elements.x),
            system.log_strength(d).value_or(0.0)};
}

/// The equations of a stage where the length alone may vary, as in LengthScale. They refer to the system.
///
/// Chebyshev states: the unknowns are the coefficients of u for a = 1, and represent the traction that causes it,
/// whatever a is. Their equations are again the equations of the tau method: both sides of the equation are polynomials
/// of degree at most m, and the tau method lets them differ by a multiple of T_m, which vanishes at the m Chebyshev
/// points; m equations at these points allow exactly this difference. The T_m in U itself also vanishes there.
template <class System>
class LineEquations {
public:
    using Stage = RollingStage;
    static constexpr int columns = columns_of<System>;

    LineEquations(const System& system, const Stage& present) : stage(present), system_(system) {}

    const Stage stage;

    static constexpr bool is_single() { return true; }  ///< the shape does not vary

    /// The matrix of a stage, or -G' in steady rolling.
    template <class Block>
    void fill(std::size_t d, std::size_t e, Block&& M) const {
        if (stage.steady) {
            M = -slope(system_, d, e);
        } else {
            along(d, e).fill_stage_matrix(stage, M);
        }
    }
    template <class Tractions, class Result>
    void find_displacements(const Tractions& p, Result&& U) const {
        find_scaled(LengthScale::at(stage.half_length), p, U);
        if constexpr (columns == 2) {
            if (!system_.coupled()) return;
            for (Eigen::Index d = 0; d < 2; ++d) {
                const auto direction = static_cast<std::size_t>(d);
                U.col(d).noalias() += stage.half_length * system_.G(direction, 1 - direction) * p.col(1 - d);
            }
        }
    }
    /// Input of find_growth from the start of the step.
    template <class Tractions, class Result>
    void find_start(const SemiAxes&, const Tractions& old, Result&& start) const {
        start.noalias() = system_.G() * old;
    }
    /// The change of U since the start of the step at constant unknowns, in one direction.
    template <class Tractions, class Start, class Result>
    void find_growth(const SemiAxes& from, const Tractions& old, const Start& start, Result&& growth) const {
        growth = start;
        along(0, 0).rescale(LengthScale::growth(from.half_length, stage.half_length), old.col(0), growth);
    }
    template <class Tractions, class Scratch, class Result>
    void add_travel(const Tractions& p, Scratch&& scratch, Result&& sum) const {
        const Influence own = along(0, 0);
        scratch.noalias() = own.G_prime * p;
        if (stage.growth != 0) {
            sum.array() += (stage.distance + stage.growth * own.points) * scratch.array();
        } else {
            sum += stage.distance * scratch;
        }
    }
    template <class Tractions, class Scratch, class Result>
    void add_displacement_rates(Axis, double factor, const Tractions& p, Scratch&& scratch, Result&& sum) const {
        find_scaled(LengthScale::rate(stage.half_length), p, scratch);
        sum += factor * scratch;
    }
    template <class Tractions, class Scratch, class Result>
    void add_rates(Axis axis, const StagePlace& place, const Tractions& p, Scratch&& scratch, Result&& sum) const {
        add_displacement_rates(axis, place.progress, p, scratch, sum);
        for (Eigen::Index d = 0; d < p.cols(); ++d) {
            const Influence own = along(static_cast<std::size_t>(d), static_cast<std::size_t>(d));
            scratch.col(d).noalias() = own.G_prime * p.col(d);
            sum.col(d).array() -= place.part * own.points * scratch.col(d).array();
        }
    }

private:
    Influence along(std::size_t d, std::size_t e) const { return influence(system_, d, e); }

    template <class Tractions, class Result>
    void find_scaled(const LengthScale& scale, const Tractions& p, Result&& U) const {
        for (Eigen::Index d = 0; d < p.cols(); ++d) {
            const auto direction = static_cast<std::size_t>(d);
            along(direction, direction).find_displacement(scale, p.col(d), U.col(d));
        }
    }

    const System& system_;
};

/// The mesh follows the ellipse, x = a zeta, y = b upsilon, and the material moves through it:
///
///     slip = rigid slip - (dq + da zeta) G' p - db upsilon G_y p + change of U,   U = c G p,   c = sqrt(a b)
///
/// G, G' and G_y (rows of du/dy) belong to the present a/b, in units of c. Semi-axes are in the semi-axes of a contact
/// with a/b = `a_over_b`, all lengths in the half-length of this contact. Tractions and displacements have a column for
/// each direction. Refers to the set.
class ShapeEquations {
public:
    using Stage = RollingStage;
    static constexpr int columns = 2;

    ShapeEquations(const ShapeSet<double>& set, double a_over_b, const Stage& present)
        : stage(present),
          set_(set),
          a_over_b_(a_over_b),
          per_width_(1 / a_over_b),
          c_(std::sqrt(stage.half_length * stage.half_width / a_over_b)),
          weights_(set.weights(a_over_b * stage.half_length / stage.half_width)) {}

    const Stage stage;

    bool coupled() const { return set_.coupled; }
    bool is_single() const { return set_.is_single(); }

    /// c G - (distance + growth zeta) G' - widening upsilon G_y, or -G' in steady rolling, from tractions along e to
    /// slip along d.
    void fill(std::size_t d, std::size_t e, Eigen::Ref<MatrixX<double>> M) const {
        if (stage.steady) return fill_slope(-1, d, e, M);
        const double widening = stage.widening * per_width_;
        for (Eigen::Index j = 0; j < M.cols(); ++j) {
            M.col(j).setZero();
            for (std::size_t k = 0; k < weights_.count; ++k) {
                const ShapeNode<double>& at = node(k);
                const double weight = weights_.values[k];
                auto column = M.col(j).array();
                column +=
                    (weight * c_) * at.G.block(d, e).col(j).array() -
                    (weight * (stage.distance + stage.growth * set_.zeta)) * at.G_prime.block(d, e).col(j).array();
                if (widening == 0) continue;
                column -= (weight * widening * set_.upsilon) * at.G_y.block(d, e).col(j).array();
            }
        }
    }

    /// `factor` G' from tractions along e to slip along d.
    void fill_slope(double factor, std::size_t d, std::size_t e, Eigen::Ref<MatrixX<double>> M) const {
        M.setZero();
        for (std::size_t k = 0; k < weights_.count; ++k) {
            M += factor * weights_.values[k] * node(k).G_prime.block(d, e);
        }
    }

    /// Finds U = c G p.
    template <class Tractions, class Result>
    void find_displacements(const Tractions& p, Result&& U) const {
        U.setZero();
        add(&ShapeNode<double>::G, weights_.values, c_, p, U);
    }

    /// Displacements at the start of the step, and their change since then at constant unknowns.
    template <class Tractions, class Result>
    void find_start(const SemiAxes& from, const Tractions& old, Result&& start) const {
        ShapeEquations(set_, a_over_b_, Stage::resting(from)).find_displacements(old, start);
    }
    template <class Tractions, class Start, class Result>
    void find_growth(const SemiAxes&, const Tractions& old, const Start& start, Result&& growth) const {
        find_displacements(old, growth);
        growth -= start;
    }

    /// Adds ((distance + growth zeta) G' + widening upsilon G_y) p; `scratch` is as large as p.
    template <class Tractions, class Scratch, class Result>
    void add_travel(const Tractions& p, Scratch&& scratch, Result&& sum) const {
        add_travel(stage.distance, stage.growth, stage.widening, weights_.values, p, scratch, sum);
    }

    /// Adds `factor` times dU/d axis at constant tractions. In a set of one a/b the half-width follows the half-length.
    template <class Tractions, class Scratch, class Result>
    void add_displacement_rates(Axis axis, double factor, const Tractions& p, Scratch&&, Result&& sum) const {
        const double log_rate = rate_of_log(axis);
        std::array<double, 4> coefficients;
        for (std::size_t k = 0; k < 4; ++k) {
            coefficients[k] = rate_of_c(axis) * weights_.values[k] + c_ * log_rate * weights_.rates[k];
        }
        add(&ShapeNode<double>::G, coefficients, factor, p, sum);
    }

    /// Adds the derivative of (the matrix of a stage times p) with respect to a semi-axis at the end of the step.
    template <class Tractions, class Scratch, class Result>
    void add_rates(Axis axis, const StagePlace& place, const Tractions& p, Scratch&& scratch, Result&& sum) const {
        add_displacement_rates(axis, place.progress, p, scratch, sum);
        const bool by_length = axis == Axis::half_length;
        const double part = place.part, b_over_a = stage.half_width / stage.half_length;
        add_travel(0, by_length ? -part : 0.0, by_length ? (set_.is_single() ? -part * b_over_a : 0.0) : -part,
                   weights_.values, p, scratch, sum);
        if (set_.is_single()) return;
        const double factor = -place.progress * rate_of_log(axis);
        add_travel(factor * stage.distance, factor * stage.growth, factor * stage.widening, weights_.rates, p, scratch,
                   sum);
    }

private:
    using Rows = InfluenceRows<double>;
    using Weights = std::array<double, 4>;

    const ShapeNode<double>& node(std::size_t k) const { return set_.nodes[weights_.first + k]; }

    double rate_of_c(Axis axis) const {
        if (axis == Axis::half_width) return set_.is_single() ? 0 : c_ / (2 * stage.half_width);
        return c_ / stage.half_length / (set_.is_single() ? 1 : 2);
    }
    // Rate of ln(a/b).
    double rate_of_log(Axis axis) const {
        return axis == Axis::half_length ? 1 / stage.half_length : -1 / stage.half_width;
    }

    template <class Tractions, class Result>
    void add(const Rows ShapeNode<double>::*quantity, const Weights& weights, double factor, const Tractions& p,
             Result&& sum) const {
        for (std::size_t k = 0; k < weights_.count; ++k) {
            const Rows& rows = node(k).*quantity;
            const double weight = factor * weights[k];
            if (weight == 0) continue;
            sum.col(0).noalias() += weight * rows.xx * p.col(0);
            sum.col(1).noalias() += weight * rows.yy * p.col(1);
            if (!set_.coupled) continue;
            sum.col(0).noalias() += weight * rows.xy * p.col(1);
            sum.col(1).noalias() += weight * rows.xy * p.col(0);
        }
    }

    template <class Tractions, class Scratch, class Result>
    void add_travel(double distance, double growth, double widening, const Weights& weights, const Tractions& p,
                    Scratch&& scratch, Result&& sum) const {
        if (distance != 0 || growth != 0) {
            scratch.setZero();
            add(&ShapeNode<double>::G_prime, weights, 1, p, scratch);
            for (Eigen::Index d = 0; d < 2; ++d) {
                sum.col(d).array() += (distance + growth * set_.zeta) * scratch.col(d).array();
            }
        }
        if (widening == 0) return;
        scratch.setZero();
        add(&ShapeNode<double>::G_y, weights, widening * per_width_, p, scratch);
        for (Eigen::Index d = 0; d < 2; ++d) sum.col(d).array() += set_.upsilon * scratch.col(d).array();
    }

    const ShapeSet<double>& set_;
    double a_over_b_, per_width_, c_;  // a/b and half-width of the contact; present c
    ShapeWeights<double> weights_;
};

/// Calls use(equations) with the equations of a stage of the system.
template <class System, class Use>
void with_equations(const System& system, const RollingStage& stage, const Use& use) {
    if constexpr (columns_of<System> == 2) {
        if (system.shapes()) {
            use(ShapeEquations(*system.shapes(), system.a_over_b(), stage));
            return;
        }
    }
    use(LineEquations<System>(system, stage));
}

/// Displacements in all directions at these semi-axes.
template <class System, class Vectors>
void find_displacements(const System& system, const SemiAxes& axes, const Vectors& p, Vectors& U) {
    with_equations(system, RollingStage::resting(axes),
                   [&](const auto& equations) { equations.find_displacements(p, U); });
}

/// The ellipses of a patch whose semi-axes may vary, else null.
inline const ShapeSet<double>* shapes_of(const RollingSystem<double>&) { return nullptr; }
inline const ShapeSet<double>* shapes_of(const ElementSystem<double, 2>& system) { return system.shapes().get(); }
/// Whether the a/b of a patch may change (changes_shape), or its size alone (keeps_shape).
template <class System>
bool changes_shape(const System& system) {
    return shapes_of(system) != nullptr && !shapes_of(system)->is_single();
}
template <class System>
bool keeps_shape(const System& system) {
    return shapes_of(system) != nullptr && shapes_of(system)->is_single();
}

inline bool can_breathe(const RollingSystem<double>& system) { return system.log_strength() && system.points(); }
inline bool can_breathe(const ElementSystem<double, 2>& system) {
    return system.shapes() || (system.log_strength(0) && system.log_strength(1) && !system.coupled());
}

/// Whether the semi-axes of a contact, over its own, can change from `from` to `to` while it rolls by `distance` in
/// a_0: ok or needs_fixed_mesh. Where the half-length changes by `distance` or more, an edge overtakes the particles,
/// and the equations of elements that move with the edge are no longer upwind. On a line the half-width is 1. `shapes`,
/// unless null, belong to a patch whose a/b is `a_over_b` at its own semi-axes.
inline Status check_growth(bool can_breathe, double half_length_limit, const ShapeSet<double>* shapes, double a_over_b,
                           double distance, const SemiAxes& from, const SemiAxes& to) {
    if (from == contact_axes && to == contact_axes) return Status::ok;
    const auto covers = [&](const SemiAxes& axes) {
        return shapes == nullptr || shapes->covers(a_over_b * axes.half_length / axes.half_width);
    };
    const bool possible = can_breathe && to.half_length < half_length_limit && covers(from) && covers(to) &&
                          (from == to || std::abs(to.half_length - from.half_length) < distance);
    return possible ? Status::ok : Status::needs_fixed_mesh;
}
template <class System>
Status check_growth(const System& system, double distance, const SemiAxes& from, const SemiAxes& to) {
    double a_over_b = 1;
    if constexpr (columns_of<System> == 2) a_over_b = system.a_over_b();
    return check_growth(can_breathe(system), system.half_length_limit(), shapes_of(system), a_over_b, distance, from,
                        to);
}

}  // namespace rollbem::detail
