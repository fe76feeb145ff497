// Bodies of normal/wheel_on_rail.hpp. Internal.
#pragma once

#include "../wheel_on_rail.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../detail/curve_index.hpp"
#include "../detail/finite_position.hpp"
#include "../detail/highest_place.hpp"
#include "../detail/plane_patches.hpp"
#include "../detail/profile_doubts.hpp"
#include "../detail/rail_samples.hpp"
#include "../detail/region_solver.hpp"
#include "../detail/silhouette_search.hpp"
#include "../profile_file.hpp"

namespace rollbem::detail {

/// The place of the rail in the track: the gauge is measured where the rail's inner side is narrowest down to
/// gauge_depth below its top; the top is at z = 0 (EN 13848-1).
inline WheelOnRail::Dimensions::Origin origin_by_gauge(const Profile& rail, const WheelOnRail::Dimensions& d) {
    const auto root = [](double low, double high, const auto& rises) {
        for (int k = 0; k < 60; ++k) (rises((low + high) / 2) ? low : high) = (low + high) / 2;
        return low;
    };
    Eigen::Index top = 0;
    rail.z().minCoeff(&top);
    const double z_top = rail.at(highest_place(rail)).z;
    // from the top inwards, as far as the depth
    Eigen::Index below = top;
    while (below > 0 && rail.z()[below] - z_top < d.gauge_depth) --below;
    const bool other = rail.z().tail(rail.size() - top).maxCoeff() - z_top >= d.gauge_depth;
    require(rail.z()[below] - z_top >= d.gauge_depth, "WheelOnRail", "depth of the rail's inner side",
            rail.z()[below] - z_top,
            other ? "be at least the gauge_depth, as its side at positive y is: --rail-mirror y for a left rail, or "
                    "give rail_origin"
                  : "be at least the gauge_depth; without an inner side give rail_origin");
    const double deepest =
        root(rail.s()[below], rail.s()[below + 1], [&](double s) { return rail.at(s).z - z_top >= d.gauge_depth; });
    double narrowest = rail.at(deepest).y;
    for (Eigen::Index i = below; i < top; ++i) {
        const double from = (std::max)(rail.s()[i], deepest), to = rail.s()[i + 1];
        if (rail.at(from).slope[0] < 0 && rail.at(to).slope[0] > 0) {
            narrowest =
                (std::min)(narrowest, rail.at(root(from, to, [&](double s) { return rail.at(s).slope[0] < 0; })).y);
        }
        narrowest = (std::min)(narrowest, rail.at(to).y);
    }
    return {d.gauge / 2 - narrowest, -z_top};
}

}  // namespace rollbem::detail

namespace rollbem {

ROLLBEM_DECL WheelOnRail::Geometry::Geometry(WheelSurface wheel, RailSurface rail,
                                             const WheelOnRail::Dimensions& dimensions)
    : wheel_(std::move(wheel)), rail_(std::move(rail)), dimensions_(dimensions) {
    constexpr const char* who = "WheelOnRail";
    const WheelOnRail::Dimensions& d = dimensions_;
    detail::require_positive(who, "gauge", d.gauge);
    detail::require_positive(who, "gauge_depth", d.gauge_depth);
    detail::require_finite(who, "flange_back", d.flange_back);
    detail::require_finite(who, "tape_offset", d.tape_offset);
    detail::require_positive(who, "radius", d.radius);
    detail::require_positive(who, "shear_modulus", d.shear_modulus);
    detail::require_poisson_ratio(who, d.poisson_ratio);
    detail::require_positive(who, "compliance (1 - poisson_ratio) / shear_modulus", compliance());
    if (wheel_.is_round()) require_wheel(wheel_.profile(), d.tape_offset);
    if (!rail_.has_sections()) require_rail(rail_.profile());
    if (d.rail_origin) {
        detail::require_finite(who, "rail_origin.y", d.rail_origin->y);
        detail::require_finite(who, "rail_origin.z", d.rail_origin->z);
        origin_ = *d.rail_origin;
    } else {
        detail::require(rail_.is_straight(), who, "rail_origin", "not given",
                        "be given for a roller and for a rail that changes along the track");
        origin_ = detail::origin_by_gauge(rail_.profile(), d);
    }
    wheel_origin_ = d.flange_back / 2 + d.tape_offset;
    if (is_plain()) {
        auto index = std::make_shared<detail::CurveIndex>();
        index->build(detail::rail_samples(*this, 0));
        index_ = std::move(index);
        const auto is_rough = [](const Profile& of) { return detail::median_noise(of.y(), of.z()).is_rough(); };
        rough_ = is_rough(wheel_.profile()) && is_rough(rail_.profile());
    }
}

ROLLBEM_DECL auto WheelOnRail::Geometry::rail_at(double s, double x) const -> RailSurface::Point {
    RailSurface::Point p = rail_.at(s, x);
    p.y += origin_.y;
    p.z += origin_.z;
    return p;
}

ROLLBEM_DECL double RailPatch::vertical_load() const {
    return detail::vertical_load(pressure, grid, rail_slope, angle);
}

ROLLBEM_DECL double RailPatch::in_rows(const Eigen::ArrayXd& rows, double s) const {
    const double row = std::clamp((s - grid.y_0) / grid.dy, 0.0, double(grid.ny - 1));
    const auto low = (std::min)(Eigen::Index(row), grid.ny - 2);
    return rows[low] + (row - double(low)) * (rows[low + 1] - rows[low]);
}

}  // namespace rollbem

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

ROLLBEM_DECL WheelOnRail::RigidContact rigid_contact(const WheelOnRail& wheel, const WheelsetPosition& position) {
    const WheelOnRail::Geometry& geometry = wheel.geometry();
    detail::require(geometry.is_plain(), "rigid_contact", "sections of wheel and rail", "several",
                    "be one: a round wheel on a straight rail");
    WheelOnRail::RigidContact contact;
    const WheelsetPosition used{.lateral = position.lateral, .roll = position.roll, .yaw = position.yaw};
    if (!detail::is_finite(used)) return contact;
    detail::SilhouetteSearch search;
    contact.status = search.locate(geometry, used);
    if (contact.status != Status::ok) return contact;
    const std::optional<detail::PenetrationSample> point = search.first_point();
    if (!point) {
        contact.status = Status::end_of_profile;
        return contact;
    }
    const Profile::Point on_wheel = wheel.wheel().at(point->wheel_s);
    // the deepest sample touches, this point lies a little below the rail
    const double raised = point->closest.depth / std::cos(point->closest.angle());
    contact.height = search.touch() - raised;
    contact.x = point->x;
    contact.y = point->y;
    contact.z = point->z - raised;
    contact.rail_y = point->y - wheel.rail_origin();
    contact.wheel_y = on_wheel.y;
    contact.wheel_s = point->wheel_s;
    contact.angle = point->closest.angle();
    contact.rolling_radius = wheel.dimensions().radius + on_wheel.z;
    return contact;
}

}  // namespace rollbem
