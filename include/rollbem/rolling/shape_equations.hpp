// The equations of one stage of rolling of a patch whose semi-axes vary: matrices of the present a/b, between those of a
// ShapeSet, and scaled by the present size. Independent of friction and units.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Core>

#include "../scene/semi_axes.hpp"
#include "../system/shape_set.hpp"
#include "../types.hpp"
#include "stage.hpp"

namespace rollbem::detail {

/// The mesh follows the ellipse, x = a zeta, y = b upsilon, and the material moves through it:
///
///     slip = rigid slip - (dq + da zeta) G' p - db upsilon G_y p + change of U,   U = c G p,   c = sqrt(a b)
///
/// with G, G' and G_y (rows of du/dy) those of the present a/b in units of c. Semi-axes are in those of a contact, for
/// which a/b is `a_over_b`, all lengths in the half-length of that contact. Tractions and displacements have a column
/// for each direction. Refers to the set.
template <class Scalar>
class ShapeEquations {
public:
    using Stage = RollingStage<Scalar>;
    static constexpr int columns = 2;

    ShapeEquations(const ShapeSet<Scalar>& set, Scalar a_over_b, const Stage& present)
        : stage(present),
          set_(set),
          a_over_b_(a_over_b),
          per_width_(1 / a_over_b),
          c_(std::sqrt(stage.half_length * stage.half_width / a_over_b)),
          weights_(set.weights(a_over_b * stage.half_length / stage.half_width)) {}

    const Stage stage;

    bool coupled() const { return set_.coupled; }
    bool is_single() const { return set_.is_single(); }

    /// c G - (distance + growth zeta) G' - widening upsilon G_y, of tractions along e and slip along d.
    void fill(std::size_t d, std::size_t e, Eigen::Ref<MatrixX<Scalar>> M) const {
        const Scalar widening = stage.widening * per_width_;
        for (Eigen::Index j = 0; j < M.cols(); ++j) {
            M.col(j).setZero();
            for (std::size_t k = 0; k < weights_.count; ++k) {
                const ShapeNode<Scalar>& at = node(k);
                const Scalar weight = weights_.values[k];
                auto column = M.col(j).array();
                column +=
                    (weight * c_) * at.G.block(d, e).col(j).array() -
                    (weight * (stage.distance + stage.growth * set_.zeta)) * at.G_prime.block(d, e).col(j).array();
                if (widening == 0) continue;
                column -= (weight * widening * set_.upsilon) * at.G_y.block(d, e).col(j).array();
            }
        }
    }

    /// `factor` G' of tractions along e and slip along d.
    void fill_slope(Scalar factor, std::size_t d, std::size_t e, Eigen::Ref<MatrixX<Scalar>> M) const {
        M.setZero();
        for (std::size_t k = 0; k < weights_.count; ++k) {
            M += factor * weights_.values[k] * node(k).G_prime.block(d, e);
        }
    }

    /// U
    template <class Tractions, class Result>
    void find_displacements(const Tractions& p, Result&& U) const {
        U.setZero();
        add(&ShapeNode<Scalar>::G, weights_.values, c_, p, U);
    }

    /// Those at the start of the step, and their change since then at constant unknowns.
    template <class Tractions, class Result>
    void find_start(const SemiAxes<Scalar>& from, const Tractions& old, Result&& start) const {
        ShapeEquations(set_, a_over_b_, Stage::resting(from)).find_displacements(old, start);
    }
    template <class Tractions, class Start, class Result>
    void find_growth(const SemiAxes<Scalar>&, const Tractions& old, const Start& start, Result&& growth) const {
        find_displacements(old, growth);
        growth -= start;
    }

    /// Adds ((distance + growth zeta) G' + widening upsilon G_y) p; `scratch` is as large.
    template <class Tractions, class Scratch, class Result>
    void add_travel(const Tractions& p, Scratch&& scratch, Result&& sum) const {
        add_travel(stage.distance, stage.growth, stage.widening, weights_.values, p, scratch, sum);
    }

    /// Adds `factor` times dU/d axis at constant tractions. In a set of one a/b the half-width follows the half-length.
    template <class Tractions, class Scratch, class Result>
    void add_displacement_rates(Axis axis, Scalar factor, const Tractions& p, Scratch&&, Result&& sum) const {
        const Scalar log_rate = rate_of_log(axis);
        std::array<Scalar, 4> coefficients;
        for (std::size_t k = 0; k < 4; ++k) {
            coefficients[k] = rate_of_c(axis) * weights_.values[k] + c_ * log_rate * weights_.rates[k];
        }
        add(&ShapeNode<Scalar>::G, coefficients, factor, p, sum);
    }

    /// Adds the derivative with respect to a semi-axis at the end of a step of the matrix of a stage times p. The stage takes `part`
    /// of the step, `progress` of which is done at its end.
    template <class Tractions, class Scratch, class Result>
    void add_rates(Axis axis, Scalar part, Scalar progress, const Tractions& p, Scratch&& scratch, Result&& sum) const {
        add_displacement_rates(axis, progress, p, scratch, sum);
        const bool by_length = axis == Axis::half_length;
        const Scalar ratio = stage.half_width / stage.half_length;
        add_travel(0, by_length ? -part : Scalar(0), by_length ? (set_.is_single() ? -part * ratio : Scalar(0)) : -part,
                   weights_.values, p, scratch, sum);
        if (set_.is_single()) return;
        const Scalar factor = -progress * rate_of_log(axis);
        add_travel(factor * stage.distance, factor * stage.growth, factor * stage.widening, weights_.rates, p, scratch,
                   sum);
    }

private:
    using Rows = InfluenceRows<Scalar>;
    using Weights = std::array<Scalar, 4>;

    const ShapeNode<Scalar>& node(std::size_t k) const { return set_.nodes[weights_.first + k]; }

    Scalar rate_of_c(Axis axis) const {
        if (axis == Axis::half_width) return set_.is_single() ? 0 : c_ / (2 * stage.half_width);
        return c_ / stage.half_length / (set_.is_single() ? 1 : 2);
    }
    // Of ln(a/b).
    Scalar rate_of_log(Axis axis) const {
        return axis == Axis::half_length ? 1 / stage.half_length : -1 / stage.half_width;
    }

    template <class Tractions, class Result>
    void add(const Rows ShapeNode<Scalar>::*quantity, const Weights& weights, Scalar factor, const Tractions& p,
             Result&& sum) const {
        for (std::size_t k = 0; k < weights_.count; ++k) {
            const Rows& rows = node(k).*quantity;
            const Scalar weight = factor * weights[k];
            if (weight == 0) continue;
            sum.col(0).noalias() += weight * rows.xx * p.col(0);
            sum.col(1).noalias() += weight * rows.yy * p.col(1);
            if (!set_.coupled) continue;
            sum.col(0).noalias() += weight * rows.xy * p.col(1);
            sum.col(1).noalias() += weight * rows.xy * p.col(0);
        }
    }

    template <class Tractions, class Scratch, class Result>
    void add_travel(Scalar distance, Scalar growth, Scalar widening, const Weights& weights, const Tractions& p,
                    Scratch&& scratch, Result&& sum) const {
        if (distance != 0 || growth != 0) {
            scratch.setZero();
            add(&ShapeNode<Scalar>::G_prime, weights, 1, p, scratch);
            for (Eigen::Index d = 0; d < 2; ++d) {
                sum.col(d).array() += (distance + growth * set_.zeta) * scratch.col(d).array();
            }
        }
        if (widening == 0) return;
        scratch.setZero();
        add(&ShapeNode<Scalar>::G_y, weights, widening * per_width_, p, scratch);
        for (Eigen::Index d = 0; d < 2; ++d) sum.col(d).array() += set_.upsilon * scratch.col(d).array();
    }

    const ShapeSet<Scalar>& set_;
    Scalar a_over_b_, per_width_, c_;  // half-width of the contact and present c
    ShapeWeights<Scalar> weights_;
};

}  // namespace rollbem::detail
