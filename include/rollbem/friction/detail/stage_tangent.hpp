// Derivatives of the tractions of a solved stage by a creepage, the load or a semi-axis, with the contribution of an
// earlier stage.
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "../../rolling/stage_equations.hpp"
#include "scratch.hpp"

namespace rollbem::detail {

/// dp of the stage of a friction frame that was solved last, by one of TangentBy while no element changes its zone, in
/// the solver. False, and nothing found, if it is the KeptResponse.
template <class Frame>
bool respond(Frame& frame, std::size_t parameter) {
    constexpr int directions = Frame::directions;
    using By = TangentBy<directions>;
    auto& scratch = frame.scratch;
    auto& solver = scratch.solver;
    typename Frame::Change change;
    for (std::size_t which = 0; which < solver.constant_count(); ++which) {
        auto& right = scratch.right[which];
        if (frame.place.is_second) {
            right = scratch.carried[which][parameter];
        } else {
            right.setZero();
        }
        if (parameter < By::creepages) frame.slip.add_rate(frame, parameter, right);
        if (By::is_axis(parameter)) {
            const Axis axis = By::axis(parameter);
            frame.slip.add_rate(frame, axis, !changes_shape(frame.system), right);
            with_equations(frame.system, frame.stage, [&](const auto& equations) {
                equations.add_rates(axis, frame.place, solver.traction(which), scratch.change, right);
            });
        }
        change.constant[which] = &right;
    }
    if (parameter == By::load) {
        scratch.stage_bound_rate = frame.place.progress * scratch.bound_rate;
        change.bound = &scratch.stage_bound_rate;
    }
    const auto revision = frame.bounds.linearise(solver);
    if (directions == 1 && parameter < By::creepages) {
        auto& kept = scratch.kept[frame.place.is_last() ? 1 : 0];
        if (revision && revision == kept.revision && same_bits(scratch.right[0], kept.right)) return false;
        kept.revision = revision;
        kept.right = scratch.right[0];
    }
    frame.bounds.respond(solver, change, parameter);
    return true;
}

/// For the next stage, which starts from U + ratio (U_1 - U): what dp of this one, after respond(), adds to its
/// constants, with the direct effect of a semi-axis if that is the parameter.
template <class Frame>
void carry_response(Frame& frame, std::size_t parameter) {
    using By = TangentBy<Frame::directions>;
    auto& scratch = frame.scratch;
    const auto& solver = scratch.solver;
    for (std::size_t which = 0; which < solver.constant_count(); ++which) {
        auto& carried = scratch.carried[which][parameter];
        with_equations(frame.system, frame.stage, [&](const auto& equations) {
            equations.find_displacements(solver.response(which), carried);
            if (!By::is_axis(parameter)) return;
            equations.add_displacement_rates(By::axis(parameter), frame.place.progress, solver.traction(which),
                                             scratch.change, carried);
        });
        carried *= -frame.place.ratio();
    }
    frame.bounds.carry_response(parameter);
}

/// Calls use(parameter, is_new) after respond() by the creepages, and by what is asked for.
template <class Frame, class Use>
void for_responses(Frame& frame, const Use& use) {
    using By = TangentBy<Frame::directions>;
    const auto find = [&](std::size_t parameter) { use(parameter, respond(frame, parameter)); };
    for (std::size_t j = 0; j < frame.slip.creepage_count(); ++j) find(j);
    if (frame.asked.by_load) find(By::load);
    if (frame.asked.by_half_length) find(By::half_length);
    if constexpr (Frame::directions == 2) {
        if (frame.asked.by_half_width) find(By::half_width);
    }
}

/// What the second of two stages needs of the responses of the first.
template <class Frame>
void carry_responses(Frame& frame) {
    for_responses(frame, [&](std::size_t parameter, bool is_new) {
        if (is_new) carry_response(frame, parameter);
    });
}

/// The tangent by one of TangentBy.
template <int directions, class Step>
auto& tangent_by(Step& step, std::size_t parameter) {
    using By = TangentBy<directions>;
    if (parameter == By::load) return step.tangent_by_load;
    if (parameter == By::half_length) return step.tangent_by_half_length;
    if (parameter == By::half_width) return step.tangent_by_half_width;
    if constexpr (directions == 1) {
        return step.tangent;
    } else {
        auto& by = step.tangent;
        return parameter == 0 ? by.by_longitudinal : parameter == 1 ? by.by_lateral : by.by_spin;
    }
}

/// Adds the tangents at the end of the last or only stage to the result.
template <class Frame, class Forces>
void add_tangents(Frame& frame, const Forces& forces) {
    constexpr int directions = Frame::directions;
    using By = TangentBy<directions>;
    const auto& solver = frame.scratch.solver;
    const bool follows = keeps_shape(frame.system);  // the half-width the half-length
    auto& kept = frame.scratch.kept[frame.place.is_last() ? 1 : 0];
    auto& step = frame.result;
    for_responses(frame, [&](std::size_t parameter, bool is_new) {
        auto& tangent = tangent_by<directions>(step, parameter);
        if (By::is_axis(parameter)) {
            tangent = forces.rate(solver, frame.end, By::axis(parameter), follows);
        } else if (is_new) {
            tangent = forces.of(solver.response(), frame.end);
            if constexpr (directions == 1) {
                if (parameter == 0) kept.tangent = tangent / forces.unit(frame.end);
            }
        } else if constexpr (directions == 1) {
            tangent = kept.tangent * forces.unit(frame.end);
        }
    });
    if constexpr (directions == 2) {
        if (follows && frame.asked.by_half_length) step.tangent_by_half_width = {0, 0, 0};
    }
}

}  // namespace rollbem::detail
