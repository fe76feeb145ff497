// Bodies of status.hpp. Internal.
#pragma once

#include "../status.hpp"

namespace rollbem {

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
