// Status: the outcome of a computation, with its name for messages and tables. A broken precondition throws; a
// computation that fails reports it here.
#pragma once

#include "detail/language.hpp"

namespace rollbem {

/// Whether a result can be used, and if not, why.
enum class Status {
    ok,
    ill_conditioned,   ///< the matrix is singular to working precision, or the residual is far above rounding
    assists_creepage,  ///< solved accurately, but the tractions of steady rolling assist the creepage: the scheme does
                       ///< not converge to full adhesion, as with alpha <= 0 or alpha > 1
    unstable,          ///< a mode of the system grows with the distance rolled
    order_differs,     ///< values to be extrapolated do not converge with the given order

    // statuses of a step, or of a solution with friction that starts from a state
    /// Friction: no solution was found to rounding; the complementarity residual is the distance from one. With finite
    /// bounds a solution always exists, so this happens only with matrices that are singular to rounding, and with
    /// friction that depends on slip without a memory.
    no_solution,
    invalid_step,  ///< the distance rolled is not positive and finite, or below 1e-292 (for a rigid shift: negative or
                   ///< not finite), or the model's system has G' alone, which knows steady rolling only
    wrong_state,   ///< a state or workspace of another system, or the same object as `from` and `to`
    invalid_load,  ///< a pressure is negative or not finite, their number differs from the number of elements, or the
                   ///< half-length is not positive and finite
    /// The mesh cannot follow the half-length. Use a fixed mesh on the largest contact, whose elements gain and lose
    /// pressure, in the last case with the strip kernel. Either
    ///
    /// - the half-length changes by at least the distance that the step rolls;
    /// - the system knows only one half-length (the strip kernel, Galerkin, ready matrices); or
    /// - the contact has grown so long (a > 2.4b) that the plane kernel is unstable, Lambda <= 0.
    needs_fixed_mesh,
    needs_places,  ///< spin other than zero, although the system does not know the points of its equations (ready
                   ///< matrices)
    wrong_table,  ///< a table of forces for another Poisson's ratio, or for ellipses although the contact is an outline
    unresolved,   ///< the contact on a fixed mesh is narrower than three of its strips or elements: forces are too
                  ///< rough

    // statuses of the contact of profiles, from the mildest to the worst
    doubtful_plane,     ///< numbers, but surfaces turn by more than 0.2 rad over the contact: a plane is an assumption
    unbalanced,         ///< numbers, but normal forces and friction did not settle, or a wheel does not roll
    no_contact,         ///< the surfaces do not touch: a wheel is lifted, or beside the rail
    end_of_profile,     ///< contact reaches the end of a profile, which is not known beyond
    beyond_clearance,   ///< a wheel would climb over its flange, or a motion would leave the rails
    undefined_section,  ///< the wheel's section is not a function there: yaw is too large
    too_deep,           ///< the wheel lies more than a millimetre within the rail: a position that cannot be intended
    load_not_reached,   ///< no height was found at which the contact carries the load
    not_converged,  ///< pressures did not settle; the order of a polynomial is too low, or monomials have broken down
                    ///< by cancellation; other meshes of a long patch give other coefficients
    few_cells,      ///< pressures need smaller cells, or fewer than 7 cells touch
    not_finite,     ///< an input or a result is NaN or infinite
};

using StepStatus = Status;  ///< its name before 0.5

/// Whether the contact of profiles has numbers.
constexpr bool has_numbers(Status status) {
    return status == Status::ok || status == Status::doubtful_plane || status == Status::unbalanced;
}

/// The name of a status as spelt in this header.
constexpr const char* name(Status status) {
    switch (status) {
        case Status::ok: return "ok";
        case Status::ill_conditioned: return "ill_conditioned";
        case Status::assists_creepage: return "assists_creepage";
        case Status::unstable: return "unstable";
        case Status::order_differs: return "order_differs";
        case Status::no_solution: return "no_solution";
        case Status::invalid_step: return "invalid_step";
        case Status::wrong_state: return "wrong_state";
        case Status::invalid_load: return "invalid_load";
        case Status::needs_fixed_mesh: return "needs_fixed_mesh";
        case Status::needs_places: return "needs_places";
        case Status::wrong_table: return "wrong_table";
        case Status::unresolved: return "unresolved";
        case Status::doubtful_plane: return "doubtful_plane";
        case Status::unbalanced: return "unbalanced";
        case Status::no_contact: return "no_contact";
        case Status::end_of_profile: return "end_of_profile";
        case Status::beyond_clearance: return "beyond_clearance";
        case Status::undefined_section: return "undefined_section";
        case Status::too_deep: return "too_deep";
        case Status::load_not_reached: return "load_not_reached";
        case Status::not_converged: return "not_converged";
        case Status::few_cells: return "few_cells";
        case Status::not_finite: break;
    }
    return "not_finite";
}

}  // namespace rollbem
