// Bodies of normal/rail_patch.hpp. Internal.
#pragma once

#include "../rail_patch.hpp"

#include <algorithm>
#include <utility>

#include "../detail/plane_patches.hpp"

namespace rollbem {

ROLLBEM_DECL double RailPatch::vertical_load() const {
    return detail::vertical_load(pressure, grid, rail_slope, angle);
}

ROLLBEM_DECL double RailPatch::in_rows(const Eigen::ArrayXd& rows, double s) const {
    const double row = std::clamp((s - grid.y_0) / grid.dy, 0.0, double(grid.ny - 1));
    const auto low = (std::min)(Eigen::Index(row), grid.ny - 2);
    return rows[low] + (row - double(low)) * (rows[low + 1] - rows[low]);
}

ROLLBEM_DECL RailPatch mirrored(RailPatch patch, const Mirror& mirror) {
    const auto [x, y, z] = mirror.of_vector();
    patch.x *= x;
    for (double* of : {&patch.y, &patch.rail_y, &patch.wheel_y, &patch.angle}) *of *= y;
    if (x < 0) {
        patch.grid.x_0 = -patch.grid.x(patch.grid.nx - 1);
        patch.pressure = patch.pressure.colwise().reverse().eval();
    }
    if (y < 0) {
        patch.grid.y_0 = -patch.grid.y(patch.grid.ny - 1);
        patch.pressure = patch.pressure.rowwise().reverse().eval();
        for (Eigen::ArrayXd* of : {&patch.rail_n, &patch.wheel_n}) *of = of->reverse().eval();
        patch.rail_slope = -patch.rail_slope.reverse().eval();
    }
    if (patch.outline) patch.outline = mirrored(*patch.outline, mirror);
    return patch;
}

}  // namespace rollbem
