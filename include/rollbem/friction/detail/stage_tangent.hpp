// Derivatives of the tractions of a solved stage by a creepage, the load or a semi-axis, with the contribution of an
// earlier stage.
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "../../rolling/stage_equations.hpp"
#include "scratch.hpp"

namespace rollbem::detail {

/// The semi-axis of a parameter of TangentBy that is one.
template <int directions>
constexpr Axis axis_of(std::size_t parameter) {
    return parameter == TangentBy<directions>::half_length ? Axis::half_length : Axis::half_width;
}
template <int directions>
constexpr bool is_axis(std::size_t parameter) {
    return parameter >= TangentBy<directions>::half_length;
}

/// dp of the stage of a friction frame that was solved last, by one of TangentBy while no element changes its zone, in
/// the solver.
template <class Frame>
void respond(Frame& frame, std::size_t parameter) {
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
        if (is_axis<directions>(parameter)) {
            const Axis axis = axis_of<directions>(parameter);
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
    frame.bounds.respond(solver, change, parameter);
}

/// For the next stage, which starts from U + ratio (U_1 - U): what dp of this one, after respond(), adds to its
/// constants, with the direct effect of a semi-axis if that is the parameter.
template <class Frame>
void carry_response(Frame& frame, std::size_t parameter) {
    constexpr int directions = Frame::directions;
    auto& scratch = frame.scratch;
    const auto& solver = scratch.solver;
    for (std::size_t which = 0; which < solver.constant_count(); ++which) {
        auto& carried = scratch.carried[which][parameter];
        with_equations(frame.system, frame.stage, [&](const auto& equations) {
            equations.find_displacements(solver.response(which), carried);
            if (!is_axis<directions>(parameter)) return;
            equations.add_displacement_rates(axis_of<directions>(parameter), frame.place.progress,
                                             solver.traction(which), scratch.change, carried);
        });
        carried *= -frame.place.ratio();
    }
    frame.bounds.carry_response(parameter);
}

/// Calls use(parameter) after respond() by the creepages, unless their tangents are kept, and by what is asked for.
template <class Frame, class Use>
void for_responses(Frame& frame, const Use& use) {
    using By = TangentBy<Frame::directions>;
    const auto find = [&](std::size_t parameter) {
        respond(frame, parameter);
        use(parameter);
    };
    for (std::size_t j = 0; !Frame::keeps_tangents && j < frame.slip.creepage_count(); ++j) find(j);
    if (frame.asked.by_load) find(By::load);
    if (frame.asked.by_half_length) find(By::half_length);
    if constexpr (Frame::directions == 2) {
        if (frame.asked.by_half_width) find(By::half_width);
    }
}

/// What the second of two stages needs of the responses of the first; of kept ones that to a unit of the constants.
template <class Frame>
void carry_responses(Frame& frame) {
    if constexpr (Frame::keeps_tangents) {
        auto& scratch = frame.scratch;
        if (scratch.carried_revision != scratch.solver.roles_revision()) {
            scratch.solver.respond({{&frame.slip.unit()}});
            carry_response(frame, 0);
            scratch.carried_revision = scratch.solver.roles_revision();
            scratch.tangent_revision = scratch.never;
        }
    }
    for_responses(frame, [&](std::size_t parameter) { carry_response(frame, parameter); });
}

/// The sum of areas times the response to the creepage at the end of a step, by those to units of the constants, which
/// are kept as long as the sticking elements.
template <class Frame, class Areas>
auto kept_tangent(const Frame& frame, const Areas& areas) {
    auto& scratch = frame.scratch;
    auto& solver = scratch.solver;
    if (scratch.tangent_revision != solver.roles_revision()) {
        solver.respond({{&frame.slip.unit()}});
        scratch.unit_tangent = areas.dot(solver.response());
        solver.respond({{&scratch.carried[0][0]}});
        scratch.carried_tangent = areas.dot(solver.response());
        scratch.tangent_revision = solver.roles_revision();
    }
    // without a first stage, carried_tangent is that of an earlier step
    const auto last = frame.per_end() * scratch.unit_tangent, carried = frame.carried_per_end();
    return carried == 0 ? last : last + carried * scratch.carried_tangent;
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
template <class Frame, class Forces, class Step>
void add_tangents(Frame& frame, const Forces& forces, Step& step) {
    constexpr int directions = Frame::directions;
    const auto& solver = frame.scratch.solver;
    const bool follows = keeps_shape(frame.system);  // the half-width the half-length
    if constexpr (Frame::keeps_tangents) step.tangent = forces.unit(frame.end) * kept_tangent(frame, forces.areas());
    for_responses(frame, [&](std::size_t parameter) {
        tangent_by<directions>(step, parameter) =
            is_axis<directions>(parameter)
                ? forces.rate(solver, frame.end, axis_of<directions>(parameter), follows)
                : forces.of(solver.response(), frame.end);
    });
    if constexpr (directions == 2) {
        if (follows && frame.asked.by_half_length) step.tangent_by_half_width = {0, 0, 0};
    }
}

}  // namespace rollbem::detail
