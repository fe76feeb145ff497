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

}  // namespace rollbem::detail
