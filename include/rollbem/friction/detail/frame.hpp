// FrictionFrame: a step with friction, or steady rolling, while its stages are solved, and the tangents of its result.
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../rolling/rigid_slip.hpp"
#include "../../rolling/stage_equations.hpp"
#include "../../rolling/step_frame.hpp"
#include "../../scene/directions.hpp"
#include "../../scene/rigid_motion.hpp"
#include "../../system/element_blocks.hpp"
#include "../../types.hpp"
#include "../state.hpp"
#include "scratch.hpp"

namespace rollbem::detail {

/// The load at the end of a step: pressures [Pa] of at least all unknown elements, half-length and half-width [m].
struct StepLoad {
    const ArrayX<double>& pressure;
    double half_length, half_width;
    const ArrayX<double>* pressure_rate = nullptr;  ///< d pressure / d load; null without a load of its own
};

/// The input of a step or of steady rolling. Its load has been checked and, for a step, its motion.
template <int directions>
struct FrictionRequest {
    const FrictionState<directions>& from;
    rollbem::Travel<double> travel;
    const RigidMotion<CreepageAlong<directions, double>>& motion;
    StepLoad load;
};

template <int directions, class Bounds>
struct FrictionFrame : StepFrame<CreepageAlong<directions, double>, double> {
    using By = TangentBy<directions>;
    using Vectors = ElementVectors<directions>;

    const FrictionRequest<directions>& request;
    const ElementSystem<double, directions>& system;
    const RigidSlip<directions, double>& slip;
    FrictionScratch<directions>& scratch;
    Bounds bounds;
    FrictionStep<directions> result{};  ///< sums over all stages so far
    bool tangent_exists = true;

    /// Sets the constants c of a stage: the rigid slip minus `displacement`.
    void impose(const Vectors& displacement, Vectors& constant) const {
        constant = -displacement;
        this->add_motion(slip, constant);
        if (this->motion.has_rows()) {
            const double share = this->place.progress;
            constant += this->factor() * ((1 - share) * this->motion.start_rows() + share * this->motion.end_rows());
        }
        // without creepage tractions decay for ever, but the rounding errors by which solutions are judged underflow
        // first
        const bool has_decayed = constant.cwiseAbs().maxCoeff() < negligible<double> && all_finite(constant);
        if (has_decayed) constant.setZero();
    }

    /// Keeps the responses of the first of two stages for the second.
    void carry_responses() {
        this->for_parameters([&](std::size_t parameter) {
            if (respond(parameter)) carry_response(parameter);
        });
    }
    /// Adds the tangents at the end of the last or only stage to the result.
    void add_tangents(const ContactForces<directions, double>& forces) {
        const auto& solver = scratch.solver;
        const bool follows = keeps_shape(system);  // the half-width follows the half-length
        this->for_parameters([&](std::size_t parameter) {
            auto& tangent = tangent_by(parameter);
            if (!respond(parameter)) return void(tangent = kept().tangent);
            const auto& dp = solver.response();
            tangent = force_along<directions, double>(
                By::is_axis(parameter) ? forces.rate(solver.traction(), dp, this->end, By::axis(parameter), follows)
                                       : forces.of(dp, this->end));
            if (is_kept(parameter)) kept().tangent = tangent;
        });
        if constexpr (directions == 2) {
            if (follows && this->asked[By::half_length]) result.tangent_by_half_width = {0, 0, 0};
        }
    }

private:
    KeptResponse<directions>& kept() {
        return scratch.kept[this->place.is_second ? 2 : this->place.is_last() ? 1 : 0];
    }
    static bool is_kept(std::size_t parameter) { return directions == 1 && parameter == 0; }

    // Finds dp of the last solved stage with respect to a parameter (TangentBy), while no element changes its zone; the
    // solver holds dp. False, and dp is not computed, if the KeptResponse still holds.
    bool respond(std::size_t parameter) {
        auto& solver = scratch.solver;
        const auto revision = bounds.linearise(solver);
        if (is_kept(parameter)) {
            KeptResponse<directions>& kept = this->kept();
            const bool is_known =
                revision && revision == kept.revision && kept.per_end == this->per_end() && kept.axes == this->end;
            if (is_known) return false;
            kept.revision = revision;
            kept.per_end = this->per_end();
            kept.axes = this->end;
        }
        typename StickSlip<directions>::Change change;
        for (std::size_t which = 0; which < solver.constant_count(); ++which) {
            Vectors& right = scratch.right[which];
            if (this->place.is_second) {
                right = scratch.carried[which][parameter];
            } else {
                right.setZero();
            }
            with_equations(system, this->stage, [&](const auto& equations) {
                this->add_rate(parameter, slip, equations, solver.traction(which), scratch.change, right);
            });
            change.constant[which] = &right;
        }
        if (parameter == By::load) {
            scratch.stage_bound_rate = this->place.progress * scratch.bound_rate;
            change.bound = &scratch.stage_bound_rate;
        }
        bounds.respond(solver, change, parameter);
        return true;
    }

    // Keeps the change that dp of this stage, found by respond(), causes in the constants of the next stage.
    void carry_response(std::size_t parameter) {
        const auto& solver = scratch.solver;
        for (std::size_t which = 0; which < solver.constant_count(); ++which) {
            with_equations(system, this->stage, [&](const auto& equations) {
                StepFrame<CreepageAlong<directions, double>, double>::carry_response(
                    parameter, equations, solver.traction(which), solver.response(which), scratch.change,
                    scratch.carried[which][parameter]);
            });
        }
        bounds.carry_response(parameter);
        if (parameter == 0) scratch.kept[2].revision.reset();
    }

    auto& tangent_by(std::size_t parameter) {
        if (parameter == By::load) return result.tangent_by_load;
        if (parameter == By::half_length) return result.tangent_by_half_length;
        if (parameter == By::half_width) return result.tangent_by_half_width;
        return by_creepage(result.tangent, parameter);
    }
};

}  // namespace rollbem::detail
