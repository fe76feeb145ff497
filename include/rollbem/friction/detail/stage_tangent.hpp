// Derivatives of the tractions of a solved stage by a creepage, the load or the half-length, including the contribution
// of an earlier stage.
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "../../rolling/stage_equations.hpp"
#include "../../types.hpp"
#include "directions.hpp"
#include "scratch.hpp"

namespace rollbem::detail {

/// Derivatives with respect to one parameter of the stage that `bounds` have solved last in scratch.solver, while no
/// element changes its zone. Each leaves dp in scratch.response.
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

    /// By a semi-axis at the end of the step, in that of the contact. The rigid slip of spin follows the points: it
    /// changes by `rate` times `columns` in the directions that the axis stretches.
    template <class Columns>
    void by_axis(const System& system, Axis axis, const StagePlace<Scalar>& place, Scalar rate,
                 const Columns& columns) {
        const bool by_length = axis == Axis::half_length;
        const Scalar across = by_length && changes_shape(system) ? Scalar(0) : rate;
        add([&](const Vectors& p, Vectors& right) {
            if constexpr (directions == 2) add_turned(across, by_length ? rate : Scalar(0), columns, right);
            with_equations(system, scratch_.stage,
                           [&](const auto& equations) { equations.add_rates(axis, place, p, scratch_.change, right); });
        });
        if (by_length) {
            bounds_.respond_to_half_length(scratch_.solver, scratch_.right, scratch_.response, parameter_);
        } else {
            bounds_.respond(scratch_.solver, scratch_.right, scratch_.response, parameter_);
        }
    }

    /// For the next stage, which starts from U + ratio (U_1 - U): what dp of this one adds to its constants, with the
    /// direct effect of a semi-axis if that is the parameter.
    void carry(const System& system, const StagePlace<Scalar>& place) {
        carry(system, place, scratch_.solver.traction(), scratch_.response, scratch_.carried[parameter_]);
        if constexpr (directions == 2) {
            if (scratch_.solver.keeps_plain()) {
                carry(system, place, scratch_.solver.plain_traction(), scratch_.solver.plain_response(),
                      scratch_.plain_carried[parameter_]);
            }
        }
        bounds_.carry_response(parameter_);
    }

private:
    using By = TangentBy<directions>;

    void carry(const System& system, const StagePlace<Scalar>& place, const Vectors& traction, const Vectors& response,
               Vectors& carried) {
        with_equations(system, scratch_.stage, [&](const auto& equations) {
            equations.find_displacements(response, carried);
            if (parameter_ != By::half_length && parameter_ != By::half_width) return;
            const Axis axis = parameter_ == By::half_length ? Axis::half_length : Axis::half_width;
            equations.add_displacement_rates(axis, place.progress, traction, scratch_.change, carried);
        });
        carried *= -place.ratio();
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
