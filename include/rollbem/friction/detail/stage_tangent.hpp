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
/// scratch.response.
template <class Frame>
void respond(Frame& frame, std::size_t parameter) {
    constexpr int directions = Frame::directions;
    using By = TangentBy<directions>;
    auto& scratch = frame.scratch;
    auto& solver = scratch.solver;
    const auto add = [&](const auto& traction, auto& right) {
        if (parameter < By::creepages) frame.slip.add_rate(frame, parameter, right);
        if (!is_axis<directions>(parameter)) return;
        const Axis axis = axis_of<directions>(parameter);
        frame.slip.add_rate(frame, axis, !changes_shape(*frame.system), right);
        with_equations(*frame.system, frame.stage, [&](const auto& equations) {
            equations.add_rates(axis, frame.place, traction, scratch.change, right);
        });
    };
    const auto begin = [&](const auto& carried, auto& right) {
        if (frame.place.is_second) {
            right = carried;
        } else {
            right.setZero();
        }
    };
    begin(scratch.carried[parameter], scratch.right);
    add(solver.traction(), scratch.right);
    if constexpr (directions == 2) {  // for slip that is not turned, if angles follow it
        begin(scratch.plain_carried[parameter], solver.plain_change());
        if (solver.keeps_plain()) add(solver.plain_traction(), solver.plain_change());
    }
    if (parameter == By::load) {
        frame.bounds.respond(solver, scratch.right, scratch.response, parameter, &scratch.bound_rate,
                             frame.place.progress);
    } else if (parameter == By::half_length) {
        frame.bounds.respond_to_half_length(solver, scratch.right, scratch.response, parameter);
    } else {
        frame.bounds.respond(solver, scratch.right, scratch.response, parameter);
    }
}

/// For the next stage, which starts from U + ratio (U_1 - U): what dp of this one, after respond(), adds to its
/// constants, with the direct effect of a semi-axis if that is the parameter.
template <class Frame>
void carry_response(Frame& frame, std::size_t parameter) {
    constexpr int directions = Frame::directions;
    auto& scratch = frame.scratch;
    auto& solver = scratch.solver;
    const auto carry = [&](const auto& traction, const auto& response, auto& carried) {
        with_equations(*frame.system, frame.stage, [&](const auto& equations) {
            equations.find_displacements(response, carried);
            if (!is_axis<directions>(parameter)) return;
            equations.add_displacement_rates(axis_of<directions>(parameter), frame.place.progress, traction,
                                             scratch.change, carried);
        });
        carried *= -frame.place.ratio();
    };
    carry(solver.traction(), scratch.response, scratch.carried[parameter]);
    if constexpr (directions == 2) {
        if (solver.keeps_plain()) {
            carry(solver.plain_traction(), solver.plain_response(), scratch.plain_carried[parameter]);
        }
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
            scratch.solver.respond(frame.slip.unit(), scratch.response);
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
    if (scratch.tangent_revision != scratch.solver.roles_revision()) {
        scratch.solver.respond(frame.slip.unit(), scratch.response);
        scratch.unit_tangent = areas.dot(scratch.response);
        scratch.solver.respond(scratch.carried[0], scratch.response);
        scratch.carried_tangent = areas.dot(scratch.response);
        scratch.tangent_revision = scratch.solver.roles_revision();
    }
    // without a first stage, carried_tangent is that of an earlier step
    const auto last = frame.per_end() * scratch.unit_tangent, carried = frame.carried_per_end();
    return carried == 0 ? last : last + carried * scratch.carried_tangent;
}

/// Adds the tangents at the end of the last or only stage to the result.
template <class Frame, class Forces, class Step>
void add_tangents(Frame& frame, const Forces& forces, Step& step) {
    constexpr int directions = Frame::directions;
    using By = TangentBy<directions>;
    const auto& scratch = frame.scratch;
    if constexpr (Frame::keeps_tangents) step.tangent = forces.unit(frame.end) * kept_tangent(frame, forces.areas());
    for_responses(frame, [&](std::size_t parameter) {
        if (is_axis<directions>(parameter)) {
            const Axis axis = axis_of<directions>(parameter);
            const bool follows = keeps_shape(*frame.system);  // the half-width follows
            (axis == Axis::half_length ? step.tangent_by_half_length : step.tangent_by_half_width) =
                forces.rate(scratch.start, scratch.response, frame.end, axis, follows);
            if constexpr (directions == 2) {
                if (follows) step.tangent_by_half_width = {0, 0, 0};
            }
            return;
        }
        const auto caused = forces.of(scratch.response, frame.end);
        if (parameter == By::load) {
            step.tangent_by_load = caused;
        } else if constexpr (directions == 1) {
            step.tangent = caused;
        } else {
            auto& by = step.tangent;
            (parameter == 0 ? by.by_longitudinal : parameter == 1 ? by.by_lateral : by.by_spin) = caused;
        }
    });
}

}  // namespace rollbem::detail
