// Derivatives of the tractions of a solved stage by a creepage, the load or the half-length, including the contribution
// of an earlier stage.
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "../../types.hpp"
#include "bounds.hpp"
#include "directions.hpp"
#include "rolling_stage.hpp"
#include "scratch.hpp"

namespace rollbem::detail {

/// Derivatives with respect to one parameter of the stage that `bounds` have solved last in scratch.solver, while no element changes
/// its zone. Each leaves dp in scratch.response.
template <int directions, class Scalar, class Bounds>
class StageTangent {
    // Columns of an angle of turn; empty where places are not known, and then the angle is 0.
    template <class Columns, class Vectors>
    static void add_turned(Scalar first, Scalar second, const Columns& columns, Vectors& sum) {
        if (columns.rows() == 0) return;
        sum.col(0) += first * columns.col(0);
        sum.col(1) += second * columns.col(1);
    }

public:
    using Scratch = FrictionScratch<directions, Scalar>;
    using System = typename Directions<directions, Scalar>::System;
    using Vectors = ElementVectors<Scalar, directions>;

    /// `parameter`: see TangentBy. `carried`: scratch.carried of an earlier stage shifts the equations.
    StageTangent(Bounds& bounds, Scratch& scratch, std::size_t parameter, bool carried)
        : bounds_(bounds), scratch_(scratch), parameter_(parameter) {
        scratch.right.setZero();
        if (carried) scratch.right = scratch.carried[parameter];
        if constexpr (directions == 2) {
            Vectors& plain = scratch.solver.plain_change();
            plain.setZero();
            if (carried) plain = scratch.plain_carried[parameter];
        }
    }

    /// By a creepage, with d(imposed motion)/d creepage = `imposed`.
    void by_creepage(Scalar imposed) {
        add([&](const Vectors&, Vectors& right) {
            right.col(static_cast<Eigen::Index>(parameter_)).array() += imposed;
        });
        bounds_.respond(scratch_.solver, scratch_.right, scratch_.response, parameter_);
    }

    /// By spin, whose rigid slip changes by `imposed` times `columns`, stretched to these semi-axes.
    template <class Columns>
    void by_spin(Scalar imposed, const SemiAxes<Scalar>& axes, const Columns& columns) {
        add([&](const Vectors&, Vectors& right) {
            add_turned(imposed * axes.half_width, imposed * axes.half_length, columns, right);
        });
        bounds_.respond(scratch_.solver, scratch_.right, scratch_.response, parameter_);
    }

    /// By the load: bounds change by `progress` times scratch.bound_rate, and slipping elements follow theirs.
    void by_load(Scalar progress) {
        bounds_.respond(scratch_.solver, scratch_.right, scratch_.response, parameter_, &scratch_.bound_rate, progress);
    }

    /// By the half-length at the end of the step, in a_0: dM p = progress dU/da - part zeta G' p. The rigid slip of
    /// spin follows the points: it changes by `rate` times `columns`.
    template <class Columns>
    void by_half_length(const System& system, const StagePlace<Scalar>& stage, Scalar rate, const Columns& columns) {
        if constexpr (directions == 2) {
            if (system.shapes()) {
                const bool single = system.shapes()->is_single();
                by_axis(system, Shape::Axis::half_length, stage, single ? rate : Scalar(0), rate, columns);
                bounds_.respond_to_half_length(scratch_.solver, scratch_.right, scratch_.response, parameter_);
                return;
            }
        }
        add([&](const Vectors& p, Vectors& right) {
            if (rate != 0) right += rate * columns;
            add_displacement_rates(system, scratch_.stage.half_length, stage.progress, p, scratch_.change, right);
            for (Eigen::Index d = 0; d < directions; ++d) {
                const auto direction = static_cast<std::size_t>(d);
                const Influence<Scalar> own = influence(system, direction, direction);
                scratch_.rate.noalias() = own.G_prime * p.col(d);
                right.col(d).array() -= stage.part * own.points * scratch_.rate.array();
            }
        });
        bounds_.respond_to_half_length(scratch_.solver, scratch_.right, scratch_.response, parameter_);
    }

    /// By the half-width of a patch at the end of the step, in that of the contact.
    template <class Columns>
    void by_half_width(const System& system, const StagePlace<Scalar>& stage, Scalar rate, const Columns& columns) {
        by_axis(system, Shape::Axis::half_width, stage, rate, Scalar(0), columns);
        bounds_.respond(scratch_.solver, scratch_.right, scratch_.response, parameter_);
    }

    /// For the second stage, which starts from U + ratio (U_1 - U): what dp of the first adds to its constants, with
    /// the direct effect of the half-length by `progress` if that is the parameter.
    void carry(const System& system, Scalar ratio, Scalar progress) {
        carry(system, ratio, progress, scratch_.solver.traction(), scratch_.response, scratch_.carried[parameter_]);
        if constexpr (directions == 2) {
            if (scratch_.solver.keeps_plain()) {
                carry(system, ratio, progress, scratch_.solver.plain_traction(), scratch_.solver.plain_response(),
                      scratch_.plain_carried[parameter_]);
            }
        }
        bounds_.carry_response(parameter_);
    }

private:
    using Shape = ShapeInfluence<Scalar>;

    void carry(const System& system, Scalar ratio, Scalar progress, const Vectors& traction, const Vectors& response,
               Vectors& carried) {
        find_displacements(system, axes(), response, carried);
        const bool by_length = parameter_ == TangentBy<directions>::half_length;
        bool is_patch = false;
        if constexpr (directions == 2) {
            is_patch = system.shapes() != nullptr;
            if (is_patch && (by_length || parameter_ == TangentBy<directions>::half_width)) {
                shape(system).add_displacement_rates(by_length ? Shape::Axis::half_length : Shape::Axis::half_width,
                                                     progress, traction, carried);
            }
        }
        if (by_length && !is_patch) {
            add_displacement_rates(system, scratch_.stage.half_length, progress, traction, scratch_.change, carried);
        }
        carried *= -ratio;
    }

    SemiAxes<Scalar> axes() const { return {scratch_.stage.half_length, scratch_.stage.half_width}; }
    Shape shape(const System& system) const { return Shape(*system.shapes(), system.a_over_b(), scratch_.stage); }

    // The rigid slip of spin changes by both rates times its `columns`.
    template <class Columns>
    void by_axis(const System& system, typename Shape::Axis axis, const StagePlace<Scalar>& stage, Scalar first_rate,
                 Scalar second_rate, const Columns& columns) {
        add([&](const Vectors& p, Vectors& right) {
            add_turned(first_rate, second_rate, columns, right);
            shape(system).add_rates(scratch_.stage, axis, stage.part, stage.progress, p, scratch_.change, right);
        });
    }

    // Calls with the stage's tractions and dc; also with those for slip that is not turned, if angles follow them.
    template <class Add>
    void add(const Add& call) {
        call(scratch_.solver.traction(), scratch_.right);
        if constexpr (directions == 2) {
            if (scratch_.solver.keeps_plain()) call(scratch_.solver.plain_traction(), scratch_.solver.plain_change());
        }
    }

    Bounds& bounds_;
    Scratch& scratch_;
    std::size_t parameter_;
};

}  // namespace rollbem::detail
