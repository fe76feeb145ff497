// FrictionFrame: a step with friction, or steady rolling, while its stages are solved, and the tangents of its result.
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "../../rolling/stage_equations.hpp"
#include "../../rolling/step_frame.hpp"
#include "../../scene/rigid_motion.hpp"
#include "../../system/element_blocks.hpp"
#include "../../types.hpp"
#include "../state.hpp"
#include "contact_forces.hpp"
#include "imposed_slip.hpp"
#include "scratch.hpp"

namespace rollbem::detail {

/// The load at the end of a step: pressures [Pa] of at least all unknown elements, half-length and half-width [m].
template <class Scalar>
struct StepLoad {
    const ArrayX<Scalar>& pressure;
    Scalar half_length, half_width;
    const ArrayX<Scalar>* pressure_rate = nullptr;  ///< of a step under a load of its own, else null
};

/// What is asked for. The load has been checked, and in a step the motion.
template <int directions, class Scalar>
struct FrictionRequest {
    const FrictionState<directions, Scalar>& from;
    rollbem::Travel<Scalar> travel;
    const RigidMotion<CreepageAlong<directions, Scalar>>& motion;
    StepLoad<Scalar> load;
};

template <int directions, class Scalar, class Bounds>
struct FrictionFrame : StepFrame<CreepageAlong<directions, Scalar>, Scalar> {
    /// Derivatives in addition to those by the creepages.
    struct Asked {
        bool by_load = false, by_half_length = false, by_half_width = false;
    };

    const FrictionRequest<directions, Scalar>& request;
    const ElementSystem<Scalar, directions>& system;
    const ImposedSlip<directions, Scalar>& slip;
    FrictionScratch<directions, Scalar>& scratch;
    Bounds bounds;
    Asked asked{};
    FrictionStep<directions, Scalar> result{};  ///< of all stages so far
    bool tangent_exists = true;

    /// Keeps what the second of two stages needs of the responses of the first.
    void carry_responses() {
        for_responses([&](std::size_t parameter, bool is_new) {
            if (is_new) carry_response(parameter);
        });
    }
    /// Adds the tangents at the end of the last or only stage to the result.
    void add_tangents(const ContactForces<directions, Scalar>& forces) {
        const auto& solver = scratch.solver;
        const bool follows = keeps_shape(system);  // the half-width the half-length
        for_responses([&](std::size_t parameter, bool is_new) {
            auto& tangent = tangent_by(parameter);
            if (By::is_axis(parameter)) {
                tangent = forces.rate(solver, this->end, By::axis(parameter), follows);
            } else if (is_new) {
                tangent = forces.of(solver.response(), this->end);
            }
            if constexpr (directions == 1) {
                if (parameter != 0) return;
                if (is_new) kept().tangent = forces.areas().dot(solver.response());
                tangent = forces.unit(this->end) * kept().tangent;
            }
        });
        if constexpr (directions == 2) {
            if (follows && asked.by_half_length) result.tangent_by_half_width = {0, 0, 0};
        }
    }

private:
    using By = TangentBy<directions>;
    using Vectors = ElementVectors<Scalar, directions>;

    KeptResponse<Scalar>& kept() { return scratch.kept[this->place.is_second ? 2 : this->place.is_last() ? 1 : 0]; }

    // Calls use(parameter, is_new) after respond() by the creepages, and by what is asked for.
    template <class Use>
    void for_responses(const Use& use) {
        const auto find = [&](std::size_t parameter) { use(parameter, respond(parameter)); };
        for (std::size_t j = 0; j < slip.creepage_count(); ++j) find(j);
        if (asked.by_load) find(By::load);
        if (asked.by_half_length) find(By::half_length);
        if (asked.by_half_width) find(By::half_width);
    }

    // Finds dp of the stage that was solved last, by one of TangentBy while no element changes its zone, in the solver.
    // False, and nothing found, if it is the KeptResponse.
    bool respond(std::size_t parameter) {
        auto& solver = scratch.solver;
        const auto revision = bounds.linearise(solver);
        if (directions == 1 && parameter == 0) {
            if (revision && revision == kept().revision && kept().per_end == this->per_end()) return false;
            kept().revision = revision;
            kept().per_end = this->per_end();
        }
        typename StickSlip<directions, Scalar>::Change change;
        for (std::size_t which = 0; which < solver.constant_count(); ++which) {
            Vectors& right = scratch.right[which];
            if (this->place.is_second) {
                right = scratch.carried[which][parameter];
            } else {
                right.setZero();
            }
            if (parameter < By::creepages) slip.add_rate(*this, parameter, right);
            if (By::is_axis(parameter)) {
                const Axis axis = By::axis(parameter);
                slip.add_rate(*this, axis, !changes_shape(system), right);
                with_equations(system, this->stage, [&](const auto& equations) {
                    equations.add_rates(axis, this->place, solver.traction(which), scratch.change, right);
                });
            }
            change.constant[which] = &right;
        }
        if (parameter == By::load) {
            scratch.stage_bound_rate = this->place.progress * scratch.bound_rate;
            change.bound = &scratch.stage_bound_rate;
        }
        bounds.respond(solver, change, parameter);
        return true;
    }

    // For the next stage, which starts from U + ratio (U_1 - U): what dp of this one, after respond(), adds to its
    // constants, with the direct effect of a semi-axis if that is the parameter.
    void carry_response(std::size_t parameter) {
        const auto& solver = scratch.solver;
        for (std::size_t which = 0; which < solver.constant_count(); ++which) {
            Vectors& carried = scratch.carried[which][parameter];
            with_equations(system, this->stage, [&](const auto& equations) {
                equations.find_displacements(solver.response(which), carried);
                if (!By::is_axis(parameter)) return;
                equations.add_displacement_rates(By::axis(parameter), this->place.progress, solver.traction(which),
                                                 scratch.change, carried);
            });
            carried *= -this->place.ratio();
        }
        bounds.carry_response(parameter);
        if (parameter == 0) scratch.kept[2].revision.reset();
    }

    auto& tangent_by(std::size_t parameter) {
        if (parameter == By::load) return result.tangent_by_load;
        if (parameter == By::half_length) return result.tangent_by_half_length;
        if (parameter == By::half_width) return result.tangent_by_half_width;
        if constexpr (directions == 1) {
            return result.tangent;
        } else {
            auto& by = result.tangent;
            return parameter == 0 ? by.by_longitudinal : parameter == 1 ? by.by_lateral : by.by_spin;
        }
    }
};

}  // namespace rollbem::detail
