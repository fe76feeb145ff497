// Bodies of normal/wheel_on_rail.hpp. Internal.
#pragma once

#include "../wheel_on_rail.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../detail/finite_position.hpp"
#include "../detail/region_solver.hpp"

namespace rollbem::detail {

inline void check(const WheelOnRail::Options& options) {
    constexpr const char *who = "WheelOnRail", *few = "be at least 5";
    require(options.cells_x >= 5, who, "cells_x", options.cells_x, few);
    require(options.cells_s >= 5, who, "cells_s", options.cells_s, few);
    require(options.tolerance > 0 && options.tolerance < 1, who, "tolerance", options.tolerance,
            "be positive and below 1");
    const double size = options.cell_size;
    require(size == 0 || (size >= 1e-5 && size <= 1), who, "cell_size", size, "be 0 or lie in [1e-5, 1]");
}

inline ContactSettings settings(const WheelOnRail::Options& options) {
    return {options.cells_x,   options.cells_s,     options.tolerance,
            options.cell_size, options.interaction, options.halves_cells};
}

/// The height at which coarse grids carry the load.
inline Status approach_load(RegionSolver& solver, double load, double& approach) {
    // loads grow like the power 3/2 of the approach
    if (!(approach > 0)) approach = 2e-5 * std::cbrt(load / 1e4 * (load / 1e4));
    double low = 0, high = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 60; ++k) {
        solver.divide(solver.touch() + approach);
        const double found = solver.carried();
        if (std::abs(found / load - 1) < 0.02) return Status::ok;
        (found < load ? low : high) = approach;
        if (high - low < 1e-3 * high) return Status::ok;  // loads jump where regions join
        const double to = found > 0 ? approach * std::pow(load / found, 2.0 / 3) : 2 * approach;
        const bool safe = to > low && to < high && (k < 8 || !is_finite(high));
        approach = safe ? to : is_finite(high) ? (low + high) / 2 : 2 * approach;
    }
    return Status::load_not_reached;
}

/// The tolerance of pressures by which cells are judged, before these are found on the cells that suffice.
inline double roughly(double tolerance) { return (std::max)(tolerance, 1e-4); }

/// The height at which fine grids carry the load.
inline Status settle_height(RegionSolver& solver, double load, double tolerance, bool first, double& approach,
                            double& lower) {
    // planes rotate with the height: secants on the missing load
    double last = 0, step = 0, rate = -1;
    for (int round = first ? 0 : 1, k = 0; k < 12; ++round, ++k) {
        round = solver.refine(solver.touch() + approach, round, k < 3, k == 0);
        std::optional<double> missing = solver.lower_until(load, k == 0 ? roughly(tolerance) : tolerance);
        while (k == 0 && missing && solver.double_cells()) {
            solver.refine(solver.touch() + approach, 1, false, true);
            missing = solver.lower_until(load, roughly(tolerance));
        }
        if (!missing) return Status::load_not_reached;
        lower = *missing;
        const bool settled = std::abs(lower) < 1e-3 * solver.deepest() && !solver.outgrown();
        if (k > 0) rate = std::clamp((lower - last) / step, -10.0, -0.1);
        last = lower;
        step = settled ? lower : -lower / rate;
        approach += step;
        if (settled && k > 0) return Status::ok;
    }
    lower = step;
    return std::abs(last) < 1e-2 * solver.deepest() ? Status::ok : Status::load_not_reached;
}

inline void collect(const RegionSolver& solver, double lower, WheelOnRail::Contact& contact) {
    contact.height = solver.height() + lower;
    contact.patches = solver.patches(lower);
    contact.dropped = solver.carried();
    for (const RailPatch& patch : contact.patches) contact.dropped -= patch.vertical_load();
    contact.status = contact.patches.empty() ? Status::no_contact : Status::ok;
    for (const RailPatch& patch : contact.patches) contact.status = (std::max)(contact.status, patch.status);
    if (solver.is_too_deep()) contact.status = (std::max)(contact.status, Status::too_deep);
    if (has_numbers(contact.status) && solver.outgrown()) contact.status = Status::not_converged;
}

}  // namespace rollbem::detail

namespace rollbem {

ROLLBEM_DECL auto WheelOnRail::solve_for_load(const WheelsetPosition& position, double load, Workspace& workspace,
                                              const Options& options) const -> Contact {
    detail::check(options);
    Contact contact;
    if (!detail::is_finite(position) || !detail::is_finite(load)) return contact;
    contact.status = Status::no_contact;
    if (!(load > 0)) return contact;
    detail::RegionSolver& solver = workspace.solver_.made();
    contact.status = solver.locate(geometry_, position, detail::settings(options));
    if (contact.status != Status::ok) return contact;
    double approach = workspace.approach_;
    contact.status = detail::approach_load(solver, load, approach);
    if (contact.status != Status::ok) return contact;
    double lower = 0;
    // again if a patch has got too few cells for an outline
    for (bool first = true; first || (contact.status == Status::few_cells && solver.double_cells()); first = false) {
        const Status settled = detail::settle_height(solver, load, options.tolerance, first, approach, lower);
        if (settled != Status::ok) {
            contact.status = first ? settled : Status::few_cells;
            return contact;
        }
        workspace.approach_ = approach;
        detail::collect(solver, lower, contact);
    }
    return contact;
}

ROLLBEM_DECL auto WheelOnRail::solve_at_height(const WheelsetPosition& position, Workspace& workspace,
                                               const Options& options) const -> Contact {
    detail::check(options);
    Contact contact;
    if (!detail::is_finite(position)) return contact;
    detail::RegionSolver& solver = workspace.solver_.made();
    contact.status = solver.locate(geometry_, position, detail::settings(options));
    if (contact.status != Status::ok) return contact;
    solver.divide(position.height);
    solver.refine(position.height, 0, true, true);
    solver.settle(0, detail::roughly(options.tolerance), false);
    for (bool first = true; first || contact.status == Status::few_cells; first = false) {
        bool doubled = false;
        while (solver.double_cells()) {
            doubled = true;
            solver.refine(position.height, 1, false, true);
            solver.settle(0, detail::roughly(options.tolerance), true);
        }
        if (!first && !doubled) break;
        solver.settle(0, options.tolerance, true);
        for (int k = 0; k < 8 && solver.outgrown(); ++k) {
            solver.refine(position.height, 1, true, false);
            solver.settle(0, options.tolerance, true);
        }
        detail::collect(solver, 0, contact);
    }
    return contact;
}

}  // namespace rollbem
