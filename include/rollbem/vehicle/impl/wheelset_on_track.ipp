// Bodies of vehicle/wheelset_on_track.hpp. Internal.
#pragma once

#include "../wheelset_on_track.hpp"

#include <algorithm>
#include <cmath>

#include "../../detail/finite.hpp"
#include "../../detail/rising_root.hpp"
#include "../../normal/detail/finite_position.hpp"
#include "../detail/slip_velocity.hpp"

namespace rollbem {

ROLLBEM_DECL Creepage<double> creepage_of(const RailPatch& patch, const WheelsetPosition& at,
                                          const WheelsetSpeeds& speeds, double radius) {
    const Creepage<double> slip = detail::SlipVelocity(patch, at, speeds, radius).at_reference();
    const double speed = std::abs(rolling_velocity_of(patch, speeds));
    return {slip.longitudinal / speed, slip.lateral / speed, slip.spin / speed};
}

ROLLBEM_DECL Eigen::MatrixX2d curved_slip_of(const RailPatch& patch, const WheelsetPosition& at,
                                             const WheelsetSpeeds& speeds, double radius, const Eigen::ArrayXd& x,
                                             const Eigen::ArrayXd& s) {
    const detail::SlipVelocity slip(patch, at, speeds, radius);
    const double speed = std::abs(rolling_velocity_of(patch, speeds));
    const Creepage<double> linear = creepage_of(patch, at, speeds, radius);
    const CellGrid& grid = patch.grid;
    const Eigen::ArrayXd middle = (patch.rail_n + patch.wheel_n) / 2;
    Eigen::MatrixX2d rows(x.size(), 2);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        const double row = std::clamp((s[i] - grid.y(0)) / grid.dy, 0.0, double(grid.ny - 1) - 1e-9);
        const auto j = static_cast<Eigen::Index>(row);
        const double part = row - double(j), n = (1 - part) * patch.wheel_n[j] + part * patch.wheel_n[j + 1];
        const Creepage<double> here = slip(x[i], s[i], n, std::atan((middle[j + 1] - middle[j]) / grid.dy));
        rows(i, 0) = here.longitudinal / speed - (linear.longitudinal - linear.spin * s[i]);
        rows(i, 1) = here.lateral / speed - (linear.lateral + linear.spin * x[i]);
    }
    return rows;
}

ROLLBEM_DECL PatchContact<double> contact_of(const RailPatch& patch, const TrackDimensions& dimensions) {
    detail::require(patch.outline.has_value(), "contact_of", "status of the patch", name(patch.status), "be ok");
    return {*patch.outline, dimensions.shear_modulus, dimensions.poisson_ratio};
}

ROLLBEM_DECL PressureGrid<double> pressure_of(const RailPatch& patch) {
    const CellGrid& grid = patch.grid;
    return {Eigen::ArrayXd::LinSpaced(grid.nx, grid.x(0), grid.x(grid.nx - 1)),
            Eigen::ArrayXd::LinSpaced(grid.ny, grid.y(0), grid.y(grid.ny - 1)), patch.pressure.matrix()};
}

ROLLBEM_DECL auto WheelsetOnTrack::solve(WheelsetPosition position, const std::array<double, 2>& loads,
                                         Workspace& workspace, Free free, const WheelOnRail::Options& options) const
    -> Contacts {
    Contacts contacts;
    WheelOnRail::Options cells = options;
    // height of the right wheel minus height of the left one; a roll lowers the right wheel, so that the gap falls
    const auto gap = [&](double roll) {
        position.roll = roll;
        for (const Side side : sides) {
            const auto k = static_cast<std::size_t>(side);
            WheelsetPosition at = seen_from(side, position);
            at.height += height_above(side);
            WheelOnRail::Options of = cells;
            // without numbers of the one wheel there are none of the other
            if (free == Free::height_and_roll && side == Side::right) {
                of.halves_cells = of.halves_cells && has_numbers(contacts.wheels[0].status);
            }
            contacts.wheels[k] = free == Free::nothing
                                     ? wheels_[k].solve_at_height(at, workspace.wheels[k], of)
                                     : wheels_[k].solve_for_load(at, loads[k], workspace.wheels[k], of);
        }
        contacts.status = (std::max)(contacts.wheels[0].status, contacts.wheels[1].status);
        return contacts.wheels[1].height - (contacts.wheels[0].height - height_above(Side::left));
    };
    // the roll on the given cells, then on those that suffice
    if (free == Free::height_and_roll) cells.halves_cells = false;
    double roll = position.roll, excess = gap(roll);
    contacts.position = position;
    if (free != Free::height_and_roll) return contacts;
    // contacts, and with them heights, jump a little where grids change
    constexpr double precise = 1e-10, small = 1e-8, jump = 1e-6;  // tolerances of the height [m]
    const detail::RisingRoot anywhere(wheels_[0].wheel_origin() + wheels_[1].wheel_origin(), 5e-3);
    detail::RisingRoot root = anywhere;
    const auto refined = [&] { return cells.halves_cells == options.halves_cells; };
    // a patch with few cells at one roll need not have few at the next
    const auto goes_on = [&] {
        return has_numbers(contacts.status) || (contacts.status == Status::few_cells && !cells.halves_cells);
    };
    for (int k = 0, fine = 0; k < 60 && goes_on(); ++k) {
        fine += refined();
        const bool found =
            std::abs(excess) <= (fine > 2 ? small : precise) || (root.width() < 1e-10 && std::abs(excess) < jump);
        if (found && refined()) break;
        if (!found) roll = root.next(roll, -excess);
        if (!refined() && std::abs(excess) < jump) {
            cells.halves_cells = options.halves_cells;
            root = anywhere;
        }
        excess = gap(roll);
    }
    if (has_numbers(contacts.status) && std::abs(excess) > jump) contacts.status = Status::load_not_reached;
    if (!has_numbers(contacts.status)) {
        for (WheelOnRail::Contact& wheel : contacts.wheels) wheel.status = contacts.status;
    }
    position.height = (contacts.wheels[0].height - height_above(Side::left) + contacts.wheels[1].height) / 2;
    contacts.position = position;
    return contacts;
}

}  // namespace rollbem
