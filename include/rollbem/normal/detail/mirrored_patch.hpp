// The mirror image of a contact patch. Internal.
#pragma once

#include "../../detail/language.hpp"

#include <Eigen/Core>

#include "../../scene/detail/mirror.hpp"
#include "../wheel_on_rail.hpp"

namespace rollbem::detail {

/// The mirror image of a patch. Lengths along the profiles stay as they are.
inline RailPatch mirrored(RailPatch patch, const Mirror& mirror) {
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

}  // namespace rollbem::detail
